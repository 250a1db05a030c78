"""How long a fleet takes as files are cut finer: stragglers, lost workers, and what each task costs besides.

Simulates W workers that take files from one queue. A file's work is lognormal around its share, some workers are slow,
now and then one is lost and its file is begun again elsewhere. Writes a table of docs/scale.md.

    python python/benchmarks/stragglers.py
"""

from __future__ import annotations

import heapq

import numpy as np

#: Seconds of work of all files together, and those that a task costs besides: it is sent, and reads and writes a file.
WORK, TASK = 100 * 600.0, 0.05
WORKERS = 100
#: The standard deviation of the logarithm of a file's work; the share of slow workers, and how much slower these are.
SPREAD, SLOW, SLOWER = 0.2, 0.05, 3.0
#: Losses of a worker in an hour, and seconds until another stands in its place.
LOSSES, AGAIN = 0.5, 60.0


def makespan(files: int, draw: np.random.Generator) -> float:
    """When the last file is done."""
    work = WORK / files * np.exp(SPREAD * draw.standard_normal(files) - SPREAD**2 / 2)
    pace = np.where(draw.random(WORKERS) < SLOW, SLOWER, 1.0)
    free = [(0.0, worker) for worker in range(WORKERS)]
    heapq.heapify(free)
    left, done = list(work), 0.0
    while left:
        task = left.pop()
        at, worker = heapq.heappop(free)
        takes = TASK + task * pace[worker]
        lost = draw.exponential(3600 / LOSSES)
        if lost < takes:
            left.append(task)
            heapq.heappush(free, (at + lost + AGAIN, worker))
        else:
            done = max(done, at + takes)
            heapq.heappush(free, (at + takes, worker))
    return done


def main() -> None:
    """Simulates and prints."""
    ideal = WORK / WORKERS
    print(f"| files for each worker | work of a file | time, median | 95 % | against {ideal:.0f} s |")
    print("|--:|--:|--:|--:|--:|")
    for each in (1, 2, 4, 8, 16, 32, 64, 256, 1024):
        draw = np.random.default_rng(each)
        times = [makespan(each * WORKERS, draw) for _ in range(200 if each <= 64 else 20)]
        median, high = np.quantile(times, [0.5, 0.95])
        print(f"| {each} | {ideal / each:.2g} s | {median:.0f} s | {high:.0f} s | {median / ideal:.2f} |")


if __name__ == "__main__":
    main()

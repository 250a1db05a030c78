"""What a fleet costs on each engine: tracks a second, the start, memory. Writes the table of docs/scale.md.

python python/benchmarks/scale.py --copies 400 --files 16 --command target/release/givens
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any, NamedTuple

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

import fleet

import givens as gv


class Cost(NamedTuple):
    """Of one way to run the files."""

    start: float
    seconds: float
    megabytes: float
    processes: int


def resident() -> tuple[float, int]:
    """Megabytes of this process and all below it, shared pages counted once for each, and how many there are."""
    parents: dict[int, list[int]] = {}
    sizes: dict[int, int] = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                fields = (entry / "stat").read_text().rpartition(")")[2].split()
            except OSError:
                continue
            parents.setdefault(int(fields[1]), []).append(int(entry.name))
            sizes[int(entry.name)] = int(fields[21]) * os.sysconf("SC_PAGE_SIZE")
    total, count, left = 0, 0, [os.getpid()]
    while left:
        one = left.pop()
        total, count = total + sizes.get(one, 0), count + 1
        left += parents.get(one, [])
    return total / 1e6, count


@contextmanager
def watched() -> Iterator[list[tuple[float, int]]]:
    """Looks at the memory every 50 ms."""
    seen, done = [resident()], threading.Event()

    def look() -> None:
        while not done.wait(0.05):
            seen.append(resident())

    thread = threading.Thread(target=look)
    thread.start()
    try:
        yield seen
    finally:
        done.set()
        thread.join()


def measured(engine: Callable[..., Any], run: Any, files: list[Path]) -> Cost:
    """An engine: it starts, and then maps the run over the files."""
    before, _ = resident()
    with watched() as seen:
        begun = time.perf_counter()
        with engine() as over:
            over(time.time, 2)
            started = time.perf_counter()
            over(run, files)
            ended = time.perf_counter()
    megabytes, processes = max(seen)
    return Cost(started - begun, ended - started, megabytes - before, processes - 1)


@contextmanager
def alone(threads: int) -> Iterator[Any]:
    """Within the process itself."""

    def over(run: Any, files: Any) -> Any:
        if not isinstance(files, int):
            run.job._asked = threads
            return [run(file) for file in files]
        return None

    yield over


@contextmanager
def pool(workers: int) -> Iterator[Any]:
    """Processes of the standard library."""
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as executor:
        yield (
            lambda run, files: (
                [executor.submit(run).result() for _ in range(files)]
                if isinstance(files, int)
                else list(executor.map(run, files))
            )
        )


@contextmanager
def dask(workers: int) -> Iterator[Any]:
    """A LocalCluster."""
    import distributed

    settings = {"n_workers": workers, "threads_per_worker": 1, "dashboard_address": None, "silence_logs": 50}
    with distributed.LocalCluster(**settings) as cluster, distributed.Client(cluster) as client:
        yield (
            lambda run, files: (
                [client.submit(run, pure=False).result() for _ in range(files)]
                if isinstance(files, int)
                else client.gather(client.map(run, files, pure=False))
            )
        )


@contextmanager
def ray(workers: int) -> Iterator[Any]:
    """Ray on this machine."""
    import ray

    ray.init(num_cpus=workers, include_dashboard=False, log_to_driver=False)

    def over(run: Any, files: Any) -> Any:
        task = ray.remote(lambda *file: run(*file))
        return ray.get(
            [task.remote() for _ in range(files)] if isinstance(files, int) else list(map(task.remote, files))
        )

    yield over
    ray.shutdown()


@contextmanager
def command(words: list[Any]) -> Iterator[Any]:
    """The command over the folder of the files."""
    yield lambda _, files: isinstance(files, int) or subprocess.run(words, check=True, capture_output=True)


def main() -> None:
    """Measures and prints."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--copies", type=int, default=400)
    options.add_argument("--files", type=int, default=16)
    options.add_argument("--repeat", type=int, default=3)
    options.add_argument("--command", type=Path)
    asked = options.parse_args()
    ways = {
        "one process, 1 thread": lambda: alone(1),
        "one process, 2 threads": lambda: alone(2),
        "processes, 1": lambda: pool(1),
        "processes, 2": lambda: pool(2),
        "Dask, 1 worker": lambda: dask(1),
        "Dask, 2 workers": lambda: dask(2),
        "Ray, 1 CPU": lambda: ray(1),
        "Ray, 2 CPUs": lambda: ray(2),
    }
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        files = fleet.write_files(place / "data", asked.copies, asked.files)
        job = fleet.model().batch_job(goal="smooth")
        total = sum(map(job.into(place / "first"), files), gv.Summary())
        rows = sum(fleet.rows_of(file) for file in files)
        size = [sum(file.stat().st_size for file in place.joinpath(of).iterdir()) for of in ("data", "first")]
        print(
            f"{rows} rows of {total.tracks} tracks in {len(files)} files; bytes a row: {size[0] / rows:.1f} in, ",
            end="",
        )
        print(f"{size[1] / rows:.1f} out\n")
        print("| | start | run | tracks/s | rows/s | memory | processes |\n|---|--:|--:|--:|--:|--:|--:|")

        def line(name: str, costs: list[Cost]) -> None:
            start, seconds = (statistics.median(getattr(cost, of) for cost in costs) for of in ("start", "seconds"))
            spread = (max(cost.seconds for cost in costs) - min(cost.seconds for cost in costs)) / 2
            memory = max(cost.megabytes for cost in costs)
            each = f"{total.tracks / seconds:,.0f} | {rows / seconds:,.0f} | {memory:,.0f} MB | {costs[0].processes}"
            print(f"| {name} | {start:.1f} s | {seconds:.2f} ± {spread:.2f} s | {each} |", flush=True)

        for name, way in ways.items():
            run = fleet.model().batch_job(goal="smooth").into(place / "answers")
            try:
                line(name, [measured(way, run, files) for _ in range(asked.repeat)])
            except ImportError as error:
                print(f"| {name} | {error} | | | | | |")
        for threads in (1, 2) if asked.command else ():
            words = [asked.command, "smooth", fleet.FOLDER / "fleet.toml", place / "data", "-o", place / "command"]

            own = partial(command, [*words, "--threads", str(threads)])
            costs = [measured(own, None, files) for _ in range(asked.repeat)]
            line(f"the command, {threads} thread{'s'[: threads - 1]}", costs)


if __name__ == "__main__":
    main()

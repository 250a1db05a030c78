"""What a contestant says to the runner, as benchmarks/protocol has it for Rust; and the inputs."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path

import numpy as np

CONTESTANT, WORKLOAD, INPUTS = sys.argv[1:4]


def rows(name: str) -> np.ndarray:
    return np.loadtxt(Path(INPUTS) / f"{name}.csv", delimiter=",", skiprows=1, ndmin=2)


def tracks() -> np.ndarray:
    """W2's, 1000 x 100 x 2."""
    return np.fromfile(Path(INPUTS) / "plane_tracks.f32", "<f4").reshape(-1, 100, 2).astype(float)


def report(means: np.ndarray, covs: np.ndarray, every: int) -> np.ndarray:
    """Means, then variances, of every `every`-th row."""
    means, covs = np.asarray(means)[every - 1 :: every], np.asarray(covs)[every - 1 :: every]
    return np.concatenate([means, np.diagonal(covs, axis1=-2, axis2=-1)], axis=-1)


def lacks(reason: str) -> None:
    print(f"lacks\t{reason}")
    sys.exit()


def serve(packages: str, steps: int, result: np.ndarray, go: Callable[[], object]) -> None:
    """Speaks to the runner. The time is that of the whole process: libraries compute in threads of their own."""
    words = ", ".join(f"{name} {version(name)}" for name in packages.split())
    numbers = " ".join(repr(float(x)) for x in np.ravel(result))
    print(f"version\t{words}\nsteps\t{steps}\nresult\t{numbers}\nready\t", flush=True)
    for _ in sys.stdin:
        cpu, wall = time.process_time_ns(), time.perf_counter_ns()
        go()
        print(time.process_time_ns() - cpu, time.perf_counter_ns() - wall, flush=True)

"""The times that the package promises, measured: `python python/benchmarks/targets.py`.

* `import givens` takes less than 150 ms, NumPy included;
* the first result of a fresh process takes less than 50 ms from the first line of the model on;
* a traced model takes less than 1.5 times as long as the same model written in Rust: seven states, one filter.

Everything is measured in fresh interpreters that take turns, in seconds of the processor for the calling thread,
because others may use the machine; the least and the median of all are told. The model in Rust is the example
`turn_rows`, which cargo builds.
"""

from __future__ import annotations

import json
import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
ROUNDS = int(os.environ.get("ROUNDS", "15"))
ROWS = 500

#: Seconds.
PROMISED = {"import givens": 0.150, "first result, turn": 0.050, "first result, plane": 0.050}
#: A traced model over the same one written in Rust.
PROMISED_RATIO = 1.5


def imports() -> dict[str, float]:
    """Seconds for NumPy and for the rest."""
    begin = time.thread_time()
    import numpy  # noqa: F401

    between = time.thread_time()
    import givens  # noqa: F401

    end = time.thread_time()
    return {"import numpy": between - begin, "import givens after it": end - between, "import givens": end - begin}


def turn(rows: int = 100) -> dict[str, Any]:
    """The turning flight in continuous time, seven states: what `gv.filter` is given."""
    import numpy as np

    import givens as gv

    def drift(t: Any, x: Any) -> Any:
        return [x[1], -x[6] * x[3], x[3], x[6] * x[1], x[5], 0, 0]

    def radar(t: Any, x: Any) -> Any:
        ground = np.hypot(x[0], x[2])
        return [np.hypot(ground, x[4]), np.arctan2(x[2], x[0]), np.arctan2(x[4], ground)]

    mean = [1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 0.1]
    velocity = 0.4472135954999579
    names = ["e", "ve", "n", "vn", "z", "vz", "w"]
    spread = {"ve": velocity, "vn": velocity, "vz": velocity, "w": 7e-3}
    model = gv.Sde(drift, diffusion=spread, state=names)
    std = [50.0, *[np.radians(0.1)] * 2]
    sensor = gv.Sensor(radar, measures=["r", "az", "el"], std=std, angles=["az"])
    t = np.arange(1.0, rows + 1)
    e, n = 2500 + 1500 * np.sin(0.1 * t) - 1500, 1150 + 1500 * np.cos(0.1 * t)
    wave = np.sin(np.outer(t, [12.9898, 78.233, 37.719]))
    z = np.stack([np.sqrt(e**2 + n**2 + 200**2), np.arctan2(n, e), np.arctan2(200, np.hypot(e, n))], -1) + std * wave
    prior = gv.Gaussian(mean, std=[*[100.0] * 6, 0.02])
    return {"model": model, "sensors": sensor, "t": t, "z": z, "prior": prior, "t0": 0.0, "method": "sr-cd-ckf"}


def plane(rows: int = 100) -> dict[str, Any]:
    """The coordinated turn in the plane, five states, discrete."""
    import numpy as np

    import givens as gv

    def f(t: Any, dt: Any, x: Any) -> Any:
        w = np.where(np.abs(x[4]) < 1e-9, 1e-9, x[4])
        s, c = np.sin(w * dt), np.cos(w * dt)
        along, across = s / w, (1 - c) / w
        east, north = x[0] + along * x[1] - across * x[3], x[2] + across * x[1] + along * x[3]
        return [east, c * x[1] - s * x[3], north, s * x[1] + c * x[3], x[4]]

    def noise(t: Any, dt: Any, *, q1: float = 0.1, q2: float = 1.75e-4) -> Any:
        block = q1 * np.array([[dt**3 / 3, dt**2 / 2], [dt**2 / 2, dt]])
        cov = np.zeros((5, 5))
        cov[:2, :2] = cov[2:4, 2:4] = block
        cov[4, 4] = q2 * dt
        return cov

    def radar(t: Any, x: Any) -> Any:
        return [np.hypot(x[0], x[2]), np.arctan2(x[2], x[0])]

    model = gv.Transition(f, noise_cov=noise, state=["x", "vx", "y", "vy", "w"])
    std = np.array([10.0, 0.00316])
    sensor = gv.Sensor(radar, measures=["range", "bearing"], std=std, angles=["bearing"])
    t = np.arange(1.0, rows + 1)
    x, y = 1000 + 6000 * np.sin(0.05 * t), 1000 - 6000 * (1 - np.cos(0.05 * t))
    z = np.stack([np.hypot(x, y), np.arctan2(y, x)], -1) + std * np.sin(np.outer(t, [12.9898, 78.233]))
    prior = gv.Gaussian([1000, 300, 1000, 0, -0.05], std=[10, 3.2, 10, 3.2, 0.01])
    return {"model": model, "sensors": sensor, "t": t, "z": z, "prior": prior, "t0": 0.0, "method": "sr-ckf"}


def first(problem: Callable[[], dict[str, Any]]) -> dict[str, float]:
    """Seconds from the model's first line to its estimates."""
    import givens as gv

    begin = time.thread_time()
    est = gv.filter(**problem())
    seconds = time.thread_time() - begin
    assert len(est.mean) == 100
    return {f"first result, {problem.__name__}": seconds}


def traced() -> dict[str, float]:
    """Seconds per row of a model that was traced before, of the fastest of many runs."""
    import givens as gv

    given = turn(ROWS)
    least = float("inf")
    for _ in range(40):
        begin = time.perf_counter()
        est = gv.filter(**given)
        least = min(least, time.perf_counter() - begin)
    _last.extend(est.mean[-1])
    return {"row, traced": least / ROWS}


#: The last mean that `traced` found.
_last: list[float] = []

MEASURES: dict[str, Callable[[], dict[str, float]]] = {
    "imports": imports,
    "turn": lambda: first(turn),
    "plane": lambda: first(plane),
    "traced": traced,
}


def rust() -> Callable[[], dict[str, float]]:
    """Builds the model in Rust; a function that runs it over the same rows."""
    words = ["cargo", "build", "--release", "-p", "givens", "--example", "turn_rows", "--message-format", "json"]
    built = subprocess.run(words, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout
    found = [json.loads(line).get("executable") for line in built.splitlines()]
    (program,) = filter(None, found)
    given = turn(ROWS)
    lines = [" ".join(map(repr, map(float, [t, *z]))) for t, z in zip(given["t"], given["z"], strict=True)]

    def run() -> dict[str, float]:
        said = subprocess.run([program], input="\n".join(lines), check=True, stdout=subprocess.PIPE, text=True).stdout
        nanoseconds, *mean = map(float, said.split())
        _last[:] = mean
        return {"row, Rust": nanoseconds * 1e-9}

    return run


def fresh(name: str) -> dict[str, float]:
    """A measurement in an interpreter of its own."""
    words = [sys.executable, __file__, name]
    # as installed, with bytecode
    env = {key: value for key, value in os.environ.items() if key != "PYTHONDONTWRITEBYTECODE"}
    return dict(json.loads(subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True, env=env).stdout))


def main() -> None:
    """Measures all, and prints a table."""
    in_rust = rust()
    for name in MEASURES:
        fresh(name)
    found: dict[str, list[float]] = {}
    for _ in range(ROUNDS):
        for measured in (*map(fresh, MEASURES), in_rust()):
            for name, seconds in measured.items():
                found.setdefault(name, []).append(seconds)
    for name, times in found.items():
        tell(name, times, 1e-3 if min(times) > 1e-3 else 1e-6, PROMISED.get(name))
    both = zip(found["row, traced"], found["row, Rust"], strict=True)
    tell("traced over Rust", [python / native for python, native in both], 1.0, PROMISED_RATIO)
    in_rust()
    own = [*_last]
    _last.clear()
    traced()
    print(f"the last means differ by {max(abs(a - b) for a, b in zip(own, _last, strict=True))}")


def tell(name: str, found: Sequence[float], unit: float, promised: float | None) -> None:
    """Prints a row of the table."""
    unit_name = {1e-3: "ms", 1e-6: "µs"}.get(unit, "")
    least, median = min(found) / unit, statistics.median(found) / unit
    kept = (
        "" if promised is None else f"  promised {promised / unit:g}: {'kept' if least < promised / unit else 'MISSED'}"
    )
    print(f"{name:24} least {least:8.3f} {unit_name:2}  median {median:8.3f} {unit_name:2}{kept}")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(json.dumps(MEASURES[sys.argv[1]]()))
    else:
        main()

"""Measurements as they come: a filter stepped by hand, with a gate against outliers, saved and resumed.

Run it with ``python python/examples/online.py``.
"""

import pickle
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

import givens as gv

Array = NDArray[np.float64]
GATE = 10.83  # 99.9 % of χ² with one degree of freedom


def straight(t: float, x: Array) -> list[float]:
    """Constant speed, but for noise."""
    return [x[1], 0.0]


def position(t: float, x: Array) -> Array:
    """What the ruler sees."""
    return x[:1]


def readings() -> Iterator[tuple[float, Array]]:
    """A cart at a metre a second; one reading in twenty is nonsense."""
    rng = np.random.default_rng(1)
    t = 0.0
    while t < 30.0:
        t += float(rng.exponential(0.3))
        nonsense = rng.random() < 0.05
        yield t, np.array([rng.uniform(-50, 50) if nonsense else t + 0.1 * rng.standard_normal()])


def main() -> None:
    """Follows the cart."""
    model = gv.Sde(straight, diffusion={"v": 0.1}, state=["s", "v"])
    ruler = gv.Sensor(position, measures=["s"], std=[0.1])
    f = gv.Filter(model, ruler, prior=gv.Gaussian([0.0, 0.0], std=[1.0, 2.0]), t0=0.0)

    rows, refused = 0, 0
    for t, z in readings():
        f.predict(t)
        trial = f.copy()
        trial.update(z)
        if trial.nis < GATE:
            f = trial
        else:
            refused += 1
        rows += 1
        if rows == 50:
            f = pickle.loads(pickle.dumps(f))
    print(f"{rows} readings, {refused} refused")
    print(f"at {f.time:.2f} s: {f.state.mean.round(3)} ± {f.state.std.round(3)}")


if __name__ == "__main__":
    main()

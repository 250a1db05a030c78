"""An oscillator in continuous time, measured seldom: its path, and its stiffness by likelihood.

Run it with ``python python/examples/oscillator.py``.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

import givens as gv

Array = NDArray[np.float64]


def oscillator(t: float, x: Array, *, stiffness: float = 1.0) -> list[Any]:
    """Van der Pol's: it keeps its amplitude."""
    return [x[1], stiffness * (1 - x[0] ** 2) * x[1] - x[0]]


def position(t: float, x: Array) -> Array:
    """Where it is; how fast is not seen."""
    return x[:1]


def main() -> None:
    """Draws data with stiffness 1.5, and finds it again."""
    model = gv.Sde(oscillator, diffusion={"v": 0.2}, state=["x", "v"])
    ruler = gv.Sensor(position, measures=["position"], std=[0.2])
    prior = gv.Gaussian([1.0, 0.0], std=[0.5, 0.5])

    # the drift is cubic: a solver finds the steps that are right for it
    run: dict[str, Any] = {"prior": prior, "t0": 0.0, "method": "sr-cd-ckf2"}
    t = np.sort(np.random.default_rng(1).uniform(0.0, 60.0, 80))
    drawn = gv.simulate(model.with_params(stiffness=1.5), ruler, t, prior=prior, t0=0.0, seed=1)

    values = np.linspace(0.5, 3.0, 51)
    likelihood = [
        gv.filter(model.with_params(stiffness=value), ruler, t, drawn.z, **run).total_log_likelihood for value in values
    ]
    best = float(values[np.argmax(likelihood)])
    print(f"stiffness {best:.2f}, drawn with 1.50")

    est = gv.smooth(model.with_params(stiffness=best), ruler, t, drawn.z, **run)
    print(est.consistency())
    print(est.at([10.0, 10.5, 11.0]).mean.round(3))


if __name__ == "__main__":
    main()

"""The README's flight: an aircraft tracked by radar, from a model file and a table.

Run it with ``python python/examples/flight.py``.
"""

from pathlib import Path

import numpy as np

import givens as gv

FLIGHT = Path(__file__).parents[2] / "examples" / "flight"


def main() -> None:
    """Smooths the detections, and compares the positions with the recorded ones."""
    model = gv.read_model(FLIGHT / "flight.toml")
    est = model.smooth(FLIGHT / "detections.csv")
    print(est)
    print(est.consistency())

    truth = np.genfromtxt(FLIGHT / "truth.csv", delimiter=",", names=True)
    rows = np.searchsorted(truth["time"], est.time)
    for name in ("east", "north", "up"):
        at = est.state.index(name)
        error = est.mean[:, at] - truth[name][rows]
        inside = np.mean(np.abs(error) < 2 * est.std[:, at])
        print(f"{name:>6}: RMSE {np.sqrt(np.mean(error**2)):6.1f} m, {inside:.1%} within 2σ")


if __name__ == "__main__":
    main()

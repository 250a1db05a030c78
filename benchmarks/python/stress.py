"""The Python peers on the ladders of tests/golden/stress.json: `stress.py PEER PRECISION FILE`, JSON on stdout.

What stands here is what tests/src/stress/peers.rs reads: a list of filters, of each by case the rungs, of each rung
the rows that it answered and the exception that stopped it, if one did.
"""

from __future__ import annotations

import json
import sys
import warnings
from collections.abc import Callable
from importlib.metadata import version

PEER, PRECISION, FILE = sys.argv[1:4]
if PEER in ("cuthbert", "dynamax"):
    import jax

    jax.config.update("jax_enable_x64", PRECISION == "f64")

import numpy as np  # noqa: E402
import stress_filters as own  # noqa: E402

#: Filters that take longer than a minute over a hundred thousand rows.
SLOW = {
    "CubatureKalmanFilter",
    "UnscentedKalmanFilter",
    "UnscentedKalmanFilter, square root",
    "unscented_kalman_filter",
}


def filters() -> list[tuple[str, bool, Callable]]:
    """Name, whether it asks the model at points, and the generator."""
    if PEER == "filterpy":
        from filterpy.kalman import KalmanFilter, SquareRootKalmanFilter

        return [
            ("KalmanFilter", False, own.filterpy_linear(KalmanFilter)),
            ("SquareRootKalmanFilter", False, own.filterpy_linear(SquareRootKalmanFilter)),
            ("CubatureKalmanFilter", True, own.filterpy_cubature),
            ("UnscentedKalmanFilter", True, own.filterpy_unscented),
        ]
    if PEER == "turbo-ckf":
        from turbo_ckf import TurboCKF, TurboSRCKF

        return [("TurboCKF", True, own.turbo(TurboCKF)), ("TurboSRCKF", True, own.turbo(TurboSRCKF))]
    if PEER == "kalman-py":
        return [
            ("KalmanFilter", False, own.kalman_py_linear(False)),
            ("KalmanFilter, square root", False, own.kalman_py_linear(True)),
            ("UnscentedKalmanFilter", True, own.kalman_py_unscented(False)),
            ("UnscentedKalmanFilter, square root", True, own.kalman_py_unscented(True)),
        ]
    if PEER == "cuthbert":
        return [("square root", False, own.cuthbert())]
    if PEER == "dynamax":
        return [("lgssm_filter", False, own.dynamax_linear), ("unscented_kalman_filter", True, own.dynamax_unscented)]
    sys.exit(f"no peer {PEER}: filterpy, turbo-ckf, kalman-py, cuthbert, dynamax")


def number(x) -> float | None:
    """JSON knows no number that is not finite."""
    return float(x) if np.isfinite(x) else None


def climb(rung: own.Rung, run: Callable) -> dict:
    rows, error = [], None
    try:
        for mean, cov in run(rung):
            if rung.repeat:
                rows.clear()
            triangle = [number(cov[i, j]) for i in range(rung.n) for j in range(i + 1)]
            rows.append({"mean": [number(x) for x in mean], "cov": triangle})
    except Exception as stopped:
        error = f"{type(stopped).__name__}: {stopped}"
        rows = [] if rung.repeat else rows
    return {"rows": rows, "error": error}


def main() -> None:
    warnings.simplefilter("ignore")
    np.seterr(all="ignore")
    with open(FILE) as file:
        cases = json.load(file)
    dtype = np.float32 if PRECISION == "f32" else np.float64
    out = []
    for name, points, run in filters():
        answers = {}
        for case, of in cases.items():
            rungs = of["rungs"]
            several = len(rungs[0]["steps"]) > 1
            fixed = several and "nscented" in name and PEER != "filterpy"  # one Q for all rows
            if "only" in rungs[0] or fixed or ("repeat" in rungs[0] and name in SLOW):
                continue
            # a linear filter has no place for an angle
            if "period" in rungs[0] and not points:
                continue
            answers[case] = [climb(own.Rung(rung, dtype), run) for rung in rungs]
            if answers[case][0]["error"]:
                print(f"{PEER} {name}: {case}, first rung: {answers[case][0]['error']}", file=sys.stderr)
        title = f"{PEER} {version('cuthbertlib' if PEER == 'cuthbert' else PEER)}, {name}"
        out.append({"name": title, "precision": PRECISION, "points": points, "cases": answers})
    json.dump(out, sys.stdout)


main()

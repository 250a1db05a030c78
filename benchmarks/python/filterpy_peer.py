"""FilterPy: its unscented filter with alpha = 1, beta = 0, kappa = 0, and its cubature filter."""

from __future__ import annotations

import numpy as np
from contest import CONTESTANT, WORKLOAD, report, rows, serve
from filterpy.kalman import CubatureKalmanFilter, MerweScaledSigmaPoints, UnscentedKalmanFilter
from problems import *


def filter_of(f, h, q, r, mean, cov):
    n, d = len(q), len(r)
    if CONTESTANT == "ckf":
        kf = CubatureKalmanFilter(n, d, 1.0, h, f)
        kf.x = mean.reshape(-1, 1).copy()
    else:
        points = MerweScaledSigmaPoints(n, alpha=1.0, beta=0.0, kappa=0.0)
        kf = UnscentedKalmanFilter(n, d, 1.0, h, f, points)
        kf.x = mean.copy()
    kf.P, kf.Q, kf.R = cov.copy(), q, r
    return kf


def run(problem, z):
    kf = filter_of(*problem)
    means, covs = [], []
    for row in z:
        kf.predict()
        kf.update(row.reshape(-1, 1) if CONTESTANT == "ckf" else row)
        means.append(kf.x.ravel().copy())
        covs.append(kf.P.copy())
    return means, covs, kf


PLANE = (lambda x, dt: plane_step(x), plane_radar, PLANE_Q, PLANE_R, PLANE_MEAN, PLANE_COV)
if WORKLOAD in ("W1", "W4"):
    z = rows("plane")

    def go():
        means, covs, kf = run(PLANE, z)
        return kf.rts_smoother(np.array(means), np.array(covs))[:2] if WORKLOAD == "W4" else (means, covs)

    serve("filterpy numpy", len(z), report(*go(), every=10), go)
else:
    n = int(WORKLOAD.removeprefix("W5-"))
    z, mean = rows(f"circle_{n}"), rows(f"circle_{n}_prior")[:, 0]
    noises = (CIRCLE_Q * np.eye(n), CIRCLE_R * np.eye(n // 2), mean, CIRCLE_P * np.eye(n))

    def go():
        return run((lambda x, dt: circle_steps(x), circle_radars, *noises), z)[:2]

    serve("filterpy numpy", len(z), report(*go(), every=len(z)), go)

"""givens from Python: functions in NumPy, traced once; `gv.filter` and `gv.smooth` over trajectories, in one thread."""

from __future__ import annotations

import givens as gv
import numpy as np
from contest import WORKLOAD, report, rows, serve, tracks
from problems import *


def plane_problem():
    def step(t, dt, x):
        s, c = np.sin(x[4] * dt), np.cos(x[4] * dt)
        a, b = s / x[4], (1.0 - c) / x[4]
        return [x[0] + a * x[1] - b * x[3], c * x[1] - s * x[3], x[2] + b * x[1] + a * x[3], s * x[1] + c * x[3], x[4]]

    def radar(t, x):
        return [np.sqrt(x[0] * x[0] + x[2] * x[2]), np.arctan2(x[2], x[0])]

    model = gv.Transition(step, noise_cov=PLANE_Q, state=["x", "vx", "y", "vy", "w"])
    sensor = gv.Sensor(radar, measures=["range", "bearing"], std=np.sqrt(np.diag(PLANE_R)))
    z = tracks() if WORKLOAD == "W2" else rows("plane")
    return model, sensor, z, 1.0, PLANE_MEAN, PLANE_COV, {"method": "sr-ckf"}, 10


def space_problem():
    def drift(t, x):
        return [x[1], -x[6] * x[3], x[3], x[6] * x[1], x[5], 0, 0]

    def radar(t, x):
        ground = np.sqrt(x[0] * x[0] + x[2] * x[2])
        return [np.sqrt(ground * ground + x[4] * x[4]), np.arctan2(x[2], x[0]), np.arctan2(x[4], ground)]

    names = ["e", "ve", "n", "vn", "z", "vz", "w"]
    model = gv.Sde(drift, diffusion=np.diag(np.sqrt(np.diag(SPACE_K))), state=names)
    sensor = gv.Sensor(radar, measures=["range", "azimuth", "elevation"], std=np.sqrt(np.diag(SPACE_R)))
    method = {"method": "sr-cd-ckf", "substeps": P1_SUBSTEPS}
    return model, sensor, rows("space_fast"), P1_GAP, SPACE_MEAN, SPACE_COV, method, 10


model, sensor, z, gap, mean, cov, method, every = space_problem() if WORKLOAD == "P1" else plane_problem()
t, prior = gap * np.arange(1.0, z.shape[-2] + 1), gv.Gaussian(mean, cov=cov)
run = gv.smooth if WORKLOAD == "W4" else gv.filter


def go():
    return run(model, sensor, t, z, prior=prior, t0=0.0, threads=1, **method)


est = go()
if z.ndim == 3:
    result, steps = report(est.mean[:, -1], est.cov[:, -1], every=1), z.shape[0] * z.shape[1]
else:
    result, steps = report(est.mean, est.cov, every=every), len(z)
serve("givens numpy", steps, result, go)

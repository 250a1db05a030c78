"""turbo-ckf: its cubature filter and its square-root one, with NumPy's functions of all points at once."""

from __future__ import annotations

from contest import CONTESTANT, WORKLOAD, report, rows, serve
from problems import *
from turbo_ckf import TurboCKF, TurboSRCKF

plane = (plane_steps, plane_radars, PLANE_Q, PLANE_R, PLANE_MEAN, PLANE_COV)
space = (space_steps, space_radars, SPACE_QD, SPACE_R, SPACE_MEAN, SPACE_COV)
f, h, q, r, mean, cov = plane if WORKLOAD == "W1" else space
z, every = (rows("plane"), 10) if WORKLOAD == "W1" else (rows("space"), 1)


def go():
    kind = TurboSRCKF if CONTESTANT == "root" else TurboCKF
    kf = kind(len(q), len(r), 1.0, hx=h, fx=lambda x, dt: f(x))
    kf.x, kf.P, kf.Q, kf.R = mean, cov, q, r
    result = kf.run(z)
    return result.xs, result.Ps


serve("turbo-ckf numpy", len(z), report(*go(), every=every), go)

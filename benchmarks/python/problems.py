"""The workloads' models and numbers, as every contestant has them. Functions of one point, and of many (state last)."""

from __future__ import annotations

from math import atan2, cos, sin, sqrt

import numpy as np

# ---- W1, W2, W4: a turn in the plane; state x, vx, y, vy, turn rate; a step of one second
PLANE_MEAN = np.array([20000.0, 300.0, 20000.0, 0.0, -np.deg2rad(3.0)])
PLANE_COV = np.diag([100.0, 10.0, 100.0, 10.0, 1e-5])
PLANE_R = np.diag([100.0, 1e-5])
PLANE_Q = np.zeros((5, 5))
PLANE_Q[:2, :2] = PLANE_Q[2:4, 2:4] = 0.1 * np.array([[1 / 3, 1 / 2], [1 / 2, 1.0]])
PLANE_Q[4, 4] = 1e-7


def plane_step(x):
    w = x[4]
    s, c = sin(w), cos(w)
    a, b = s / w, (1.0 - c) / w
    return np.array(
        [x[0] + a * x[1] - b * x[3], c * x[1] - s * x[3], x[2] + b * x[1] + a * x[3], s * x[1] + c * x[3], w]
    )


def plane_radar(x):
    return np.array([sqrt(x[0] * x[0] + x[2] * x[2]), atan2(x[2], x[0])])


def plane_steps(x):
    w = x[..., 4]
    s, c = np.sin(w), np.cos(w)
    a, b = s / w, (1.0 - c) / w
    x0, x1, x2, x3 = (x[..., i] for i in range(4))
    return np.stack([x0 + a * x1 - b * x3, c * x1 - s * x3, x2 + b * x1 + a * x3, s * x1 + c * x3, w], -1)


def plane_radars(x):
    return np.stack([np.sqrt(x[..., 0] ** 2 + x[..., 2] ** 2), np.arctan2(x[..., 2], x[..., 0])], -1)


# ---- W3, P1, P2: a turn in space in continuous time; state e, ve, n, vn, z, vz, turn rate
SPACE_MEAN = np.array([1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, np.deg2rad(6.0)])
SPACE_COV = np.diag([100.0, 10.0, 100.0, 10.0, 100.0, 10.0, 1e-4])
SPACE_K = np.diag([0.0, 0.2, 0.0, 0.2, 0.0, 0.2, 4.9e-7])
SPACE_R = np.diag([50.0**2, np.deg2rad(0.1) ** 2, np.deg2rad(0.1) ** 2])
#: Seconds between the rows of W3, and its sub-steps; those of P1.
SPACE_GAP, SPACE_SUBSTEPS = 4.0, 16
P1_GAP, P1_SUBSTEPS = 1.0, 8
SPACE_QD = np.zeros((7, 7))
for _i in (0, 2, 4):
    SPACE_QD[_i : _i + 2, _i : _i + 2] = 0.2 * np.array(
        [[SPACE_GAP**3 / 3, SPACE_GAP**2 / 2], [SPACE_GAP**2 / 2, SPACE_GAP]]
    )
SPACE_QD[6, 6] = 4.9e-7 * SPACE_GAP


def space_drift(x):
    return np.array([x[1], -x[6] * x[3], x[3], x[6] * x[1], x[5], 0.0, 0.0])


def space_drifts(x):
    out = np.zeros_like(x)
    out[..., 0], out[..., 2], out[..., 4] = x[..., 1], x[..., 3], x[..., 5]
    out[..., 1], out[..., 3] = -x[..., 6] * x[..., 3], x[..., 6] * x[..., 1]
    return out


def rk4(f, x, gap, substeps):
    h = gap / substeps
    for _ in range(substeps):
        k1 = f(x)
        k2 = f(x + 0.5 * h * k1)
        k3 = f(x + 0.5 * h * k2)
        k4 = f(x + h * k3)
        x = x + (h / 6.0) * (k1 + 2 * k2 + 2 * k3 + k4)
    return x


def space_step(x):
    return rk4(space_drift, x, SPACE_GAP, SPACE_SUBSTEPS)


def space_steps(x):
    return rk4(space_drifts, x, SPACE_GAP, SPACE_SUBSTEPS)


def space_radar(x):
    ground = sqrt(x[0] * x[0] + x[2] * x[2])
    return np.array([sqrt(ground * ground + x[4] * x[4]), atan2(x[2], x[0]), atan2(x[4], ground)])


def space_radars(x):
    ground = np.sqrt(x[..., 0] ** 2 + x[..., 2] ** 2)
    range_ = np.sqrt(ground**2 + x[..., 4] ** 2)
    return np.stack([range_, np.arctan2(x[..., 2], x[..., 0]), np.arctan2(x[..., 4], ground)], -1)


# ---- W5: Lorenz-96, one Runge-Kutta step of 0.05 between rows; every other component measured
CIRCLE_ROWS = {20: 50, 50: 50, 100: 20, 200: 20}
CIRCLE_Q, CIRCLE_R, CIRCLE_P = 0.05, 1.0, 1.0


def circle_drifts(x):
    return (np.roll(x, -1, -1) - np.roll(x, 2, -1)) * np.roll(x, 1, -1) - x + 8.0


def circle_steps(x):
    return rk4(circle_drifts, x, 0.05, 1)


def circle_radars(x):
    return x[..., ::2]

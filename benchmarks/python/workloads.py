"""A workload as discrete filters in JAX are given it."""

from __future__ import annotations

import jax_problems as jp
import numpy as np
from contest import WORKLOAD, rows, tracks
from problems import *


def discrete():
    """Functions, noises, prior, measurements (many trajectories if they have three dimensions), rows reported."""
    if WORKLOAD in ("W1", "W2", "W4"):
        z = tracks() if WORKLOAD == "W2" else rows("plane")
        return jp.plane_step, jp.plane_radar, PLANE_Q, PLANE_R, PLANE_MEAN, PLANE_COV, z, 10
    if WORKLOAD == "W3b":
        return jp.space_step, jp.space_radar, SPACE_QD, SPACE_R, SPACE_MEAN, SPACE_COV, rows("space"), 1
    n = int(WORKLOAD.removeprefix("W5-"))
    z, mean = rows(f"circle_{n}"), rows(f"circle_{n}_prior")[:, 0]
    noises = (CIRCLE_Q * np.eye(n), CIRCLE_R * np.eye(n // 2))
    return jp.circle_step, jp.circle_radar, *noises, mean, CIRCLE_P * np.eye(n), z, len(z)

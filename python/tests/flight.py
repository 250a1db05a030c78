"""The turning flight of the golden files, written in NumPy."""

import json
from pathlib import Path

import numpy as np

import givens as gv

GOLDEN = Path(__file__).parents[2] / "tests" / "golden"
STATES = ["e", "e_dot", "n", "n_dot", "z", "z_dot", "w"]


def golden(name):
    return json.loads((GOLDEN / name).read_text())


def drift(t, x):
    return [x[1], -x[6] * x[3], x[3], x[6] * x[1], x[5], 0, 0]


def radar(t, x):
    return [np.sqrt(x[0] ** 2 + x[2] ** 2 + x[4] ** 2), np.arctan2(x[2], x[0]), np.arctan2(x[4], np.hypot(x[0], x[2]))]


def turn():
    """Model and sensor of `continuous.json`."""
    g = golden("continuous.json")["models"]["turn"]
    model = gv.Sde(drift, diffusion=g["sQ_diag"], state=STATES)
    sensor = gv.Sensor(radar, measures=["r", "az", "el"], std=np.sqrt(g["R_diag"]), angles=["az"], name="radar")
    return model, sensor


def worst(mean, cov, expected_mean, expected_cov):
    """Errors of a mean and a covariance in standard deviations."""
    std = np.sqrt(np.diag(expected_cov))
    return max(np.max(np.abs(mean - expected_mean) / std), np.max(np.abs(cov - expected_cov) / np.outer(std, std)))

"""Golden values through models written in NumPy, to the bounds of the tests in Rust."""

import functools

import numpy as np
import pytest
from flight import golden, turn, worst

import givens as gv

CONTINUOUS = golden("continuous.json")
DISCRETE = golden("discrete.json")["scenarios"]
VELOCITY = {
    "std": "standard",
    "avg_printed": "averaged-printed",
    "avg_code": "averaged",
    "partial_mean": "partial",
    "partial_x1": "partial-printed",
    "avg_sqrtn": "cubature",
}
SOLVER = {"RK1": "euler", "RK2": "rk2", "RK4": "rk4", "AD": "dp5"}


def parts(name, m):
    """Method and options that the name of a golden entry stands for."""
    steps = {"substeps": m}
    rk4 = {"time_update": "moment-ode", "solver": "rk4", **steps}
    full = {"time_update": "ito-taylor", "variant": "full", **steps}
    table = {
        "EKF-RK4": [("cd-ekf", rk4)],
        "CKF1": [("cd-ckf1", steps), ("sr-cd-ckf", full)],
        "UKF1": [("cd-ukf1", steps), ("sr-cd-ukf1", steps)],
        "GHKF1": [("cd-ghkf1", steps), ("sr-cd-ghkf1", steps)],
        "CKF2": [("cd-ckf2", {"solver": "rk4", **steps})],
        "UKF2": [("cd-ukf", {"solver": "rk4", **steps})],
        "GHKF2": [("cd-ghkf2", {"solver": "rk4", **steps})],
        "UKF-Euler": [("cd-ukf", {"solver": "euler", **steps})],
        "CKF2010-sub": [("cd-ckf", steps), ("sr-cd-ckf", steps)],
        "CKF2010-once": [
            ("cd-ckf", {"variant": "noise-once", **steps}),
            ("sr-cd-ckf", {"variant": "noise-once", **steps}),
        ],
    }
    if name.startswith("LSKF-"):
        velocity, solver = name.removeprefix("LSKF-").rsplit("-", 1)
        options = {"velocity": VELOCITY[velocity], "solver": SOLVER[solver], "gauge": "free", "root": "moved"}
        adaptive = solver == "AD"
        return [("lskf", options | ({"rtol": 1e-11} if adaptive else steps))]
    return table.get(name, [])


@functools.cache
def models():
    return turn()


def bound(name):
    return 1e-8 if name.endswith("AD") else 1e-10


@pytest.mark.parametrize("entry", CONTINUOUS["predict"], ids=lambda e: f"{e['filter']}-{e['M']}")
def test_one_interval_agrees(entry):
    model, radar = models()
    start = CONTINUOUS["radar_sequence"]
    prior = gv.Gaussian(start["m0"], start["P0"])
    for method, options in parts(entry["filter"], entry["M"]):
        f = gv.Filter(model, radar, prior=prior, t0=0.0, method=method, **options)
        f.predict(entry["T"])
        assert worst(f.state.mean, f.state.cov, entry["m"], entry["P"]) < bound(entry["filter"])


# as few steps as the other program took
@pytest.mark.filterwarnings("ignore::givens.DoubtWarning")
@pytest.mark.parametrize("entry", CONTINUOUS["sequence"], ids=lambda e: f"{e['filter']}-{e['M']}")
def test_ten_measurements_agree(entry):
    model, radar = models()
    g = CONTINUOUS["radar_sequence"]
    t = g["T"] * np.arange(1, 11)
    prior = gv.Gaussian(g["m0"], g["P0"])
    for method, options in parts(entry["filter"], entry["M"]):
        try:
            est = gv.filter(model, radar, t, g["z"], prior=prior, t0=0.0, method=method, **options)
            failed = None
        except gv.StepError as error:
            est, failed = error.finished, error.row
        assert failed == entry["failed_at"]
        assert len(est) == len(entry["m"])
        std = np.sqrt(np.diagonal(est.cov, axis1=1, axis2=2))
        assert np.max(np.abs(est.mean - np.reshape(entry["m"], (-1, 7))) / std) < bound(entry["filter"])
        assert worst(est.mean[0], est.cov[0], est.mean[0], np.array(entry["P_first"])) < bound(entry["filter"])
        assert worst(est.mean[-1], est.cov[-1], est.mean[-1], np.array(entry["P_last"])) < bound(entry["filter"])


def cv_transition(t, dt, x):
    return [x[0] + dt * x[1], x[1], x[2] + dt * x[3], x[3]]


def turning(t, dt, x):
    w = x[4]
    small = np.abs(w * dt) < 1e-3
    safe = np.where(small, 1.0, w)
    half = (w * dt) ** 2
    s = np.where(small, dt * (1 - half / 6 * (1 - half / 20)), np.sin(safe * dt) / safe)
    c = np.where(small, w * dt**2 / 2 * (1 - half / 12), (1 - np.cos(safe * dt)) / safe)
    cos, sin = np.cos(w * dt), np.sin(w * dt)
    return [
        x[0] + s * x[1] - c * x[3],
        cos * x[1] - sin * x[3],
        x[2] + c * x[1] + s * x[3],
        sin * x[1] + cos * x[3],
        w,
    ]


@functools.cache
def discrete(name):
    g = DISCRETE[name]
    if name == "cv":
        model = gv.Transition(cv_transition, noise_cov=g["Q"], state=["x", "vx", "y", "vy"], step=1.0)
        sensor = gv.Sensor(lambda t, x: x[[0, 2]], measures=["x", "y"], cov=g["R"])
        return model, sensor, g, 1e-11
    model = gv.Transition(turning, noise_cov=g["Q"], state=["x", "vx", "y", "vy", "w"], step=1.0)
    sensor = gv.Sensor(
        lambda t, x: [np.hypot(x[0], x[2]), np.arctan2(x[2], x[0])],
        measures=["range", "bearing"],
        cov=g["R"],
        angles=["bearing"],
    )
    return model, sensor, g, 1e-10


METHODS = {
    "EKF": ["ekf", "sr-ekf"],
    "UKF": ["ukf", "sr-ukf"],
    "CDKF": ["cdkf", "sr-cdkf"],
    "QKF": ["qkf", "sr-qkf"],
    "CKF": ["ckf", "sr-ckf"],
    "CKF5": ["ckf5"],
}


def close(mean, cov, series, at, room):
    expected, var = np.array(series["mean"]), np.array(series["var"])
    rows = slice(at, at + len(expected))
    assert np.max(np.abs(mean[rows] - expected) / np.sqrt(var)) < room
    found = np.diagonal(cov[rows], axis1=1, axis2=2)
    assert np.max(np.abs(found / var - 1)) < room
    for k, matrix in series["cov"].items():
        assert worst(0, cov[int(k) + at], 0, np.array(matrix)) < room


@pytest.mark.parametrize("name", ["cv", "ct"])
@pytest.mark.parametrize("filter_name", METHODS)
def test_discrete_filters_and_smoothers_agree(name, filter_name):
    model, sensor, g, room = discrete(name)
    expected = g["filters"][filter_name]
    z = np.vstack([np.full(2, np.nan), g["z"]])
    run = functools.partial(gv.smooth, model, sensor, np.arange(21.0), z, prior=gv.Gaussian(g["m0"], g["P0"]), t0=0.0)
    for method in METHODS[filter_name]:
        est = run(method=method)
        close(est.filtered_mean, est.filtered_cov, expected["filt"], 0, room)
        close(est.predicted_mean, est.predicted_cov, expected["pred"], 1, room)
        close(est.mean, est.cov, expected["smooth"], 0, room)
        assert abs(est.total_log_likelihood - expected["loglik"]) < 1e-9
        lag = run(method=method, lag=5)
        close(lag.mean, lag.cov, expected["lag5"], 0, room)
        # the square root of a smoothed covariance gives it back
        assert np.max(np.abs(est.factor @ est.factor.swapaxes(1, 2) - est.cov)) < 1e-12 * np.max(est.cov)

"""The error function and its complement: traced from `math`, SciPy and SymPy, and written in a model file."""

import math

import numpy as np
import pytest

import givens as gv

SPECIAL = pytest.importorskip("scipy.special")
POINTS = [-3.1, -0.7, 0.0, 0.4, 1.3, 2.2, 5.0]
STILL = gv.Transition(lambda t, dt, x: x, noise_cov=np.zeros((1, 1)), state=["a"])


def bell(x):
    return 2 / math.sqrt(math.pi) * math.exp(-x * x)


def normal(x):
    return math.exp(-x * x / 2) / math.sqrt(2 * math.pi)


CASES = [
    ("math.erf", lambda t, x: [math.erf(x[0])], math.erf, bell),
    ("math.erfc", lambda t, x: [math.erfc(x[0])], math.erfc, lambda x: -bell(x)),
    ("scipy erf of an array", lambda t, x: SPECIAL.erf(x), math.erf, bell),
    ("scipy erf of a list", lambda t, x: SPECIAL.erf([x[0]]), math.erf, bell),
    ("scipy erfc of a number", lambda t, x: [SPECIAL.erfc(x[0])], math.erfc, lambda x: -bell(x)),
    ("scipy ndtr", lambda t, x: SPECIAL.ndtr(x), lambda x: math.erfc(-x / math.sqrt(2)) / 2, normal),
    ("a sum with numbers", lambda t, x: SPECIAL.erf(x) + SPECIAL.erf(0.0), math.erf, bell),
]


@pytest.mark.parametrize(("h", "value", "slope"), [case[1:] for case in CASES], ids=[case[0] for case in CASES])
def test_value_and_slope_are_exact(h, value, slope):
    sensor = gv.Sensor(h, measures=["z"], std=[1.0])
    for x in POINTS:
        est = gv.filter(STILL, sensor, [0.0], [[1.0]], prior=gv.Gaussian([x], std=[1e3]), method="ekf")
        np.testing.assert_allclose(1.0 - est.innovation[0, 0], value(x), rtol=1e-15, atol=3e-16)
        np.testing.assert_allclose(est.innovation_cov[0, 0, 0], 1e6 * slope(x) ** 2 + 1, rtol=1e-13)


def test_second_derivatives_move_a_drift_as_the_moments_do():
    model = gv.Sde(lambda t, x: [-SPECIAL.erf(x[0])], diffusion=[0.3], state=["a"])
    sensor = gv.Sensor(lambda t, x: x, measures=["z"], std=[0.1])
    t, z = np.linspace(0.05, 1.0, 20), np.full((20, 1), 0.2)
    prior = gv.Gaussian([0.6], std=[0.05])
    given = {"prior": prior, "t0": 0.0}
    found = gv.filter(model, sensor, t, z, method="sr-cd-ckf", **given)
    exact = gv.filter(model, sensor, t, z, method="sr-cd-ckf2", rtol=1e-10, **given)
    np.testing.assert_allclose(found.mean, exact.mean, rtol=1e-5)


def test_a_batch_computes_it_as_one_track_does():
    model = gv.Transition(lambda t, dt, x: [x[0] - dt * math.erf(x[0])], noise_cov=[[0.01]], state=["a"])
    sensor = gv.Sensor(lambda t, x: [math.erfc(x[0])], measures=["z"], std=[0.1])
    t = np.arange(1.0, 6.0)
    z = np.linspace(0.2, 0.9, 50).reshape(10, 5, 1)
    prior = gv.Gaussian([0.3], std=[0.5])
    many = gv.filter(model, sensor, t, z, prior=prior)
    for k in range(10):
        np.testing.assert_allclose(many[k].mean, gv.filter(model, sensor, t, z[k], prior=prior).mean, rtol=1e-13)


def test_a_model_file_and_sympy_know_it():
    sympy = pytest.importorskip("sympy")
    a = sympy.Symbol("a")
    text = """
    [state]
    names = ["a"]
    mean = [0.3]
    std = [0.5]
    [dynamics]
    transition = { a = "a - erf(a)/10" }
    noise_cov = [["0.01"]]
    [[sensor]]
    name = "s"
    measures = { z = "erfc(-a/sqrt(2))/2" }
    std = { z = 0.1 }
    """
    file = gv.parse_model(text)
    model = gv.Transition([a - sympy.erf(a) / 10], noise_cov=[[0.01]], state=["a"])
    sensor = gv.Sensor([sympy.erfc(-a / sympy.sqrt(2)) / 2], measures=["z"], std=[0.1], name="s")
    t, z, prior = [0.0, 1.0, 2.0], [[0.5], [0.7], [0.6]], gv.Gaussian([0.3], std=[0.5])
    found, of_file = (
        gv.smooth(m, s, t, z, prior=prior, method="sr-ekf", t0=0.0) for m, s in ((model, sensor), (file, None))
    )
    np.testing.assert_allclose(found.mean, of_file.mean, rtol=1e-13)

"""The derivatives of traced functions are those of the functions, at zero and at ties as well."""

import numpy as np
import pytest

import givens as gv

SMOOTH = [
    ("arcsinh", lambda x: np.arcsinh(x[0]), [0.0], [1.0]),
    ("arcsinh_far_out", lambda x: np.arcsinh(x[0]), [2e9], [5e-10]),
    ("arctanh", lambda x: np.arctanh(x[0]), [0.0], [1.0]),
    ("expm1", lambda x: np.expm1(x[0]), [0.0], [1.0]),
    ("expm1_at_its_seam", lambda x: np.expm1(x[0]), [-1.0], [np.exp(-1.0)]),
    ("log1p", lambda x: np.log1p(x[0]), [0.0], [1.0]),
    ("log2", lambda x: np.log2(x[0]), [8.0], [1 / (8 * np.log(2.0))]),
    ("softplus", lambda x: np.logaddexp(0, x[0]), [0.0], [0.5]),
    ("softplus_turned", lambda x: np.logaddexp(x[0], 0), [0.0], [0.5]),
    ("a_tie", lambda x: np.logaddexp(x[0], x[1]), [0.3, 0.3], [0.5, 0.5]),
    ("a_tie_of_powers_of_two", lambda x: np.logaddexp2(x[0], x[1]), [0.3, 0.3], [0.5, 0.5]),
    ("a_tie_of_three", lambda x: np.logaddexp.reduce(x), [0.3, 0.3, 0.3], [1 / 3, 1 / 3, 1 / 3]),
    ("apart", lambda x: np.logaddexp(x[0], x[1]), [0.0, 3.0], [1 / (1 + np.exp(3.0)), 1 / (1 + np.exp(-3.0))]),
    ("sinc", lambda x: np.sinc(x[0]), [0.0], [0.0]),
    ("remainder", lambda x: x[0] % 0.3, [1.0], [1.0]),
    ("remainder_of_a_negative", lambda x: np.fmod(x[0], -0.3), [-1.0], [1.0]),
]


@pytest.mark.parametrize(("function", "x", "slopes"), [case[1:] for case in SMOOTH], ids=[case[0] for case in SMOOTH])
def test_an_extended_filter_sees_the_slope_of_an_elementary_function(function, x, slopes):
    n = len(x)
    model = gv.Transition(lambda t, dt, x: x, noise_cov=np.zeros((n, n)), state=[f"s{i}" for i in range(n)])
    sensor = gv.Sensor(lambda t, x: [1e3 * function(x)], measures=["z"], std=[1.0], check_at=x)
    found = gv.filter(model, sensor, [0.0], [[1.0]], prior=gv.Gaussian(x, std=np.ones(n)), method="ekf")
    expected = 1e6 * np.dot(slopes, slopes) + 1
    np.testing.assert_allclose(found.innovation_cov[0, 0, 0], expected, rtol=1e-9)


def test_a_slope_that_expressions_lose_is_refused():
    wrong = [lambda t, x: [np.sign(x[0]) * np.abs(x[0])], lambda t, x: [np.where(x[0] == 0, 0.0, np.sin(x[0]))]]
    for h in wrong:
        model = gv.Transition(lambda t, dt, x: x, noise_cov=[[1.0]], state=["a"])
        with pytest.raises(gv.TraceError, match=r"that of component 'z' by x\[0\] is 1, and that of its expressions 0"):
            gv.filter(
                model, gv.Sensor(h, measures=["z"], std=[1.0]), [0.0], [[1.0]], prior=gv.Gaussian([0.0], std=[1.0])
            )


def test_kinks_and_jumps_have_no_slope_to_compare():
    def bent(t, x):
        y = np.abs(x) + np.maximum(x, 0) + np.clip(x, 0, 1) + np.sign(x) * np.sqrt(np.abs(x)) + np.floor(x)
        return y + np.linalg.norm(x) + np.where(x > 0, 1.0, 0.0) + np.interp(x, [-1, 0, 1], [0, 3, 4]) + x % 1

    gv.Sde(bent, diffusion=[1, 1], state=["a", "b"])


def test_a_slope_is_compared_at_the_state_of_check_at_too():
    def tied(t, x):
        return [np.where(x[0] == 5.0, 5.0, x[0]), x[1]]

    gv.Sde(tied, diffusion=[1, 1], state=["a", "b"])
    with pytest.raises(gv.TraceError, match="do not have its derivatives"):
        gv.Sde(tied, diffusion=[1, 1], state=["a", "b"], check_at=[5.0, 0.0])


def test_rounding_is_not_taken_for_a_slope():
    def far(t, x):
        return [(x[0] + 1e9) - 1e9, np.linalg.norm([x[0] + 6.371e6, x[1], 1.0]) - 6.371e6]

    gv.Sde(far, diffusion=[1, 1], state=["a", "b"])

"""The derivatives of traced functions are those of the functions, at zero and at ties as well."""

import pickle

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


STILL = gv.Transition(lambda t, dt, x: x, noise_cov=[[1.0]], state=["a"])
FLOW = gv.Sde(lambda t, x: -x, diffusion=[1.0], state=["a"])
ZERO = gv.Gaussian([0.0], std=[1.0])


def folded(t, x):
    return np.sign(x) * np.abs(x)


def pinned(t, x):
    return np.where(x == 0, 0.0, np.sin(x))


def measured(h, model=STILL, **options):
    sensor = gv.Sensor(h, measures=["z"], std=[1.0])
    return gv.filter(model, sensor, [0.0, 1.0], [[1.0], [1.0]], prior=ZERO, **options)


@pytest.mark.parametrize("h", [folded, pinned])
def test_a_slope_that_expressions_lose_is_refused_to_those_who_take_it(h):
    with pytest.raises(gv.TraceError) as caught:
        measured(h, method="ekf")
    first = h.__code__.co_firstlineno
    assert str(caught.value).endswith(
        f"test_slopes.py:{first}, in {h.__name__}: its expressions do not have its derivatives, which `ekf` takes: that "
        "of component 'z' by x[0] is 1, and that of its expressions 0 at t = 0.5, x = [0]\n  help: write np.where(x < 0, "
        "-f(-x), f(x)) for np.sign(x) * f(np.abs(x)), and give both sides of an np.where one slope where they meet; or "
        'write method="sr-ckf", which takes none'
    )
    assert (caught.value.function, caught.value.line, caught.value.argument) == (h.__name__, first, "h")
    with pytest.raises(gv.TraceError, match='(?s)which `cd-ekf` takes: .*method="sr-cd-ckf"'):
        measured(h, FLOW, method="cd-ekf")
    with pytest.raises(gv.TraceError, match="which `ekf` takes"):
        gv.Filter(STILL, gv.Sensor(h, measures=["z"], std=[1.0]), prior=ZERO, t0=0.0, method="ekf")


@pytest.mark.parametrize("h", [folded, pinned])
def test_methods_without_derivatives_take_such_a_function(h):
    plain = measured(lambda t, x: x if h is folded else np.sin(x))
    np.testing.assert_allclose(measured(h).mean, plain.mean, rtol=1e-14)
    assert np.isfinite(measured(h, FLOW).mean).all()


@pytest.mark.parametrize("used", [False, True])
def test_what_is_said_of_slopes_outlives_a_pickle(used):
    model = gv.Sde(folded, diffusion=[1.0], state=["a"])
    sensor = gv.Sensor(folded, measures=["z"], std=[1.0])
    if used:
        gv.filter(model, sensor, [0.0], [[1.0]], prior=ZERO, method="sr-cd-ckf2")
    model, sensor = pickle.loads(pickle.dumps((model, sensor)))
    for method in ("cd-ekf", "cd-ckf"):
        with pytest.raises(gv.TraceError, match=f'(?s)which `{method}` takes: .*method="sr-cd-ckf2"'):
            gv.filter(model, sensor, [0.0], [[1.0]], prior=ZERO, method=method)
    with pytest.raises(gv.TraceError, match="in folded: .*, which `sr-cd-ckf2` takes"):
        gv.filter(model, sensor, [0.0], [[1.0]], prior=ZERO, method="sr-cd-ckf2", solver="rodas4")


def test_a_drift_without_its_slopes_is_moved_by_what_takes_none():
    model, plain = (gv.Sde(f, diffusion=[1.0], state=["a"]) for f in (folded, lambda t, x: x))
    found, expected = (measured(lambda t, x: x, m, method="sr-cd-ckf2") for m in (model, plain))
    np.testing.assert_allclose(found.mean, expected.mean, rtol=1e-12)
    sensor = gv.Sensor(lambda t, x: x, measures=["z"], std=[1.0])
    with pytest.raises(gv.TraceError, match="(?s)which `simulate` takes: .* or write trace=False"):
        gv.simulate(model, sensor, [0.0, 1.0], prior=ZERO, seed=1)
    called = gv.Sde(folded, diffusion=[1.0], state=["a"], trace=False)
    assert np.isfinite(gv.simulate(called, sensor, [0.0, 1.0], prior=ZERO, seed=1).x).all()
    varied = gv.Sde(folded, diffusion=lambda t, x: np.cos(x), state=["a"])
    assert np.isfinite(gv.simulate(varied, sensor, [0.0, 1.0], prior=ZERO, seed=1).x).all()


def test_kinks_and_jumps_have_no_slope_to_compare():
    def bent(t, x):
        y = np.abs(x) + np.maximum(x, 0) + np.clip(x, 0, 1) + np.sign(x) * np.sqrt(np.abs(x)) + np.floor(x)
        return y + np.linalg.norm(x) + np.where(x > 0, 1.0, 0.0) + np.interp(x, [-1, 0, 1], [0, 3, 4]) + x % 1

    assert gv.Sde(bent, diffusion=[1, 1], state=["a", "b"])._parts["drift"].steep is None


def test_a_slope_is_compared_at_the_state_of_check_at_too():
    def tied(t, x):
        return [np.where(x[0] == 5.0, 5.0, x[0]), x[1]]

    sensor, prior = gv.Sensor(lambda t, x: x, measures=["y", "z"], std=[1, 1]), gv.Gaussian([0, 0], std=[1, 1])

    def run(model):
        return gv.filter(model, sensor, [0.0], [[1.0, 1.0]], prior=prior, method="cd-ekf")

    run(gv.Sde(tied, diffusion=[1, 1], state=["a", "b"]))
    with pytest.raises(gv.TraceError, match="do not have its derivatives"):
        run(gv.Sde(tied, diffusion=[1, 1], state=["a", "b"], check_at=[5.0, 0.0]))


def test_rounding_is_not_taken_for_a_slope():
    def far(t, x):
        return [(x[0] + 1e9) - 1e9, np.linalg.norm([x[0] + 6.371e6, x[1], 1.0]) - 6.371e6]

    assert gv.Sde(far, diffusion=[1, 1], state=["a", "b"])._parts["drift"].steep is None

"""Models, sensors and beliefs: what they take, and what they are."""

import copy
import math
import pickle

import numpy as np
import pytest
from flight import drift, radar

import givens as gv

STATES = ["x", "v"]
PRIOR = gv.Gaussian([1.0, 0.0], std=[1.0, 1.0])
T = np.arange(1.0, 9.0)
Z = np.cos(T)[:, None]


def oscillator(t, x, *, omega=1.0):
    return [x[1], -(omega**2) * x[0]]


def ruler(t, x):
    return x[:1]


def model_of(**arguments):
    return gv.Sde(oscillator, **{"diffusion": {"v": 0.1}, "state": STATES, **arguments})


def sensor_of(**arguments):
    return gv.Sensor(ruler, **{"measures": ["length"], "std": [0.1], **arguments})


def mean_of(model, sensors, z=Z, **options):
    return gv.filter(model, sensors, T, z, prior=PRIOR, t0=0.0, **options).mean


def test_parameters_change_without_a_second_trace():
    model, sensor = model_of(), sensor_of()
    mean_of(model, sensor)
    changed = model.with_params(omega=1.3)
    assert changed.parameters["omega"] == 1.3 and model.parameters["omega"] == 1.0
    np.testing.assert_array_equal(mean_of(changed, sensor), mean_of(model_of(parameters={"omega": 1.3}), sensor))
    assert not np.array_equal(mean_of(changed, sensor), mean_of(model, sensor))
    assert changed._parts is model._parts


def test_arrays_are_parameters_too():
    def weighted(t, x, *, k=np.array([[0.0, 1.0], [-1.0, -0.1]])):
        return k @ x

    model = gv.Sde(weighted, diffusion=[0.0, 0.1], state=STATES)
    other = np.array([[0.0, 1.0], [-2.0, -0.1]])
    fixed = gv.Sde(lambda t, x: other @ x, diffusion=[0.0, 0.1], state=STATES)
    np.testing.assert_allclose(
        mean_of(model.with_params(k=other), sensor_of()), mean_of(fixed, sensor_of()), rtol=1e-12
    )


def test_a_sensor_has_parameters_of_its_own():
    def h(t, x, *, gain=1.0):
        return [gain * x[0]]

    sensor = gv.Sensor(h, measures=["y"], std=lambda t, *, s=0.1: [s])
    doubled = mean_of(model_of(), sensor.with_params(gain=2.0, s=0.2), 2 * Z)
    np.testing.assert_allclose(doubled, mean_of(model_of(), sensor), rtol=1e-12)


@pytest.mark.parametrize(
    "diffusion",
    [
        [0.0, 0.1],
        {"v": 0.1},
        np.array([[0.0], [0.1]]),
        np.diag([0.0, 0.1]),
        lambda t: [0, 0.1],
        lambda t, *, q=0.1: np.array([[0.0], [q]]),
    ],
)
def test_the_diffusion_is_a_diagonal_or_all_of_g(diffusion):
    model = model_of(diffusion=diffusion)
    assert model.noises == 1
    np.testing.assert_allclose(mean_of(model, sensor_of()), mean_of(model_of(), sensor_of()), rtol=1e-12)


def test_a_second_argument_called_u_is_controls_and_any_other_the_state():
    with_u = gv.Sde(
        lambda t, x, u: [x[1], u[0]], diffusion=lambda t, u: [0, 0.1 + u[0]], state=STATES, controls=["force"]
    )
    with_x = gv.Sde(lambda t, x: [x[1], 0.2], diffusion=lambda t, y: [0, 0.3 + 0 * y[0]], state=STATES)
    u = np.full((len(T), 1), 0.2)
    found = mean_of(with_u, sensor_of(), u=u, method="cd-ckf2")
    np.testing.assert_allclose(found, mean_of(with_x, sensor_of(), method="cd-ckf2"), rtol=1e-10)
    np.testing.assert_array_equal(found, mean_of(with_u, sensor_of(), u={"force": 0.2}, method="cd-ckf2"))


def test_tables_by_name_are_lists_in_order():
    by_name = gv.Sde(lambda t, x: {"v": -x[0], "x": x[1]}, diffusion={"v": 0.1}, state=STATES)
    np.testing.assert_array_equal(mean_of(by_name, sensor_of()), mean_of(model_of(), sensor_of()))
    sensor = sensor_of(std={"length": 0.1})
    np.testing.assert_array_equal(mean_of(model_of(), sensor), mean_of(model_of(), sensor_of()))


@pytest.mark.parametrize("used", [False, True])
def test_a_model_made_of_lambdas_can_be_pickled(used):
    model = gv.Sde(lambda t, x, *, k=2.0: [x[1], -k * np.sin(x[0])], diffusion=[0, 0.1], state=STATES)
    if used:
        mean_of(model, sensor_of())
    twin = pickle.loads(pickle.dumps(model.with_params(k=3.0)))
    assert twin == model.with_params(k=3.0) and twin != model
    np.testing.assert_array_equal(mean_of(twin, sensor_of()), mean_of(model.with_params(k=3.0), sensor_of()))


def test_a_sensor_can_be_pickled_with_a_function_of_a_module_or_once_it_was_used():
    fresh = pickle.loads(pickle.dumps(sensor_of()))
    expected = mean_of(model_of(), sensor_of())
    np.testing.assert_array_equal(mean_of(model_of(), fresh), expected)
    by_lambda = sensor_of()
    used = gv.Sensor(lambda t, x: x[:1], measures=["length"], std=[0.1])
    mean_of(model_of(), used)
    np.testing.assert_array_equal(mean_of(model_of(), pickle.loads(pickle.dumps(used))), expected)
    assert copy.copy(by_lambda) is by_lambda


def test_models_are_equal_if_they_say_the_same():
    assert model_of() == model_of() and hash(model_of()) == hash(model_of())
    assert model_of() != model_of(diffusion={"v": 0.2})
    assert model_of() != gv.Sde(lambda t, x: [x[1], -x[0]], diffusion={"v": 0.1}, state=STATES)
    f = gv.Transition(lambda t, dt, x: x, noise_cov=np.eye(2), state=STATES)
    assert f != gv.Transition(lambda t, dt, x: x, noise_cov=np.eye(2), state=STATES, step=1.0)


def test_models_cannot_be_changed():
    with pytest.raises(AttributeError, match="cannot be changed"):
        model_of().state = ("a", "b")
    with pytest.raises(AttributeError, match="cannot be changed"):
        PRIOR.mean = np.zeros(2)
    with pytest.raises(ValueError, match="read-only"):
        PRIOR.mean[0] = 1


def test_a_gaussian_gives_its_root():
    cov = np.array([[4.0, 2.0], [2.0, 1.0]])
    belief = gv.Gaussian([0, 0], cov)
    np.testing.assert_allclose(belief.factor @ belief.factor.T, cov, atol=1e-15)
    assert np.all(np.triu(belief.factor, 1) == 0) and np.all(np.diag(belief.factor) >= 0)
    assert pickle.loads(pickle.dumps(belief)) == belief
    assert repr(gv.Gaussian([0.0, 1.0], std=[2, 0.5])) == "Gaussian([0., 1.], std=[2. , 0.5])"
    assert gv.Gaussian(3.0, 4.0).cov.shape == (1, 1)


def test_expressions_of_sympy_are_models():
    sympy = pytest.importorskip("sympy")
    x, v, omega = sympy.symbols("x v omega")
    by_sympy = gv.Sde([v, -(omega**2) * sympy.sin(x)], diffusion=[0, 0.1], state=STATES, parameters={"omega": 1.0})
    by_numpy = gv.Sde(lambda t, x, *, omega=1.0: [x[1], -(omega**2) * np.sin(x[0])], diffusion=[0, 0.1], state=STATES)
    sensor = gv.Sensor([sympy.Max(x, -5) + sympy.Piecewise((0, v > 0), (0, True))], measures=["length"], std=[0.1])
    np.testing.assert_allclose(mean_of(by_sympy, sensor), mean_of(by_numpy, sensor_of()), rtol=1e-10)
    assert by_sympy.with_params(omega=2.0).parameters["omega"] == 2.0


def test_a_function_of_numba_serves_by_its_address():
    numba = pytest.importorskip("numba")
    signature = numba.types.void(*[numba.types.float64] + [numba.types.CPointer(numba.types.float64)] * 3)

    @numba.cfunc(signature)
    def compiled(t, x, p, out):
        out[0] = x[1]
        out[1] = -p[0] * p[0] * x[0]

    model = gv.Sde(compiled, diffusion={"v": 0.1}, state=STATES, parameters={"omega": 1.0})
    options = {"method": "cd-ckf2", "rtol": 1e-9}
    np.testing.assert_allclose(
        mean_of(model.with_params(omega=1.2), sensor_of(), **options),
        mean_of(model_of(parameters={"omega": 1.2}), sensor_of(), **options),
        rtol=1e-7,
    )


def test_a_function_with_branches_can_be_called():
    def branching(t, x, *, omega=1.0):
        if x[0] > 100:
            return [0.0, 0.0]
        return [x[1], -(omega**2) * x[0]]

    def together(t, x, *, omega=1.0):
        return [x[1], -(omega**2) * x[0]]

    expected = mean_of(model_of(), sensor_of(), method="cd-ckf2", rtol=1e-9)
    for function in (branching, together):
        model = (
            model_of(parameters=None)
            if function is oscillator
            else gv.Sde(function, diffusion={"v": 0.1}, state=STATES, trace=False)
        )
        np.testing.assert_allclose(mean_of(model, sensor_of(), method="cd-ckf2", rtol=1e-9), expected, rtol=1e-7)
    many = gv.Sde(together, diffusion={"v": 0.1}, state=STATES, trace=False, vectorized=True)
    np.testing.assert_allclose(mean_of(many, sensor_of(), method="cd-ckf2", rtol=1e-9), expected, rtol=1e-7)


def test_a_jacobian_lets_a_called_function_serve_methods_that_differentiate():
    def jacobian(t, x, *, omega=1.0):
        return [[0.0, 1.0], [-(omega**2), 0.0]]

    model = gv.Sde(oscillator, diffusion={"v": 0.1}, state=STATES, trace=False, jacobian=jacobian)
    expected = mean_of(model_of(), sensor_of(), method="cd-ekf", rtol=1e-9)
    np.testing.assert_allclose(mean_of(model, sensor_of(), method="cd-ekf", rtol=1e-9), expected, rtol=1e-7)


def test_a_model_file_and_numpy_say_the_same():
    text = """
    [state]
    names = ["e", "e_dot", "n", "n_dot", "z", "z_dot", "w"]
    mean = [1060, -4, 2570, 157, 250, 3, 0.115]
    std = [100, 10, 100, 10, 100, 10, 0.02]
    time = 0.0
    [parameters]
    q = 0.447
    [dynamics]
    drift = ["e_dot", "-w*n_dot", "n_dot", "w*e_dot", "z_dot", "0", "0"]
    diffusion = { e_dot = "q", n_dot = "q", z_dot = "q", w = "7e-3" }
    [[sensor]]
    name = "radar"
    measures = { r = "sqrt(e^2 + n^2 + z^2)", az = "atan2(n, e)", el = "atan2(z, hypot(e, n))" }
    std = { r = 50, az = 2e-3, el = 2e-3 }
    angles = ["az"]
    [filter]
    method = "sr-cd-ckf"
    substeps = 8
    """
    file = gv.parse_model(text)
    model = gv.Sde(drift, diffusion=[0, 0.447, 0, 0.447, 0, 0.447, 7e-3], state=file.state)
    sensor = gv.Sensor(radar, measures=["r", "az", "el"], std=[50, 2e-3, 2e-3], angles={"az": 2 * math.pi})
    data = gv.simulate(model, sensor, 2 * np.arange(1, 21), prior=file.prior, t0=0.0, seed=3)
    ours = gv.smooth(model, sensor, data.t, data.z, prior=file.prior, t0=0.0, method="sr-cd-ckf", substeps=8)
    theirs = file.smooth(data.t, data.z)
    std = np.sqrt(np.diagonal(ours.cov, axis1=1, axis2=2))
    assert np.max(np.abs(ours.mean - theirs.mean) / std) < 1e-10
    assert abs(ours.total_log_likelihood - theirs.total_log_likelihood) < 1e-9
    assert theirs.method == "sr-cd-ckf" and file.options["substeps"] == 8
    table = {"time": data.t, "r": data.z[:, 0], "az": data.z[:, 1], "el": data.z[:, 2]}
    np.testing.assert_array_equal(file.smooth(table).mean, theirs.mean)
    changed = pickle.loads(pickle.dumps(file.with_params(q=0.5)))
    assert changed.parameters["q"] == 0.5 and changed == file.with_params(q=0.5) and changed != file
    np.testing.assert_array_equal(gv.filter(file, None, data.t, data.z).mean, file.filter(data.t, data.z).mean)


def test_models_show_themselves():
    assert repr(model_of()) == "Sde(oscillator, state=[x, v], noises=1, parameters=(omega=1))"
    assert repr(sensor_of()) == "Sensor(ruler, measures=[length], std=[0.1])"
    assert "<th>state</th><td>[x, v]</td>" in model_of()._repr_html_()


def test_a_notebook_shows_a_belief_with_its_correlations():
    plain = gv.Gaussian([0.5, -2e6], std=[2.0, 0.0])._repr_html_()
    assert "<td>0</td><td>0.5</td><td>2</td>" in plain and "<td>1</td><td>-2e+06</td><td>0</td>" in plain
    assert "corr." not in plain
    related = gv.Gaussian([1.0, 2.0, 3.0], [[4.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 0.0]])._repr_html_()
    assert related.count("corr.") == 2 and "<td>1</td><td>2</td><td>1</td><td>0.5</td><td></td>" in related
    assert gv.Gaussian(np.zeros(40), std=np.ones(40))._repr_html_().count("<tr>") == 14


@pytest.mark.parametrize(("method", "points"), [("ckf", 2), ("sr-ckf", 2), ("ukf", 3)])
def test_a_called_function_is_asked_at_the_points_of_the_rule_only(method, points):
    asked = []

    def measure(t, x):
        asked.append(float(x[0]))
        return [np.log(abs(x[0]))] if points == 2 else [x[0]]

    model = gv.Transition(lambda t, dt, x: x, noise_cov=[[0.1]], state=["x"])
    sensor = gv.Sensor(measure, measures=["z"], std=[0.1], trace=False)
    asked.clear()
    gv.filter(model, sensor, [0.0], [[0.5]], prior=gv.Gaussian([0.0], std=[1.0]), method=method)
    assert len(asked) == points

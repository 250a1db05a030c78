"""All ways of giving a model are one model."""

from __future__ import annotations

import ctypes
import math
from typing import Any

import native_models as m
import numpy as np
import pytest
from native_models import MEAN, SPRING, STD, STEPS, TIME, Z, choose

from givens._native import Estimates, Function, Model, methods, run, simulate

CONTINUOUS = [entry["name"] for entry in methods() if entry["kind"] == "continuous"]
DISCRETE = [entry["name"] for entry in methods() if entry["kind"] == "discrete"]
FIELDS = ["mean", "cov", "predicted_mean", "predicted_cov", "innovation", "innovation_cov", "nis", "log_likelihood"]


def solve(model: Model, method: str, goal: Any = "interval", **options: Any) -> Estimates:
    est = run(model, choose(method, model.kind, **options), MEAN, STD, 0.0, TIME, Z, goal=goal)
    assert est.failure is None, est.failure
    return est


def assert_equal(a: Estimates, b: Estimates, tolerance: float = 0.0) -> None:
    for field in FIELDS:
        np.testing.assert_allclose(getattr(a, field), getattr(b, field), rtol=tolerance, atol=tolerance, err_msg=field)


@pytest.mark.parametrize("method", CONTINUOUS)
def test_a_continuous_graph_gives_the_numbers_of_its_model_file(method: str) -> None:
    assert_equal(solve(m.continuous(), method), solve(Model.parse(SPRING), method))


@pytest.mark.parametrize("method", DISCRETE)
def test_a_discrete_graph_gives_the_numbers_of_its_model_file(method: str) -> None:
    assert_equal(solve(m.discrete(), method), solve(Model.parse(STEPS), method))


@pytest.mark.parametrize("method", [name for name in DISCRETE if "ekf" not in name])
def test_a_callback_gives_the_numbers_of_the_graph(method: str) -> None:
    model = m.discrete({"measures": m.called(m.distance)}, transition=m.called(m.transition))
    assert_equal(solve(model, method), solve(m.discrete(), method), 1e-12)


@pytest.mark.parametrize("method", ["sr-cd-ckf2", "cd-ckf2", "cd-ukf", "sr-cd-ghkf2", "lskf"])
def test_a_drift_that_is_called_serves_moment_equations(method: str) -> None:
    model = m.continuous(drift=m.called(m.drift))
    assert_equal(solve(model, method), solve(m.continuous(), method), 1e-9)


def test_noises_may_be_called() -> None:
    noise = {"noise_cov": m.called(lambda t, dt, x, u, p: [[0, 0], [0, p[1] ** 2 * dt]])}
    std = {"std": m.called(lambda t, dt, x, u, p: [0.1])}
    cov = {"std": None, "cov": m.called(lambda t, dt, x, u, p: [[0.01]])}
    whole = solve(m.discrete(), "sr-ckf")
    for sensor in (std, cov):
        assert_equal(solve(m.discrete(sensor, **noise), "sr-ckf"), whole, 1e-12)
    diffusion = m.called(lambda t, dt, x, u, p: [[0], [p[1]]])
    for varies in ("never", "time", "state"):
        model = m.continuous(diffusion=diffusion, varies=varies)
        assert_equal(solve(model, "sr-cd-ckf2"), solve(m.continuous(), "sr-cd-ckf2"), 1e-6)


@pytest.mark.parametrize("method", ["ekf", "sr-ekf"])
def test_a_jacobian_serves_the_extended_filters_in_steps(method: str) -> None:
    sensor = {"measures": m.called(m.distance), "jacobian": m.called(m.distance_jacobian)}
    model = m.discrete(sensor, transition=m.called(m.transition), jacobian=m.called(m.transition_jacobian))
    assert_equal(solve(model, method), solve(m.discrete(), method), 1e-12)


@pytest.mark.parametrize("method", ["cd-ekf", "sr-cd-ekf", "sr-acd-ekf"])
def test_a_jacobian_serves_the_extended_filters_in_continuous_time(method: str) -> None:
    model = m.continuous(drift=m.called(m.drift), jacobian=m.called(m.drift_jacobian))
    assert_equal(solve(model, method), solve(m.continuous(), method), 1e-9)


def test_other_parameters_need_no_new_model() -> None:
    text = SPRING.replace("k = 2.0", "k = 3.0")
    other = np.array([3.0, 0.1])
    for model in (m.continuous(), Model.parse(SPRING), Model.parse(SPRING, "spring", {"q": 0.1})):
        changed = model.with_parameters(other)
        assert list(changed.parameters) == [3.0, 0.1]
        assert list(model.parameters) == [2.0, 0.1]
        assert_equal(solve(changed, "sr-cd-ckf"), solve(Model.parse(text), "sr-cd-ckf"))


def test_a_model_file_is_evaluated_anew_for_other_parameters() -> None:
    model = Model.parse(SPRING.replace("std = [0.3, 0.2]", 'std = ["3*q", 0.2]'))
    prior = model.with_parameters(np.array([2.0, 0.2])).prior
    assert prior is not None
    assert prior[1][0, 0] == pytest.approx(0.36)


def test_the_functions_of_a_model_can_be_evaluated() -> None:
    x = np.array([0.5, -0.25])
    for model in (m.continuous(), m.continuous(drift=m.called(m.drift)), Model.parse(SPRING)):
        np.testing.assert_allclose(model.drift(0.0, x), [-0.25, -2 * np.sin(0.5)])
        np.testing.assert_array_equal(model.diffusion(0.0, x), [[0], [0.1]])
        np.testing.assert_allclose(model.measure(0.0, x), [np.hypot(0.5, 1)])
        np.testing.assert_array_equal(model.measurement_noise(0.0), [[0.1]])
    for model in (m.discrete(), m.discrete(transition=m.called(m.transition)), Model.parse(STEPS)):
        np.testing.assert_allclose(model.transition(0.0, 0.5, x), x + 0.5 * np.array([-0.25, -2 * np.sin(0.5)]))
        np.testing.assert_allclose(model.noise_cov(0.0, 0.5), [[0, 0], [0, 0.005]])


def test_what_a_model_tells_of_itself() -> None:
    model = Model.parse(SPRING + '[filter]\nmethod = "cd-ckf"\nsubsteps = 4\n')
    assert (model.kind, model.states, model.measures) == ("continuous", ["x", "v"], ["r"])
    assert (model.controls, model.parameter_names, model.noises, model.step) == (0, ["k", "q"], 1, None)
    assert (model.method, model.options, model.time, model.start) == ("cd-ckf", {"substeps": 4.0}, 0.0, [])
    assert model.sensors == [{"name": "range", "columns": ["r"], "angles": [None]}]
    traced = m.discrete({"angles": [360.0]}, step=0.1)
    assert (traced.kind, traced.step, traced.noises) == ("discrete", 0.1, None)
    assert traced.sensors[0]["angles"] == [360.0]
    assert (traced.prior, traced.method, traced.options, traced.file) == (None, None, {}, None)


def test_a_start_is_found_from_the_rows() -> None:
    model = Model.parse(
        """
        [state]
        names = ["x", "vx"]
        start = { x = "z", vx = "rate(x)" }
        [dynamics]
        transition = { x = "x + dt*vx", vx = "vx" }
        noise_cov = [["dt^3/3", "dt^2/2"], ["dt^2/2", "dt"]]
        [[sensor]]
        name = "gps"
        measures = { z = "x" }
        std = [2]
        """
    )
    t0, mean, cov, row, started = model.begin(np.array([1.0, 2.0, 4.0]), np.array([[np.nan], [10.0], [16.0]]))
    assert (t0, row, started) == (4.0, 2, True)
    np.testing.assert_allclose(mean, [16.0, 3.0])
    np.testing.assert_allclose(cov, [[4, 2], [2, 2]])
    assert model.start == ["x", "vx"]


def test_states_between_the_rows_change_no_other_number() -> None:
    at = np.array([0.05, 0.1, 0.55, 3.0])
    choice = choose("sr-cd-ckf", "continuous")
    plain = run(m.continuous(), choice, MEAN, STD, 0.0, TIME, Z, goal="interval")
    asked = run(m.continuous(), choice, MEAN, STD, 0.0, TIME, Z, goal="interval", at=at)
    assert_equal(plain, asked)
    assert plain.at is None
    assert asked.at is not None
    np.testing.assert_array_equal(asked.at.time, at)
    np.testing.assert_array_equal(asked.at.mean[1], plain.mean[0])


def test_a_simulation_is_the_same_for_any_number_of_threads() -> None:
    model = m.continuous()
    x, z = simulate(model, MEAN, STD, 0.0, TIME, 7, 5, threads=1)
    again = simulate(model, MEAN, STD, 0.0, TIME, 7, 5, threads=3)
    assert x.shape == (5, 20, 2)
    assert z.shape == (5, 20, 1)
    np.testing.assert_array_equal(x, again[0])
    np.testing.assert_array_equal(z, again[1])
    assert not np.array_equal(x[0], x[1])
    one = simulate(model, MEAN, STD, 0.0, TIME, 7)
    np.testing.assert_array_equal(one[0][0], x[0])


def test_a_simulation_leaves_out_what_is_missing_and_calls_back() -> None:
    asked = np.zeros((20, 1))
    asked[3] = np.nan
    _, z = simulate(m.continuous(drift=m.called(m.drift)), MEAN, STD, 0.0, TIME, 7, z=asked)
    np.testing.assert_array_equal(np.isnan(z[0]), np.isnan(asked))


def test_estimates_are_made_once_and_cannot_be_written_to() -> None:
    est = solve(m.discrete(), "sr-ckf", "filter")
    for field in [*FIELDS, "time", "nis_dof"]:
        array = getattr(est, field)
        assert array is getattr(est, field)
        assert not array.flags.writeable
    assert est.filtered_mean is est.mean
    assert not est.smoothed


def test_functions_of_c_are_called_by_their_address() -> None:
    numbers = ctypes.POINTER(ctypes.c_double)

    @ctypes.CFUNCTYPE(None, ctypes.c_double, numbers, numbers, numbers)
    def flow(t: float, x: Any, p: Any, out: Any) -> None:
        out[0], out[1] = x[1], -p[0] * math.sin(x[0])

    @ctypes.CFUNCTYPE(None, ctypes.c_double, ctypes.c_double, numbers, numbers, numbers)
    def step(t: float, dt: float, x: Any, p: Any, out: Any) -> None:
        out[0], out[1] = x[0] + dt * x[1], x[1] - dt * p[0] * math.sin(x[0])

    def at(function: Any, **how: Any) -> Function:
        address = ctypes.cast(function, ctypes.c_void_p).value
        assert address is not None
        return Function.address(address, function, **how)

    model = m.continuous(drift=at(flow))
    assert_equal(solve(model, "sr-cd-ckf2"), solve(m.continuous(), "sr-cd-ckf2"), 1e-9)
    model = m.discrete(transition=at(step, step=True))
    assert_equal(solve(model, "sr-ckf"), solve(m.discrete(), "sr-ckf"), 1e-12)

"""A filter stepped by hand gives the numbers of a run, and goes on from a snapshot."""

from __future__ import annotations

import pickle
from typing import Any

import native_models as m
import numpy as np
import pytest
from native_models import MEAN, STD, TIME, Z, choose

from givens._native import Filter, methods, run
from givens.errors import GivensError, InputError, MethodError, StepError

METHODS = [(entry["name"], entry["kind"]) for entry in methods()]


def model_of(kind: str) -> Any:
    return m.discrete() if kind == "discrete" else m.continuous()


@pytest.mark.parametrize(("method", "kind"), METHODS)
def test_steps_by_hand_give_the_numbers_of_a_run_also_across_a_pickled_snapshot(method: str, kind: str) -> None:
    model, choice = model_of(kind), choose(method, kind)
    z = Z.copy()
    z[5] = np.nan
    est = run(model, choice, MEAN, STD, 0.0, TIME, z)
    f = Filter.start(model, choice, MEAN, STD, 0.0)
    for k, t in enumerate(TIME):
        f.predict(t)
        if k % 7 == 3:
            f = Filter.resume(model, choice, pickle.loads(pickle.dumps(f.snapshot())))
        np.testing.assert_array_equal(f.mean, est.predicted_mean[k])
        f.update(z[k])
        if k % 5 == 2:
            f = Filter.resume(model, choice, f.snapshot())
        assert f.time == t
        for field in ("mean", "cov", "factor", "innovation", "innovation_cov", "nis", "nis_dof", "log_likelihood"):
            np.testing.assert_array_equal(getattr(f, field), getattr(est, field)[k], err_msg=field)


def test_a_factor_is_a_root_of_the_covariance() -> None:
    for goal in ("filter", "interval"):
        est = run(m.discrete(), choose("sr-ckf"), MEAN, STD, 0.0, TIME, Z, goal=goal)  # type: ignore[arg-type]
        np.testing.assert_allclose(est.factor @ est.factor.transpose(0, 2, 1), est.cov, rtol=1e-12, atol=1e-15)


def test_a_filter_keeps_its_model_alive_and_steps_what_is_called() -> None:
    f = Filter.start(m.discrete(transition=m.called(m.transition)), choose("sr-ckf"), MEAN, STD, 0.0)
    g = Filter.start(m.discrete(), choose("sr-ckf"), MEAN, STD, 0.0)
    for one in (f, g):
        one.predict(0.1)
        one.update(np.array([1.4]))
    np.testing.assert_allclose(f.mean, g.mean, rtol=1e-13)


def test_an_exception_in_a_step_reaches_the_user_and_leaves_the_belief() -> None:
    def failing(t: float, dt: float, x: Any, u: Any, p: Any) -> Any:
        raise ZeroDivisionError("mine")

    f = Filter.start(m.discrete(transition=m.called(failing)), choose("sr-ckf"), MEAN, STD, 0.0)
    with pytest.raises(ZeroDivisionError, match="mine") as caught:
        f.predict(0.5)
    assert caught.value.__notes__ == ["raised in a function of the model at t = 0.5"]
    np.testing.assert_array_equal(f.mean, MEAN)
    f.update(np.array([1.4]))
    assert f.nis_dof == 1


def test_controls_are_asked_for_and_set() -> None:
    nodes = m.Nodes()
    g = nodes.graph
    pushed = [nodes.transition[0], g.binary("add", nodes.transition[1], g.control(0))]
    model = type(m.discrete()).discrete(g, ["x", "v"], 1, [2.0, 0.1], pushed, nodes.noise_cov, None, nodes.sensors())
    f = Filter.start(model, choose("sr-ckf"), MEAN, STD, 0.0)
    with pytest.raises(StepError, match="controls that were never set") as caught:
        f.predict(0.1)
    assert caught.value.remedy == "give `u`"
    f.set_controls(np.array([0.5]))
    f.predict(0.1)
    again = Filter.resume(model, choose("sr-ckf"), f.snapshot())
    again.predict(0.2)
    f.predict(0.2)
    np.testing.assert_array_equal(f.mean, again.mean)
    for wrong in (np.zeros(2), np.array([np.nan])):
        with pytest.raises(InputError):
            f.set_controls(wrong)


def test_absurd_steps_are_refused() -> None:
    f = Filter.start(m.discrete(), choose("sr-ckf"), MEAN, STD, 0.0)
    for t in (np.nan, np.inf):
        with pytest.raises(InputError, match="`t` is"):
            f.predict(t)
    with pytest.raises(StepError, match="cannot predict back to t = -1"):
        f.predict(-1.0)
    for z in (np.zeros(2), np.array([np.inf]), np.zeros((1, 1)), np.zeros(0)):
        with pytest.raises(InputError):
            f.update(z)
    with pytest.raises(TypeError):
        f.update([1.0])  # type: ignore[arg-type]
    with pytest.raises(InputError):
        Filter.start(m.discrete(), choose("sr-ckf"), MEAN, STD, np.nan)
    with pytest.raises(MethodError):
        Filter.start(m.continuous(), choose("sr-ckf"), MEAN, STD, 0.0)


@pytest.mark.parametrize(
    "wrong",
    [
        {"mean": np.zeros(3)},
        {"mean": np.array([np.nan, 0.0])},
        {"factor": np.ones((2, 2))},
        {"factor": -np.eye(2)},
        {"cov": "x"},
        {"moved": np.eye(2)},
        {"floor": np.zeros(0)},
        {"controls": np.zeros(3)},
        {"parameters": np.zeros(9)},
        {"work": (1, 2)},
        {"step": -1},
        {"time": None},
        {"innovation": np.zeros(4)},
        {"innovation_cov": np.zeros(4)},
        {"nis_dof": -1},
    ],
)
def test_a_snapshot_that_is_none_is_refused(wrong: dict[str, Any]) -> None:
    model, choice = m.discrete(), choose("sr-ckf")
    snapshot: Any = dict(Filter.start(model, choice, MEAN, STD, 0.0).snapshot())
    refusals = (GivensError, TypeError, ValueError, OverflowError)
    with pytest.raises(refusals):
        Filter.resume(model, choice, snapshot | wrong)
    (key,) = wrong
    del snapshot[key]
    with pytest.raises(InputError, match=f"the snapshot has no `{key}`"):
        Filter.resume(model, choice, snapshot)

"""Trajectories drawn jointly from what a smoother knows."""

from __future__ import annotations

from typing import Any

import native_models as m
import numpy as np
import pytest
from native_models import MEAN, STD, STEPS, TIME, Z, choose

from givens._native import run, sample
from givens.errors import GivensError, MethodError, StepError


def draw(model: Any, method: str = "sr-ckf", **other: Any) -> Any:
    arguments: dict[str, Any] = {"draws": 3, "seed": 7} | other
    return sample(model, choose(method, model.kind), MEAN, STD, 0.0, TIME, Z, **arguments)


@pytest.mark.parametrize(("kind", "method"), [("discrete", "sr-ckf"), ("discrete", "ckf"), ("continuous", "sr-cd-ckf")])
def test_draws_have_the_mean_and_covariance_of_the_smoother(kind: str, method: str) -> None:
    model = m.discrete() if kind == "discrete" else m.continuous()
    x = draw(model, method, draws=4000)
    assert x.shape == (4000, 20, 2)
    est = run(model, choose(method, model.kind), MEAN, STD, 0.0, TIME, Z, goal="interval")
    std = np.sqrt(np.diagonal(est.cov, axis1=1, axis2=2))
    # the mean of 4000 draws has a standard deviation of 0.016 of theirs; five of these
    assert np.all(np.abs(x.mean(0) - est.mean) < 0.08 * std)
    assert np.all(np.abs(x.std(0) / std - 1) < 0.08)


def test_a_draw_does_not_depend_on_how_many_there_are_and_says_its_seed() -> None:
    few, many = draw(m.discrete()), draw(m.discrete(), draws=8)
    np.testing.assert_array_equal(few, many[:3])
    assert not np.array_equal(few, draw(m.discrete(), seed=8))
    assert not np.array_equal(few, draw(m.discrete(), track=1))
    assert draw(m.discrete(), draws=0).shape == (0, 20, 2)


def test_a_draw_that_fails_is_told_as_a_run_is() -> None:
    failing = type(m.discrete()).parse(STEPS.replace('"hypot(x, 1)"', '"where(t > 0.45, sqrt(-1 - x^2), x)"'))
    with pytest.raises(StepError, match="row 4, t = 0.5: the predicted measure `r`") as caught:
        draw(failing)
    assert caught.value.row == 4

    def raising(t: float, dt: float, x: Any, u: Any, p: Any) -> Any:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError) as raised:
        draw(m.discrete(transition=m.called(raising)))
    assert raised.value.__notes__ == ["raised in a function of the model at row 0, t = 0.1"]


@pytest.mark.parametrize("wrong", [{"draws": -1}, {"draws": 1.5}, {"seed": -1}, {"track": -1}, {"u": np.zeros((3, 1))}])
def test_absurd_draws_are_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises((GivensError, TypeError, OverflowError)):
        draw(m.discrete(), **wrong)
    with pytest.raises(MethodError):
        sample(m.continuous(), choose(None), MEAN, STD, 0.0, TIME, Z, draws=1, seed=1)

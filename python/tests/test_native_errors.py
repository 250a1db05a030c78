"""What is wrong is told by name, with the remedy in the words of Python."""

from __future__ import annotations

import pickle
from typing import Any

import native_models as m
import numpy as np
import pytest
from native_models import MEAN, SPRING, STD, STEPS, TIME, Z, choose

from givens._native import Model, methods, run, run_batch, simulate
from givens.errors import GivensError, InputError, MethodError, ModelError, StepError, TraceError

WITHOUT = [entry["name"] for entry in methods() if entry["rule"] != "taylor" and entry["time_update"] != "ito-taylor"]


def solve(model: Model, method: str | None = None, z: Any = Z, **options: Any) -> Any:
    return run(model, choose(method, model.kind, **options), MEAN, STD, 0.0, TIME, z)


@pytest.mark.parametrize(
    ("method", "options", "option", "words"),
    [
        ("sr-kcf", {}, None, "did you mean `sr-ckf`"),
        ("sr-ckf", {"kapa": 1.0}, "kapa", "did you mean `kappa`"),
        ("sr-ckf", {"kappa": 1.0}, "kappa", "does not read `kappa`"),
        ("sr-ukf", {"kappa": "much"}, "kappa", "must be a number"),
        ("sr-ukf", {"kappa": [1]}, "kappa", "is a number or a word, not list"),
        ("sr-ckf", {"form": "cube"}, "form", "no such choice"),
        ("sr-cd-ckf", {}, None, "is a continuous-time method, and the model is discrete"),
        ("qkf", {"points": 1}, "points", "must be a whole number from 2 to 64"),
    ],
)
def test_a_method_that_is_not_there_is_refused_by_name(
    method: str, options: dict[str, Any], option: str | None, words: str
) -> None:
    with pytest.raises(MethodError) as caught:
        choose(method, "discrete", **options)
    assert words in str(caught.value)
    assert caught.value.option == option


def test_an_option_out_of_its_range_for_the_model_is_refused_by_name() -> None:
    with pytest.raises(MethodError, match="kappa = -2") as caught:
        solve(m.discrete(), "sr-ukf", kappa=-2)
    assert caught.value.option == "kappa"
    assert caught.value.remedy is not None
    assert "n = 2" in caught.value.remedy


def test_a_method_that_differentiates_what_is_called_names_those_that_do_not() -> None:
    plain = m.called(m.drift)
    cases = [
        (m.continuous(drift=plain), "sr-cd-ckf", "second derivatives of `drift`"),
        (m.continuous(drift=plain, jacobian=m.called(m.drift_jacobian)), "sr-cd-ckf", "brings the first only"),
        (m.continuous(drift=plain), "cd-ekf", "derivatives of `drift`"),
        (m.continuous({"measures": m.called(m.distance)}), "cd-ekf", "derivatives of `measures`"),
    ]
    for model, method, words in cases:
        with pytest.raises(MethodError) as caught:
            solve(model, method)
        assert words in caught.value.message
        remedy = str(caught.value.remedy)
        assert [name for name in WITHOUT if name in remedy.split(": ")[-1].split(", ")] == [
            name for name in WITHOUT if name in {e["name"] for e in methods() if e["kind"] == "continuous"}
        ]
        assert "sr-cd-ckf2" in remedy
    with pytest.raises(MethodError, match="derivatives of `transition`") as caught:
        solve(m.discrete(transition=m.called(m.transition)), "ekf")
    assert "sr-ckf" in str(caught.value.remedy)
    with pytest.raises(MethodError, match="rodas4 takes derivatives") as caught:
        solve(m.continuous(drift=plain), "cd-ckf2", solver="rodas4")
    assert caught.value.option == "solver"


def test_a_diffusion_that_reads_the_state_is_refused_where_it_cannot_be_served() -> None:
    nodes = m.Nodes()
    x = nodes.graph.state(0)
    model = Model.continuous(
        nodes.graph, ["x", "v"], 0, [2.0, 0.1], nodes.drift, [nodes.diffusion[0], x], 1, nodes.sensors()
    )
    with pytest.raises(MethodError, match="the diffusion depends on the state") as caught:
        solve(model)
    assert 'method="sr-cd-ckf2"' in str(caught.value.remedy)


def test_an_exception_of_the_model_reaches_the_user_unchanged_with_row_and_time() -> None:
    class MyError(Exception):
        pass

    error = MyError("out of fuel")

    def failing(t: float, dt: float, x: Any, u: Any, p: Any) -> Any:
        if t > 0.65:
            raise error
        return m.transition(t, dt, x, u, p)

    with pytest.raises(MyError) as caught:
        solve(m.discrete(transition=m.called(failing)))
    assert caught.value is error
    assert caught.value.__notes__ == ["raised in a function of the model at row 7, t = 0.8"]


@pytest.mark.parametrize(
    ("result", "words"),
    [
        (None, "`transition` gave NoneType"),
        ("text", "`transition` gave str"),
        (np.zeros((4, 2)), "`transition` gave an array of shape (4, 2), not (2, 4)"),
        (np.zeros(3), "`transition` gave an array of shape (3,), not (2, 4)"),
    ],
)
def test_a_function_that_gives_no_numbers_is_named(result: Any, words: str) -> None:
    model = m.discrete(transition=m.called(lambda t, dt, x, u, p: result))
    with pytest.raises(InputError) as caught:
        solve(model)
    assert words in str(caught.value)


def test_a_failed_step_names_row_time_matrix_and_state_and_a_remedy_of_python() -> None:
    text = STEPS.replace('r = "hypot(x, 1)"', 'r = "where(t > 0.45, sqrt(-1 - x^2), x)"')
    est = solve(Model.parse(text))
    assert len(est) == 4
    failure = est.failure
    assert (failure["row"], failure["fault"], failure["quantity"]) == (4, "not-finite", "predicted measure")
    assert (failure["component"], failure["matrix"]) == ("r", None)
    assert failure["time"] == TIME[4]
    assert failure["message"] == "the predicted measure `r` is not a finite number"
    text = STEPS.replace("std = [0.1]", "std = [0]").replace('"hypot(x, 1)"', '"0*x"')
    failure = solve(Model.parse(text), "ckf").failure
    assert (failure["row"], failure["pivot"], failure["component"]) == (0, 0, "r")
    assert failure["remedy"] == 'give it a std above zero, or try the square-root form (form="square-root")'


def test_a_simulation_that_fails_raises_a_step_error() -> None:
    text = STEPS.replace('v = "v - dt*k*sin(x)"', 'v = "v - dt*k*sin(x) + where(t > 0.45, 1/0, 0)"')
    with pytest.raises(StepError) as caught:
        simulate(Model.parse(text), MEAN, STD, 0.0, TIME, 1)
    error = caught.value
    assert (error.row, error.component, error.fault) == (5, "v", "not-finite")
    assert str(error).startswith("row 5, t = 0.6")


def test_a_model_file_with_errors_tells_all_of_them_with_their_places() -> None:
    with pytest.raises(ModelError) as caught:
        Model.parse(SPRING.replace("-k*sin(x)", "-k*sin(y)").replace("std = [0.1]", 'std = ["w"]'), "spring.toml")
    assert (caught.value.file, caught.value.line) == ("spring.toml", 11)
    assert str(caught.value).count("spring.toml:") == 2
    with pytest.raises(ModelError, match="no-such"):
        Model.read("no-such.toml")


def test_a_track_of_several_that_fails_does_not_stop_the_others() -> None:
    good, bad = m.discrete(), Model.parse(STEPS.replace('"hypot(x, 1)"', '"sqrt(-1-x^2)"'))
    tracks: list[Any] = [(model, choose(None), MEAN, STD, 0.0, TIME, Z, None, None) for model in (good, bad, good)]
    (one, two, three), _ = run_batch(tracks, threads=2)
    assert two.failure is not None
    assert one.failure is None
    np.testing.assert_array_equal(one.mean, three.mean)
    tracks[1] = (good, choose(None), MEAN, STD, 0.0, TIME[::-1], Z, None, None)
    with pytest.raises(InputError) as caught:
        run_batch(tracks)
    assert caught.value.row == 1
    assert caught.value.__notes__ == ["in track 1"]


@pytest.mark.parametrize(
    "error",
    [
        GivensError("a", remedy="b"),
        InputError("a", argument="z", row=3, component="x", remedy="b"),
        TraceError("a", function="f", file="f.py", line=3, source="x = 1", argument="drift"),
        ModelError("a", file="f.toml", line=1, column=2),
        MethodError("a", option="kappa", remedy="b"),
        StepError("a", time=1.0, row=2, matrix="m", pivot=0, component="x", track="t", remedy="b"),
    ],
)
def test_errors_can_be_pickled_with_their_fields(error: GivensError) -> None:
    error.add_note("a note")
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert str(again) == str(error)
    assert vars(again) == vars(error)


def test_errors_are_also_what_python_calls_them() -> None:
    assert issubclass(InputError, ValueError)
    assert issubclass(StepError, ArithmeticError)
    assert str(GivensError("bad", remedy="do better")) == "bad\n  help: do better"

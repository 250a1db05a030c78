"""Nothing panics, whatever the arguments: they are refused, or they work."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import native_models as m
import numpy as np
import pytest
from native_models import MEAN, SPRING, STD, STEPS, TIME, Z, choose

from givens import _native as native
from givens.errors import GivensError, InputError

NAN, INF = np.nan, np.inf
#: What refuses an argument: never a panic, which is no `Exception`.
REFUSALS = (GivensError, TypeError, ValueError, OverflowError, KeyError)


def refused(f: Callable[[], Any], words: str = "") -> None:
    with pytest.raises(REFUSALS) as caught:
        f()
    assert words in str(caught.value)


def run(model: Any = None, **other: Any) -> Any:
    arguments: dict[str, Any] = {"mean": MEAN, "cov": STD, "t0": 0.0, "time": TIME, "z": Z} | other
    model = model or m.discrete()
    return native.run(model, choose(None, model.kind), **arguments)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"mean": np.zeros(3)}, "`mean` has shape (3,), not (2,)"),
        ({"mean": np.array([NAN, 0])}, "the initial mean of `x` is NaN"),
        ({"mean": MEAN.astype(int)}, ""),
        ({"mean": [1.0, 2.0]}, ""),
        ({"mean": np.zeros((2, 1))}, "`mean` has shape (2, 1)"),
        ({"cov": np.zeros((2, 3))}, "`cov` has shape (2, 3)"),
        ({"cov": np.zeros((2, 2, 2))}, "`cov` has shape (2, 2, 2)"),
        ({"cov": np.array(1.0)}, "`cov` has shape ()"),
        ({"cov": np.array([1.0, -1.0])}, "not positive semidefinite"),
        ({"cov": np.array([[1.0, 2.0], [2.0, 1.0]])}, "at pivot 2 of 2 (state `v`)"),
        ({"cov": np.array([[1.0, 2.0], [0.0, 1.0]])}, "is not symmetric: [1, 0] and [0, 1] differ (state `v`)"),
        ({"t0": NAN}, "`t0` is NaN"),
        ({"t0": 5.0}, "row 0: time 0.1 is before"),
        ({"time": TIME[::-1]}, "row 1: time"),
        ({"time": TIME[:3]}, "`z` has shape (20, 1), not (3, 1)"),
        ({"time": TIME.astype("datetime64[s]")}, ""),
        ({"time": np.array(0.5), "z": np.zeros((1, 1))}, "`t` has shape (), not (1,)"),
        ({"time": np.full(20, INF)}, "row 0: time"),
        ({"z": Z[:, 0]}, "`z` has shape (20,), not (20, 1)"),
        ({"z": Z.astype(np.float32)}, ""),
        ({"z": np.where(Z > 1.4, INF, Z)}, "measure `r` is infinite"),
        ({"u": np.zeros((20, 1))}, "`u` has shape (20, 1), not (20, 0)"),
        ({"goal": "guess"}, "goal = guess"),
        ({"goal": "lag"}, "`lag` is a whole number"),
        ({"goal": "lag", "goal_value": -1}, "`lag` is a whole number"),
        ({"goal": "lag", "goal_value": 1.5}, "`lag` is a whole number"),
        ({"goal": "lag", "goal_value": NAN}, "`lag` is a whole number"),
        ({"goal": "point"}, "goal = point"),
        ({"goal": "point", "goal_value": 0.33}, "the nearest row is at 0.3"),
        ({"goal": "point", "goal_value": NAN}, "neither a row nor the initial belief stands at NaN"),
        ({"at": np.array([0.5, 0.2])}, "time 1 of `at` is 0.2"),
        ({"at": np.array([NAN])}, "time 0 of `at` is NaN"),
        ({"at": np.array([-1.0])}, "time 0 of `at` is -1"),
        ({"at": np.zeros((2, 2))}, "dimensions of `at`"),
    ],
)
def test_a_run_refuses_absurd_arguments(arguments: dict[str, Any], words: str) -> None:
    refused(lambda: run(**arguments), words)


def test_a_run_takes_arrays_however_they_lie_in_memory() -> None:
    wide = np.zeros((40, 3))
    wide[::2, 1] = Z[:, 0]
    plain = run()
    strided = run(z=wide[::2, 1:2], time=np.repeat(TIME, 2)[::2], mean=np.array([0.0, 9.0, 1.0])[::-2])
    np.testing.assert_array_equal(plain.mean, strided.mean)
    assert run(cov=np.asfortranarray(np.diag(STD**2))).failure is None
    frozen = Z.copy()
    frozen.flags.writeable = False
    np.testing.assert_array_equal(run(z=frozen).mean, plain.mean)


def test_a_run_without_rows_is_empty() -> None:
    for goal in ("filter", "interval"):
        est = run(time=np.zeros(0), z=np.zeros((0, 1)), goal=goal)
        assert len(est) == 0
        assert est.mean.shape == (0, 2)
        assert est.innovation_cov.shape == (0, 1, 1)
    est = run(goal="lag", goal_value=1e30)
    assert len(est) == 20


def test_a_batch_refuses_absurd_arguments() -> None:
    track = (m.discrete(), choose(None), MEAN, STD, 0.0, TIME, Z, None, None)
    assert native.run_batch([]) == ([], [])
    for threads in (1, 7):
        assert len(native.run_batch([track] * 3, threads=threads)[0]) == 3
    refused(lambda: native.run_batch([track], threads=0), "at least one thread")
    refused(lambda: native.run_batch([track], threads=-1))
    refused(lambda: native.run_batch([track[:5]]))  # type: ignore[list-item]
    refused(lambda: native.run_batch([track], goal="guess"))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"seed": -1}, ""),
        ({"seed": 2**70}, ""),
        ({"seed": 1.5}, ""),
        ({"runs": -1}, ""),
        ({"substeps": 0}, "`substeps` is 0"),
        ({"threads": 0}, "at least one thread"),
        ({"mean": np.zeros(1)}, "`mean` has shape"),
        ({"time": TIME[::-1]}, "row 1: time"),
        ({"z": np.zeros((20, 2))}, "`z` has shape"),
        ({"u": np.zeros((20, 2))}, "`u` has shape"),
    ],
)
def test_a_simulation_refuses_absurd_arguments(arguments: dict[str, Any], words: str) -> None:
    all_: dict[str, Any] = {"mean": MEAN, "cov": STD, "t0": 0.0, "time": TIME, "seed": 1} | arguments
    refused(lambda: native.simulate(m.continuous(), **all_), words)


def test_a_simulation_of_nothing_is_empty() -> None:
    x, z = native.simulate(m.discrete(), MEAN, STD, 0.0, TIME, 1, 0)
    assert x.shape == (0, 20, 2)
    x, z = native.simulate(m.discrete(), MEAN, STD, None, np.zeros(0), 1)
    assert z.shape == (1, 0, 1)


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ({"drift": [1]}, "the drift: 2 expected, 1 found"),
        ({"drift": [10**6, 1]}, "there is no node 1000000"),
        ({"drift": [-1, 1]}, ""),
        ({"drift": [1.5, 1]}, ""),
        ({"drift": None}, ""),
        ({"diffusion": [1, 1, 1]}, "the entries of the diffusion: 2 expected, 3 found"),
        ({"noises": 2**60}, "the entries of the diffusion"),
        ({"noises": -1}, ""),
        ({"varies": "often"}, "varies = often"),
        ({"jacobian": 3}, ""),
    ],
)
def test_a_model_refuses_absurd_parts(parts: dict[str, Any], words: str) -> None:
    refused(lambda: m.continuous(**parts), words)


@pytest.mark.parametrize(
    ("sensor", "words"),
    [
        ({"std": None}, "needs its noise"),
        ({"cov": [1]}, "needs its noise: `std` or `cov`, and not both"),
        ({"columns": []}, "a sensor measures nothing"),
        ({"columns": ["a", "b"]}, "the measures of sensor `range`: 2 expected, 1 found"),
        ({"angles": [NAN]}, "the period of the angle `r` is not a positive number"),
        ({"angles": [1.0, 2.0]}, "the angles of sensor `range`"),
        ({"std": [1, 2]}, "the noise of sensor `range`: 1 expected, 2 found"),
        ({"std": None, "cov": [1, 2]}, "the noise of sensor `range`: 1 expected, 2 found"),
        ({"measures": "x"}, ""),
        ({"name": 3}, ""),
    ],
)
def test_a_sensor_refuses_absurd_parts(sensor: dict[str, Any], words: str) -> None:
    refused(lambda: m.discrete(sensor), words)


def test_models_refuse_absurd_sizes_and_inputs() -> None:
    nodes = m.Nodes()
    graph, sensors = nodes.graph, nodes.sensors()

    def build(states: Any, controls: Any, parameters: Any, transition: Any = None, step: Any = None) -> Any:
        transition = nodes.transition if transition is None else transition
        return native.Model.discrete(graph, states, controls, parameters, transition, [], step, sensors)

    refused(lambda: build([], 0, [2.0, 0.1]), "the model has no state")
    refused(lambda: build(["x"], 0, [2.0, 0.1], [nodes.transition[0]]), "component 1 of the state")
    refused(lambda: build(["x", "v"], 0, [2.0], [nodes.transition[0], graph.parameter(5)]), "may not name parameter 5")
    refused(lambda: build(["x", "v"], 0, [NAN, 1.0]), "`parameters[0]` is NaN")
    refused(lambda: build(["x", "v"], 0, [2.0, 0.1], [graph.control(3), nodes.drift[0]]), "may not name control 3")
    refused(lambda: build(["x", "v"], -1, [2.0, 0.1]))
    refused(lambda: build(["x", "v"], 0, [2.0, 0.1], step=0.0), "not a positive number")
    refused(lambda: build(["x", "v"], 0, [2.0, 0.1], step=NAN), "not a positive number")
    refused(
        lambda: native.Model.discrete(graph, ["x", "v"], 0, [2.0, 0.1], nodes.transition, [], None, []),
        "measures nothing",
    )
    called = m.called(m.drift)
    refused(lambda: m.continuous(drift=called, diffusion=[graph.step(), nodes.graph.step()]), "names a quantity")


@pytest.mark.parametrize("values", [np.zeros(1), np.zeros(3), np.array([NAN, 1.0]), np.zeros(2, int), [1.0, 2.0], None])
def test_parameters_of_the_wrong_kind_are_refused(values: Any) -> None:
    for model in (m.discrete(), native.Model.parse(SPRING)):
        refused(lambda model=model: model.with_parameters(values))


def test_the_functions_of_a_model_refuse_absurd_points() -> None:
    model, x = m.continuous(), np.zeros(2)
    for f in (model.drift, model.diffusion, model.measure):
        refused(lambda f=f: f(0.0, np.zeros(3)), "`x` has shape (3,), not (2,)")
        refused(lambda f=f: f(0.0, x, np.zeros(1)), "`u` has shape (1,), not (0,)")
        refused(lambda f=f: f(0.0, [0.0, 0.0]))
        assert np.isnan(f(0.0, np.full(2, NAN))).any() or f == model.diffusion
    refused(lambda: model.transition(0.0, 1.0, x), "a continuous model has no transition")
    refused(lambda: model.noise_cov(0.0, 1.0), "a continuous model has no noise_cov")
    refused(lambda: m.discrete().drift(0.0, x), "a discrete model has no drift")
    refused(lambda: model.begin(TIME, Z), "the model is not from a file")
    file = native.Model.parse(SPRING)
    refused(lambda: file.begin(TIME[:3], Z), "`z` has shape")
    refused(lambda: native.read_tracks(model, "data.csv"), "the model is not from a file")
    refused(lambda: native.read_tracks(file, "no-such.csv"), "no-such.csv")


def test_functions_that_are_none_are_refused() -> None:
    refused(lambda: native.Function.callable(3), "must be callable")  # type: ignore[arg-type]
    refused(lambda: native.Function.address(0, None), "is null")
    refused(lambda: native.Function.address(-1, None))


def test_choices_refuse_absurd_arguments() -> None:
    refused(lambda: native.Choice("sr-ckf", {}, "cubic"), "kind = cubic")  # type: ignore[arg-type]
    refused(lambda: native.Choice("", {}, "discrete"), "there is no method ``")
    refused(lambda: native.Choice("sr-ckf", {3: 4}, "discrete"))  # type: ignore[dict-item]
    refused(lambda: native.Choice("ukf", {"alpha": NAN}, "discrete"), "must be a number")
    refused(lambda: native.Choice("ukf", {"alpha": True}, "discrete"), "must be a number")
    assert native.Choice("ukf", {"kappa": np.float32(0.5)}, "discrete").parts(3)["kappa"] == 0.5
    assert native.Choice(None, {}, "continuous").name == "sr-cd-ckf"


def test_metrics_refuse_absurd_arguments() -> None:
    refused(lambda: native.consistency(np.zeros(2), np.zeros(3, np.int64)), "degrees of freedom")
    refused(lambda: native.consistency(np.zeros(1), np.array([-1])), "-1 degrees of freedom")
    refused(lambda: native.consistency(np.zeros(1), np.zeros(1)))  # type: ignore[arg-type]
    assert native.consistency(np.zeros(0), np.zeros(0, np.int64))["verdict"] == "unknown"
    refused(lambda: native.accuracy(np.zeros(2), np.zeros((2, 2)), np.zeros(2)), "two dimensions")
    refused(lambda: native.accuracy(np.zeros((3, 2)), np.zeros((3, 2)), np.zeros((3, 2))), "`cov` has shape")
    nothing = native.accuracy(np.zeros((0, 2)), np.zeros((0, 2, 2)), np.zeros((0, 2)))
    assert np.isnan(nothing["rmse"]).all()


def test_graphs_refuse_absurd_arguments() -> None:
    graph = native.Graph()
    x = graph.state(0)
    refused(lambda: graph.unary("cube", x), "no operation `cube`")
    refused(lambda: graph.binary("add", x, 99), "there is no node 99")
    refused(lambda: graph.state(-1))
    refused(lambda: graph.power(x, 2**40))
    empty = np.zeros(0)
    assert np.isnan(graph.evaluate([x], empty, 0.0, 0.0, empty, empty)).all()
    refused(lambda: graph.evaluate([99], empty, 0.0, 0.0, empty, empty), "there is no node 99")
    np.testing.assert_array_equal(graph.evaluate([x], np.arange(4.0)[::2], 0.0, 0.0, empty, empty), [0.0])


def test_a_graph_that_is_full_is_told() -> None:
    graph = native.Graph()
    with pytest.raises(InputError) as caught:
        for k in range(100_001):
            graph.constant(k)
    assert str(caught.value) == (
        "the expressions have more than 100000 distinct operations\n  help: shorten them, or pass trace=False"
    )


def test_model_files_refuse_absurd_arguments() -> None:
    refused(lambda: native.Model.read(""))
    refused(lambda: native.Model.read("\0"))
    refused(lambda: native.Model.parse(""))
    refused(lambda: native.Model.parse(STEPS, "steps", {"w": 1.0}), "`w`")
    refused(lambda: native.Model.parse(STEPS, "steps", {"k": NAN}), "parameter `k` is NaN")


def test_what_says_that_it_is_endless_is_refused() -> None:
    endless = range(2**62)
    refused(lambda: native.run_batch(endless), "more than there is memory for")  # type: ignore[arg-type]
    refused(lambda: m.discrete(transition=endless))
    ones, counts = np.broadcast_to(1.0, (2**50,)), np.broadcast_to(np.int64(1), (2**50,))
    refused(lambda: native.consistency(ones, counts), "longer than there is memory for")


def test_an_array_that_lies_across_words_is_read() -> None:
    across = np.frombuffer(b"\0" + MEAN.tobytes(), "u1", offset=1).view("f8")
    assert not across.flags.aligned
    assert (run(mean=across).mean == run().mean).all()

"""Any argument in any place of the native half: it works or it is refused, and the interpreter goes on.

A panic is no ``Exception``, and memory that is not there ends the program: either fails here. GIVENS_CASES=100 tries a
hundred times as many, of another seed.
"""

from __future__ import annotations

import os
import random
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import native_models as m
import numpy as np
import pytest
from native_models import MEAN, SPRING, STD, STEPS, TIME, Z

from givens import _native as native
from givens.errors import GivensError

TIMES = int(os.environ.get("GIVENS_CASES", "1"))
#: Calls of each function.
CALLS = 200 * TIMES


class Lie(Exception):
    """What an object raises in place of an answer."""


#: What refuses an argument.
REFUSALS = (GivensError, TypeError, ValueError, OverflowError, LookupError, AttributeError, MemoryError, BufferError, Lie)


class Long(Sequence[Any]):
    """A sequence that says it has more items than there are."""

    def __init__(self, length: int) -> None:
        self.length = length

    def __len__(self) -> int:
        return self.length

    def __getitem__(self, at: Any) -> Any:
        if at >= 3:
            raise IndexError(at)
        return at


class Raising(Sequence[Any]):
    """A sequence that raises wherever it is asked."""

    def __len__(self) -> int:
        raise Lie

    def __getitem__(self, at: Any) -> Any:
        raise Lie

    def __iter__(self) -> Iterator[Any]:
        raise Lie


class Array:
    """An object that gives another array than it says, or none."""

    def __init__(self, given: Any) -> None:
        self.given = given

    def __array__(self, *_: Any, **__: Any) -> Any:
        if self.given is Lie:
            raise Lie
        return self.given

    def __float__(self) -> float:
        raise Lie

    def __index__(self) -> Any:
        return self.given

    def __arrow_c_stream__(self, _: Any = None) -> Any:
        return self.given


def arrays(draw: random.Random) -> Any:
    """An array of any kind, length and layout; some say that they are longer than all memory."""
    shape = draw.choice([(), (0,), (1,), (2,), (20,), (20, 1), (20, 2), (2, 2), (1, 20), (0, 1), (20, 0), (2, 2, 2), (20, 2, 2)])
    kind = draw.choice(["f8", "f8", "f8", "f8", "f4", "i8", "u1", "?", "c16", ">f8", "O", "U3", "M8[s]", "V8"])
    array = np.zeros(shape, dtype=kind)
    if kind == "f8":
        array = np.asarray(array + draw.choice([0.0, 1.0, -1.0, np.nan, np.inf, 1e308, 5e-324, 1e160]))
        if array.size:
            array.flat[draw.randrange(array.size)] = draw.choice([0.0, -1.0, np.nan, np.inf, 1e308, 2.0])
    layout = draw.randrange(10)
    if layout == 0:
        return array.T
    if layout == 1:
        return np.asfortranarray(array)
    if layout == 2:
        return np.repeat(array, 2, axis=0)[::2] if array.ndim else array
    if layout == 3:
        return array[::-1] if array.ndim else array
    if layout == 4:
        array.flags.writeable = False
    if layout == 5:
        return np.ma.masked_array(array)
    if layout == 6 and array.size:
        unaligned = np.frombuffer(bytes(8 * array.size + 1), dtype="u1", offset=1).view("f8")
        return unaligned.reshape(array.shape)
    if layout == 7:
        length = draw.choice([2**40, 2**57])
        return np.broadcast_to(np.float64(1), draw.choice([(length,), (length, 1), (length, 2), (2, length)]))
    return array


def anything(draw: random.Random) -> Any:
    """Any object."""
    if draw.random() < 0.5:
        return arrays(draw)
    return draw.choice(
        [
            None, True, 0, 1, -1, 3, 2**31, 2**32, 2**63 - 1, 2**63, 2**64, -(2**63), 10**30, 0.0, -0.5, 1.5, np.nan, np.inf,
            1e308, "", "x", "f32", "sr-ckf", "\0", "\ud800", "é" * 1000, b"x", [], [0], [0, 1], [1.0, 2.0], [None], [[]], (),
            ("x", "v"), {}, {"x": 1}, {1: "x"}, {"name": "x"}, set(), object(), range(2), range(2**36), range(2**62), Long(2**40),
            Long(2**62), Long(1), Raising(), Array(Lie), Array(1), Array(2**70), Array(np.zeros(2)), Array("x"), np.float64(2),
            np.float32(2), np.int64(1), np.datetime64("2026-01-01"), memoryview(bytes(16)), lambda *_: None, lambda *_: 1 / 0,
            native.Graph(), m.Nodes().graph, m.discrete(), m.continuous(), m.choose(None), m.called(lambda *_: np.zeros(9)),
        ]
    )  # fmt: skip


def stepped() -> Any:
    return native.Filter.start(m.discrete(), m.choose(None), MEAN, STD, 0.0)


def parts(kind: str) -> dict[str, Any]:
    nodes = m.Nodes()
    both = {"graph": nodes.graph, "states": ["x", "v"], "controls": 0, "parameters": [2.0, 0.1], "sensors": nodes.sensors()}
    if kind == "discrete":
        return both | {"transition": nodes.transition, "noise_cov": nodes.noise_cov, "step": None}
    return both | {"drift": nodes.drift, "diffusion": nodes.diffusion, "noises": 1}


def rows() -> dict[str, Any]:
    return {"model": m.discrete(), "mean": MEAN, "cov": STD, "t0": 0.0, "time": TIME}


#: Every function with arguments that are right.
FUNCTIONS: dict[str, tuple[Callable[..., Any], Callable[[], dict[str, Any]]]] = {
    "Model.parse": (native.Model.parse, lambda: {"text": SPRING, "name": "m", "parameters": {"k": 1.0}}),
    "Model.discrete": (native.Model.discrete, lambda: parts("discrete")),
    "Model.continuous": (native.Model.continuous, lambda: parts("continuous")),
    "Model.begin": (native.Model.parse(STEPS).begin, lambda: {"time": TIME, "z": Z, "u": None}),
    "Model.with_parameters": (m.discrete().with_parameters, lambda: {"values": np.array([1.0, 2.0])}),
    "Model.transition": (m.discrete().transition, lambda: {"t": 0.0, "dt": 0.1, "x": MEAN, "u": None}),
    "Model.noise_cov": (m.discrete().noise_cov, lambda: {"t": 0.0, "dt": 0.1, "u": None}),
    "Model.drift": (m.continuous().drift, lambda: {"t": 0.0, "x": MEAN, "u": None}),
    "Model.diffusion": (m.continuous().diffusion, lambda: {"t": 0.0, "x": MEAN, "u": None}),
    "Model.measure": (m.discrete().measure, lambda: {"t": 0.0, "x": MEAN, "u": None}),
    "Model.measurement_noise": (m.discrete().measurement_noise, lambda: {"t": 0.0, "u": None}),
    "Choice": (native.Choice, lambda: {"method": "sr-ukf", "options": {"kappa": 1.0}, "kind": "discrete"}),
    "Choice.parts": (m.choose(None).parts, lambda: {"states": 2}),
    "Choice.check": (m.choose(None).check, lambda: {"model": m.discrete()}),
    "run": (native.run, lambda: rows() | {"choice": m.choose(None), "z": Z, "goal": "lag", "goal_value": 2, "at": TIME[:3]}),
    "sample": (native.sample, lambda: rows() | {"choice": m.choose(None), "z": Z, "draws": 2, "seed": 1}),
    "simulate": (native.simulate, lambda: rows() | {"seed": 1, "runs": 2, "z": Z, "substeps": 4, "threads": 1}),
    "consistency": (native.consistency, lambda: {"nis": np.ones(3), "nis_dof": np.ones(3, dtype=np.int64)}),
    "accuracy": (native.accuracy, lambda: {"mean": np.ones((3, 1)), "cov": np.ones((3, 1, 1)), "truth": np.ones((3, 1))}),
    "arrow_stream": (native.arrow_stream, lambda: {"columns": [("a", "number", np.ones(3))]}),
    "ArrowTable.read": (native.ArrowTable.read, lambda: {"capsule": native.arrow_stream([("a", "number", np.ones(3))])}),
    "Filter.start": (native.Filter.start, lambda: {"model": m.discrete(), "choice": m.choose(None), "mean": MEAN, "cov": STD, "t0": 0.0}),
    "Filter.resume": (native.Filter.resume, lambda: {"model": m.discrete(), "choice": m.choose(None), "snapshot": stepped().snapshot()}),
    "Filter.update": (lambda z: stepped().update(z), lambda: {"z": np.ones(1)}),
    "Filter.predict": (lambda t: stepped().predict(t), lambda: {"t": 1.0}),
    "Filter.set_controls": (lambda u: stepped().set_controls(u), lambda: {"u": np.ones(0)}),
    "Graph.unary": (m.Nodes().graph.unary, lambda: {"operation": "sin", "a": 1}),
    "Graph.binary": (m.Nodes().graph.binary, lambda: {"operation": "add", "a": 1, "b": 2}),
    "Graph.power": (m.Nodes().graph.power, lambda: {"a": 1, "exponent": 2}),
    "Graph.select": (m.Nodes().graph.select, lambda: {"condition": 1, "yes": 1, "no": 2}),
    "Graph.state": (m.Nodes().graph.state, lambda: {"index": 1}),
    "Graph.constant_value": (m.Nodes().graph.constant_value, lambda: {"node": 1}),
    "Graph.evaluate": (
        m.Nodes().graph.evaluate,
        lambda: {"nodes": [1, 2], "x": MEAN, "t": 0.0, "dt": 0.1, "u": np.ones(0), "p": np.ones(2)},
    ),
}  # fmt: skip


def changed(right: dict[str, Any], draw: random.Random) -> dict[str, Any]:
    """The arguments with one to three of them, or an item of one, in another's place."""
    made = dict(right)
    for _ in range(draw.randrange(1, 4)):
        name = draw.choice(list(made))
        inner = made[name]
        if isinstance(inner, dict) and inner and draw.random() < 0.8:
            made[name] = inner | {draw.choice(list(inner)): anything(draw)}
        elif isinstance(inner, list) and inner and draw.random() < 0.6:
            at = draw.randrange(len(inner))
            item = inner[at]
            within = isinstance(item, dict) and item and draw.random() < 0.8
            made[name] = [*inner]
            made[name][at] = item | {draw.choice(list(item)): anything(draw)} if within else anything(draw)
        elif draw.random() < 0.1:
            del made[name]
            if not made:
                return made
        else:
            made[name] = anything(draw)
    return made


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", FUNCTIONS)
def test_any_arguments_work_or_are_refused(name: str) -> None:
    function, right = FUNCTIONS[name]
    function(**right())
    draw = random.Random(f"{name} {TIMES}")
    refused = 0
    for _ in range(CALLS):
        arguments = changed(right(), draw)
        try:
            function(**arguments)
        except REFUSALS as refusal:
            refused += 1
            assert not isinstance(refusal, GivensError) or str(refusal), arguments
        except ZeroDivisionError:
            # a function of the user's raises what it likes
            refused += 1
    assert refused > CALLS // 10

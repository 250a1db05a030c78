"""Calling a function with symbols."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np

from givens._trace.arguments import Arguments
from givens._trace.array import SymArray, boxed
from givens._trace.left_behind import Stores
from givens._trace.place import Place, locals_at, of_function, of_traceback
from givens._trace.refuse import failures, refuse
from givens._trace.symbol import Sym
from givens._trace.tape import Tape
from givens._trace.traced import Sizes, Traced
from givens._trace.transplant import transplanted
from givens.errors import GivensError, TraceError

__all__ = ["trace"]


def trace(function: Callable[..., Any], arguments: Arguments, sizes: Sizes, names: tuple[str, ...] = ()) -> Traced:
    """Traces a function twice and makes sure that both traces are the same.

    `names` are those of its results, where it may answer with a table by name.
    """
    tape = Tape()
    stores = Stores(function)
    try:
        traced = _traced_twice(function, arguments, sizes, tape, names)
    except BaseException:
        stores.polluted()
        raise
    kept = stores.polluted()
    if kept is None:
        return traced
    place = stores.line_of(kept, lambda: _called(function, arguments, sizes, Tape(), names))
    raise refuse(
        f"it keeps a value that is not known yet in `{kept.name}`",
        "keep nothing between calls: fill a cache before, compute it outside, or pass trace=False",
        place or of_function(function),
    )


def _traced_twice(
    function: Callable[..., Any], arguments: Arguments, sizes: Sizes, tape: Tape, names: tuple[str, ...]
) -> Traced:
    first = _called(function, arguments, sizes, tape, names)
    second = _called(function, arguments, sizes, tape, names)
    nodes = _nodes(tape, first, function)
    if first.shape != second.shape or nodes != _nodes(tape, second, function):
        raise refuse(
            "called twice with the same arguments, it computes different things",
            "leave out what changes between calls, such as random numbers, the clock and counters",
            of_function(function),
        )
    return Traced(tape, nodes, first.shape, arguments).pruned()


def _nodes(tape: Tape, result: SymArray, function: Callable[..., Any]) -> tuple[int, ...]:
    try:
        return tuple(value.node if isinstance(value, Sym) else tape.constant(float(value)) for value in result.flat)
    except OverflowError as error:
        raise refuse(str(error), "shorten its loops, or pass trace=False", of_function(function)) from None


def _symbols(tape: Tape, kind: str, shape: tuple[int, ...], start: int = 0) -> Any:
    if shape == ():
        return Sym(tape, tape.put(kind, start))
    array = np.empty(shape, dtype=object)
    for k, at in enumerate(np.ndindex(shape)):
        array[at] = Sym(tape, tape.put(kind, start + k))
    return array.view(SymArray)


def _called(
    function: Callable[..., Any], arguments: Arguments, sizes: Sizes, tape: Tape, names: tuple[str, ...]
) -> SymArray:
    stand_for: dict[str, Callable[[], Any]] = {
        "t": lambda: Sym(tape, tape.put("time")),
        "dt": lambda: Sym(tape, tape.put("step")),
        "x": lambda: _symbols(tape, "state", (sizes.states,)),
        "u": lambda: _symbols(tape, "control", (sizes.controls,)),
    }
    parameters, start = {}, 0
    for name, value in arguments.parameters.items():
        parameters[name] = _symbols(tape, "parameter", value.shape, start)
        start += value.size
    positions = [stand_for[position]() for position in arguments.positions]
    noted: list[TraceError] = []
    token = failures.set(noted)
    try:
        with np.errstate(all="ignore"):
            result: Any = transplanted(function)(*positions, **parameters)
    except GivensError as error:
        raise (noted[0] if noted else error) from None
    except Exception as error:
        if noted:
            raise noted[0] from error
        raise _foreign(error, function, arguments.positions) from error
    finally:
        failures.reset(token)
    if noted:
        raise noted[0]
    return _answer(result, function, names)


#: What Python says when a number is taken for an array.
_NO_ELEMENTS = re.compile(r"'Sym'.* (not subscriptable|not iterable|no len)|non-iterable Sym|iterable, not Sym")


def _foreign(error: Exception, function: Callable[..., Any], positions: tuple[str, ...]) -> TraceError:
    """What the function itself, or a library it calls, raised."""
    place = of_traceback(error.__traceback__)
    place = place if place.file else of_function(function)
    if isinstance(error, TypeError) and _NO_ELEMENTS.search(str(error)):
        return _no_elements(error, function, positions, place)
    said = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
    return refuse(
        f"when called with symbols it raised {said}",
        "call it with numbers first; if it is right, write it in NumPy's own functions, or pass trace=False",
        place,
    )


def _no_elements(
    error: Exception, function: Callable[..., Any], positions: tuple[str, ...], place: Place
) -> TraceError:
    """Of a single number that was taken for an array: of the time, most likely, by a function of (x, t)."""
    line = place.source or ""
    for name, value in locals_at(error.__traceback__).items():
        taken = rf"\b{name}\s*\[|[*=(]\s*{name}\s*($|[,)\]])|\bin\s+{name}\b"
        if not isinstance(value, Sym) or not re.search(taken, line):
            continue
        kind = str(value.tape.instructions[value.node][0])
        if kind in ("time", "step"):
            called = of_function(function).function or "f"
            called = called if called.isidentifier() else "f"
            return refuse(
                f"write {called}({', '.join(positions)}): `{name}` is the {kind}, one number, and taken for an array",
                "the time comes first, then " + ("the step, then " if "dt" in positions else "") + "the state",
                place,
            )
    return refuse(
        "one number is taken for an array",
        "x and u are arrays, their elements, t and dt are numbers; np.atleast_1d makes an array of a number",
        place,
    )


def _answer(result: Any, function: Callable[..., Any], names: tuple[str, ...]) -> SymArray:
    place = of_function(function)
    if result is None:
        raise refuse("it returns nothing", "end it with `return [...]`", place)
    if isinstance(result, dict):
        missing = [name for name in names if name not in result]
        other = [name for name in result if name not in names]
        if missing or other:
            wrong = f"{missing[0]!r} is missing" if missing else f"{other[0]!r} is none of them"
            raise refuse(f"it returns a table in which {wrong}", f"its names are {', '.join(names)}", place)
        result = [result[name] for name in names]
    try:
        with np.errstate(over="ignore"):
            return boxed(result)
    except OverflowError:
        raise refuse("it returns a number beyond 1.8e308", "measure it in a larger unit", place) from None
    except (ValueError, TraceError):
        said = "it returns something else than an array of numbers"
        raise refuse(said, "return a list of numbers; np.concatenate and np.hstack join arrays", place) from None

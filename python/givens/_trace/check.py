"""Whether a trace computes what the function computes, at random points."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from givens._native import Graph
from givens._trace.place import of_function
from givens._trace.refuse import refuse
from givens._trace.traced import Sizes, Traced
from givens.errors import GivensError, TraceError

__all__ = ["Point", "compare", "component", "digits", "draws", "real"]

Array = npt.NDArray[np.float64]

#: Sizes of the states that are tried, and how many points of each.
_SCALES = (1.0, 0.03, 30.0, 1e3, 1e6)
_EACH = 4
_RELATIVE = 1e-9


@dataclass(frozen=True)
class Point:
    """Arguments of one call."""

    t: float
    dt: float
    x: Array
    u: Array
    p: Array

    def named(self, positions: Sequence[str]) -> str:
        """As words: `t = 0.3, x = [1, 2]`."""
        values = {"t": self.t, "dt": self.dt, "x": self.x, "u": self.u}
        parts = [f"{name} = {digits(values[name])}" for name in positions]
        return ", ".join(parts + ([f"parameters = {digits(self.p)}"] if self.p.size else []))


def digits(value: Any) -> str:
    """A number, or several, to the bit."""
    if np.ndim(value):
        return f"[{', '.join(f'{number:.17g}' for number in np.ravel(value))}]"
    return f"{value:.17g}"


def draws() -> tuple[Callable[[int], Array], Callable[[int], Array]]:
    """Uniform and normal numbers, always the same: a generator of a library takes longer to import than all of this."""
    state = 20090513

    def uniform(length: int) -> Array:
        nonlocal state
        drawn = []
        for _ in range(length):
            # 64-bit linear congruential, multiplier of Knuth's MMIX
            state = (6364136223846793005 * state + 1442695040888963407) % 2**64
            drawn.append((state >> 11) / 2**53)
        return np.array(drawn)

    def normal(length: int) -> Array:
        radius = np.sqrt(-2 * np.log1p(-uniform(length)))
        turned: Array = radius * np.cos(2 * np.pi * uniform(length))
        return turned

    return uniform, normal


def _points(sizes: Sizes, values: Array, near: Array | None) -> Iterator[Point]:
    """States of several sizes, of either sign and of positive sign; parameters at and around their values."""
    uniform, normal = draws()

    def point(x: Array, u: Array, p: Array, longest: float = 10.0) -> Point:
        t, dt = uniform(2)
        return Point(longest * t, 0.01 + 0.99 * dt, x, u, p)

    for scale in _SCALES:
        for k in range(_EACH):
            x, u = normal(sizes.states), normal(sizes.controls)
            x, u = (x, u) if k % 2 else (np.abs(x), np.abs(u))
            p = values * (0.8 + 0.45 * uniform(values.size) if k else 1.0)
            yield point(scale * x, u, p, 10.0 if k < _EACH - 1 else 1e4)
    for k in range(_EACH if near is not None else 0):
        x = np.asarray(near) * (1 + 0.1 * k * (2 * uniform(sizes.states) - 1))
        yield point(x, normal(sizes.controls), values)


def compare(
    function: Callable[..., Any],
    traced: Traced,
    sizes: Sizes,
    names: tuple[str, ...],
    near: Array | None = None,
) -> None:
    """Raises a `TraceError` if the trace and the function differ anywhere, or the function is finite nowhere."""
    points = list(_points(sizes, traced.arguments.values, near))
    found = _evaluated(traced, points)
    counted, last = 0, "it is finite at none of them"
    for point, expressions in zip(points, found, strict=True):
        try:
            own = real(function, traced, point, names)
            again = real(function, traced, point, names)
            nearby = real(function, traced, _moved(point), names)
        except GivensError:
            raise
        except Exception as error:
            last = f"it raised {type(error).__name__}: {error}"
            continue
        if own.shape != expressions.shape:
            raise _differs(function, f"it gives {own.size} numbers, and {expressions.size} when traced")
        if not np.array_equal(own, again, equal_nan=True):
            raise refuse(
                "called twice with the same numbers, it gives different results",
                "leave out what changes between calls, such as random numbers, the clock and counters",
                of_function(function),
            )
        wrong = _wrong(own, nearby, expressions)
        if wrong is not None:
            at = component(wrong, traced.shape, names)
            raise _differs(
                function,
                f"{at} is {digits(own[wrong])}, but its expressions give {digits(expressions[wrong])} "
                f"at {point.named(traced.arguments.positions)}",
            )
        counted += bool(np.isfinite(own).all())
    if not counted:
        raise refuse(
            f"it cannot be compared with its expressions at any of {len(points)} random points: {last}",
            "pass check_at=… with a state where it is finite",
            of_function(function),
        )


def _differs(function: Callable[..., Any], said: str) -> TraceError:
    return refuse(
        f"its expressions do not compute what it computes: {said}",
        "values read from elsewhere must not change between calls, and branches must be np.where; or pass trace=False",
        of_function(function),
    )


def _wrong(real: Array, nearby: Array, found: Array) -> int | None:
    """The first component that differs by more than rounding can explain."""
    with np.errstate(all="ignore"):
        room = _RELATIVE * np.abs(real) + 1e3 * np.abs(real - nearby)
        equal = (np.abs(real - found) <= room) | (real == found) | np.isnan(real)
    wrong = np.flatnonzero(~equal)
    return int(wrong[0]) if wrong.size else None


def _moved(point: Point) -> Point:
    """By one unit in the last place: how far the function moves there is how well it can be computed."""

    def moved(values: Array) -> Array:
        return values * (1 + 2.0**-51)

    return Point(point.t, point.dt, moved(point.x), moved(point.u), moved(point.p))


def real(function: Callable[..., Any], traced: Traced, point: Point, names: tuple[str, ...]) -> Array:
    """What the function itself gives."""
    positions = {"t": point.t, "dt": point.dt, "x": point.x.copy(), "u": point.u.copy()}
    parameters, start = {}, 0
    for name, value in traced.arguments.parameters.items():
        part = point.p[start : start + value.size].reshape(value.shape)
        parameters[name] = float(part) if part.ndim == 0 else part.copy()
        start += value.size
    with np.errstate(all="ignore"):
        result = function(*(positions[name] for name in traced.arguments.positions), **parameters)
    if isinstance(result, dict):
        result = [result[name] for name in names]
    return np.asarray(result, dtype=float).ravel()


def _evaluated(traced: Traced, points: Sequence[Point]) -> Array:
    graph = Graph()
    nodes = traced.tape.lay_into(graph, traced.nodes)
    rows = [graph.evaluate(nodes, point.x, point.t, point.dt, point.u, point.p) for point in points]
    return np.array(rows).reshape(len(points), len(nodes))


def component(k: int, shape: tuple[int, ...], names: tuple[str, ...]) -> str:
    """A result in words, by its name if it has one."""
    if len(shape) == 1 and k < len(names):
        return f"component {names[k]!r}"
    at = np.unravel_index(k, shape) if shape else ()
    return f"component [{', '.join(map(str, at))}]" if at else "the value"

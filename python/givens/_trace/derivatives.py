"""Whether a trace has the derivatives of its function: at random points, and where a run begins."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from givens._trace.check import Point, component, digits, draws, real
from givens._trace.place import Place, of_function
from givens._trace.slopes import Slopes, wrong_slope
from givens._trace.steep import Steep
from givens._trace.traced import Sizes, Traced

__all__ = ["Watch", "compare_slopes", "has_kinks"]

Array = npt.NDArray[np.float64]

#: States along each of which derivatives are taken at one point; more are tried along one direction.
_FEW = 8
#: The step of a transition.
_DT = 0.25
#: Operations whose derivatives jump: a function without them has those of its expressions everywhere.
_KINKED = {"sign", "abs", "floor", "min", "max", "less", "less_equal", "equal", "select"}
#: Points that are kept.
_KEPT = 256


def has_kinks(traced: Traced) -> bool:
    """Whether its derivatives may differ from those of its function at points that no one has tried."""
    tape = traced.tape
    return any(tape.instructions[k][0] in _KINKED for k in tape.reachable(traced.nodes))


def compare_slopes(
    function: Callable[..., Any],
    traced: Traced,
    sizes: Sizes,
    names: tuple[str, ...],
    near: Array | None = None,
) -> Steep | None:
    """Where the derivatives differ, if they do: at zero and where states are equal, at `near`, and elsewhere."""
    n = sizes.states
    if "x" not in traced.arguments.positions or not n or not traced.nodes:
        return None
    uniform, normal = draws()
    slopes, axes = Slopes(traced, sizes, _DT), list(np.eye(n))
    places = [(np.zeros(n), axes), (np.ones(n), axes if n <= _FEW else [2 * uniform(n) - 1])]
    places += [(np.array(near, dtype=float), axes)] if near is not None else []
    places += [(scale * normal(n), [2 * uniform(n) - 1]) for scale in (1.0, 30.0)]
    for x, directions in places:
        point = Point(0.5, _DT, x, np.full(sizes.controls, 0.5), traced.arguments.values)

        def moved(x: Array, point: Point = point) -> Array:
            return real(function, traced, replace(point, x=x), names)

        said = _said(traced, slopes, moved, point, directions, names)
        if said is not None:
            return Steep(of_function(function), said)
    return None


class Watch:
    """Compares the derivatives of a trace with difference quotients of its own values, once at each point."""

    def __init__(self, traced: Traced, sizes: Sizes, names: tuple[str, ...], place: Place) -> None:
        self._traced, self._names, self._place, self._sizes = traced, names, place, sizes
        self._slopes = Slopes(traced, sizes, _DT)
        self._known: dict[bytes, Steep | None] = {}

    def at(self, t: float, x: Array, u: Array, p: Array) -> Steep | None:
        """How they differ there, if they do."""
        key = np.concatenate([[t], x, u, p]).tobytes()
        if key not in self._known:
            if len(self._known) >= _KEPT:
                self._known.clear()
            point, values = Point(t, _DT, x, u, p), self._slopes.values(t, u, p)
            n = self._sizes.states
            directions = list(np.eye(n)) if n <= _FEW else [2 * draws()[0](n) - 1]
            said = _said(self._traced, self._slopes, values, point, directions, self._names)
            self._known[key] = None if said is None else Steep(self._place, said)
        return self._known[key]


def _said(
    traced: Traced,
    slopes: Slopes,
    moved: Callable[[Array], Array],
    point: Point,
    directions: Sequence[Array],
    names: tuple[str, ...],
) -> str | None:
    """Which derivative differs at a point, and what both are."""
    found = slopes.at(point.t, point.x, point.u, point.p)
    try:
        wrong = wrong_slope(moved, point.x, found, directions) if found is not None else None
    except Exception:
        # where the function has no value, it has no derivative
        return None
    if wrong is None:
        return None
    k, direction, own, other = wrong
    by = f"x[{int(np.argmax(direction))}]" if np.count_nonzero(direction) == 1 else digits(direction)
    return (
        f"that of {component(k, traced.shape, names)} by {by} is {own:.6g}, and that of its expressions {other:.6g} at "
        f"{point.named(traced.arguments.positions)}"
    )

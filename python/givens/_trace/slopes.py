"""Whether the derivatives of a trace are the function's: where it is smooth, they are its difference quotients."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import numpy.typing as npt

from givens._native import Choice, Filter, Graph, Model
from givens._trace.tape import Tape
from givens._trace.traced import Sizes, Traced
from givens.errors import GivensError

__all__ = ["Slopes", "wrong_slope"]

Array = npt.NDArray[np.float64]

#: The larger one of two steps, for numbers of size one, and the share of it that is the other: what agrees over so
#: many sizes is no coincidence of rounding.
_STEP, _SHARE = 2.0**-16, 2.0**-6
#: How far four quotients of a smooth function may lie apart, and how far a derivative from them.
_SMOOTH, _RELATIVE = 1e-3, 1e-2


class Slopes:
    """The derivatives that a filter works with, read off one update of an extended Kalman filter.

    With the states themselves measured beside the function and a unit covariance, the covariance of the innovation
    holds the derivatives.
    """

    def __init__(self, traced: Traced, sizes: Sizes, dt: float) -> None:
        n, self._given = sizes.states, len(traced.nodes)
        instructions = [("constant", dt.hex()) if op == ("step",) else op for op in traced.tape.instructions]
        graph = Graph()
        states, zero = [graph.state(i) for i in range(n)], graph.constant(0.0)
        measures = [*Tape(instructions).lay_into(graph, traced.nodes), *states]
        columns = [f"z{k}" for k in range(len(measures))]
        sensor = {
            "name": "slopes",
            "columns": columns,
            "measures": measures,
            "angles": [None] * len(columns),
            "std": [graph.constant(1.0)] * len(columns),
        }
        names, values = [f"x{i}" for i in range(n)], traced.arguments.values.tolist()
        noise = [zero] * n**2
        self._model = Model.discrete(graph, names, sizes.controls, values, states, noise, None, [sensor])  # type: ignore[list-item]
        self._choice = Choice("ekf", {}, "discrete")
        self._n, self._controls = n, sizes.controls

    def at(self, t: float, x: Array, u: Array, p: Array) -> Array | None:
        """∂f/∂x, one row for each result; None where it is not finite."""
        model = self._model.with_parameters(p) if p.size else self._model
        try:
            filtering = Filter.start(model, self._choice, x, np.ones(self._n), t)
            if self._controls:
                filtering.set_controls(u)
            filtering.update(np.zeros(self._given + self._n))
            return filtering.innovation_cov[: self._given, self._given :]
        except GivensError:
            return None

    def values(self, t: float, u: Array, p: Array) -> Callable[[Array], Array]:
        """The function itself, as its expressions compute it, of the state alone."""
        model = self._model.with_parameters(p) if p.size else self._model
        return lambda x: model.measure(t, x, u)[: self._given]


def wrong_slope(
    function: Callable[[Array], Array], x: Array, slopes: Array, directions: Sequence[Array]
) -> tuple[int, Array, float, float] | None:
    """The first result whose derivative along one of the directions is not that of `slopes`: which, where, and both."""
    here, along = function(x), np.array(directions)
    sizes = _STEP * np.maximum(1.0, np.abs(np.where(along != 0, x, 0)).max(axis=1, initial=0.0))
    with np.errstate(all="ignore"):
        quotients = np.array([_quotients(function, x, here, *one) for one in zip(along, sizes, strict=True)])
        own, found = quotients.mean(axis=1), along @ slopes.T
        noise = 1024 * np.finfo(float).eps * np.abs(here) / sizes[:, None]
        smooth = np.ptp(quotients, axis=1) <= _SMOOTH * np.abs(quotients).max(axis=1) + noise
        # one that does not move at all may do so by less than its rounding
        smooth &= quotients.any(axis=1)
        # a covariance brings them, rounded as its largest entries are
        room = 4 * noise + 1e-9 * np.abs(slopes).max(axis=1) + 1e-12
        apart = np.abs(found - own) > _RELATIVE * np.maximum(np.abs(found), np.abs(own)) + room
    for at, k in np.argwhere(smooth & apart & np.isfinite(own)):
        if _wrong_nearby(function, x, here, along[at], min(_STEP, float(sizes[at]) * _SHARE), int(k), found[at, k]):
            return int(k), along[at], float(own[at, k]), float(found[at, k])
    return None


def _wrong_nearby(
    function: Callable[[Array], Array], x: Array, here: Array, direction: Array, step: float, k: int, slope: float
) -> bool:
    """Whether a step that does not grow with the state says so, too: long ones go over waves, of a sine far from zero.

    Where numbers of that size cannot be told apart over such a step, nothing is known.
    """
    ahead, behind = function(x + step * direction)[k], function(x - step * direction)[k]
    size = np.abs(here[k]) + np.abs(x * direction).max() * max(1.0, abs(slope))
    noise = 32 * np.finfo(float).eps * size / step
    sides = ((ahead - here[k]) / step, (here[k] - behind) / step)
    return all(abs(slope - side) > _RELATIVE * max(abs(slope), abs(side)) + noise for side in sides)


def _quotients(function: Callable[[Array], Array], x: Array, here: Array, direction: Array, size: float) -> Array:
    try:
        steps = (size, -size, size * _SHARE, -size * _SHARE)
        return np.array([(function(x + step * direction) - here) / step for step in steps])
    except Exception:
        # where the function has no value, it has no derivative
        return np.full((4, len(here)), np.nan)

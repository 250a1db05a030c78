"""Functions that are called while a filter runs: of Python, asked for by `trace=False`, or of C by their address."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from givens._arrays import Array
from givens._native import Function
from givens._trace.arguments import parameter_value, read_arguments

if TYPE_CHECKING:
    from givens._part import Request

__all__ = ["Called", "called", "slots"]

#: Points at which it is found out whether a function takes many at once.
_TRIED = 3


def slots(parameters: Mapping[str, Array], start: int = 0) -> dict[str, slice]:
    """Where each parameter stands among all numbers."""
    places: dict[str, slice] = {}
    for name, value in parameters.items():
        places[name] = slice(start, start + value.size)
        start += value.size
    return places


@dataclass(frozen=True)
class Called:
    """A function that is called as it is."""

    function: Any
    positions: tuple[str, ...]
    parameters: dict[str, Array]
    shape: tuple[int, ...] | None
    names: tuple[str, ...]
    #: Whether one call takes all points, x of shape (n, points).
    many: bool
    #: Whether it is only called at one point.
    single: bool = False

    def native(self, places: Mapping[str, slice]) -> Function:
        """As the native half takes it."""
        if hasattr(self.function, "address"):
            return Function.address(int(self.function.address), self.function, step="dt" in self.positions)
        return Function.callable(_Caller(self, {name: places[name] for name in self.parameters}))


@dataclass(frozen=True)
class _Caller:
    called: Called
    places: dict[str, slice]

    def __call__(self, t: float, dt: float, x: Array, u: Array, p: Array) -> Array:
        named = {}
        for name, place in self.places.items():
            shape = self.called.parameters[name].shape
            named[name] = p[place].reshape(shape) if shape else float(p[place][0])
        if self.called.single:
            return self.once(t, dt, x[:, 0], u, named)
        if self.called.many:
            return self.once(t, dt, x, u, named)
        points = [self.once(t, dt, x[:, k], u, named) for k in range(x.shape[1])]
        return np.stack(points, axis=-1)

    def once(self, t: float, dt: float, x: Array, u: Array, named: Mapping[str, Any]) -> Array:
        values = {"t": t, "dt": dt, "x": x, "u": u}
        result = self.called.function(*(values[position] for position in self.called.positions), **named)
        if isinstance(result, dict):
            result = [result[name] for name in self.called.names]
        if isinstance(result, (list, tuple)) and self.called.many:
            # a component that is the same at all points may be one number
            result = np.broadcast_arrays(*result)
        return np.asarray(result, dtype=float)


def called(request: Request, function: Callable[..., Any]) -> Called:
    """Reads the call of such a function, and finds out whether one call can take all points."""
    if hasattr(function, "address"):
        given = {name: parameter_value(request.argument, name, v) for name, v in request.parameters.items()}
        return Called(function, request.required, given, None, request.names, many=False)
    arguments = read_arguments(request.argument, function, request.required, request.optional, request.parameters)
    one = Called(function, arguments.positions, arguments.parameters, None, request.names, many=False)
    if "x" not in arguments.positions or request.argument == "jacobian":
        return replace(one, single=True)
    many = Called(function, arguments.positions, arguments.parameters, None, request.names, many=True)
    return many if _agree(one, many, request) else one


def _agree(one: Called, many: Called, request: Request) -> bool:
    """Whether many points at once give what they give one by one."""
    sizes = request.sizes
    x = np.linspace(0.1, 1.9, max(sizes.states, 1) * _TRIED).reshape(_TRIED, -1)[:, : sizes.states].T
    u = np.full(sizes.controls, 0.5)
    p = np.concatenate([value.ravel() for value in one.parameters.values()] or [np.empty(0)])
    places = slots(one.parameters)
    try:
        with np.errstate(all="ignore"):
            single = _Caller(one, places)(0.5, 0.5, x, u, p)
            joint = _Caller(many, places)(0.5, 0.5, x, u, p)
    except Exception:
        # a branch on an array, or indices that mean something else: it is called point by point, and speaks there
        return False
    return single.shape == joint.shape and bool(np.allclose(single, joint, rtol=1e-9, atol=0, equal_nan=True))

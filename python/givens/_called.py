"""Functions that are called while a filter runs: of Python, asked for by `trace=False`, or of C by their address."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from givens._arrays import Array
from givens._compiled import address_of, is_compiled
from givens._native import Function
from givens._scalars import shown
from givens._trace.arguments import parameter_value, read_arguments
from givens.errors import InputError

if TYPE_CHECKING:
    from givens._part import Request

__all__ = ["Called", "called", "slots"]


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) < 80 else f"{text[:77]}…"


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

    argument: str
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
        if is_compiled(self.function):
            address = address_of(self.argument, self.function, len(self.positions) + 2)
            own = [k for name in self.parameters for k in range(places[name].start, places[name].stop)]
            return Function.address(address, self.function, step="dt" in self.positions, parameters=own)
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
            missing = [name for name in self.called.names if name not in result]
            if missing:
                raise self.wrong(f"gave a table without `{missing[0]}`", x)
            result = [result[name] for name in self.called.names]
        if result is None:
            raise self.wrong("gave nothing", x)
        if isinstance(result, (list, tuple)) and self.called.many:
            # a component that is the same at all points may be one number
            result = np.broadcast_arrays(*result)
        try:
            given = np.asarray(result)
        except ValueError:
            raise self.wrong(f"gave {shown(result)}, which is no array of numbers", x) from None
        if given.dtype.kind not in "fiub":
            given = self.real(given, x)
        if len(self.called.names) == 1 and given.shape == x.shape[1:]:
            given = given[None]
        if self.called.names and not self.called.single and given.shape != self.wanted(x):
            shape = "one number" if given.shape == () else f"an array of shape {given.shape}"
            raise self.wrong(f"gave {shape}, not one of shape {self.wanted(x)}", x)
        return given.astype(float)

    def real(self, given: Any, x: Array) -> Array:
        """Objects that are numbers, as such."""
        try:
            if given.dtype.kind != "O":
                raise TypeError
            return given.astype(float)  # type: ignore[no-any-return]
        except (TypeError, ValueError):
            raise self.wrong(f"gave {_shown(given.tolist())}, which is no array of real numbers", x) from None

    def wanted(self, x: Array) -> tuple[int, ...]:
        return (len(self.called.names), *x.shape[1:])

    def wrong(self, said: str, x: Array) -> InputError:
        """Of a function that did not give what it is to give."""
        name = self.called.argument
        many = ", one column for each of the points in x" if self.called.many else ""
        what = f"return one value for each of {', '.join(self.called.names)}{many}" if self.called.names else None
        return InputError(f"`{name}` {said}", argument=name, remedy=what or "end it with `return [...]`")


def called(request: Request, function: Callable[..., Any]) -> Called:
    """Reads the call of such a function."""
    if is_compiled(function):
        address_of(request.argument, function, len(request.required) + 2)
        if request.vectorized:
            raise InputError(
                f"`vectorized` is given, but `{request.argument}` is a function of C, which takes one point",
                argument="vectorized",
                remedy="leave it out",
            )
        given = {name: parameter_value(request.argument, name, v) for name, v in request.parameters.items()}
        return Called(request.argument, function, request.required, given, None, request.names, many=False)
    arguments = read_arguments(request.argument, function, request.required, request.optional, request.parameters)
    single = "x" not in arguments.positions or request.argument == "jacobian"
    return Called(
        request.argument,
        function,
        arguments.positions,
        arguments.parameters,
        None,
        request.names,
        many=request.vectorized and not single,
        single=single,
    )

"""What a function's arguments stand for: by position time, step, state and controls, by name its parameters."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from givens._scalars import shown
from givens._trace.order import check_places
from givens._trace.place import of_function
from givens.errors import InputError

__all__ = ["Arguments", "parameter_value", "read_arguments", "reads_state"]

_POSITIONAL = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)


@dataclass(frozen=True)
class Arguments:
    """The call of a function: what stands at each position, and the values of its parameters by name."""

    positions: tuple[str, ...]
    parameters: dict[str, npt.NDArray[np.float64]]

    @property
    def values(self) -> npt.NDArray[np.float64]:
        """All parameters in order, arrays row by row."""
        flat = [value.ravel() for value in self.parameters.values()]
        return np.concatenate(flat) if flat else np.empty(0)


def parameter_value(argument: str, name: str, value: object) -> npt.NDArray[np.float64]:
    """A parameter as an array of finite or infinite numbers, of no dimension if it is one number."""
    try:
        with np.errstate(over="ignore"):
            array = np.array(value, dtype=float)
    except OverflowError:
        raise InputError(
            f"`{argument}`: the parameter `{name}` is a number beyond 1.8e308",
            argument=argument,
            component=name,
            remedy="measure it in a larger unit",
        ) from None
    except (TypeError, ValueError):
        raise InputError(
            f"`{argument}`: the parameter `{name}` is not a number: {shown(value)}",
            argument=argument,
            component=name,
            remedy="parameters are floats or arrays of floats; bind others with functools.partial",
        ) from None
    if np.isnan(array).any():
        raise InputError(
            f"`{argument}`: the parameter `{name}` is NaN",
            argument=argument,
            component=name,
            remedy="give a finite number"
            if argument == "params"
            else "give it a number, as a default or in parameters={…}",
        )
    array.setflags(write=False)
    return array


def _signature(argument: str, function: Callable[..., Any]) -> inspect.Signature:
    if not callable(function):
        raise InputError(
            f"`{argument}` is not a function: {shown(function)}",
            argument=argument,
            remedy=f"write def {argument}(…): return […]",
        )
    try:
        return inspect.signature(function)
    except (TypeError, ValueError):
        raise InputError(
            f"`{argument}`: the arguments of {shown(function)} cannot be read",
            argument=argument,
            remedy="wrap it: lambda t, x: function(t, x)",
        ) from None


def _is_parameter(default: object) -> bool:
    """Whether a default makes its argument a parameter: a number, or an array of floats."""
    if isinstance(default, (bool, np.bool_)):
        return False
    if isinstance(default, (int, float, np.integer, np.floating)):
        return True
    if isinstance(default, np.ndarray):
        return bool(default.dtype.kind == "f")
    return isinstance(default, (list, tuple)) and len(default) > 0 and all(isinstance(part, float) for part in default)


def read_arguments(
    argument: str,
    function: Callable[..., Any],
    required: Sequence[str],
    optional: Sequence[str],
    given: Mapping[str, object] | None = None,
) -> Arguments:
    """Reads the call of `function`, the `argument` of a model, from its signature.

    `required` and `optional` name what may stand at its positions, in order; `given` are values for its parameters.
    """
    signature = _signature(argument, function)
    given = dict(given or {})
    bound = set(function.keywords) if isinstance(function, functools.partial) else set()
    positions: list[str] = []
    parameters: dict[str, npt.NDArray[np.float64]] = {}
    takes_all = False
    for name, parameter in signature.parameters.items():
        if name in bound or parameter.kind is inspect.Parameter.VAR_POSITIONAL:
            continue
        if parameter.kind is inspect.Parameter.VAR_KEYWORD:
            takes_all = True
        elif name in given:
            parameters[name] = parameter_value(argument, name, given[name])
        elif name in optional and len(positions) == len(required) + optional.index(name):
            # `u=None` of a function that serves without controls too
            positions.append(name)
        elif parameter.default is not parameter.empty:
            if _is_parameter(parameter.default):
                parameters[name] = parameter_value(argument, name, parameter.default)
        elif parameter.kind in _POSITIONAL and not parameters:
            positions.append(name)
        else:
            raise InputError(
                f"`{argument}`: {of_function(function).function} asks for `{name}`, which has no value",
                argument=argument,
                component=name,
                remedy=f"give it a default, {name}=…, or write parameters={{{name!r}: …}}",
            )
    if takes_all:
        parameters |= {n: parameter_value(argument, n, v) for n, v in given.items() if n not in parameters}
    check_places(argument, function, positions, required, optional)
    return Arguments(tuple((*required, *optional)[: len(positions)]), parameters)


def reads_state(argument: str, function: Callable[..., Any]) -> bool:
    """Whether a function of t and x or u reads x: its second argument is not called `u`, or its only one `x`."""
    parameters = [p for p in _signature(argument, function).parameters.values() if p.kind in _POSITIONAL]
    free = [p.name for p in parameters if p.default is p.empty]
    return free[1] != "u" if len(free) > 1 else free == ["x"]

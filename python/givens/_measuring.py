"""What a sensor is made of, checked when it is made."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from givens._arrays import Array, numbers, shape_error, vector
from givens._compiled import is_compiled
from givens._covariance import check_covariance
from givens._dynamics import parameters_of
from givens._names import known_name, names_of, ordered
from givens._part import Request, is_function
from givens._scalars import positive
from givens._symbolic import is_symbolic
from givens._trace.arguments import parameter_value, read_arguments
from givens.errors import InputError

__all__ = ["near", "parameters", "periods", "spread"]


def spread(noise: str, given: Any, columns: tuple[str, ...]) -> Any:
    """Numbers are checked when the sensor is made; functions when it is traced."""
    if is_function(given) or is_symbolic(given):
        return given
    d = len(columns)
    if isinstance(given, Mapping) and noise == "std":
        given = _by_name(given, columns)
    array = numbers(noise, given)
    wanted = (d,) if noise == "std" else (d, d)
    array = array.reshape(wanted) if d == 1 and array.size == 1 else array
    if array.shape != wanted:
        flat = noise == "cov" and array.shape == (d,)
        remedy = "write std=… for standard deviations, or cov=np.diag(…)" if flat else None
        raise shape_error(noise, array.shape, f"{wanted} for the measures {', '.join(columns)}", remedy)
    wrong = ~np.isfinite(array) if noise == "cov" else ~(np.isfinite(array) & (array >= 0))
    if wrong.any():
        at = np.argwhere(wrong)[0]
        name = columns[int(at[0])]
        raise InputError(
            f"`{noise}` of `{name}` is {array[tuple(at)]}",
            argument=noise,
            component=name,
            remedy="standard deviations are finite, from 0 up" if noise == "std" else "give finite numbers",
        )
    if noise == "cov":
        check_covariance("cov", Request("cov", ()).read(array), "measure", columns)
    return array


def _by_name(given: Mapping[str, Any], columns: tuple[str, ...]) -> list[Any]:
    entries = ordered("std", given, columns, "measure of this sensor")
    for name, entry in zip(columns, entries, strict=True):
        if entry is None:
            raise InputError(
                f"`std` has no entry `{name}`", argument="std", component=name, remedy="give one for each measure"
            )
    return entries


def periods(angles: Any, columns: tuple[str, ...]) -> tuple[float | None, ...]:
    if not isinstance(angles, Mapping):
        angles = dict.fromkeys(names_of("angles", angles, example='["bearing"]'), 2 * math.pi)
    for name in angles:
        known_name("angles", name, columns, "measure of this sensor")
    remedy = "a period is longer than 0: 2π of radians, 360 of degrees"
    return tuple(
        positive("angles", angles[name], remedy, "period", name) if name in angles else None for name in columns
    )


def parameters(given: Mapping[str, Any], noise: str) -> dict[str, Array]:
    """The parameters of its functions, which are known before they are traced."""
    tables: list[Mapping[str, Array]] = []
    for argument, required in (("h", ("t", "x")), (noise, ("t",))):
        function = given[argument]
        if callable(function) and not is_compiled(function):
            tables.append(read_arguments(argument, function, required, ("u",), given["parameters"]).parameters)
        elif is_symbolic(function) or is_compiled(function):
            tables.append({n: parameter_value(argument, n, v) for n, v in given["parameters"].items()})
    return parameters_of(tables, given["parameters"])


def near(check_at: Any, states: tuple[str, ...]) -> Array | None:
    return None if check_at is None else vector("check_at", check_at, states)

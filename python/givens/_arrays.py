"""Numbers that users give, as arrays of a known shape."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from givens.errors import InputError

__all__ = ["Array", "frozen", "is_masked", "numbers", "shape_error", "square", "vector"]

Array = npt.NDArray[np.float64]


def frozen(array: Array) -> Array:
    """The same numbers in an array that cannot be written to."""
    own = np.array(array, dtype=np.float64, order="C")
    own.setflags(write=False)
    return own


def is_masked(value: object) -> bool:
    """Whether this is a masked array; their module is not imported to find out."""
    masked: Any = sys.modules.get("numpy.ma")
    return masked is not None and isinstance(value, masked.MaskedArray)


def numbers(argument: str, value: Any) -> Array:
    """Anything like an array as 64-bit floats; what a mask hides is NaN."""
    if is_masked(value):
        return np.asarray(value.astype(np.float64).filled(np.nan))
    if hasattr(value, "to_numpy") and not isinstance(value, np.ndarray):
        value = value.to_numpy()
    try:
        array = np.asarray(value)
        if array.dtype.kind == "c":
            raise TypeError("complex numbers")
        return np.asarray(array, dtype=np.float64)
    except (TypeError, ValueError) as error:
        said = "parts of different lengths" if "inhomogeneous" in str(error) else "something else"
        raise InputError(
            f"`{argument}` is not an array of real numbers: it holds {said}",
            argument=argument,
            remedy="give a list of numbers, or a NumPy array of floats",
        ) from None


def shape_error(argument: str, found: Sequence[int], wanted: str, remedy: str | None = None) -> InputError:
    """The error of an array of the wrong shape; `wanted` says it in words."""
    return InputError(f"`{argument}` has shape {tuple(found)}, not {wanted}", argument=argument, remedy=remedy)


def vector(argument: str, value: Any, names: Sequence[str]) -> Array:
    """One number for each name: a list in order, or a table by name."""
    if isinstance(value, dict):
        from givens._names import ordered

        entries = ordered(argument, value, names, "name of this list")
        missing = [name for name, entry in zip(names, entries, strict=True) if entry is None]
        if missing:
            raise InputError(
                f"`{argument}` has no entry `{missing[0]}`",
                argument=argument,
                component=missing[0],
                remedy=f"give all of {', '.join(names)}",
            )
        value = entries
    array = numbers(argument, value)
    n = len(names)
    if array.shape == (n,):
        return array
    if array.ndim == 0 and n == 1:
        return array.reshape(1)
    column = array.ndim == 2 and 1 in array.shape and array.size == n
    raise shape_error(
        argument,
        array.shape,
        f"({n},): one number for each of {', '.join(names)}",
        f"a vector has one dimension: {argument}=np.ravel(…)" if column else None,
    )


def square(argument: str, value: Any, n: int) -> Array:
    """A matrix of n rows and n columns."""
    array = numbers(argument, value)
    if array.shape != (n, n):
        flat = array.shape == (n,)
        remedy = f"{argument}=np.diag(…) makes one of variances" if flat else None
        raise shape_error(argument, array.shape, f"({n}, {n})", remedy)
    return array

"""Numbers that users give, as arrays of a known shape."""

from __future__ import annotations

import datetime
import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from givens.errors import GivensError, InputError

__all__ = [
    "Array",
    "array_of",
    "dimensions",
    "frozen",
    "is_null",
    "numbers",
    "shape_error",
    "square",
    "unmasked",
    "vector",
]

Array = npt.NDArray[np.float64]

#: Among values of these types nothing is masked.
_PLAIN = {bool, int, float, str, type(None)}


def frozen(array: Array) -> Array:
    """The same numbers in an array that cannot be written to."""
    own = np.array(array, dtype=np.float64, order="C")
    own.setflags(write=False)
    return own


def is_masked(value: object) -> bool:
    """Whether this is a masked array; their module is not imported to find out."""
    masked: Any = sys.modules.get("numpy.ma")
    return masked is not None and isinstance(value, masked.MaskedArray)


def is_null(value: object) -> bool:
    """Whether this one value is missing: None, NaN, NaT, or the null of another library."""
    if value is None:
        return True
    try:
        return bool(value != value)
    except (TypeError, ValueError):
        return type(value).__name__ == "NAType"


def unmasked(value: Any) -> Any:
    """The same without masks, in lists as well: what they hide is NaN, of dates NaT, of other things None."""
    if is_masked(value):
        if value.dtype.kind in "biuf":
            return np.asarray(value.astype(np.float64).filled(np.nan))
        if value.dtype.kind in "Mm":
            return np.asarray(value.filled(np.array("NaT", dtype=value.dtype)))
        own = np.array(value.data, dtype=object)
        own[np.ma.getmaskarray(value)] = None
        return own
    if isinstance(value, (list, tuple)) and "numpy.ma" in sys.modules and not set(map(type, value)) <= _PLAIN:
        parts = [unmasked(part) for part in value]
        return value if all(new is old for new, old in zip(parts, value, strict=True)) else parts
    return value


#: Begins what is said of a column of pyarrow that NumPy cannot hold.
_UNKNOWN = "no array holds "


def array_of(value: Any) -> np.ndarray[Any, Any]:
    """Anything like an array as one, of whatever it holds; a ValueError of parts of different lengths and of unions."""
    value = unmasked(value)
    # a single array of pyarrow refuses to give nulls away by that name
    arrow = type(value).__module__.startswith("pyarrow")
    if hasattr(value, "to_numpy") and not isinstance(value, np.ndarray) and not arrow:
        value = value.to_numpy()
    try:
        return np.asarray(value)
    except NotImplementedError:
        # what pyarrow has no array for, such as a union
        raise ValueError(f"{_UNKNOWN}{getattr(value, 'type', type(value).__name__)}") from None


def dimensions(value: Any) -> int:
    """How many an array of this would have; -1 if its parts have different lengths, or no array holds it."""
    try:
        return int(np.ndim(unmasked(value)))
    except (ValueError, NotImplementedError):
        return -1


#: What an array holds in place of real numbers, and what to do about it.
_OTHERS = {
    "M": ("dates", 'give seconds: (dates - dates[0]) / np.timedelta64(1, "s")'),
    "m": ("durations", 'give seconds: durations / np.timedelta64(1, "s")'),
    "c": ("complex numbers", "give their real parts, np.real(…), if that is all they have"),
    **dict.fromkeys("UST", ("text", "give a list of numbers, or a NumPy array of floats")),
}


def numbers(argument: str, value: Any, called: str | None = None) -> Array:
    """Anything like an array as 64-bit floats; what is null, or hidden by a mask, is NaN.

    `called` is what errors call it, if that is not the argument itself.
    """
    said, remedy = "something else", "give a list of numbers, or a NumPy array of floats"
    try:
        array = array_of(value)
        if array.dtype.kind == "O":
            array = _of_objects(array)
        if array.dtype.kind in "biuf":
            # what is too large becomes infinite, which whoever asks refuses
            with np.errstate(over="ignore"):
                return np.asarray(array, dtype=np.float64)
        said, remedy = _OTHERS.get(array.dtype.kind, (said, remedy))
    except GivensError:
        raise
    except (TypeError, ValueError, OverflowError) as error:
        if isinstance(error, OverflowError):
            said, remedy = "a number beyond 1.8e308", "measure it in a larger unit"
        elif "inhomogeneous" in str(error):
            said = "parts of different lengths"
        elif str(error).startswith(_UNKNOWN):
            said, remedy = str(error).removeprefix(_UNKNOWN), "cast it where the table is made"
    raise InputError(
        f"{called or f'`{argument}`'} is not an array of real numbers: it holds {said}",
        argument=argument,
        remedy=remedy,
    )


def _of_objects(array: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """Single values without their nulls, as numbers if they are such, as what they are if not."""
    flat = [np.nan if is_null(value) else value for value in array.flat]
    for value in flat:
        kind = np.asarray(value).dtype.kind
        if isinstance(value, datetime.timedelta):
            kind = "m"
        elif isinstance(value, datetime.date):
            kind = "M"
        if kind not in "biufO":
            return np.empty(0, dtype={"M": "M8[s]", "m": "m8[s]"}.get(kind, kind))
    return np.array([float(value) for value in flat]).reshape(array.shape)


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

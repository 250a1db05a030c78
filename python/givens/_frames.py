"""Arrays that are frames of pandas, polars or pyarrow: their columns are taken by name."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from givens._arrays import Array, numbers
from givens._names import known_name, listed
from givens.errors import InputError

__all__ = ["columns_of", "is_frame", "numbers_by_name", "twice"]


def is_frame(value: object) -> bool:
    """Whether this is a table whose columns have names; those of some are only numbered."""
    frame = hasattr(value, "columns") and hasattr(value, "__getitem__")
    if not (frame or hasattr(value, "column_names")):
        return False
    return any(not isinstance(name, (int, np.integer)) for name in columns_of(value))


def columns_of(frame: Any) -> list[Any]:
    """The names of the columns."""
    return list(getattr(frame, "column_names", None) or frame.columns)


def twice(argument: str, name: str) -> InputError:
    """The error of a table with two columns of one name."""
    return InputError(
        f"`{argument}` has the column `{name}` twice",
        argument=argument,
        component=name,
        remedy="leave one of them out, or name it otherwise",
    )


def numbers_by_name(argument: str, value: Any, names: Sequence[str], what: str, prefix: str = "") -> Array:
    """Anything like an array as floats; of a frame, the columns of these names, in their order.

    `what` says of what kind they are; a column may be called by its name with the prefix as well.
    """
    if not is_frame(value):
        return numbers(argument, value)
    found: dict[str, Any] = {}
    for name in columns_of(value):
        plain = str(name) if name in names else str(name).removeprefix(prefix)
        known_name(f"the columns of {argument}", plain, names, what)
        if plain in found:
            raise twice(argument, plain)
        found[plain] = value[name]
    missing = [name for name in names if name not in found]
    if missing:
        raise InputError(
            f"`{argument}` has no column `{missing[0]}`: it has {listed(found)}",
            argument=argument,
            component=missing[0],
            remedy="give one for each of " + ", ".join(names),
        )
    return np.stack([numbers(argument, found[name], f"the column `{name}`") for name in names], axis=1)

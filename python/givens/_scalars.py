"""Single numbers and words that users give."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Any

import numpy as np

from givens.errors import InputError

__all__ = ["mapping", "positive", "seed_of", "shown", "text", "threads_of", "whole"]

#: The largest number of threads, steps or rows that is taken for one.
MOST = 2**31 - 1
#: The largest number of runs; whether there is memory for them is another matter.
MOST_RUNS = 2**32 - 1
#: The largest number.
LARGEST = sys.float_info.max
#: The largest seed.
LAST_SEED = 2**64 - 1


def whole(argument: str, value: Any, least: int = 0, most: int = MOST) -> int:
    """A whole number from `least` up."""
    fits = isinstance(value, (int, np.integer)) and not isinstance(value, bool) and least <= value <= most
    if not fits:
        room = f"from {least} up"
        if isinstance(value, (int, np.integer)) and value > most:
            room = f"from {least} to {most}"
        raise InputError(f"`{argument}` is {shown(value)}", argument=argument, remedy=f"give a whole number, {room}")
    return int(value)


def seed_of(seed: Any) -> int:
    """A seed, which has 64 bits."""
    return whole("seed", seed, 0, LAST_SEED)


def threads_of(threads: Any) -> int | None:
    """How many threads; None: as many as there are cores."""
    return None if threads is None else whole("threads", threads, 1)


def text(argument: str, value: Any, what: str, remedy: str, split: str = "give words that are UTF-8") -> str:
    """Words that can be written in UTF-8; `remedy` is of what is none, `split` of words with half a character."""
    if not isinstance(value, str):
        raise InputError(f"`{argument}` is {_shown(value)}, not {what}", argument=argument, remedy=remedy)
    try:
        value.encode()
    except UnicodeEncodeError as error:
        raise InputError(
            f"`{argument}` holds {value[error.start]!r} at character {error.start}, which is half of one",
            argument=argument,
            remedy=split,
        ) from None
    return value


def positive(argument: str, value: Any, remedy: str, what: str = "", component: str | None = None) -> float:
    """A finite number above 0; of a component, `what` says what of it."""
    number = isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool)
    if not (number and 0 < _float(value) < np.inf):
        called = f"`{argument}`" if component is None else f"`{argument}`: the {what} of `{component}`"
        raise InputError(f"{called} is {_shown(value)}", argument=argument, component=component, remedy=remedy)
    return float(value)


def _float(value: Any) -> float:
    try:
        return float(value)
    except OverflowError:
        return np.inf


def mapping(argument: str, value: Any, example: str) -> Mapping[str, Any]:
    """A table by name; None is an empty one."""
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise InputError(
            f"`{argument}` is {_shown(value)}, not a table by name", argument=argument, remedy=f"write {example}"
        )
    return value


def _shown(value: Any) -> str:
    return shown(value) if value is None or isinstance(value, (int, float, str)) else type(value).__name__


def shown(value: Any) -> str:
    """As Python writes it; what Python cannot, such as a number of thousands of digits, in words."""
    if isinstance(value, int) and abs(value) > LARGEST:
        return "a number beyond 1.8e308"
    try:
        return repr(value)
    except Exception:
        return f"a {type(value).__name__}"

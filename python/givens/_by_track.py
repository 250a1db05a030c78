"""What is given for each track by its name: ``{track_id: value}``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from givens._arrays import array_of, dimensions
from givens._scalars import shown
from givens.errors import InputError

__all__ = ["by_track", "near_track", "starts"]

#: So many names stand in a message, and the number of the others.
_SHOWN = 5


def by_track(argument: str, table: Mapping[Any, Any], tracks: Sequence[Any]) -> list[Any]:
    """The values of the tracks in their order; `table` has one for each, and no others."""
    known = set(tracks)
    table = {name if name in known else _plain(name): value for name, value in table.items()}
    strange = [name for name in table if name not in known]
    if strange:
        missing = [name for name in tracks if name not in table]
        raise InputError(
            f"{argument} is for the track{_s(strange)} {_names(strange)}, of which there {_is(strange)} none",
            argument=_word(argument),
            remedy=near_track(strange[0], missing or tracks),
        )
    missing = [name for name in tracks if name not in table]
    if missing:
        raise InputError(
            f"{argument} has nothing for the track{_s(missing)} {_names(missing)}",
            argument=_word(argument),
            remedy="give one for each track",
        )
    return [table[name] for name in tracks]


def starts(t0: Any, tracks: Sequence[Any], batch: bool) -> list[Any]:
    """When each track begins: at one time for all, by name, or in their order; None is at its first row."""
    if batch and isinstance(t0, Mapping):
        return by_track("`t0`", t0, tracks)
    if not batch or dimensions(t0) != 1:
        return [t0] * len(tracks)
    each = list(array_of(t0))
    if len(each) != len(tracks):
        raise InputError(
            f"`t0` has {len(each)} times, but there are {len(tracks)} tracks",
            argument="t0",
            remedy="give one for each, or one for all",
        )
    return each


def _plain(name: Any) -> Any:
    """A time stamp of pandas as NumPy has it, as tables have them."""
    return name.to_datetime64() if hasattr(name, "to_datetime64") else name


def near_track(name: Any, among: Sequence[Any]) -> str:
    """What may have been meant, or what there is."""
    from difflib import get_close_matches

    words = {str(one): one for one in among}
    close = get_close_matches(shown(name) if not isinstance(name, str) else name, list(words), 1)
    if close:
        return f"did you mean {shown(words[close[0]])}?"
    return f"there {'is' if len(among) == 1 else 'are'} {_names(among)}" if among else "there is none"


def _word(argument: str) -> str:
    """The argument itself, of "`params` of `k`"."""
    return argument.split("`")[1]


def _s(names: Sequence[Any]) -> str:
    return "" if len(names) == 1 else "s"


def _is(names: Sequence[Any]) -> str:
    return "is" if len(names) == 1 else "are"


def _names(names: Sequence[Any]) -> str:
    told = ", ".join(shown(name) for name in names[:_SHOWN])
    return told if len(names) <= _SHOWN else f"{told}, … ({len(names)} in all)"

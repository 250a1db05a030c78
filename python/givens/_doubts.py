"""What is doubtful about answers, in words and as warnings."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TYPE_CHECKING, Any

import numpy as np

from givens.errors import DoubtWarning

if TYPE_CHECKING:
    from givens import _native
    from givens._plan import Track

__all__ = ["about", "doubtful", "place_of", "warn"]

#: What warnings begin with; None: there are none.
_ABOUT: ContextVar[str | None] = ContextVar("about", default="")


@contextmanager
def about(name: str | None) -> Iterator[None]:
    """Warns of doubts by this name; without one not at all."""
    before = _ABOUT.set(None if name is None else f"{name}: ")
    try:
        yield
    finally:
        _ABOUT.reset(before)


def place_of(track: Track, row: int | None, time: float, name: Any = None) -> str:
    """Where something is, in words: `time` as the track counts it, `row` as its data do."""
    shown = track.clock.shown(np.array([time]))[0]
    place = f"t = {shown:g}" if track.clock.origin is None else f"{shown}"
    place = place if row is None else f"row {row}, {place}"
    return place if name is None else f"track {name}, {place}"


def doubtful(track: Track, doubt: _native._Doubt, name: Any = None) -> str:
    """A doubt about a row of this track."""
    _, row, time, message, rows, _ = doubt
    more = "" if rows == 1 else f" (the same of {rows} rows that were looked at)"
    return f"{place_of(track, row + track.before, time, name)}: {message}{more}"


def warn(doubts: Iterable[tuple[str, bool]]) -> None:
    """Warns of those doubts that are grave, at the line from which the package was called."""
    frame, level = sys._getframe(1), 2
    while frame.f_back is not None and frame.f_globals.get("__name__", "").startswith("givens."):
        frame, level = frame.f_back, level + 1
    name = _ABOUT.get()
    if name is None:
        return
    for doubt in [doubt for doubt, grave in doubts if grave]:
        warnings.warn(name + doubt, DoubtWarning, stacklevel=level)

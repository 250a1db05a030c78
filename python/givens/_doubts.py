"""What is doubtful about answers, in words and as warnings."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from givens.errors import DoubtWarning

if TYPE_CHECKING:
    from givens import _native
    from givens._plan import Track

__all__ = ["doubtful", "place_of", "warn"]


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
    for doubt in [doubt for doubt, grave in doubts if grave]:
        warnings.warn(doubt, DoubtWarning, stacklevel=level)

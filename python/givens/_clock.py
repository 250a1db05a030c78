"""Times as seconds: numbers as they are, dates since an origin."""

from __future__ import annotations

import datetime
from dataclasses import dataclass
from typing import Any

import numpy as np

from givens._arrays import Array, numbers
from givens.errors import InputError

__all__ = ["Clock", "clock_of"]


@dataclass(frozen=True)
class Clock:
    """What zero seconds are: nothing, or a date."""

    origin: np.datetime64 | None = None

    def seconds(self, argument: str, times: Any) -> Array:
        """Times as seconds since the origin."""
        dates = _dates(times)
        if dates is None and self.origin is None:
            return numbers(argument, times)
        if dates is None or self.origin is None:
            kinds = ("dates", "numbers") if dates is not None else ("numbers", "dates")
            raise InputError(
                f"`{argument}` holds {kinds[0]}, but the other times are {kinds[1]}",
                argument=argument,
                remedy="give all times as numbers, or all as dates",
            )
        if np.isnat(dates).any():
            row = int(np.flatnonzero(np.isnat(dates))[0])
            raise InputError(
                f"`{argument}` is no time at row {row}", argument=argument, row=row, remedy="leave the row out"
            )
        return (dates - self.origin).astype("timedelta64[ns]").astype(np.int64) / 1e9

    def shown(self, seconds: Array) -> np.ndarray[Any, Any]:
        """Seconds as they were given: numbers, or dates to the nanosecond."""
        if self.origin is None:
            return seconds
        dates: np.ndarray[Any, Any] = self.origin.astype("datetime64[ns]") + np.round(seconds * 1e9).astype(
            "timedelta64[ns]"
        )
        dates.setflags(write=False)
        return dates


def _dates(times: Any) -> np.ndarray[Any, np.dtype[np.datetime64]] | None:
    """An array of dates; None for anything else."""
    if hasattr(times, "to_numpy") and not isinstance(times, np.ndarray):
        times = times.to_numpy()
    array = np.asarray(times)
    if array.dtype.kind == "M":
        return array
    first = next(iter(array.flat), None) if array.dtype == object else None
    if not isinstance(first, datetime.datetime):
        return None
    if first.tzinfo is not None:
        utc = [value.astimezone(datetime.UTC).replace(tzinfo=None) for value in array.flat]
        return np.array(utc, dtype="datetime64[ns]").reshape(array.shape)
    return array.astype("datetime64[ns]")


def clock_of(t: Any, t0: Any) -> Clock:
    """The clock of times that begin at `t0`, or at the first of them."""
    dates = _dates(t if t0 is None else t0)
    if dates is None or dates.size == 0:
        return Clock()
    return Clock(np.asarray(dates).ravel()[0].astype("datetime64[ns]"))

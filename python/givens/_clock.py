"""Times as seconds: numbers as they are, dates since an origin."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from givens._arrays import Array, dimensions, shape_error
from givens._dates import Dates, dates_of, seconds_of
from givens.errors import InputError

__all__ = ["Clock", "Times", "clock_of"]


@dataclass(frozen=True)
class Times:
    """Times in seconds, and as they were given."""

    seconds: Array
    #: Dates as they were given, in UTC if they had a zone; the seconds, of numbers.
    given: np.ndarray[Any, Any]

    def of(self, seconds: Array, clock: Clock) -> np.ndarray[Any, Any]:
        """As they were given, where `seconds` are some of these in a row; told by the clock where they are not."""
        if clock.origin is not None and len(seconds):
            first = int(np.searchsorted(self.seconds, seconds[0]))
            if np.array_equal(self.seconds[first : first + len(seconds)], seconds):
                return self.given[first : first + len(seconds)]
        return clock.shown(seconds)


@dataclass(frozen=True)
class Clock:
    """What zero seconds are: nothing, or a date."""

    origin: np.datetime64 | None = None
    #: Whether dates have a time zone; None: they may or may not, and those without are in UTC.
    aware: bool | None = False

    def times(self, argument: str, times: Any) -> Times:
        """Times, one behind the other, as seconds since the origin."""
        found = self._read(argument, times)
        if found.seconds.ndim != 1:
            raise shape_error(argument, found.seconds.shape, "(rows,)", f"times are a vector: {argument}=np.ravel(…)")
        return found

    def wanted(self, argument: str, times: Any) -> Times:
        """Times that are asked for: one, or several behind each other."""
        found = self._read(argument, times)
        if found.seconds.ndim > 1:
            remedy = (
                f"times are a vector, the same for all tracks: {argument}=np.unique(…), or one track after the other"
            )
            raise shape_error(argument, found.seconds.shape, "(times,)", remedy)
        return Times(np.atleast_1d(found.seconds), np.atleast_1d(found.given))

    def moment(self, argument: str, time: Any) -> float:
        """One time as seconds since the origin."""
        if self.origin is None and (isinstance(time, float) or (type(time) is int and abs(time) < 2**53)):
            # as it comes to a filter at work
            return float(time)
        if time is None:
            raise InputError(f"`{argument}` is missing", argument=argument, remedy="give a number, or a date")
        if dimensions(time) != 0:
            raise InputError(
                f"`{argument}` is {_several(time)}, not one time", argument=argument, remedy="give a number, or a date"
            )
        return float(self._read(argument, time).seconds)

    def _read(self, argument: str, times: Any) -> Times:
        dates = dates_of(argument, times)
        if dates is None and self.origin is None:
            seconds = seconds_of(argument, times)
            return Times(seconds, seconds)
        if dates is None or self.origin is None:
            kinds = ("dates", "numbers") if dates is not None else ("numbers", "dates")
            raise InputError(
                f"`{argument}` holds {kinds[0]}, but the other times are {kinds[1]}",
                argument=argument,
                remedy="give all times as numbers, or all as dates",
            )
        if self.aware is not None and self.aware != dates.aware:
            words = ("with a time zone", "without one") if dates.aware else ("without a time zone", "with one")
            raise InputError(
                f"`{argument}` holds dates {words[0]}, but the other times are dates {words[1]}",
                argument=argument,
                remedy='give all with a time zone, or none: pandas.to_datetime(…).tz_localize("UTC")',
            )
        given = dates.array.copy()
        given.setflags(write=False)
        return Times(_since(argument, dates, self.origin), given)

    def shown(self, seconds: Array) -> np.ndarray[Any, Any]:
        """Seconds as they would have been given: numbers, or dates to the nanosecond."""
        if self.origin is None:
            return seconds
        dates: np.ndarray[Any, Any] = self.origin.astype("datetime64[ns]") + np.round(seconds * 1e9).astype(
            "timedelta64[ns]"
        )
        dates.setflags(write=False)
        return dates


def _since(argument: str, dates: Dates, origin: np.datetime64) -> Array:
    exact = dates.array.astype("datetime64[ns]")
    apart = (exact.astype("datetime64[s]") - origin.astype("datetime64[s]")).astype(np.int64)
    # 2⁶³ nanoseconds, less some seconds
    far = np.abs(apart.ravel()) > 9_223_372_000
    if far.any():
        row = int(np.flatnonzero(far)[0])
        day = origin.astype("datetime64[D]")
        raise InputError(
            f"`{argument}` is {dates.array.ravel()[row]} at row {row}, more than 292 years from {day}",
            argument=argument,
            row=row,
            remedy="give seconds as numbers",
        )
    return np.asarray((exact - origin).astype(np.int64) / 1e9)


def _several(value: Any) -> str:
    return f"a {type(value).__name__} of {len(value)}" if hasattr(value, "__len__") else type(value).__name__


def clock_of(t: Any, t0: Any) -> Clock:
    """The clock of times that begin at `t0`, or at the first of them."""
    dates = dates_of("t", t) if t0 is None else dates_of("t0", t0)
    if dates is None or dates.array.size == 0:
        return Clock()
    return Clock(dates.array.ravel()[0].astype("datetime64[ns]"), dates.aware)

"""Dates and durations of every library, as NumPy has them."""

from __future__ import annotations

import datetime
from dataclasses import dataclass
from typing import Any

import numpy as np

from givens._arrays import Array, array_of, is_null, numbers, unmasked
from givens.errors import InputError

__all__ = ["Dates", "dates_of", "seconds_of"]

#: Dates that a count of nanoseconds can tell, from the first on and before the last.
_FIRST, _LAST = np.datetime64("1677-09-22", "D"), np.datetime64("2262-04-11", "D")


@dataclass(frozen=True)
class Dates:
    """Dates without a zone, or in UTC if they had one."""

    array: np.ndarray[Any, np.dtype[np.datetime64]]
    aware: bool

    def __len__(self) -> int:
        return len(self.array)

    def __getitem__(self, rows: list[int]) -> Dates:
        return Dates(self.array[rows], self.aware)

    def to_numpy(self) -> np.ndarray[Any, Any]:
        """The dates without their zone."""
        return self.array


def dates_of(argument: str, times: Any) -> Dates | None:
    """Times that are dates, none of them null and all of them told by nanoseconds; None for anything else."""
    found = times if isinstance(times, Dates) else _read(argument, unmasked(times))
    if found is None:
        return None
    flat = found.array.ravel()
    if np.isnat(flat).any():
        row = int(np.flatnonzero(np.isnat(flat))[0])
        raise InputError(
            f"`{argument}` is no time at row {row}", argument=argument, row=row, remedy="leave the row out"
        )
    finer = np.datetime_data(flat.dtype)[0] in ("ps", "fs", "as")
    far = np.zeros(len(flat), dtype=bool) if finer else (flat < _FIRST) | (flat >= _LAST)
    if far.any():
        row = int(np.flatnonzero(far)[0])
        raise InputError(
            f"`{argument}` is {flat[row]} at row {row}, which nanoseconds cannot tell",
            argument=argument,
            row=row,
            remedy="dates lie from 1677-09-22 to 2262-04-10; give seconds as numbers for others",
        )
    return found


def _read(argument: str, times: Any) -> Dates | None:
    zone = _zone(times)
    if zone is not None and hasattr(times, "tz_convert"):
        # an index, or a series below, of pandas: of single time stamps NumPy would take the microseconds only
        of = times.dt if hasattr(times, "dt") else times
        return Dates(np.asarray(of.tz_convert(None).to_numpy()), True)
    if isinstance(times, datetime.date):
        array: np.ndarray[Any, Any] = np.empty((), dtype=object)
        array[()] = times
    else:
        try:
            array = array_of(times)
        except ValueError:
            return None
    if array.dtype.kind == "M":
        return Dates(array, zone is not None)
    if array.dtype.kind != "O":
        return None
    return _of_objects(argument, array)


def _zone(times: Any) -> Any:
    """The time zone that a column of pandas, polars or pyarrow names."""
    kind = getattr(times, "dtype", None)
    for of, name in ((kind, "tz"), (kind, "time_zone"), (getattr(times, "type", None), "tz")):
        zone = getattr(of, name, None)
        if zone is not None:
            return zone
    return None


def _of_objects(argument: str, array: np.ndarray[Any, Any]) -> Dates | None:
    values = list(array.flat)
    if any(type(value).__name__ == "NaTType" for value in values) and all(map(is_null, values)):
        return Dates(np.full(array.shape, np.datetime64("NaT", "s")), False)
    there = [k for k, value in enumerate(values) if not is_null(value)]
    if not there or not all(isinstance(values[k], (datetime.date, np.datetime64)) for k in there):
        return None
    aware = [getattr(values[k], "tzinfo", None) is not None for k in there]
    if any(aware) and not all(aware):
        row = there[aware.index(not aware[0])]
        raise InputError(
            f"`{argument}` holds dates with a time zone and without one: row {row} is {values[row]}",
            argument=argument,
            row=row,
            remedy="give all of them with a time zone, or none",
        )
    plain = [_plain(value) for value in values]
    return Dates(np.array(plain, dtype=np.result_type(*plain)).reshape(array.shape), any(aware))


def _plain(value: Any) -> np.datetime64:
    """One date; what has a zone, in UTC."""
    if is_null(value):
        return np.datetime64("NaT", "s")
    if hasattr(value, "to_datetime64"):
        stamp: np.datetime64 = value.to_datetime64()
        return stamp
    if isinstance(value, datetime.datetime) and value.tzinfo is not None:
        value = value.astimezone(datetime.UTC).replace(tzinfo=None)
    return np.datetime64(value)


def seconds_of(argument: str, times: Any) -> Array:
    """Times that are numbers, and durations by their unit, as seconds."""
    times = unmasked(times)
    if isinstance(times, datetime.timedelta):
        times = np.timedelta64(times)
    try:
        array = array_of(times)
    except ValueError:
        return numbers(argument, times)
    if array.dtype.kind in "UST" or any(isinstance(value, str) for value in array.flat[:1].tolist()):
        raise InputError(
            f"`{argument}` holds text, not times",
            argument=argument,
            remedy='give numbers, or dates: np.array(…, dtype="datetime64[ms]")',
        )
    if array.dtype.kind == "O":
        values = list(array.flat)
        kinds = (datetime.timedelta, np.timedelta64)
        if any(isinstance(value, kinds) for value in values) and all(
            isinstance(value, kinds) or is_null(value) for value in values
        ):
            each = [np.timedelta64("NaT") if is_null(value) else _duration(value) for value in values]
            array = np.array(each, dtype=np.result_type(*each)).reshape(array.shape)
    if array.dtype.kind != "m":
        return numbers(argument, array)
    unit = np.datetime_data(array.dtype)[0]
    if unit in ("Y", "M", "generic"):
        word = {"Y": "years", "M": "months"}.get(unit, "no unit")
        raise InputError(
            f"`{argument}` holds durations in {word}, which are no number of seconds",
            argument=argument,
            remedy="give them in days, seconds or parts of those",
        )
    return np.asarray(array / np.timedelta64(1, "s"))


def _duration(value: Any) -> np.timedelta64:
    if hasattr(value, "to_timedelta64"):
        found: np.timedelta64 = value.to_timedelta64()
        return found
    return np.timedelta64(value)

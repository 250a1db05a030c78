"""Sensors that measure at their own times, in rows of common times."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from givens._arrays import Array, numbers
from givens._dates import Dates, dates_of, seconds_of
from givens.errors import InputError

__all__ = ["merge"]


def merge(measurements: Mapping[str, tuple[Any, Any]]) -> tuple[Any, dict[str, npt.NDArray[np.float64]]]:
    """Brings sensors that measure at their own times into rows of common times.

    Parameters
    ----------
    measurements : mapping
        For each sensor its times and its measurements: ``{"radar": (t1, z1), "gps": (t2, z2)}``.

    Returns
    -------
    t : ndarray
        All times in order, each once; dates with a time zone come back in UTC.
    z : dict
        For each sensor an array of as many rows, NaN where it did not measure.

    Raises
    ------
    InputError
        For times that are missing, come twice, or are numbers here and dates there.

    Examples
    --------
    >>> import givens as gv
    >>> t, z = gv.merge({"radar": ([0.0, 1.0], [[5.0], [6.0]]), "gps": ([0.5, 1.0], [[7.0], [8.0]])})
    >>> t
    array([0. , 0.5, 1. ])
    >>> z["gps"].ravel()
    array([nan,  7.,  8.])
    """
    if not isinstance(measurements, Mapping):
        raise InputError(
            f"`measurements` is {type(measurements).__name__}, not a table by sensor",
            argument="measurements",
            remedy='write {"radar": (t, z), …}',
        )
    dates: dict[str, Dates | None] = {}
    times: dict[str, np.ndarray[Any, Any]] = {}
    values: dict[str, Array] = {}
    for name, pair in measurements.items():
        if not (isinstance(pair, tuple) and len(pair) == 2):
            raise _wrong(name, "is not a pair of times and measurements", "write {name: (t, z)}")
        found = dates[name] = dates_of(name, pair[0])
        of = times[name] = seconds_of(name, pair[0]) if found is None else found.array
        array = numbers(name, pair[1])
        values[name] = array = array.reshape(-1, 1) if array.ndim == 1 else array
        if of.ndim != 1 or array.ndim != 2:
            raise _wrong(name, f"has times of shape {of.shape} and measurements of shape {array.shape}", _SHAPES)
        if len(array) != len(of):
            raise _wrong(name, f"has {len(of)} times and {len(array)} measurements", _SHAPES)
        if found is None and not np.isfinite(of).all():
            row = int(np.flatnonzero(~np.isfinite(of))[0])
            raise _wrong(name, f"has the time {of[row]} in row {row}", "leave the row out", row)
        if len(np.unique(of)) != len(of):
            raise _wrong(name, "measures twice at one time", "give the second one as a sensor of its own")
    _of_one_kind(dates)
    common = np.unique(np.concatenate(list(times.values()))) if times else np.empty(0)
    merged = {}
    for name, array in values.items():
        merged[name] = np.full((len(common), array.shape[1]), np.nan)
        merged[name][np.searchsorted(common, times[name])] = array
    return common, merged


_SHAPES = "give times (rows,) and measurements (rows, d)"


def _of_one_kind(dates: Mapping[str, Dates | None]) -> None:
    """All times are numbers, or dates without a zone, or dates with one."""
    kinds = {
        name: "numbers" if of is None else "dates with a time zone" if of.aware else "dates"
        for name, of in dates.items()
    }
    (first, kind), *others = kinds.items() or [("", "")]
    for name, other in others:
        if other != kind:
            raise _wrong(name, f"has times that are {other}, but those of `{first}` are {kind}", "give all alike")


def _wrong(name: str, said: str, remedy: str, row: int | None = None) -> InputError:
    return InputError(f"`{name}` {said}", argument="measurements", component=name, row=row, remedy=remedy)

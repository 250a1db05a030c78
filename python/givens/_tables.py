"""Tables of measurements: of pandas, polars, pyarrow and duckdb, and dicts of arrays."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from givens._arrays import Array, array_of, is_null, numbers
from givens._dates import Dates, dates_of, seconds_of
from givens._frames import columns_of, twice
from givens._join import Joined
from givens._names import known_name, listed
from givens._rows import controls_of
from givens._scalars import shown
from givens._shared import refuse_shared, refuse_shared_rows
from givens.errors import InputError

__all__ = ["is_table", "rows_by_track"]

_TIME = ("time", "t")
_SENSOR = "sensor"
_TRACK = "track_id"


def is_table(value: object) -> bool:
    """Whether this is a table with named columns."""
    if isinstance(value, Mapping):
        return True
    frame = hasattr(value, "columns") and hasattr(value, "__getitem__")
    return frame or hasattr(value, "column_names") or hasattr(value, "fetchnumpy")


class _Columns(Mapping[str, Any]):
    """The columns of a table, each taken out when it is asked for."""

    def __init__(self, table: Any) -> None:
        if hasattr(table, "fetchnumpy"):
            table = table.fetchnumpy()
        self._table = table
        self._index = _index(table)
        names = list(table) if isinstance(table, Mapping) else columns_of(table)
        self._names = {str(name): name for name in names}
        self._twice = {str(name) for k, name in enumerate(names) if name in names[:k]}

    def __getitem__(self, name: str) -> Any:
        if name in self._twice:
            raise twice("t", name)
        return self._table[self._names[name]] if name in self._names else self._index[name]

    def __iter__(self) -> Iterator[str]:
        return iter([*(name for name in self._index if name not in self._names), *self._names])

    def __len__(self) -> int:
        return len(self._index.keys() | self._names.keys())


def _index(table: Any) -> dict[str, Any]:
    """What a frame of pandas has beside its columns: times, by their name or as dates, and tracks."""
    index: Any = getattr(table, "index", None)
    if not hasattr(index, "get_level_values"):
        return {}
    levels = {name: index.get_level_values(k) for k, name in enumerate(index.names)}
    found = {name: level for name, level in levels.items() if name in (*_TIME, _TRACK)}
    if not found and index.nlevels == 1 and getattr(index.dtype, "kind", "") == "M":
        found = {_TIME[0]: index}
    return {} if any(name in table.columns for name in _TIME) else found


def _floats(name: str, column: Any, rows: int) -> Array:
    """A column of numbers; what is null or masked is NaN."""
    array = numbers("z", column, f"the column `{name}`")
    if array.shape != (rows,):
        raise InputError(
            f"the column `{name}` has shape {array.shape}, not ({rows},)",
            argument="z",
            component=name,
            remedy="give one number for each time",
        )
    return array


def _words(name: str, column: Any) -> list[Any]:
    """A column of names; None where there is none."""
    try:
        array = array_of(column)
    except ValueError as error:
        raise InputError(
            f"the column `{name}` is no list of names: {error}",
            argument=name,
            remedy="name them by words or whole numbers",
        ) from None
    # of times that are finer than those of Python, NumPy would make whole numbers
    fine = array.dtype.kind in "mM" and np.datetime_data(array.dtype)[0] in ("ns", "ps", "fs", "as")
    return [None if is_null(value) else value for value in (list(array) if fine else array.tolist())]


def rows_by_track(joined: Joined, table: Any, controls: Any = None) -> list[dict[str, Any]]:
    """The rows of each track, in the order in which tracks appear: `id`, `time`, `z`, `u`, `rows` of the table.

    `controls` stand beside the rows of the table, in place of its columns.
    """
    columns = _Columns(table)
    time = next((columns[name] for name in _TIME if name in columns), None)
    if time is None:
        raise InputError(
            f"the table has no column `time`: it has {listed(columns)}",
            argument="t",
            remedy="name the column of times `time`",
        )
    dates = dates_of("time", time)
    times: Any = seconds_of("time", time) if dates is None else dates
    if (times.array if isinstance(times, Dates) else times).ndim != 1:
        raise InputError(
            "the column `time` is not a list of times", argument="t", remedy="give one time for each row of the table"
        )
    rows = len(times)
    z = _measures(joined, columns, rows)
    u = _controls(joined, columns, rows) if controls is None else _beside(joined, columns, controls, rows)
    if _TRACK not in columns:
        return [{"id": None, "time": times, "z": z, "u": u, "rows": None}]
    found: dict[Any, list[int]] = {}
    for row, track in enumerate(_words(_TRACK, columns[_TRACK])):
        if track is None:
            raise InputError(
                f"`{_TRACK}` is missing in row {row}",
                argument=_TRACK,
                row=row,
                remedy="name the track of each row, or leave such rows out",
            )
        try:
            found.setdefault(track, []).append(row)
        except TypeError:
            raise InputError(
                f"`{_TRACK}` is {shown(track)} in row {row}, which is no name",
                argument=_TRACK,
                row=row,
                remedy="name tracks by words or whole numbers",
            ) from None
    return [
        {"id": track, "time": times[of], "z": z[of], "u": None if u is None else u[of], "rows": of}
        for track, of in found.items()
    ]


def _measures(joined: Joined, columns: Mapping[str, Any], rows: int) -> Array:
    z = np.full((rows, len(joined.measures)), np.nan)
    absent = []
    for sensor, place in joined.sensors.items():
        names = joined.measures[place]
        missing = [name for name in names if name not in columns]
        absent += missing
        if missing and len(missing) < len(names):
            from difflib import get_close_matches

            close = get_close_matches(missing[0], list(columns), 1)
            raise InputError(
                f"the table has no column `{missing[0]}` of the sensor `{sensor}`",
                argument="z",
                component=missing[0],
                remedy=f"did you mean `{close[0]}`?" if close else "a sensor may be absent as a whole, not in part",
            )
        if not missing:
            z[:, place] = np.stack([_floats(name, columns[name], rows) for name in names], axis=1)
    if len(absent) == len(joined.measures):
        raise InputError(
            f"the table has none of the measures {listed(joined.measures)}: it has {listed(columns)}",
            argument="z",
            remedy="name the columns as the measures are named",
        )
    if _SENSOR not in columns:
        refuse_shared(
            joined, "add a column `sensor` that names the sensor of each row, or give the measures other names"
        )
    else:
        of = [
            name if name is None or isinstance(name, str) else shown(name) for name in _words(_SENSOR, columns[_SENSOR])
        ]
        for sensor in {name for name in of if name}:
            known_name("sensor", sensor, tuple(joined.sensors), "sensor")
        for sensor, place in joined.sensors.items():
            others = np.array([name is not None and name != sensor for name in of])
            z[others, place] = np.nan
        refuse_shared_rows(joined, np.array([name is None for name in of], dtype=bool), z)
    return z


def _beside(joined: Joined, columns: Mapping[str, Any], controls: Any, rows: int) -> Array | None:
    for name in joined.controls:
        for column in (f"u_{name}", name):
            if column in columns:
                raise InputError(
                    f"`u` is given, and the table has the column `{column}` as well",
                    argument="u",
                    component=name,
                    remedy="leave one of them out",
                )
    return controls_of(joined, controls, rows)


def _controls(joined: Joined, columns: Mapping[str, Any], rows: int) -> Array | None:
    found = []
    for name in joined.controls:
        column = f"u_{name}" if f"u_{name}" in columns else name
        if column not in columns:
            raise InputError(
                f"the table has no column `u_{name}` for the control `{name}`",
                argument="u",
                component=name,
                remedy="add it: its values hold from their rows on; or give u=…, row by row or {name: number}",
            )
        found.append(_floats(column, columns[column], rows))
    return np.stack(found, axis=1) if found else None

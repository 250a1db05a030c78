"""Tables by Arrow's PyCapsule protocol, which asks for no library: those of others, and our own."""

from __future__ import annotations

import datetime
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from givens import _native
from givens._dates import Dates, dates_of
from givens._frames import twice
from givens.errors import InputError

if TYPE_CHECKING:
    from givens.batch import Batch
    from givens.estimates import Estimates

__all__ = ["LentTable", "batch_stream", "framed", "stream"]


class LentTable:
    """A table whose columns NumPy cannot take by itself."""

    ndim = 2

    def __init__(self, argument: str, native: _native.ArrowTable) -> None:
        self._argument = argument
        self._native = native
        self.column_names = native.names
        self.shape = (len(native), len(self.column_names))

    def __getitem__(self, name: str) -> Any:
        if self.column_names.count(name) > 1:
            raise twice(self._argument, name)
        kind, unit, values = self._native.column(self.column_names.index(name))
        if kind in ("date", "zoned"):
            return Dates(values.view(f"datetime64[{unit}]"), kind == "zoned")
        if kind == "duration":
            return values.view(f"timedelta64[{unit}]")
        if kind == "text":
            return np.array(values, dtype=object)
        if kind == "other":
            raise InputError(
                f"the column `{name}` holds {values}, which is neither numbers, dates nor words",
                argument=self._argument,
                component=name,
                remedy="cast it where the table is made",
            )
        return values

    def to_numpy(self) -> np.ndarray[Any, Any]:
        """All columns, in their order."""
        return np.stack([np.asarray(self[name]) for name in self.column_names], axis=1)


def framed(argument: str, value: Any) -> Any:
    """The same, but what can only lend its columns as a table that has them; in lists and tables by name as well."""
    if type(value).__name__ == "LazyFrame" and hasattr(value, "collect"):
        raise InputError(
            f"`{argument}` is a LazyFrame, which has no rows yet", argument=argument, remedy=f"{argument}.collect()"
        )
    if isinstance(value, (list, tuple)) and any(map(_lends_or_waits, value)):
        return [framed(f"{argument}[{k}]", part) for k, part in enumerate(value)]
    if isinstance(value, Mapping) and any(map(_lends_or_waits, value.values())):
        return {name: framed(f"{argument}[{name!r}]", part) for name, part in value.items()}
    if not _only_lends(value):
        return value
    try:
        return LentTable(argument, _native.ArrowTable.read(value.__arrow_c_stream__()))
    except InputError as error:
        # of what a producer has raised, Arrow brings the traceback, as text
        if error.message.rstrip().endswith("\nKeyboardInterrupt"):
            raise KeyboardInterrupt from error
        raise InputError(
            f"`{argument}`: {error.message}", argument=argument, remedy="give a table with named columns"
        ) from None


def _only_lends(value: object) -> bool:
    faces = ("column_names", "to_numpy", "__array__")
    return hasattr(value, "__arrow_c_stream__") and not any(hasattr(value, face) for face in faces)


def _lends_or_waits(value: object) -> bool:
    return _only_lends(value) or type(value).__name__ == "LazyFrame"


def stream(one: Estimates) -> object:
    """See `Estimates.__arrow_c_stream__`."""
    from givens._export import aware, columns

    return _native.arrow_stream(_described(columns([one]), aware([one])))


def batch_stream(batch: Batch) -> object:
    """See `Batch.__arrow_c_stream__`."""
    from givens._export import aware, columns

    if not len(batch):
        return _native.arrow_stream([])
    runs = tuple(batch)
    names = _tracks(batch.track_ids, np.array([len(one) for one in runs], dtype=np.int64))
    return _native.arrow_stream([names, *_described(columns(runs, ("track_id",)), aware(runs))])


def _tracks(names: Sequence[Any], rows: np.ndarray[Any, Any]) -> tuple[str, str, Any]:
    """The track of each row."""
    kinds = {type(name) for name in names}
    if kinds == {str}:
        return "track_id", "text", (list(names), rows)
    if kinds == {int} and all(-(2**63) <= name < 2**63 for name in names):
        return "track_id", "whole", np.repeat(np.array(names, dtype=np.int64), rows)
    if kinds == {float}:
        return "track_id", "number", np.repeat(np.array(names), rows)
    if all(issubclass(kind, (np.datetime64, datetime.date)) for kind in kinds):
        found = dates_of("track_id", list(names))
        assert found is not None
        kind, values = _dates(found.array, found.aware)
        return "track_id", kind, np.repeat(values, rows)
    words = ", ".join(sorted(kind.__name__ for kind in kinds))
    raise InputError(
        f"the tracks are named by {words}, which cannot be one column",
        argument="track_id",
        remedy="name all of them by words, or all by whole numbers below 2⁶³",
    )


#: Units of dates that Arrow has not, and the next finer one that it has.
_FINER = {"Y": "D", "M": "D", "W": "D", "h": "s", "m": "s"}


def _described(columns: Mapping[str, np.ndarray[Any, Any]], utc: bool) -> list[tuple[str, str, Any]]:
    found: list[tuple[str, str, Any]] = []
    for name, values in columns.items():
        kind = "whole" if values.dtype.kind == "i" else "number"
        if values.dtype.kind == "M":
            kind, values = _dates(values, utc)
        found.append((name, kind, values))
    return found


def _dates(values: np.ndarray[Any, Any], utc: bool) -> tuple[str, np.ndarray[Any, Any]]:
    unit = np.datetime_data(values.dtype)[0]
    unit = _FINER.get(unit, unit)
    return f"{unit} UTC" if utc else unit, values.astype(f"datetime64[{unit}]").astype(np.int64)

"""Estimates as tables of other libraries."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from givens._lazy import wanted
from givens._stack import padded
from givens.errors import InputError

if TYPE_CHECKING:
    from givens.batch import Batch
    from givens.estimates import Estimates

__all__ = ["aware", "batch_to_pandas", "batch_to_xarray", "columns", "to_pandas", "to_polars", "to_xarray"]

_LAST = ("nis", "nis_dof", "log_likelihood")


def columns(runs: Sequence[Estimates], first: Iterable[str] = ()) -> dict[str, Any]:
    """The columns of the command's CSV, of runs below each other; `first` are those that the caller adds."""
    state, last = runs[0].state, _last(runs)
    _distinct(state, ("time", *first), last)
    # one array for each column: tables of single runs would cost more than all their rows
    mean, std = (np.concatenate([getattr(one, name) for one in runs]) for name in ("mean", "std"))
    found: dict[str, Any] = {"time": np.concatenate([one.time for one in runs])}
    found |= {name: mean[:, i] for i, name in enumerate(state)}
    found |= {f"{name}_std": std[:, i] for i, name in enumerate(state)}
    found |= {name: np.concatenate([getattr(one, name) for one in runs]) for name in last}
    if "gated" in last:
        found["gated"] = found["gated"].astype(np.int64)
    return found


def _last(runs: Sequence[Estimates]) -> tuple[str, ...]:
    """The columns behind the states."""
    return (*_LAST, "gated") if any(one.__dict__["_gate"] is not None for one in runs) else _LAST


def _distinct(state: Sequence[str], first: Iterable[str], last: Iterable[str]) -> None:
    meant = {name: f"the column `{name}` of every table" for name in (*first, *last)}
    meant |= {f"{name}_std": f"the standard deviation of `{name}`" for name in state}
    for name in state:
        if name in meant:
            raise InputError(
                f"the state `{name}` and {meant[name]} would be one column",
                argument="state",
                component=name,
                remedy="name the state otherwise in the model, or take the arrays: to_dict()",
            )


def aware(runs: Sequence[Estimates]) -> bool:
    """Whether the times are dates that had a time zone."""
    return any(one.__dict__["_aware"] for one in runs)


def _pandas(runs: Sequence[Estimates], first: Iterable[str] = ()) -> Any:
    frame = wanted("pandas").DataFrame(columns(runs, first))
    if aware(runs):
        frame["time"] = frame["time"].dt.tz_localize("UTC")
    return frame


def to_pandas(one: Estimates) -> Any:
    """See `Estimates.to_pandas`."""
    return _pandas([one]).set_index("time")


def to_polars(of: Estimates | Batch) -> Any:
    """See `Estimates.to_polars`."""
    return wanted("polars").DataFrame(of)


def batch_to_pandas(batch: Batch) -> Any:
    """See `Batch.to_pandas`."""
    pandas = wanted("pandas")
    if not len(batch):
        return pandas.DataFrame()
    frame = _pandas(tuple(batch), ("track_id",))
    names = pandas.Series(batch.track_ids).repeat([len(one) for one in batch])
    frame.insert(0, "track_id", names.to_numpy())
    return frame.set_index(["track_id", "time"])


_STATE, _MEASURE = ("state",), ("measure",)
#: The arrays of a data set, with their dimensions behind time.
_DIMS: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(("mean", "std", "filtered_mean", "predicted_mean"), _STATE),
    **dict.fromkeys(("cov", "filtered_cov", "predicted_cov"), (*_STATE, "state2")),
    "innovation": _MEASURE,
    "innovation_cov": (*_MEASURE, "measure2"),
    **dict.fromkeys((*_LAST, "gated"), ()),
}


def _xarray(of: Callable[[str], Any], one: Estimates, front: tuple[str, ...], coords: dict[str, Any]) -> Any:
    xarray = wanted("xarray")
    names, measures = list(one.state), list(one.measures)
    coords |= {"state": names, "state2": names, "measure": measures, "measure2": measures}
    data = {name: ((*front, *dims), of(name)) for name, dims in _DIMS.items()}
    return xarray.Dataset(data, coords, {"method": one.method, "smoothed": int(one.is_smoothed)})


def to_xarray(one: Estimates) -> Any:
    """See `Estimates.to_xarray`."""
    return _xarray(lambda name: getattr(one, name), one, ("time",), {"time": np.asarray(one.time)})


def batch_to_xarray(batch: Batch) -> Any:
    """See `Batch.to_xarray`."""
    xarray = wanted("xarray")
    if not len(batch):
        return xarray.Dataset()
    longest = max(batch, key=len)
    alike = all(np.array_equal(one.time, longest.time[: len(one)]) for one in batch)
    runs = tuple(batch)
    coords: dict[str, Any] = {"track": batch.track_ids}
    coords["time"] = np.asarray(longest.time) if alike else (("track", "row"), padded([one.time for one in runs]))
    front = ("track", "time" if alike else "row")
    found = _xarray(lambda name: padded([getattr(one, name) for one in runs]), longest, front, coords)
    return found.assign(rows=("track", [len(one) for one in runs]))

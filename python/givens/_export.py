"""Estimates as tables of other libraries."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from givens._lazy import wanted

if TYPE_CHECKING:
    from givens.batch import Batch
    from givens.estimates import Estimates

__all__ = ["batch_to_pandas", "batch_to_polars", "to_pandas", "to_polars", "to_xarray"]


def _columns(one: Estimates) -> dict[str, Any]:
    """The columns of the command's CSV."""
    columns: dict[str, Any] = {"time": np.asarray(one.time)}
    columns |= {name: one.mean[:, i] for i, name in enumerate(one.state)}
    columns |= {f"{name}_std": one.std[:, i] for i, name in enumerate(one.state)}
    return columns | {"nis": one.nis, "nis_dof": one.nis_dof, "log_likelihood": one.log_likelihood}


def to_pandas(one: Estimates) -> Any:
    """See `Estimates.to_pandas`."""
    return wanted("pandas").DataFrame(_columns(one)).set_index("time")


def to_polars(one: Estimates) -> Any:
    """See `Estimates.to_polars`."""
    return wanted("polars").DataFrame(_columns(one))


def batch_to_pandas(batch: Batch) -> Any:
    """See `Batch.to_pandas`."""
    pandas = wanted("pandas")
    frames = [to_pandas(one).assign(track_id=name) for name, one in zip(batch.track_ids, batch, strict=True)]
    return pandas.concat(frames).set_index("track_id", append=True).swaplevel() if frames else pandas.DataFrame()


def batch_to_polars(batch: Batch) -> Any:
    """See `Batch.to_polars`."""
    polars = wanted("polars")
    names = zip(batch.track_ids, batch, strict=True)
    frames = [to_polars(one).select(polars.lit(name).alias("track_id"), polars.all()) for name, one in names]
    return polars.concat(frames) if frames else polars.DataFrame()


def to_xarray(one: Estimates) -> Any:
    """See `Estimates.to_xarray`."""
    xarray = wanted("xarray")
    state, measure = ("time", "state"), ("time", "measure")
    dims: dict[str, tuple[str, ...]] = {"mean": state, "std": state, "filtered_mean": state, "predicted_mean": state}
    dims |= dict.fromkeys(("cov", "filtered_cov", "predicted_cov"), (*state, "state2"))
    dims |= {"innovation": measure, "innovation_cov": (*measure, "measure2")}
    dims |= dict.fromkeys(("nis", "nis_dof", "log_likelihood"), ("time",))
    names, measures = list(one.state), list(one.measures)
    coords = {"time": np.asarray(one.time), "state": names, "state2": names, "measure": measures, "measure2": measures}
    data = {name: (of, getattr(one, name)) for name, of in dims.items()}
    return xarray.Dataset(data, coords, {"method": one.method, "smoothed": int(one.is_smoothed)})

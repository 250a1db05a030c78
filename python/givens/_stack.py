"""Arrays of several tracks as one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from givens._arrays import Array
from givens.errors import InputError

if TYPE_CHECKING:
    from givens.estimates import Estimates

__all__ = ["Stacked", "is_ragged", "padded"]


def is_ragged(runs: Sequence[Estimates]) -> bool:
    """Whether some tracks have more rows than others, failures apart."""
    return len({one.__dict__["_rows"] for one in runs}) > 1


def stacked(runs: Sequence[Estimates], name: str) -> Any:
    """The arrays of this name of all tracks, one behind the other; rows that one has not reached are NaN."""
    if is_ragged(runs):
        lengths = [one.__dict__["_rows"] for one in runs]
        raise InputError(
            f"the tracks have {min(lengths)} to {max(lengths)} rows: `{name}` cannot be one array",
            argument=name,
            remedy=f"take them one by one: [est.{name} for est in batch]",
        )
    found = padded([getattr(one, name) for one in runs])
    found.setflags(write=False)
    return found


def padded(arrays: Sequence[np.ndarray[Any, Any]], axis: int = 0) -> np.ndarray[Any, Any]:
    """One behind the other, all of them as long as the longest along `axis`: behind the others stands NaN."""
    rows = max((array.shape[axis] for array in arrays), default=0)
    return np.stack([_padded(array, rows, axis) for array in arrays]) if len(arrays) else np.empty((0, 0))


def _padded(array: np.ndarray[Any, Any], rows: int, axis: int) -> np.ndarray[Any, Any]:
    """With rows behind those that a track has reached."""
    if array.shape[axis] == rows:
        return array
    shape = list(array.shape)
    shape[axis] = rows - shape[axis]
    kind = array.dtype.kind
    nothing: Any = np.array("NaT", array.dtype) if kind == "M" else 0 if kind in "ib" else np.nan
    return np.concatenate([array, np.full(shape, nothing, array.dtype)], axis=axis)


class Stacked:
    """The arrays of `Estimates`, of several tracks at once."""

    _estimates: tuple[Estimates, ...]

    def _all(self, name: str) -> Any:
        return stacked(self._estimates, name)

    def _stacked(self, name: str) -> Array:
        found: Array = self._all(name)
        return found

    def _named(self, name: str) -> tuple[str, ...]:
        found: tuple[str, ...] = getattr(self._estimates[0], name) if self._estimates else ()
        return found

    @property
    def state(self) -> tuple[str, ...]:
        """Names of the states."""
        return self._named("state")

    @property
    def measures(self) -> tuple[str, ...]:
        """Names of the measures."""
        return self._named("measures")

    @property
    def time(self) -> np.ndarray[Any, Any]:
        """Times as given, shape (runs, rows)."""
        found: np.ndarray[Any, Any] = self._all("time")
        return found

    @property
    def mean(self) -> Array:
        """Means, shape (runs, rows, n)."""
        return self._stacked("mean")

    @property
    def cov(self) -> Array:
        """Covariances, shape (runs, rows, n, n)."""
        return self._stacked("cov")

    @property
    def factor(self) -> Array:
        """Lower triangular roots of `cov`."""
        return self._stacked("factor")

    @property
    def std(self) -> Array:
        """Standard deviations, shape (runs, rows, n)."""
        return self._stacked("std")

    @property
    def filtered_mean(self) -> Array:
        """Given the measurements up to the row."""
        return self._stacked("filtered_mean")

    @property
    def filtered_cov(self) -> Array:
        """Covariances of `filtered_mean`."""
        return self._stacked("filtered_cov")

    @property
    def predicted_mean(self) -> Array:
        """Given the measurements before the row."""
        return self._stacked("predicted_mean")

    @property
    def predicted_cov(self) -> Array:
        """Covariances of `predicted_mean`."""
        return self._stacked("predicted_cov")

    @property
    def innovation(self) -> Array:
        """Measurement less prediction, shape (runs, rows, d)."""
        return self._stacked("innovation")

    @property
    def innovation_cov(self) -> Array:
        """Covariances of `innovation`, shape (runs, rows, d, d)."""
        return self._stacked("innovation_cov")

    @property
    def nis(self) -> Array:
        """Innovations squared and divided by their covariance, shape (runs, rows)."""
        return self._stacked("nis")

    @property
    def nis_dof(self) -> npt.NDArray[np.int64]:
        """Measures that were there, shape (runs, rows)."""
        found: npt.NDArray[np.int64] = self._all("nis_dof")
        return found

    @property
    def log_likelihood(self) -> Array:
        """Of each row's own measurement, shape (runs, rows)."""
        return self._stacked("log_likelihood")

    @property
    def gated(self) -> npt.NDArray[np.bool_]:
        """Rows beyond the gate, which were not taken in, shape (runs, rows)."""
        found: npt.NDArray[np.bool_] = self._all("gated")
        return found

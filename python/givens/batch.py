"""The estimates of several trajectories."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, overload

import numpy as np

from givens._arrays import Array
from givens.consistency import Consistency, consistency_of
from givens.errors import InputError, StepError
from givens.estimates import Estimates

__all__ = ["Batch"]


class Batch(Sequence[Estimates]):
    """The estimates of several trajectories, in the order of the data.

    Attributes
    ----------
    failed : list of StepError
        Those that ended early; each names its track.
    track_ids : list
        Names of the tracks, or their numbers.

    Examples
    --------
    >>> import givens as gv
    >>> import numpy as np
    >>> model = gv.Transition(lambda t, dt, x: x, noise_cov=[[0.1]], state=["x"])
    >>> sensor = gv.Sensor(lambda t, x: x, measures=["x"], std=[1.0])
    >>> z = np.zeros((5, 3, 1))
    >>> batch = gv.filter(model, sensor, [0, 1, 2], z, prior=gv.Gaussian([0], std=[1]))
    >>> batch
    Batch(5 tracks, 15 rows, 0 failed)
    >>> batch.mean.shape
    (5, 3, 1)
    """

    def __init__(self, estimates: Sequence[Estimates], failed: Sequence[StepError] = ()) -> None:
        self._estimates = tuple(estimates)
        self.failed = list(failed)
        self.track_ids = [k if one.track_id is None else one.track_id for k, one in enumerate(self._estimates)]

    @overload
    def __getitem__(self, index: int) -> Estimates: ...
    @overload
    def __getitem__(self, index: slice) -> Batch: ...
    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            chosen = self._estimates[index]
            return Batch(chosen, [one.failed for one in chosen if one.failed is not None])
        return self._estimates[index]

    def __len__(self) -> int:
        return len(self._estimates)

    def __iter__(self) -> Iterator[Estimates]:
        return iter(self._estimates)

    def track(self, name: Any) -> Estimates:
        """The estimates of a track by its name."""
        if name not in self.track_ids:
            raise InputError(f"there is no track {name!r}", argument="name", remedy=f"there are {self.track_ids[:10]}")
        return self._estimates[self.track_ids.index(name)]

    def _stacked(self, name: str) -> Array:
        lengths = {one.__dict__["_rows"] for one in self._estimates}
        if len(lengths) > 1:
            raise InputError(
                f"the tracks have {min(lengths)} to {max(lengths)} rows: `{name}` cannot be one array",
                argument=name,
                remedy=f"take them one by one: [est.{name} for est in batch]",
            )
        rows = max((len(one) for one in self._estimates), default=0)
        arrays = [np.asarray(getattr(one, name)) for one in self._estimates]
        # a track that failed has fewer rows
        return np.stack([_padded(array, rows) for array in arrays]) if arrays else np.empty((0, 0))

    @property
    def mean(self) -> Array:
        """Means, shape (runs, rows, n); NaN behind the failure of a track."""
        return self._stacked("mean")

    @property
    def cov(self) -> Array:
        """Covariances, shape (runs, rows, n, n)."""
        return self._stacked("cov")

    @property
    def std(self) -> Array:
        """Standard deviations, shape (runs, rows, n)."""
        return self._stacked("std")

    @property
    def nis(self) -> Array:
        """Shape (runs, rows)."""
        return self._stacked("nis")

    @property
    def log_likelihood(self) -> Array:
        """Shape (runs, rows)."""
        return self._stacked("log_likelihood")

    @property
    def total_log_likelihood(self) -> Array:
        """Of each track, shape (runs,)."""
        return np.array([one.total_log_likelihood for one in self._estimates])

    def consistency(self) -> Consistency:
        """Of all tracks together."""
        return consistency_of(self._estimates)

    def to_pandas(self) -> Any:
        """One table, with the column ``track_id``."""
        from givens._export import batch_to_pandas

        return batch_to_pandas(self)

    def to_polars(self) -> Any:
        """One table, with the column ``track_id``."""
        from givens._export import batch_to_polars

        return batch_to_polars(self)

    def __repr__(self) -> str:
        rows = sum(map(len, self._estimates))
        return f"Batch({len(self)} tracks, {rows} rows, {len(self.failed)} failed)"


def _padded(array: Array, rows: int) -> Array:
    if len(array) == rows:
        return array
    padded = np.full((rows, *array.shape[1:]), np.nan)
    padded[: len(array)] = array
    return padded

"""The estimates of several trajectories."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Self, overload

import numpy as np
import numpy.typing as npt

from givens import _native
from givens._arrays import Array
from givens._by_track import near_track
from givens._doubts import doubtful, warn
from givens._in_track import tell, told_by_number
from givens._memory import room
from givens._plan import Goal, Track, refuse_at
from givens._sampling import PIECES, bytes_of, draws
from givens._scalars import seed_of, shown, threads_of, whole
from givens._stack import Stacked, is_ragged, padded
from givens.consistency import Consistency, consistency_of
from givens.errors import InputError, StepError
from givens.estimates import Estimates, step_error

__all__ = ["Batch"]


class Batch(Stacked):
    """The estimates of several trajectories, in the order of the data: a sequence of `Estimates`.

    The arrays of all tracks are those of `Estimates` with one dimension more in front, and cannot be written to; behind
    the failure of a track they are NaN, and `nis_dof` and `gated` are 0. Tracks with different numbers of rows have
    none.

    Attributes
    ----------
    time : ndarray, shape (runs, rows)
        As given; NaN, or NaT, behind the failure of a track.
    mean, filtered_mean, predicted_mean, std : ndarray, shape (runs, rows, n)
    cov, factor, filtered_cov, predicted_cov : ndarray, shape (runs, rows, n, n)
    innovation, innovation_cov : ndarray, shapes (runs, rows, d) and (runs, rows, d, d)
    nis, nis_dof, log_likelihood, gated : ndarray, shape (runs, rows)
    total_log_likelihood : ndarray, shape (runs,)
        Of each track.
    state, measures : tuple of str
        Names.
    failed : list of StepError
        Those that ended early; each names its track.
    doubts : tuple of str
        Why rows may be wrong that no step has refused, the grave ones also told as a `DoubtWarning`. Of all tracks,
        once for each reason; a part of a batch has none.
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

    # no `collections.abc.Sequence`: polars would take one apart before it asks for `__arrow_c_stream__`

    def __init__(
        self, estimates: Sequence[Estimates], failed: Sequence[StepError] = (), doubts: Sequence[str] = ()
    ) -> None:
        self._estimates = tuple(estimates)
        self.failed = list(failed)
        self.doubts = tuple(doubts)
        self.track_ids = [k if one.track_id is None else one.track_id for k, one in enumerate(self._estimates)]

    @classmethod
    def _run(cls, tracks: Sequence[Track], goals: Sequence[Goal], at: Any, threads: int | None) -> Self:
        """Runs the tracks, each after its goal."""
        if at is not None:
            for goal in goals:
                refuse_at(goal)
        times = [None if at is None else track.clock.wanted("at", at) for track in tracks]
        found: list[Any] = [None] * len(tracks)
        doubts: list[tuple[str, bool]] = []
        alike: dict[Goal, list[int]] = {}
        for k, goal in enumerate(goals):
            alike.setdefault(goal, []).append(k)
        jobs = [
            track.arguments(None if wanted is None else wanted.seconds)
            for track, wanted in zip(tracks, times, strict=True)
        ]
        for goal, these in alike.items():
            try:
                natives, doubtfuls = _native.run_batch([jobs[k] for k in these], goal.word, goal.value, threads)
            except InputError as refusal:
                number = told_by_number(refusal)
                if number is not None:
                    k = these[number]
                    tell(refusal, k if tracks[k].id is None else tracks[k].id, tracks[k].rows, tracks[k].before)
                raise
            for k, native in zip(these, natives, strict=True):
                found[k] = native
            for doubt in doubtfuls:
                k = these[doubt[0]]
                name = k if tracks[k].id is None else tracks[k].id
                doubts.append((doubtful(tracks[k], doubt, name), doubt[-1]))
        estimates, failed = [], []
        for k, (track, native, goal, wanted) in enumerate(zip(tracks, found, goals, times, strict=True)):
            error = step_error(track, native, goal, k if track.id is None else track.id)
            if error is not None:
                failed.append(error)
            estimates.append(Estimates._of(track, native, goal, wanted, error))
        warn(doubts)
        return cls(estimates, failed, [words for words, _ in doubts])

    @overload
    def __getitem__(self, index: int) -> Estimates: ...
    @overload
    def __getitem__(self, index: slice) -> Batch: ...
    def __getitem__(self, index: Any) -> Any:
        if isinstance(index, slice):
            chosen = self._estimates[index]
            part = Batch(chosen, [one.failed for one in chosen if one.failed is not None])
            part.track_ids = self.track_ids[index]
            return part
        if isinstance(index, str):
            raise InputError(
                f"tracks are taken by their numbers, not by names such as {index!r}",
                argument="index",
                remedy=f"batch.track({index!r}) takes names",
            )
        try:
            return self._estimates[index]
        except IndexError:
            count = "there is one track" if len(self) == 1 else f"there are {len(self)} tracks"
            raise IndexError(f"there is no track number {index}: {count}, numbered from 0") from None

    def __len__(self) -> int:
        return len(self._estimates)

    def __iter__(self) -> Iterator[Estimates]:
        return iter(self._estimates)

    def track(self, name: Any) -> Estimates:
        """The estimates of a track by its name."""
        try:
            return self._estimates[self.track_ids.index(name)]
        except ValueError:
            raise InputError(
                f"there is no track {shown(name)}", argument="name", remedy=near_track(name, self.track_ids)
            ) from None

    @property
    def total_log_likelihood(self) -> Array:
        """Of each track, shape (runs,)."""
        return np.array([one.total_log_likelihood for one in self._estimates])

    def at(self, times: Any, *, threads: int | None = None) -> Batch:
        """The estimates of all tracks at other times, in order, as `Estimates.at` gives those of one.

        Parameters
        ----------
        times : array_like
            From the latest prior on; dates if the data has dates.
        threads : int, optional
            As for `givens.filter`.
        """
        again = [one._run_again() for one in self._estimates]
        there = Batch._run([track for track, _ in again], [goal for _, goal in again], times, threads_of(threads))
        there.track_ids = list(self.track_ids)
        return there

    def sample(self, n: int, *, seed: int) -> Array | list[Array]:
        """Draws states from the estimates of each track, as `Estimates.sample` does from one; tracks draw differently.

        Parameters
        ----------
        n : int
            How many of each track.
        seed : int
            From 0 up. Equal seeds give equal draws, however many there are.

        Returns
        -------
        ndarray, shape (runs, n, rows, states), or list of ndarray
            Rows behind the failure of a track are NaN. Of tracks with different numbers of rows a list, with an array
            of shape (n, rows, states) for each.

        Raises
        ------
        InputError
            For more draws than there is memory for.
        """
        n, seed = whole("n", n), seed_of(seed)
        ragged = is_ragged(self._estimates)
        # those of all tracks stand beside those of each, until they are one array
        room("n", n, (1 if ragged else 2) * sum(map(bytes_of, self._estimates)), PIECES)
        drawn = [draws(one, n, seed, k) for k, one in enumerate(self._estimates)]
        return drawn if ragged else padded(drawn, axis=1)

    def consistency(self) -> Consistency:
        """Of all tracks together."""
        return consistency_of(self._estimates)

    def to_dict(self) -> dict[str, Any]:
        """The arrays of all tracks by name."""
        names = self._estimates[0].to_dict() if self._estimates else ()
        return {name: getattr(self, name) for name in names}

    def to_pandas(self) -> Any:
        """One table, with the column ``track_id``."""
        from givens._export import batch_to_pandas

        return batch_to_pandas(self)

    def to_polars(self) -> Any:
        """One table, with the column ``track_id``; what is not known is null."""
        from givens._export import to_polars

        return to_polars(self)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """The table of `to_polars` for whatever reads Arrow: ``pyarrow.table(batch)``, a query of duckdb."""
        from givens._capsules import batch_stream

        return batch_stream(self)

    def to_xarray(self) -> Any:
        """A data set with the dimensions track, time, state, state2, measure, measure2.

        Where tracks have different times there is the dimension row in place of time, and `time` has track and row.
        Behind the last row of a shorter track stands NaN, NaT, or 0 in `nis_dof` and `gated`; `rows` says how many each
        track has.
        """
        from givens._export import batch_to_xarray

        return batch_to_xarray(self)

    def plot(self, *, plane: tuple[str, str] | None = None, truth: npt.ArrayLike | None = None) -> Any:
        """Draws the means of the tracks, at most fifty of them, and NIS of all; with `plane`, the tracks in it as well.

        Parameters
        ----------
        plane : (str, str), optional
            Two states that are coordinates of a plane.
        truth : array_like, shape (runs, rows, n), optional
            True states, drawn beside the estimates.
        """
        from givens._plot_batch import plot

        return plot(self, plane, truth)

    def __copy__(self) -> Batch:
        return self[:]

    def __deepcopy__(self, memo: Any) -> Batch:
        # estimates cannot change, and a failure belongs to its estimates
        return self[:]

    def __repr__(self) -> str:
        rows = sum(map(len, self._estimates))
        return f"Batch({len(self)} tracks, {rows} rows, {len(self.failed)} failed)"

    def _repr_html_(self) -> str:
        from givens._html import batch_html

        return batch_html(self)

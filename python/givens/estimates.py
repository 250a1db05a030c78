"""What a run has learnt, row by row."""

from __future__ import annotations

from typing import Any, Self

import numpy as np
import numpy.typing as npt

from givens import _native
from givens._arrays import Array, frozen
from givens._clock import Times
from givens._doubts import doubtful, place_of
from givens._plan import Goal, Track, refuse_at
from givens._sampling import draws
from givens._scalars import seed_of, whole
from givens.consistency import Consistency, Scored, consistency_of
from givens.errors import InputError, StepError

__all__ = ["Estimates", "step_error"]

_ROWS = ("mean", "cov", "factor", "predicted_mean", "predicted_cov", "filtered_mean", "filtered_cov")
_MEASURED = ("innovation", "innovation_cov", "nis")


class Estimates:
    """The estimates of one trajectory: one row for each row of the data.

    The arrays cannot be written to. n states, d measures of all sensors together.

    Attributes
    ----------
    time : ndarray, shape (rows,)
        As given: numbers, or dates, which are in UTC if they had a time zone.
    seconds : ndarray, shape (rows,)
        The same as numbers; of dates, since `t0` or the first row.
    mean, cov : ndarray, shapes (rows, n) and (rows, n, n)
        The estimates: filtered ones of `filter`, smoothed ones of `smooth`.
    factor : ndarray, shape (rows, n, n)
        Lower triangular roots of `cov`, with diagonals from zero up.
    std : ndarray, shape (rows, n)
        Standard deviations.
    filtered_mean, filtered_cov : ndarray
        Given the measurements up to the row.
    predicted_mean, predicted_cov : ndarray
        Given the measurements before the row.
    innovation, innovation_cov : ndarray, shapes (rows, d) and (rows, d, d)
        Measurement less prediction, and its covariance; NaN where a component was missing.
    nis : ndarray, shape (rows,)
        Innovations squared and divided by their covariance; NaN where nothing was measured.
    nis_dof : ndarray of int, shape (rows,)
        Measures that were there.
    log_likelihood : ndarray, shape (rows,)
        Of each row's own measurement, given those before; 0 where nothing was measured, or taken in.
    gated : ndarray of bool, shape (rows,)
        Rows beyond the `gate`, which were not taken in; `innovation` and `nis` are those that were seen.
    state, measures : tuple of str
        Names.
    method : str
        The method, by its name in the registry.
    is_smoothed : bool
        Whether `mean` and `cov` are smoothed ones.
    failed : StepError or None
        Why the rows end before those of the data.
    doubts : tuple of str
        Why rows may be wrong that no step has refused, the grave ones also told as a `DoubtWarning`; those of a batch
        are in `Batch.doubts`.

    Examples
    --------
    >>> import givens as gv
    >>> model = gv.Transition(lambda t, dt, x: x, noise_cov=[[0.1]], state=["x"])
    >>> sensor = gv.Sensor(lambda t, x: x, measures=["x"], std=[1.0])
    >>> est = gv.filter(model, sensor, [0, 1, 2], [[0.1], [0.3], [0.2]], prior=gv.Gaussian([0], std=[1]))
    >>> est
    Estimates(3 rows, state=[x], method=sr-ckf, log-likelihood -3.5558)
    >>> est.std.shape
    (3, 1)
    """

    time: np.ndarray[Any, Any]
    seconds: Array
    mean: Array
    cov: Array
    factor: Array
    filtered_mean: Array
    filtered_cov: Array
    predicted_mean: Array
    predicted_cov: Array
    innovation: Array
    innovation_cov: Array
    nis: Array
    nis_dof: npt.NDArray[np.int64]
    log_likelihood: Array
    gated: npt.NDArray[np.bool_]
    state: tuple[str, ...]
    measures: tuple[str, ...]
    method: str
    is_smoothed: bool
    failed: StepError | None
    doubts: tuple[str, ...]
    track_id: Any

    def __init__(self) -> None:
        raise TypeError("Estimates come from givens.filter and givens.smooth")

    @classmethod
    def _of(
        cls,
        track: Track,
        native: _native.Estimates,
        goal: Goal,
        at: Times | None = None,
        failed: StepError | None = None,
    ) -> Estimates:
        found = native.at if at is not None and native.at is not None else native
        self = object.__new__(cls)
        before = track.before if at is None and goal.word != "point" else 0
        fields: dict[str, Any] = {name: _after(before, getattr(found, name)) for name in (*_ROWS, *_MEASURED)}
        fields["log_likelihood"] = _after(before, found.log_likelihood, 0.0)
        fields["nis_dof"] = _after(before, found.nis_dof, 0)
        fields["gated"] = _after(before, found.gated, False)
        seconds = frozen(np.concatenate([track.time[:before], found.time])) if before else found.time
        fields |= {
            "seconds": seconds,
            "time": (at or track.times).of(seconds, track.clock),
            "is_smoothed": found.smoothed,
        }
        fields |= {"state": track.joined.states, "measures": track.joined.measures, "method": track.choice.title}
        fields["doubts"] = tuple(doubtful(track, doubt) for doubt in native.doubts)
        fields |= {"failed": failed, "track_id": track.id, "_track": track, "_goal": goal}
        # other times have no measurements: what is said of all of them is said of the rows
        rows = found if at is None else native
        fields["_total"] = native.total_log_likelihood
        fields["_scored"] = Scored.of(rows)
        fields["_gate"] = track.choice.gate
        fields["_rows"] = goal.rows(track.time) if at is None else len(at.seconds)
        fields["_aware"] = bool(track.clock.aware)
        fields["_whole"] = goal.word == "interval" and at is None and failed is None
        self.__dict__.update(fields)
        return self

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("Estimates cannot be changed")

    def __delattr__(self, name: str) -> None:
        raise AttributeError("Estimates cannot be changed")

    def __len__(self) -> int:
        return len(self.seconds)

    @property
    def std(self) -> Array:
        """Standard deviations of the states, shape (rows, n)."""
        return frozen(np.sqrt(np.maximum(np.diagonal(self.cov, axis1=1, axis2=2), 0.0)))

    @property
    def total_log_likelihood(self) -> float:
        """The log-likelihood of all measurements together, also of those at whose times no estimate was asked for."""
        total: float = self.__dict__["_total"]
        return total

    def __copy__(self) -> Self:
        return self

    def __deepcopy__(self, memo: Any) -> Self:
        # nothing of it can change
        return self

    def __getstate__(self) -> dict[str, Any]:
        # a native model cannot travel: what comes back has all numbers but cannot run again
        return {**self.__dict__, "_track": None}

    def __setstate__(self, fields: dict[str, Any]) -> None:
        for value in fields.values():
            if isinstance(value, np.ndarray):
                value.setflags(write=False)
        self.__dict__.update(fields)

    def at(self, times: Any) -> Estimates:
        """The estimates at other times, in order: predictions between the rows, or smoothed states.

        The run is done again; the other estimates do not change by being asked.

        Parameters
        ----------
        times : array_like
            From the time of the prior on; dates if the data has dates.
        """
        track, goal = self._run_again()
        refuse_at(goal)
        wanted = track.clock.wanted("at", times)
        native = track.run(goal.word, goal.value, wanted.seconds)
        error = step_error(track, native, goal)
        if error is not None:
            raise error
        return Estimates._of(track, native, goal, wanted)

    def _run_again(self) -> tuple[Track, Goal]:
        """What it was run from, and after what."""
        track: Track | None = self.__dict__["_track"]
        if track is None:
            raise InputError(
                "these estimates come from a pickle and cannot run again",
                argument="at",
                remedy="ask before they are pickled, or give at=… to givens.filter",
            )
        return track, self.__dict__["_goal"]

    def sample(self, n: int, *, seed: int) -> Array:
        """Draws states from the estimates.

        Of `givens.smooth` over all rows: whole trajectories, drawn from the joint distribution of all states given all
        measurements, each of which could be the true one. Of a filter, of a lag or a point, and of other times: each
        row by itself.

        Parameters
        ----------
        n : int
            How many.
        seed : int
            From 0 up. Equal seeds give equal draws, however many there are.

        Returns
        -------
        ndarray, shape (n, rows, states)
        """
        return draws(self, whole("n", n), seed_of(seed))

    def consistency(self) -> Consistency:
        """Whether the innovations are as large as the filter says, and unrelated to each other; without gated rows."""
        return consistency_of([self])

    def to_dict(self) -> dict[str, Any]:
        """All arrays by name."""
        names = ("time", *_ROWS, "std", *_MEASURED, "nis_dof", "log_likelihood", "gated")
        return {name: getattr(self, name) for name in names}

    def to_pandas(self) -> Any:
        """A table with the columns of the command's CSV, indexed by time."""
        from givens._export import to_pandas

        return to_pandas(self)

    def to_polars(self) -> Any:
        """A table with the columns of the command's CSV; what is not known is null."""
        from givens._export import to_polars

        return to_polars(self)

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """The table of `to_polars` for whatever reads Arrow: ``pyarrow.table(est)``, a query of duckdb."""
        from givens._capsules import stream

        return stream(self)

    def to_xarray(self) -> Any:
        """A data set with the dimensions time, state, state2, measure, measure2."""
        from givens._export import to_xarray

        return to_xarray(self)

    def plot(self, *, plane: tuple[str, str] | None = None, truth: npt.ArrayLike | None = None) -> Any:
        """Draws the states with bands of two standard deviations, and NIS; with `plane`, the track as well.

        Parameters
        ----------
        plane : (str, str), optional
            Two states that are coordinates of a plane.
        truth : array_like, shape (rows, n), optional
            True states, drawn beside the estimates.
        """
        from givens._plot import plot

        return plot(self, plane, truth)

    def __repr__(self) -> str:
        word = ", smoothed" if self.is_smoothed else ""
        beyond = f", {gated} beyond the gate" if (gated := int(np.count_nonzero(self.gated))) else ""
        end = f", failed at row {self.failed.row}" if self.failed is not None else ""
        return (
            f"Estimates({len(self)} rows, state=[{', '.join(self.state)}], method={self.method}{word}, "
            f"log-likelihood {self.total_log_likelihood:.4f}{beyond}{end})"
        )

    def _repr_html_(self) -> str:
        from givens._html import estimates_html

        return estimates_html(self)


def _after(before: int, array: Any, fill: float = np.nan) -> Any:
    """With rows in front for which there is no answer."""
    if before == 0:
        return array
    front = np.full((before, *array.shape[1:]), fill, dtype=array.dtype)
    joined = np.concatenate([front, array])
    joined.setflags(write=False)
    return joined


def step_error(track: Track, native: _native.Estimates, goal: Goal, name: Any = None) -> StepError | None:
    """Why a run ended, as an exception that holds the rows before."""
    failure = native.failure
    if failure is None:
        return None
    fields: dict[str, Any] = dict(failure)
    message, row = fields.pop("message"), fields["row"]
    if row is not None:
        row = fields["row"] = row + track.before
    place = place_of(track, row, fields["time"], name)
    error = StepError(f"{place}: {message}", track=name, **fields)
    error.finished = Estimates._of(track, native, goal, None, error)
    return error

"""Filters and smoothers over whole trajectories."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from givens._doubts import warn
from givens._plan import Goal, Track, plan, refuse_at
from givens._scalars import shown, threads_of
from givens.batch import Batch
from givens.errors import InputError
from givens.estimates import Estimates, step_error
from givens.gaussian import Gaussian

__all__ = ["filter", "smooth"]


# A batch gives a `Batch`, which no type of the arguments tells: with `Estimates | Any` a checker knows the attributes
# of one trajectory without being asked, and those of several after isinstance(found, Batch).


def filter(
    model: Any,
    sensors: Any,
    t: Any,
    z: Any = None,
    *,
    prior: Gaussian | Sequence[Gaussian] | Mapping[Any, Gaussian] | None = None,
    method: str | None = None,
    t0: Any = None,
    u: Any = None,
    at: Any = None,
    noise: Any = None,
    params: Mapping[str, Any] | None = None,
    threads: int | None = None,
    **options: Any,
) -> Estimates | Any:
    """Estimates the state at each time from the measurements up to it.

    Parameters
    ----------
    model : Sde, Transition or ModelFile
        How the state moves.
    sensors : Sensor or list of Sensor
        What is measured; None for a model file, which has its own.
    t : array_like, shape (rows,)
        Times in order: numbers, durations, which are taken as seconds, or dates, of which seconds since `t0` are taken;
        dates have a time zone all of them, or none. Or a table in place of `t` and `z`: of pandas, polars, pyarrow,
        duckdb or whatever has ``__arrow_c_stream__``, or a dict of arrays, with the columns ``time`` (in pandas, the
        index may be it), one for each measure, and, if there are such, ``sensor``, ``track_id`` and ``u_…`` for
        controls. For a model file also the path of a CSV file.
    z : array_like, shape (rows, d)
        Measurements, those of several sensors side by side in their order; NaN and masked are missing. The columns of a
        frame are taken by the names of the measures. Or a table by sensor: ``{"radar": (rows, 3), …}``. A row without
        any asks for the prediction. Of a batch: shape
        (runs, rows, d), or a list with an array for each run, with `t` of shape (rows,) or a list as well.
    prior : Gaussian
        The belief at `t0`; of a batch also a list with one for each track, in the order of `Batch.track_ids`, or a
        table by their names: ``{"a": gv.Gaussian(…), "b": gv.Gaussian(…)}``.
    method : str, optional
        A name of `methods`; by default ``"sr-cd-ckf"`` or ``"sr-ckf"``.
    t0 : float or date, optional
        When the prior holds; by default at the first row, which is then updated without a prediction. Of a batch also
        one for each track, as a list or by their names; None is at its first row.
    u : array_like, shape (rows, c), or mapping, optional
        Controls, each holding from its row to the next; of a table that has no columns of them, one row for each of its
        rows.
    at : array_like, optional
        Times at which estimates are wanted, in place of those of the rows; asking changes no other number.
    noise : array_like or mapping, optional
        Standard deviations (rows, d) or covariances (rows, d, d) of the errors, row by row, in place of the sensor's
        own; of several sensors a table by name.
    params : mapping, optional
        Values of parameters by name; of a batch also arrays with one dimension more, one value for each track in the
        order of `Batch.track_ids`, or tables by their names: ``{"k": {"a": 1.0, "b": 2.0}}``.
    threads : int, optional
        Threads for a batch; by default as many as there are cores. Estimates do not depend on it.
    **options
        Parts and options of the method, as `methods` lists them: ``substeps=8``, ``rtol=1e-8``, ``form="covariance"``,
        ``precision="f32"``, ``gate=0.9999``.

    Returns
    -------
    Estimates
        One row for each row of the data; of a batch, a `Batch` of them.

    Raises
    ------
    InputError
        For arguments that cannot serve; nothing has been computed then.
    MethodError
        For a method or an option that does not exist or does not go with the model.
    StepError
        For a step that fails; its `finished` holds the rows before. In a batch, other tracks go on, and `Batch.failed`
        lists those that did not.

    Warns
    -----
    DoubtWarning
        Of answers that may be wrong though no step has failed; `Estimates.doubts` holds the words.

    Examples
    --------
    >>> import givens as gv
    >>> import numpy as np
    >>> model = gv.Sde(lambda t, x: [x[1], -x[0]], diffusion=[0.0, 0.1], state=["x", "v"])
    >>> ruler = gv.Sensor(lambda t, x: x[:1], measures=["length"], std=[0.1])
    >>> t = np.linspace(0, 3, 31)
    >>> est = gv.filter(model, ruler, t, np.cos(t)[:, None], prior=gv.Gaussian([1, 0], std=[1, 1]))
    >>> est.mean.shape
    (31, 2)
    >>> bool(abs(est.mean[-1, 0] - np.cos(3)) < 0.05)
    True
    """
    tracks, batch = plan(
        model, sensors, t, z, prior=prior, method=method, t0=t0, u=u, noise=noise, params=params, options=options
    )
    return _run(tracks, batch, [Goal("filter")] * len(tracks), at, threads)


def smooth(
    model: Any,
    sensors: Any,
    t: Any,
    z: Any = None,
    *,
    prior: Gaussian | Sequence[Gaussian] | Mapping[Any, Gaussian] | None = None,
    method: str | None = None,
    lag: int | None = None,
    point: Any = None,
    t0: Any = None,
    u: Any = None,
    at: Any = None,
    noise: Any = None,
    params: Mapping[str, Any] | None = None,
    threads: int | None = None,
    **options: Any,
) -> Estimates | Any:
    """Estimates the state at each time from all measurements.

    Parameters
    ----------
    model, sensors, t, z, prior, method, t0, u, at, noise, params, threads, **options
        As for `filter`.
    lag : int, optional
        Each row is estimated from itself and the next `lag` rows only.
    point : float or date, optional
        The state at this time, which is that of a row or of the prior, from each row on: one row for each from then on.

    Returns
    -------
    Estimates
        `mean` and `cov` are the smoothed ones, and `filtered_mean` and `filtered_cov` stand beside them. Of a batch, a
        `Batch`.

    Raises
    ------
    InputError, MethodError, StepError
        As `filter`.

    Examples
    --------
    >>> import givens as gv
    >>> import numpy as np
    >>> model = gv.Transition(lambda t, dt, x: x, noise_cov=lambda t, dt: [[0.1 * dt]], state=["x"])
    >>> sensor = gv.Sensor(lambda t, x: x, measures=["x"], std=[1.0])
    >>> est = gv.smooth(model, sensor, [0, 1, 2], [[0.0], [np.nan], [1.0]], prior=gv.Gaussian([0], std=[10]))
    >>> bool((est.std[:, 0] <= np.sqrt(est.filtered_cov[:, 0, 0])).all())
    True
    """
    if lag is not None and point is not None:
        raise InputError("`lag` and `point` at once", argument="lag", remedy="give one of them")
    tracks, batch = plan(
        model, sensors, t, z, prior=prior, method=method, t0=t0, u=u, noise=noise, params=params, options=options
    )
    goals = [Goal("interval")] * len(tracks)
    if lag is not None:
        if not isinstance(lag, (int, np.integer)) or isinstance(lag, bool) or lag < 0:
            raise InputError(
                f"`lag` is {shown(lag)}", argument="lag", remedy="a lag is a whole number of rows, from 0 up"
            )
        # longer than any data is as long as the data
        goals = [Goal("lag", float(min(lag, 2**53)))] * len(tracks)
    if point is not None:
        # a date is as many seconds as the clock of a track says, and each has its own
        goals = [Goal("point", track.clock.moment("point", point)) for track in tracks]
    return _run(tracks, batch, goals, at, threads)


def _run(tracks: list[Track], batch: bool, goals: list[Goal], at: Any, threads: int | None) -> Estimates | Batch:
    threads = threads_of(threads)
    if batch:
        return Batch._run(tracks, goals, at, threads)
    (track,), (goal,) = tracks, goals
    if at is not None:
        refuse_at(goal)
    wanted = None if at is None else track.clock.wanted("at", at)
    native = track.run(goal.word, goal.value, None if wanted is None else wanted.seconds)
    error = step_error(track, native, goal)
    if error is not None:
        raise error
    estimates = Estimates._of(track, native, goal, wanted)
    warn((words, doubt[-1]) for words, doubt in zip(estimates.doubts, native.doubts, strict=True))
    return estimates

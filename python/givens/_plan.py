"""From the arguments of a run to tracks, each with all that it needs."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from givens import _native
from givens._arrays import Array, shape_error
from givens._clock import Clock, clock_of
from givens._dynamics import Parametric
from givens._join import Joined, join, sensors_of
from givens._rows import controls_of, measured, noise_shapes, with_noise
from givens._tables import is_table, rows_by_track
from givens.errors import InputError
from givens.gaussian import Gaussian
from givens.model_file import ModelFile

__all__ = ["Track", "plan", "read_prior"]


@dataclass(frozen=True)
class Track:
    """One trajectory and the belief in which it begins."""

    joined: Joined
    choice: _native.Choice
    clock: Clock
    mean: Array
    cov: Array
    t0: float | None
    time: Array
    z: Array
    u: Array | None
    id: Any = None
    #: Rows before the belief holds, for which there is no answer.
    before: int = 0

    def run(self, word: Any, value: float | None, at: Array | None) -> _native.Estimates:
        """Runs it alone, after this goal."""
        model, choice, mean, cov, t0, time, z, u, _ = self.arguments()
        return _native.run(model, choice, mean, cov, t0, time, z, u, word, value, at)

    def arguments(self, at: Array | None = None) -> tuple[Any, ...]:
        """As the native half takes a track of a batch."""
        first = self.before
        u = None if self.u is None else self.u[first:]
        return (
            *(self.joined.native, self.choice, self.mean, self.cov),
            *(self.t0, self.time[first:], self.z[first:], u, at),
        )


@dataclass(frozen=True)
class _Given:
    """One track as it was given."""

    t: Any
    z: Any
    u: Any = None
    noise: Any = None
    prior: Any = None
    parameters: Mapping[str, Any] | None = None
    id: Any = None


def plan(
    model: Any,
    sensors: Any,
    t: Any,
    z: Any,
    *,
    prior: Any,
    method: str | None,
    t0: Any,
    u: Any,
    noise: Any,
    params: Mapping[str, Any] | None,
    options: Mapping[str, Any],
) -> tuple[list[Track], bool]:
    """The tracks to run, and whether they are a batch; everything is checked."""
    plain = join(model, sensors)
    choice = _choice(model, plain, method, options)
    if isinstance(t, (str, os.PathLike)):
        return _of_file(model, plain, choice, os.fspath(t), prior, t0)
    widths = {name: place.stop - place.start for name, place in plain.sensors.items()}
    if z is None and is_table(t):
        rows = rows_by_track(plain, t)
        given = [_Given(track["time"], track["z"], track["u"] if u is None else u, id=track["id"]) for track in rows]
        batch = len(given) > 1 or given[0].id is not None
        if noise is not None and batch:
            raise InputError(
                "`noise` cannot be given beside a table of tracks", argument="noise", remedy="run them one by one"
            )
        given = [replace(track, noise=noise) for track in given]
    elif z is None:
        raise InputError(
            "`z` is missing", argument="z", remedy="give times and measurements, or a table with named columns"
        )
    else:
        given, batch = _split(plain, t, z, u, noise)
    priors = _each("prior", prior, len(given), batch, Gaussian)
    values = _parameters(params, len(given))
    tracks: list[Track] = []
    for k, track in enumerate(given):
        joined = plain
        shapes = noise_shapes(track.noise, widths)
        if shapes or values:
            joined = join(*_with(model, sensors, values[k]) if values else (model, sensors), shapes)
        track = replace(track, prior=priors[k])
        try:
            tracks.append(_track(model, joined, choice, track, t0))
        except InputError as error:
            if batch:
                error.add_note(f"in track {k if track.id is None else track.id}")
            raise
    return tracks, batch


def _choice(model: Any, joined: Joined, method: str | None, options: Mapping[str, Any]) -> _native.Choice:
    if isinstance(model, ModelFile):
        named = method is not None and method != model.method
        options = {**({} if named else model.options), **options}
        method = method or model.method
    choice = _native.Choice(method, dict(options), joined.kind)
    choice.check(joined.native)
    return choice


def _split(joined: Joined, t: Any, z: Any, u: Any, noise: Any) -> tuple[list[_Given], bool]:
    """One track, or several: an array (runs, rows, d), or a list of arrays or tables."""
    if isinstance(z, Mapping):
        several = [np.ndim(value) for value in z.values()] == [3] * len(z) and len(z) > 0
        runs = len(next(iter(z.values()))) if several else 0
        each: list[Any] = [{name: value[k] for name, value in z.items()} for k in range(runs)]
    elif isinstance(z, (list, tuple)) and len(z) and (isinstance(z[0], Mapping) or np.ndim(z[0]) == 2):
        several, each = True, list(z)
    else:
        several = np.ndim(z) == 3 and np.shape(z)[2] == len(joined.measures)
        each = list(np.asarray(z)) if several else []
    if not several:
        return [_Given(t, z, u, noise)], False
    runs = len(each)
    ragged = isinstance(t, (list, tuple)) and len(t) == runs and runs > 0 and np.ndim(t[0]) == 1
    times = list(t) if ragged or np.ndim(t) == 2 else [t] * runs
    if len(times) != runs:
        raise InputError(
            f"`t` has times of {len(times)} tracks, `z` measurements of {runs}",
            argument="t",
            remedy="give one list for each",
        )
    controls = _by_run("u", u, runs, 2)
    noises = _noise_by_run(noise, runs)
    return [_Given(times[k], each[k], controls[k], noises[k]) for k in range(runs)], True


def _by_run(argument: str, given: Any, runs: int, own: int) -> list[Any]:
    """One for each run, or the same for all: `own` dimensions are those of one run."""
    if given is None or isinstance(given, Mapping):
        return [given] * runs
    several = (isinstance(given, (list, tuple)) and len(given) == runs and np.ndim(given[0]) == own) or (
        not isinstance(given, (list, tuple)) and np.ndim(given) == own + 1
    )
    if several and len(given) != runs:
        raise InputError(f"`{argument}` is for {len(given)} tracks, `z` for {runs}", argument=argument)
    return list(given) if several else [given] * runs


def _noise_by_run(noise: Any, runs: int) -> list[Any]:
    if noise is None:
        return [None] * runs
    table = noise if isinstance(noise, Mapping) else {None: noise}
    split = {name: list(value) if len(value) == runs else [value] * runs for name, value in table.items()}
    if None in split:
        return split[None]
    return [{name: values[k] for name, values in split.items()} for k in range(runs)]


def _each(argument: str, given: Any, runs: int, batch: bool, kind: type) -> list[Any]:
    if not isinstance(given, (list, tuple)):
        return [given] * runs
    if not batch or len(given) != runs or not all(isinstance(one, kind) for one in given):
        what = f"one for each of {runs} tracks" if batch else f"one {kind.__name__}"
        raise InputError(
            f"`{argument}` is a list of {len(given)}, not {what}",
            argument=argument,
            remedy="write gv.Gaussian(mean, cov)",
        )
    return list(given)


def _parameters(params: Mapping[str, Any] | None, runs: int) -> list[dict[str, Any]]:
    """The values of each track: numbers are for all, arrays hold one for each."""
    if not params:
        return []
    values: list[dict[str, Any]] = [{} for _ in range(runs)]
    for name, given in params.items():
        shape = np.shape(given)
        if shape and shape[0] != runs:
            raise InputError(
                f"`params`: `{name}` has {shape[0]} values for {runs} tracks",
                argument="params",
                component=name,
                remedy="give one number, or one for each track",
            )
        for k in range(runs):
            values[k][name] = given[k] if shape else given
    return values


def _with(model: Any, sensors: Any, values: Mapping[str, Any]) -> tuple[Any, Any]:
    """Model and sensors with these parameters, wherever one has one of that name."""
    if isinstance(model, ModelFile):
        return model.with_params(**values), sensors
    owners: list[Parametric] = [model, *sensors_of(sensors)]
    known = {name for owner in owners for name in owner.parameters}
    for name in values:
        if name not in known:
            from givens._names import known_name

            known_name("params", name, sorted(known), "parameter of the model or a sensor")
    new = [owner.with_params(**{n: v for n, v in values.items() if n in owner.parameters}) for owner in owners]
    return new[0], new[1:]


def _track(model: Any, joined: Joined, choice: _native.Choice, given: _Given, t0: Any) -> Track:
    clock = clock_of(given.t, t0)
    time = clock.seconds("t", given.t)
    if time.ndim != 1:
        raise shape_error("t", time.shape, "(rows,)", "times are a vector: t=np.ravel(…)")
    z = measured(joined, given.z, len(time))
    u = with_noise(joined, controls_of(joined, given.u, len(time)), given.noise, z)
    start = None if t0 is None else float(clock.seconds("t0", t0))
    if given.prior is None and isinstance(model, ModelFile) and t0 is None:
        return _begun(model, joined, choice, clock, time, z, u, given.id)
    mean, cov = read_prior(model, given.prior, joined.states)
    if start is None and isinstance(model, ModelFile):
        start = model.time
    return Track(joined, choice, clock, mean, cov, start, time, z, u, given.id)


def _begun(
    model: ModelFile,
    joined: Joined,
    choice: _native.Choice,
    clock: Clock,
    time: Array,
    z: Array,
    u: Array | None,
    id: Any,
) -> Track:
    """A track whose belief stands in the model file, or is found from its first rows."""
    t0, mean, cov, row, started = model.native.begin(time, z, u)
    if started:
        z = z.copy()
        z[row] = np.nan
    return Track(joined, choice, clock, mean, cov, t0, time, z, u, id, before=row)


def read_prior(model: Any, prior: Any, states: Sequence[str]) -> tuple[Array, Array]:
    """Mean and covariance of an initial belief."""
    if prior is None and isinstance(model, ModelFile):
        prior = model.prior
    if not isinstance(prior, Gaussian):
        said = "missing" if prior is None else f"{type(prior).__name__}, not a Gaussian"
        raise InputError(f"`prior` is {said}", argument="prior", remedy="write prior=gv.Gaussian(mean, cov)")
    if len(prior) != len(states):
        raise InputError(
            f"`prior` is a belief about {len(prior)} states, but the model has {len(states)}: {', '.join(states)}",
            argument="prior",
        )
    return prior.mean, prior.cov


def _of_file(
    model: Any, joined: Joined, choice: _native.Choice, path: str, prior: Any, t0: Any
) -> tuple[list[Track], bool]:
    if not isinstance(model, ModelFile):
        raise InputError(
            f"`t` is the path {path!r}, which only a model file can read",
            argument="t",
            remedy="read the table with pandas or polars and give that",
        )
    read = _native.read_tracks(model.native, path)
    tracks = []
    for one in read["tracks"]:
        clock = Clock() if one["origin"] is None else Clock(np.datetime64(one["origin"].removesuffix("Z"), "ns"))
        mean, cov, start, before, z = one["mean"], one["cov"], one["t0"], one["row"], one["z"]
        if prior is not None:
            (mean, cov), before = read_prior(model, prior, joined.states), 0
            start = start if t0 is None else float(clock.seconds("t0", t0))
        elif one["started"]:
            z = np.array(z)
            z[before] = np.nan
        u = one["u"] if joined.controls else None
        tracks.append(Track(joined, choice, clock, mean, cov, start, one["time"], z, u, one["id"], before))
    return tracks, read["has_track_id"]

"""From the arguments of a run to tracks, each with all that it needs."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from givens import _native
from givens._arrays import Array
from givens._by_track import starts
from givens._capsules import framed
from givens._clock import Clock, Times, clock_of
from givens._dynamics import Parametric
from givens._given import Given, each_of, parameters_by_run, split
from givens._in_track import in_track
from givens._join import Joined, join, sensors_of
from givens._method import choose
from givens._rows import controls_of, measured, noise_shapes, with_noise
from givens._scalars import mapping, text
from givens._steep import Derivatives
from givens._tables import is_table, rows_by_track
from givens._trace.arguments import parameter_value
from givens.errors import InputError
from givens.gaussian import Gaussian
from givens.model_file import ModelFile

__all__ = ["Goal", "Track", "plan", "read_prior", "refuse_at", "with_parameters"]


@dataclass(frozen=True)
class Goal:
    """What a run is after: filter, interval, lag or point."""

    word: Any
    value: float | None = None

    def rows(self, time: Array) -> int:
        """How many rows a run over these times has if it does not fail."""
        return len(time) if self.value is None or self.word != "point" else int(np.sum(time >= self.value))


def refuse_at(goal: Goal) -> None:
    """Other times are those of a filter, or of a smoother over all rows."""
    if goal.word in ("lag", "point"):
        raise InputError(
            f"`at` and `{goal.word}` at once",
            argument="at",
            remedy=f"leave `{goal.word}` out: a smoother over all rows, and a filter, give the states at other times",
        )


@dataclass(frozen=True)
class Track:
    """One trajectory and the belief in which it begins."""

    joined: Joined
    choice: _native.Choice
    clock: Clock
    mean: Array
    cov: Array
    t0: float | None
    times: Times
    z: Array
    u: Array | None
    id: Any = None
    #: Rows of the table that those of the track are.
    rows: Sequence[int] | None = None
    #: Rows before the belief holds, for which there is no answer.
    before: int = 0

    @property
    def time(self) -> Array:
        """The times of the rows in seconds."""
        return self.times.seconds

    def run(self, word: Any, value: float | None, at: Array | None) -> _native.Estimates:
        """Runs it alone, after this goal."""
        model, choice, mean, cov, t0, time, z, u, _ = self.arguments()
        return _native.run(model, choice, mean, cov, t0, time, z, u, word, value, at)

    def refuse_steep(self, derivatives: Derivatives) -> None:
        """Refuses a method whose derivatives are wrong where the track begins."""
        t = self.t0 if self.t0 is not None else float(self.time[0]) if len(self.time) else 0.0
        derivatives.refuse(self.joined, t, self.mean, self.u)

    def arguments(self, at: Array | None = None) -> tuple[Any, ...]:
        """As the native half takes a track of a batch."""
        first = self.before
        u = None if self.u is None else self.u[first:]
        return (
            *(self.joined.native, self.choice, self.mean, self.cov),
            *(self.t0, self.time[first:], self.z[first:], u, at),
        )


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
    t, z, u, noise = framed("t", t), framed("z", z), framed("u", u), framed("noise", noise)
    plain = join(model, sensors)
    choice = choose(model, plain, method, options)
    derivatives = Derivatives.of(plain, choice)
    if isinstance(t, (str, os.PathLike)):
        _refuse_beside_file(z=z, u=u, noise=noise, params=params or None, t0=t0 if prior is None else None)
        return _of_file(model, plain, choice, _path(t), prior, t0)
    widths = plain.widths
    if z is None and is_table(t):
        given = [
            Given(track["time"], track["z"], track["u"], id=track["id"], rows=track["rows"])
            for track in rows_by_track(plain, t, u)
        ]
        batch = not given or given[0].id is not None
        if noise is not None and batch:
            raise InputError(
                "`noise` cannot be given beside a table of tracks", argument="noise", remedy="run them one by one"
            )
        given = [replace(track, noise=noise) for track in given]
    elif z is None:
        raise InputError(
            "`z` is missing", argument="z", remedy="give times and measurements, or a table with named columns"
        )
    elif is_table(t):
        raise InputError(
            "`t` is a table, and `z` is given besides",
            argument="z",
            remedy="a table holds the measurements: leave `z` out, or give the column of times alone",
        )
    else:
        given, batch = split(plain, t, z, u, noise)
    names = [k if track.id is None else track.id for k, track in enumerate(given)]
    priors, begun = each_of("prior", prior, names, batch, Gaussian), starts(t0, names, batch)
    table = mapping("params", params, "params={name: value}")
    values = parameters_by_run(table, _shapes(model, sensors), names, batch)
    tracks: list[Track] = []
    for k, track in enumerate(given):
        with in_track(names[k], track.rows, batch):
            joined = plain
            shapes = noise_shapes(track.noise, widths)
            if shapes or values:
                joined = join(*with_parameters(model, sensors, values[k]) if values else (model, sensors), shapes)
            tracks.append(_track(model, joined, choice, replace(track, prior=priors[k]), begun[k]))
            tracks[-1].refuse_steep(derivatives)
    return tracks, batch


def _refuse_beside_file(**given: Any) -> None:
    """What the CSV file of a model file has in its columns, or the model in itself."""
    remedies = {"params": "write model.with_params(…).filter(path)", "t0": "give the prior that holds then as well"}
    for name, value in given.items():
        if value is not None:
            raise InputError(
                f"`{name}` cannot be given beside the path of a CSV file",
                argument=name,
                remedy=remedies.get(name, "read the table with pandas or polars and give that"),
            )


def _path(t: Any) -> str:
    return text("t", os.fspath(t), "a path", "give the path as text", "give the file a name that is UTF-8")


def _shapes(model: Any, sensors: Any) -> dict[str, tuple[int, ...]]:
    """The parameters of a model and its sensors, with their shapes."""
    owners = (model,) if isinstance(model, ModelFile) else (model, *sensors_of(sensors))
    return {name: np.shape(value) for owner in owners for name, value in owner.parameters.items()}


def with_parameters(model: Any, sensors: Any, values: Mapping[str, Any]) -> tuple[Any, Any]:
    """Model and sensors with these parameters, wherever one has one of that name."""
    if not values:
        return model, sensors
    for name, value in values.items():
        _finite(name, value)
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


def _finite(name: str, value: Any) -> None:
    array = parameter_value("params", name, value)
    if not np.isfinite(array).all():
        raise InputError(
            f"`params`: the parameter `{name}` is {array[~np.isfinite(array)][0]}",
            argument="params",
            component=name,
            remedy="give a finite number",
        )


def _track(model: Any, joined: Joined, choice: _native.Choice, given: Given, t0: Any) -> Track:
    clock = clock_of(given.t, t0)
    start = None if t0 is None else clock.moment("t0", t0)
    times = clock.times("t", given.t)
    rows = len(times.seconds)
    z = measured(joined, given.z, rows)
    u = with_noise(joined, controls_of(joined, given.u, rows), given.noise, z)
    if given.prior is None and isinstance(model, ModelFile) and t0 is None:
        return _begun(model, joined, choice, clock, times, z, u, given)
    mean, cov = read_prior(model, given.prior, joined.states)
    if start is None and isinstance(model, ModelFile):
        start = model.time
    return Track(joined, choice, clock, mean, cov, start, times, z, u, given.id, given.rows)


def _begun(
    model: ModelFile,
    joined: Joined,
    choice: _native.Choice,
    clock: Clock,
    times: Times,
    z: Array,
    u: Array | None,
    given: Given,
) -> Track:
    """A track whose belief stands in the model file, or is found from its first rows."""
    t0, mean, cov, row, started = model.native.begin(times.seconds, z, u)
    if started:
        z = z.copy()
        z[row] = np.nan
    return Track(joined, choice, clock, mean, cov, t0, times, z, u, given.id, given.rows, row)


def read_prior(model: Any, prior: Any, states: Sequence[str]) -> tuple[Array, Array]:
    """Mean and covariance of an initial belief."""
    if prior is None and isinstance(model, ModelFile):
        prior = model.prior
    if not isinstance(prior, Gaussian):
        said = "missing" if prior is None else f"{type(prior).__name__}, not a Gaussian"
        raise InputError(f"`prior` is {said}", argument="prior", remedy="write prior=gv.Gaussian(mean, cov)")
    if len(prior) != len(states):
        raise InputError(
            f"`prior` has {len(prior)} components, but the model has the states {', '.join(states)}",
            argument="prior",
            remedy="give one mean for each state, in their order",
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
    names = [one["id"] for one in read["tracks"]]
    priors = each_of("prior", prior, names, read["has_track_id"], Gaussian)
    begun = starts(t0, names, read["has_track_id"])
    for one, own, begins in zip(read["tracks"], priors, begun, strict=True):
        clock = Clock() if one["origin"] is None else Clock(np.datetime64(one["origin"].removesuffix("Z"), "ns"), None)
        times = Times(one["time"], clock.shown(one["time"]))
        mean, cov, start, before, z = one["mean"], one["cov"], one["t0"], one["row"], one["z"]
        if own is not None:
            (mean, cov), before = read_prior(model, own, joined.states), 0
            start = start if begins is None else clock.moment("t0", begins)
        elif one["started"]:
            z = np.array(z)
            z[before] = np.nan
        u = one["u"] if joined.controls else None
        tracks.append(Track(joined, choice, clock, mean, cov, start, times, z, u, one["id"], None, before))
    return tracks, read["has_track_id"]

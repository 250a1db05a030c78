"""Several trajectories, told from one and taken apart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from givens._arrays import dimensions, unmasked
from givens._by_track import by_track
from givens._frames import is_frame
from givens._join import Joined
from givens._names import known_name
from givens._scalars import shown
from givens.errors import InputError

__all__ = ["Given", "each_of", "parameters_by_run", "split"]


@dataclass(frozen=True)
class Given:
    """One track as it was given."""

    t: Any
    z: Any
    u: Any = None
    noise: Any = None
    prior: Any = None
    parameters: Mapping[str, Any] | None = None
    id: Any = None
    #: Rows of the table that those of the track are.
    rows: Sequence[int] | None = None


def split(joined: Joined, t: Any, z: Any, u: Any, noise: Any) -> tuple[list[Given], bool]:
    """One track, or several: an array (runs, rows, d), or a list of arrays or tables."""
    z, u, noise = unmasked(z), unmasked(u), unmasked(noise)
    if isinstance(z, Mapping):
        several = len(z) > 0 and all(dimensions(value) == 3 for value in z.values())
        each: list[Any] = _by_sensor(z) if several else []
    elif isinstance(z, (list, tuple)) and len(z) and (isinstance(z[0], Mapping) or dimensions(z[0]) == 2):
        several, each = True, list(z)
    elif len(joined.measures) == 1 and _vectors(t, z):
        several, each = True, _parts(z)
    else:
        several = dimensions(z) == 3 and np.shape(z)[2] == len(joined.measures)
        each = _parts(z) if several else []
    if not several:
        _refuse_times(joined, t)
        return [Given(t, z, u, noise)], False
    runs = len(each)
    ragged = isinstance(t, (list, tuple)) and len(t) > 0 and dimensions(t[0]) == 1
    times = list(t) if ragged else _parts(t) if dimensions(t) == 2 else [t] * runs
    if len(times) != runs:
        raise InputError(
            f"`t` has times of {len(times)} tracks, `z` measurements of {runs}",
            argument="t",
            remedy="give one list for each",
        )
    controls = _by_run("u", u, runs)
    noises = _noise_by_run(joined, noise, [len(one) if dimensions(one) == 1 else 0 for one in times])
    return [Given(times[k], each[k], controls[k], noises[k]) for k in range(runs)], True


def _times_of_several(t: Any) -> bool:
    """Whether these are the times of several tracks; one row or one column may be a vector that was meant."""
    if dimensions(t) == 2:
        return min(np.shape(t)) > 1 or (isinstance(t, (list, tuple)) and isinstance(t[0], np.ndarray))
    return isinstance(t, (list, tuple)) and len(t) > 1 and dimensions(t) < 0 and all(dimensions(one) == 1 for one in t)


def _vectors(t: Any, z: Any) -> bool:
    """Whether these are tracks of one measure, (rows,) each."""
    listed = isinstance(z, (list, tuple)) and len(z) > 0 and all(dimensions(one) == 1 for one in z)
    if _times_of_several(t):
        return listed or dimensions(z) == 2
    # a list of numbers in brackets is rows; of arrays with one number each as well
    return listed and all(not isinstance(one, (list, tuple)) and len(one) > 1 for one in z)


def _refuse_times(joined: Joined, t: Any) -> None:
    if _times_of_several(t):
        raise InputError(
            f"`t` has times of {len(t)} tracks, but `z` is of one",
            argument="t",
            remedy=f"give `z` for each track: a list of arrays (rows, {len(joined.measures)})",
        )


def _parts(array: Any) -> list[Any]:
    """An array along its first dimension."""
    array = unmasked(array)
    if hasattr(array, "to_numpy") and not isinstance(array, np.ndarray):
        array = array.to_numpy()
    return list(array)


def _by_sensor(z: Mapping[str, Any]) -> list[dict[str, Any]]:
    parts = {name: _parts(value) for name, value in z.items()}
    (first, one), *others = parts.items()
    for name, other in others:
        if len(other) != len(one):
            raise InputError(
                f"`z` has measurements of {len(one)} tracks for `{first}` and of {len(other)} for `{name}`",
                argument="z",
                component=name,
                remedy="give NaN where a sensor is missing",
            )
    return [{name: values[k] for name, values in parts.items()} for k in range(len(one))]


def _by_run(argument: str, given: Any, runs: int) -> list[Any]:
    """One for each run, or the same for all; those of one run have two dimensions."""
    if given is None or isinstance(given, Mapping) or is_frame(given):
        return [given] * runs
    listed = isinstance(given, (list, tuple))
    several = len(given) == runs > 0 and dimensions(given[0]) == 2 if listed else dimensions(given) == 3
    if several and len(given) != runs:
        raise InputError(
            f"`{argument}` is for {len(given)} tracks, `z` for {runs}", argument=argument, remedy="give one for each"
        )
    return _parts(given) if several else [given] * runs


def _noise_by_run(joined: Joined, noise: Any, rows: list[int]) -> list[Any]:
    if noise is None:
        return [None] * len(rows)
    if not isinstance(noise, Mapping):
        return _noises("noise", noise, len(joined.measures), rows)
    for name in noise:
        known_name("noise", name, tuple(joined.sensors), "sensor")
    widths = joined.widths
    split = {name: _noises(f"noise[{name!r}]", value, widths[name], rows) for name, value in noise.items()}
    return [{name: values[k] for name, values in split.items()} for k in range(len(rows))]


def _noises(argument: str, given: Any, d: int, rows: list[int]) -> list[Any]:
    """That of each run, or the same for all: the shape says which."""
    runs = len(rows)
    same = all(_is_noise(given, count, d) for count in rows)
    try:
        parts = _parts(given) if not is_frame(given) else []
    except TypeError:
        parts = []
    several = len(parts) == runs and all(_is_noise(one, count, d) for one, count in zip(parts, rows, strict=True))
    if same and several and runs > 1:
        raise InputError(
            f"`{argument}` of shape {np.shape(given)} may be one for each of {runs} tracks, or the same for all",
            argument="noise",
            remedy=f"say so by its dimensions: give covariances of shape ({runs}, rows, {d}, {d})",
        )
    # what fits neither way is told by the track that it does not fit
    return parts if several or (len(parts) == runs and dimensions(given) > 3) else [given] * runs


def _is_noise(given: Any, rows: int, d: int) -> bool:
    """Whether this is the noise of one run: (rows, d), (rows, d, d), or (rows,) of one measure."""
    if dimensions(given) < 1:
        return False
    shape = np.shape(given)
    return shape in ((rows, d), (rows, d, d)) or (d == 1 and shape == (rows,))


def each_of(argument: str, given: Any, tracks: Sequence[Any], batch: bool, kind: type) -> list[Any]:
    """One for each track: given so, by name or in their order, or the same for all."""
    runs = len(tracks)
    if batch and isinstance(given, Mapping):
        return by_track(f"`{argument}`", given, tracks)
    if not isinstance(given, (list, tuple)):
        return [given] * runs
    if not batch or len(given) != runs:
        what = f"one for each of {runs} tracks" if batch else f"one {kind.__name__}"
        raise InputError(
            f"`{argument}` is a {type(given).__name__} of {len(given)}, not {what}",
            argument=argument,
            remedy="write gv.Gaussian(mean, cov)",
        )
    return list(given)


def parameters_by_run(
    params: Mapping[str, Any], own: Mapping[str, tuple[int, ...]], tracks: Sequence[Any], batch: bool
) -> list[dict[str, Any]]:
    """The values of each track: those of a parameter's `own` shape are for all, with one dimension more for each.

    A table has them by the names of the tracks.
    """
    if not params:
        return []
    runs = len(tracks)
    values: list[dict[str, Any]] = [{} for _ in range(runs)]
    for name, given in params.items():
        if isinstance(given, Mapping) and name in own:
            _by_name(values, name, given, own[name], tracks, batch)
            continue
        shape = np.shape(given) if dimensions(given) >= 0 else ()
        wanted = own.get(name, ())
        several = batch and shape == (runs, *wanted)
        if name in own and shape != wanted and not several:
            also = f", nor {(runs, *wanted)}, one for each track" if batch else ""
            raise InputError(
                f"`params`: `{name}` has shape {shape}, not {wanted}{also}",
                argument="params",
                component=name,
                remedy=_remedy(wanted, batch),
            )
        for k in range(runs):
            values[k][name] = given[k] if several else given
    return values


def _by_name(
    values: list[dict[str, Any]],
    name: str,
    given: Mapping[Any, Any],
    wanted: tuple[int, ...],
    tracks: Sequence[Any],
    batch: bool,
) -> None:
    """Puts the values of one parameter, by the names of the tracks, into those of each track."""
    if not batch:
        raise InputError(
            f"`params`: `{name}` is a table by track, but there is one track",
            argument="params",
            component=name,
            remedy=_remedy(wanted, batch),
        )
    for track, own, value in zip(tracks, values, by_track(f"`params` of `{name}`", given, tracks), strict=True):
        shape = np.shape(value) if dimensions(value) >= 0 else ()
        if shape != wanted:
            raise InputError(
                f"`params`: `{name}` of the track {shown(track)} has shape {shape}, not {wanted}",
                argument="params",
                component=name,
                remedy=_remedy(wanted, False),
            )
        own[name] = value


def _remedy(wanted: Sequence[int], batch: bool) -> str:
    one = "give as many numbers as it had" if wanted else "give one number"
    return f"{one}, or as many for each track" if batch else one

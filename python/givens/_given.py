"""Several trajectories, told from one and taken apart."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from givens._join import Joined
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


def split(joined: Joined, t: Any, z: Any, u: Any, noise: Any) -> tuple[list[Given], bool]:
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
        return [Given(t, z, u, noise)], False
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
    return [Given(times[k], each[k], controls[k], noises[k]) for k in range(runs)], True


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


def each_of(argument: str, given: Any, runs: int, batch: bool, kind: type) -> list[Any]:
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


def parameters_by_run(params: Mapping[str, Any] | None, runs: int) -> list[dict[str, Any]]:
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

"""Trajectories drawn from a model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from givens import _native
from givens._arrays import Array
from givens._capsules import framed
from givens._clock import clock_of
from givens._join import join
from givens._memory import room
from givens._plan import read_prior, with_parameters
from givens._rows import controls_of, noise_shapes, with_noise
from givens._sampling import PIECES
from givens._scalars import MOST_RUNS, mapping, seed_of, threads_of, whole
from givens._steep import refuse_steep_paths
from givens.gaussian import Gaussian

__all__ = ["Simulated", "simulate"]


@dataclass(frozen=True, eq=False)
class Simulated:
    """True states and measurements.

    Attributes
    ----------
    t : ndarray, shape (rows,)
    x : ndarray, shape (rows, n), or (runs, rows, n)
        True states.
    z : ndarray, shape (rows, d), or (runs, rows, d)
        Measurements of all sensors, side by side.
    """

    t: np.ndarray[Any, Any]
    x: Array
    z: Array

    def __repr__(self) -> str:
        return f"Simulated(t={self.t.shape}, x={self.x.shape}, z={self.z.shape})"


def simulate(
    model: Any,
    sensors: Any,
    t: Any,
    *,
    prior: Gaussian | None = None,
    seed: int,
    runs: int | None = None,
    t0: Any = None,
    u: Any = None,
    noise: Any = None,
    params: Mapping[str, Any] | None = None,
    substeps: int = 16,
    threads: int | None = None,
    first_run: int = 0,
) -> Simulated:
    """Draws true states and measurements at the times `t`.

    Parameters
    ----------
    model, sensors, t, t0, u, noise, params
        As for `filter`.
    prior : Gaussian
        The state at `t0` is drawn from it.
    seed : int
        Equal seeds give equal draws, on any number of threads.
    runs : int, optional
        How many trajectories; without it one, in arrays of two dimensions.
    substeps : int, optional
        Equal steps in each gap of a continuous model, by Itô and Taylor. They must be short against the fastest
        motion of the drift: too few draw from another model, without a word, or end in a `StepError`. Where gaps are
        long, double them until nothing changes.

    first_run : int, optional
        The number of the first of them: a run is the same whatever others are drawn with it.

    Returns
    -------
    Simulated
        The times, the states, and the measurements.

    Raises
    ------
    InputError
        For arguments that cannot serve.
    StepError
        For a model that is not finite on the way.

    Examples
    --------
    >>> import givens as gv
    >>> model = gv.Sde(lambda t, x: [x[1], -x[0]], diffusion=[0.0, 0.1], state=["x", "v"])
    >>> ruler = gv.Sensor(lambda t, x: x[:1], measures=["length"], std=[0.1])
    >>> gv.simulate(model, ruler, [0.0, 0.5, 1.0], prior=gv.Gaussian([1, 0], std=[1, 1]), seed=7, runs=100)
    Simulated(t=(3,), x=(100, 3, 2), z=(100, 3, 1))
    """
    model, sensors = with_parameters(model, sensors, mapping("params", params, "params={name: value}"))
    t, u, noise = framed("t", t), framed("u", u), framed("noise", noise)
    plain = join(model, sensors)
    widths = plain.widths
    joined = join(model, sensors, noise_shapes(noise, widths)) if noise is not None else plain
    clock = clock_of(t, t0)
    start = None if t0 is None else clock.moment("t0", t0)
    times = clock.times("t", t)
    time = times.seconds
    drawn_from, count = seed_of(seed), 1 if runs is None else whole("runs", runs, 0, MOST_RUNS)
    # numbers are kept twice while they are put together
    each = 16 * len(time) * (len(joined.states) + len(joined.measures))
    room("runs", count, each, PIECES)
    z = np.zeros((len(time), len(joined.measures)))
    controls = with_noise(joined, controls_of(joined, u, len(time)), noise, z)
    mean, cov = read_prior(model, prior, joined.states)
    refuse_steep_paths(model, joined, start or 0.0, mean, controls)
    x, drawn = _native.simulate(
        joined.native,
        mean,
        cov,
        start,
        time,
        drawn_from,
        count,
        u=controls,
        substeps=whole("substeps", substeps, 1),
        threads=threads_of(threads),
        first_run=whole("first_run", first_run, 0, MOST_RUNS - count),
    )
    return Simulated(times.given, *((x[0], drawn[0]) if runs is None else (x, drawn)))

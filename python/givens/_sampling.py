"""States drawn from estimates."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from givens import _native
from givens._arrays import Array
from givens._memory import room
from givens.errors import InputError

if TYPE_CHECKING:
    from givens._plan import Track
    from givens.estimates import Estimates

__all__ = ["PIECES", "bytes_of", "draws"]


#: How to draw more than there is memory for.
PIECES = "draw fewer at a time, each time with another seed"
#: Bytes of the native half's numbers at random, which each trajectory has of its own.
_STREAM = 320


def bytes_of(one: Estimates) -> int:
    """What one draw needs: its states, and beside them a stream, or the numbers that they are made of."""
    states = 8 * one.mean.size
    return states + _STREAM if one.__dict__["_whole"] else 2 * states


def draws(one: Estimates, n: int, seed: int, number: int = 0) -> Array:
    """See `Estimates.sample`; tracks of another number draw otherwise from the same seed."""
    room("n", n, bytes_of(one), PIECES)
    if one.__dict__["_whole"]:
        return _paths(one, n, seed, number)
    normal = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(number,)))
    try:
        spread: Array = np.einsum("kij,skj->ski", one.factor, normal.standard_normal((n, *one.mean.shape)))
    except MemoryError:
        raise InputError(
            f"`n` is {n}: they need {8 * n * one.mean.size:.3e} bytes at once, more than there is memory for",
            argument="n",
            remedy=PIECES,
        ) from None
    spread += one.mean
    return spread


def _paths(one: Estimates, n: int, seed: int, number: int) -> Array:
    """Of a smoother over all rows, jointly."""
    track: Track | None = one.__dict__["_track"]
    if track is None:
        raise InputError(
            "these estimates come from a pickle and cannot draw trajectories",
            argument="n",
            remedy="draw before they are pickled",
        )
    model, choice, mean, cov, t0, time, z, u, _ = track.arguments()
    drawn = _native.sample(model, choice, mean, cov, t0, time, z, u, draws=n, seed=seed, track=number)
    unknown = np.full((n, track.before, drawn.shape[2]), np.nan)
    return np.concatenate([unknown, drawn], axis=1) if track.before else drawn

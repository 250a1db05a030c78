"""Lower roots of covariances, which may have no inverse."""

from __future__ import annotations

from typing import Any

import numpy as np

from givens._arrays import Array

__all__ = ["first_asymmetry", "lower_factor"]

#: A pivot below this part of its variance is rounding.
_ROUNDING = 64 * np.finfo(float).eps


def first_asymmetry(cov: Array) -> tuple[int, int] | None:
    """The first pair of entries that differ by more than the rounding of products of matrices."""
    variances = np.abs(np.diagonal(cov))
    size = np.maximum(np.maximum(np.abs(cov), np.abs(cov.T)), np.sqrt(np.outer(variances, variances)))
    room = 4096 * np.finfo(float).eps * size
    apart = np.argwhere(np.abs(cov - cov.T) > room)
    return (int(apart[0][0]), int(apart[0][1])) if len(apart) else None


def lower_factor(cov: Array) -> tuple[Array, Array]:
    """S with S Sᵀ = cov, lower triangular with a diagonal from zero up, for a stack of covariances (…, n, n).

    A pivot within rounding of zero is zero, and so is its column. The second result says of each matrix at which pivot
    it turned out to be no covariance, and −1 where it is one.
    """
    n = cov.shape[-1]
    factor = np.zeros_like(cov)
    failed = np.full(cov.shape[:-2], -1)
    variance = np.diagonal(cov, axis1=-2, axis2=-1)
    with np.errstate(all="ignore"):
        for j in range(n):
            rest = cov[..., j:, j] - np.einsum("...ik,...k->...i", factor[..., j:, :j], factor[..., j, :j])
            room = n * _ROUNDING * np.abs(variance[..., j])
            pivot = rest[..., 0]
            ill = ~(pivot >= -room) | ((pivot <= room) & _beyond(rest, variance[..., j:], room))
            failed = np.where((failed < 0) & ill, j, failed)
            column = np.where(
                (pivot > room)[..., None], rest / np.sqrt(np.where(pivot > room, pivot, 1.0))[..., None], 0.0
            )
            factor[..., j:, j] = column
    factor[failed >= 0] = np.nan
    return factor, failed


def _beyond(rest: Array, variance: Array, room: Array) -> Any:
    """Whether a column below a zero pivot is more than what rounding leaves there."""
    allowed = np.sqrt(np.abs(variance) * room[..., None]) * 8
    return np.any(np.abs(rest) > allowed + room[..., None], axis=-1)

"""Noises that are no such thing, found when a model is made."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from givens._arrays import Array
from givens._factor import first_asymmetry, lower_factor
from givens._part import Part
from givens.errors import InputError

__all__ = ["CORRELATIONS", "check_covariance", "check_deviations", "check_rows"]

CORRELATIONS = "variances are from 0 up, and correlations from -1 to 1"

#: Time, step and controls at which noises that depend on them are compared with their transposes.
_MOMENTS = ((0.37, 1.3, 0.71), (2.9, 0.21, -1.7), (11.3, 3.1, 0.13))


def check_covariance(argument: str, part: Part, kind: str, names: Sequence[str], step: float | None = None) -> None:
    """Refuses a covariance that is none: as far as that is known before a run.

    One that depends on time, step or controls is compared with its transpose only; one that depends on parameters has
    their values of now. `kind` and `names` say what its rows are of.
    """
    with np.errstate(all="ignore"):
        if part.is_fixed:
            matrix = part.value()
            _check_symmetric(argument, matrix)
            _check_semidefinite(argument, matrix, kind, names)
            return
        for t, dt, u in _MOMENTS:
            dt = dt if step is None else step
            at = f" at t = {t:g}" + (f", dt = {dt:g}" if kind == "state" else "")
            _check_symmetric(argument, part.value(t, dt, u), at)


def _check_symmetric(argument: str, matrix: Array, at: str = "") -> None:
    # where a moment lies outside of what the expressions are made for, NaN differs from nothing
    apart = first_asymmetry(matrix)
    if apart is None:
        return
    i, j = apart
    raise InputError(
        f"`{argument}` is not symmetric{at}: {matrix[i, j]} at [{i}, {j}], {matrix[j, i]} at [{j}, {i}]",
        argument=argument,
        remedy="give a symmetric matrix, such as (Q + Q.T) / 2 if they differ by rounding",
    )


def _check_semidefinite(argument: str, matrix: Array, kind: str, names: Sequence[str]) -> None:
    pivot = int(lower_factor(matrix)[1])
    if pivot >= 0:
        raise InputError(
            f"`{argument}` is not positive semidefinite at pivot {pivot + 1} ({kind} `{names[pivot]}`)",
            argument=argument,
            component=names[pivot],
            remedy=CORRELATIONS,
        )


def check_deviations(argument: str, part: Part, names: Sequence[str]) -> None:
    """Refuses standard deviations below zero, where they are known before a run."""
    if not part.is_fixed:
        return
    for name, value in zip(names, part.value().ravel(), strict=True):
        if not 0 <= value < np.inf:
            raise InputError(
                f"`{argument}` of `{name}` is {value}",
                argument=argument,
                component=name,
                remedy="standard deviations are finite, from 0 up",
            )


def check_rows(argument: str, sensor: str, stack: Array, names: Sequence[str]) -> None:
    """Refuses covariances of measurements, (rows, d, d), the first of which is none."""
    apart = np.abs(stack - stack.swapaxes(-1, -2)).max(axis=(1, 2), initial=0.0) > 0
    for row in np.flatnonzero(apart):
        found = first_asymmetry(stack[row])
        if found is not None:
            i, j = found
            raise InputError(
                f"`{argument}` is not symmetric in row {row}: {stack[row, i, j]} at [{i}, {j}], {stack[row, j, i]} at "
                f"[{j}, {i}]",
                argument="noise",
                row=int(row),
                component=sensor,
                remedy="give symmetric matrices, such as (R + R.swapaxes(1, 2)) / 2 if they differ by rounding",
            )
    pivots = lower_factor(stack)[1]
    for row in np.flatnonzero(pivots >= 0)[:1]:
        name = names[int(pivots[row])]
        raise InputError(
            f"`{argument}` is not positive semidefinite in row {row}, at pivot {pivots[row] + 1} (measure `{name}`)",
            argument="noise",
            row=int(row),
            component=name,
            remedy=CORRELATIONS,
        )

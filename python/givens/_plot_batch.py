"""Figures of several trajectories."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from givens import _native
from givens._arrays import Array
from givens._plot import ESTIMATE, TRUTH, figure_of, finished, places_of, verdict
from givens._truth import truths_of
from givens.errors import InputError

if TYPE_CHECKING:
    from givens.batch import Batch
    from givens.estimates import Estimates

__all__ = ["plot"]

#: Tracks that are drawn.
_DRAWN = 50


def plot(batch: Batch, plane: tuple[str, str] | None, truth: Any) -> Any:
    """See `Batch.plot`."""
    if not len(batch):
        raise InputError("there are no tracks to draw", argument="batch", remedy="draw a batch that has some")
    known: list[Array] | list[None] = [None] * len(batch) if truth is None else truths_of(tuple(batch), truth)
    shown = np.unique(np.linspace(0, len(batch) - 1, min(len(batch), _DRAWN)).round().astype(int))
    figure, axes, track = figure_of(batch.state, plane)
    for k in shown:
        one, true = batch[k], known[k]
        first = k == shown[0]
        for i in range(len(one.state)):
            if true is not None:
                axes[i].plot(one.time, true[:, i], **_line(TRUTH, "truth", first))
            axes[i].plot(one.time, one.mean[:, i], **_line(ESTIMATE, _word(one), first))
        if plane is not None:
            i, j = places_of(one.state, plane)
            if true is not None:
                track.plot(true[:, i], true[:, j], **_line(TRUTH, "truth", first))
            track.plot(one.mean[:, i], one.mean[:, j], **_line(ESTIMATE, _word(one), first))
    _nis(axes[-1], batch)
    verdict(axes[-1], batch.consistency())
    drawn = f"{len(batch)} tracks" if len(shown) == len(batch) else f"{len(shown)} of {len(batch)} tracks"
    finished(figure, axes, batch[0], f"{batch[0].method}: means of {drawn}")
    if plane is not None:
        track.set_xlabel(plane[0])
        track.set_ylabel(plane[1])
        track.set_aspect("equal", adjustable="datalim")
    return figure


def _word(one: Estimates) -> str:
    return "smoothed" if one.is_smoothed else "filtered"


def _line(color: str, label: str, first: bool) -> dict[str, Any]:
    style = {"linestyle": "--"} if color == TRUTH else {}
    return {"color": color, "linewidth": 0.8, "alpha": 0.6, "label": label if first else None, **style}


def _nis(axes: Any, batch: Batch) -> None:
    """Of all tracks at each time, with the band of filters that are right; of those at times of their own, each row."""
    longest = max(batch, key=len)
    alike = all(np.array_equal(one.time, longest.time[: len(one)]) for one in batch)
    if not alike:
        for one in batch:
            with np.errstate(all="ignore"):
                axes.plot(one.time, one.nis / one.nis_dof, ".", color=ESTIMATE, markersize=3, alpha=0.4)
        return
    nis = np.full((len(batch), len(longest)), np.nan)
    dof = np.zeros(nis.shape, dtype=np.int64)
    for k, one in enumerate(batch):
        # rows beyond the gate say nothing of the filter
        nis[k, : len(one)] = np.where(one.gated, np.nan, one.nis)
        dof[k, : len(one)] = np.where(one.gated, 0, one.nis_dof)
    rows = [_native.consistency(*row) for row in zip(nis.T.copy(), dof.T.copy(), strict=True)]
    low, high = np.array([row["band"] for row in rows]).reshape(-1, 2).T
    axes.fill_between(longest.time, low, high, color=ESTIMATE, alpha=0.2, linewidth=0, label="95 % band")
    axes.plot(longest.time, [row["ratio"] for row in rows], ".", color=ESTIMATE, markersize=4)

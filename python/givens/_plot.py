"""Figures of estimates."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from givens._arrays import Array
from givens._lazy import wanted
from givens._names import known_name

if TYPE_CHECKING:
    from givens.estimates import Estimates

__all__ = ["plot"]

_ESTIMATE, _FILTERED, _TRUTH, _BAND = "#1f5fa8", "#9a9a9a", "#c0392b", 0.2


def plot(one: Estimates, plane: tuple[str, str] | None, truth: Any) -> Any:
    """See `Estimates.plot`."""
    pyplot = wanted("matplotlib.pyplot")
    places = (
        None if plane is None else tuple(one.state.index(known_name("plane", s, one.state, "state")) for s in plane)
    )
    known = None if truth is None else np.asarray(truth, dtype=float)
    lines = len(one.state) + 1
    width = 2 if places is not None else 1
    figure = pyplot.figure(figsize=(5.5 * width + 1, 1.6 * lines + 0.6), layout="constrained")
    grid = figure.add_gridspec(lines, width)
    first = None
    for i in range(lines):
        first = axes = figure.add_subplot(grid[i, width - 1], sharex=first)
        if i + 1 < lines:
            _state(axes, one, i, known)
            axes.tick_params(labelbottom=False)
        else:
            _nis(axes, one)
            _dates(axes, one)
    above = figure.axes[0]
    above.set_title(f"{one.method}: mean and two standard deviations", fontsize="medium", loc="left")
    # above the figure, where no line can run through it
    figure.legend(
        *above.get_legend_handles_labels(), loc="outside upper right", fontsize="small", frameon=False, ncols=3
    )
    if places is not None:
        _track(figure.add_subplot(grid[:, 0]), one, places, known)
    return figure


def _state(axes: Any, one: Estimates, i: int, truth: Array | None) -> None:
    mean, std = one.mean[:, i], one.std[:, i]
    axes.fill_between(one.time, mean - 2 * std, mean + 2 * std, color=_ESTIMATE, alpha=_BAND, linewidth=0)
    if one.is_smoothed:
        axes.plot(one.time, one.filtered_mean[:, i], color=_FILTERED, linewidth=0.8, label="filtered")
    if truth is not None:
        axes.plot(one.time, truth[:, i], color=_TRUTH, linewidth=1, linestyle="--", label="truth")
    word = "smoothed" if one.is_smoothed else "filtered"
    axes.plot(one.time, mean, color=_ESTIMATE, linewidth=1.2, label=word)
    axes.set_ylabel(one.state[i])


def _nis(axes: Any, one: Estimates) -> None:
    with np.errstate(all="ignore"):
        ratio = one.nis / one.nis_dof
    axes.plot(one.time, ratio, ".", color=_ESTIMATE, markersize=4)
    axes.axhline(1, color=_FILTERED, linewidth=0.8)
    axes.set_ylim(bottom=0)
    axes.set_ylabel("NIS / dof")
    axes.set_xlabel("time")
    found = one.consistency()
    low, high = found.band
    words = f"{found.verdict}: mean NIS {found.ratio:.3f} per degree of freedom, 95 % band {low:.3f} to {high:.3f}"
    axes.set_title(words, fontsize="small", loc="left")


def _dates(axes: Any, one: Estimates) -> None:
    if one.time.dtype.kind == "M":
        dates = wanted("matplotlib.dates")
        locator = dates.AutoDateLocator()
        axes.xaxis.set_major_locator(locator)
        axes.xaxis.set_major_formatter(dates.ConciseDateFormatter(locator))


def _track(axes: Any, one: Estimates, places: tuple[int, ...], truth: Array | None) -> None:
    i, j = places
    if truth is not None:
        axes.plot(truth[:, i], truth[:, j], color=_TRUTH, linewidth=1, linestyle="--", label="truth")
    if one.is_smoothed:
        axes.plot(one.filtered_mean[:, i], one.filtered_mean[:, j], color=_FILTERED, linewidth=0.8, label="filtered")
    word = "smoothed" if one.is_smoothed else "filtered"
    axes.plot(one.mean[:, i], one.mean[:, j], ".-", color=_ESTIMATE, linewidth=1, markersize=3, label=word)
    _ellipses(axes, one, i, j)
    axes.plot(*one.mean[0, [i, j]], "o", color=_ESTIMATE, markersize=5, markerfacecolor="white")
    axes.set_xlabel(one.state[i])
    axes.set_ylabel(one.state[j])
    axes.set_aspect("equal", adjustable="datalim")
    axes.legend(loc="best", fontsize="small", frameon=False)


def _ellipses(axes: Any, one: Estimates, i: int, j: int) -> None:
    """Of two standard deviations, at some ten rows."""
    angle = np.linspace(0, 2 * np.pi, 60)
    circle = np.stack([np.cos(angle), np.sin(angle)])
    for k in range(0, len(one), max(len(one) // 10, 1)):
        values, vectors = np.linalg.eigh(one.cov[k][np.ix_([i, j], [i, j])])
        ring = one.mean[k, [i, j], None] + 2 * (vectors * np.sqrt(np.maximum(values, 0))) @ circle
        axes.plot(*ring, color=_ESTIMATE, linewidth=0.6, alpha=0.5)

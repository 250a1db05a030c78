"""Figures of estimates."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from givens._arrays import Array
from givens._lazy import wanted
from givens._names import known_name
from givens._scalars import shown
from givens._truth import truth_of
from givens.errors import InputError

if TYPE_CHECKING:
    from givens.consistency import Consistency
    from givens.estimates import Estimates

__all__ = ["ESTIMATE", "TRUTH", "figure_of", "finished", "places_of", "plot", "verdict"]

ESTIMATE, FILTERED, TRUTH, _BAND = "#1f5fa8", "#9a9a9a", "#c0392b", 0.2


def plot(one: Estimates, plane: tuple[str, str] | None, truth: Any) -> Any:
    """See `Estimates.plot`."""
    figure, axes, track = figure_of(one.state, plane)
    known = None if truth is None else truth_of(one, truth)
    for i in range(len(one.state)):
        _state(axes[i], one, i, known)
    _nis(axes[-1], one)
    finished(figure, axes, one, f"{one.method}: mean and two standard deviations")
    if plane is not None:
        _track(track, one, places_of(one.state, plane), known)
    return figure


def places_of(state: tuple[str, ...], plane: tuple[str, str]) -> tuple[int, int]:
    """Where the states of a plane stand."""
    if not (isinstance(plane, (tuple, list)) and len(plane) == 2):
        raise InputError(
            f"`plane` is {shown(plane)}, not two states", argument="plane", remedy=f"name two of {', '.join(state)}"
        )
    i, j = (state.index(known_name("plane", name, state, "state")) for name in plane)
    return i, j


def figure_of(state: tuple[str, ...], plane: tuple[str, str] | None) -> tuple[Any, list[Any], Any]:
    """A figure with axes for each state, below them one for NIS, and, with a plane, one for the track."""
    if plane is not None:
        places_of(state, plane)
    pyplot = wanted("matplotlib.pyplot")
    lines, width = len(state) + 1, 1 if plane is None else 2
    figure = pyplot.figure(figsize=(5.5 * width + 1, 1.6 * lines + 0.6), layout="constrained")
    grid = figure.add_gridspec(lines, width)
    axes: list[Any] = []
    for i in range(lines):
        axes.append(figure.add_subplot(grid[i, width - 1], sharex=axes[-1] if axes else None))
        if i + 1 < lines:
            axes[i].set_ylabel(state[i])
            axes[i].tick_params(labelbottom=False)
    axes[-1].set_ylabel("NIS / dof")
    axes[-1].set_xlabel("time")
    return figure, axes, figure.add_subplot(grid[:, 0]) if plane is not None else None


def finished(figure: Any, axes: list[Any], one: Estimates, title: str) -> None:
    """With dates, a title and a legend."""
    _dates(axes[-1], one)
    axes[0].set_title(title, fontsize="medium", loc="left")
    # above the figure, where no line can run through it
    figure.legend(
        *axes[0].get_legend_handles_labels(), loc="outside upper right", fontsize="small", frameon=False, ncols=3
    )


def verdict(axes: Any, found: Consistency) -> None:
    """What the innovations say together."""
    axes.axhline(1, color=FILTERED, linewidth=0.8)
    axes.set_ylim(bottom=0)
    # the words of `Estimates.consistency`, in lines that fit
    lines = [part for line in found._lines for part in line.replace(": mean", ":\nmean").split("\n")]
    axes.set_title("\n".join(lines), fontsize="small", loc="left")


def _state(axes: Any, one: Estimates, i: int, truth: Array | None) -> None:
    mean, std = one.mean[:, i], one.std[:, i]
    axes.fill_between(one.time, mean - 2 * std, mean + 2 * std, color=ESTIMATE, alpha=_BAND, linewidth=0)
    if one.is_smoothed:
        axes.plot(one.time, one.filtered_mean[:, i], color=FILTERED, linewidth=0.8, label="filtered")
    if truth is not None:
        axes.plot(one.time, truth[:, i], color=TRUTH, linewidth=1, linestyle="--", label="truth")
    word = "smoothed" if one.is_smoothed else "filtered"
    axes.plot(one.time, mean, color=ESTIMATE, linewidth=1.2, label=word)


def _nis(axes: Any, one: Estimates) -> None:
    with np.errstate(all="ignore"):
        ratio = one.nis / one.nis_dof
    taken = ~one.gated
    axes.plot(one.time[taken], ratio[taken], ".", color=ESTIMATE, markersize=4)
    if one.gated.any():
        shown = {"color": ESTIMATE, "markersize": 5, "markerfacecolor": "none"}
        axes.plot(one.time[one.gated], ratio[one.gated], "o", label="beyond the gate", **shown)
    verdict(axes, one.consistency())


def _dates(axes: Any, one: Estimates) -> None:
    if one.time.dtype.kind == "M":
        dates = wanted("matplotlib.dates")
        locator = dates.AutoDateLocator()
        axes.xaxis.set_major_locator(locator)
        axes.xaxis.set_major_formatter(dates.ConciseDateFormatter(locator))


def _track(axes: Any, one: Estimates, places: tuple[int, ...], truth: Array | None) -> None:
    i, j = places
    if truth is not None:
        axes.plot(truth[:, i], truth[:, j], color=TRUTH, linewidth=1, linestyle="--", label="truth")
    if one.is_smoothed:
        axes.plot(one.filtered_mean[:, i], one.filtered_mean[:, j], color=FILTERED, linewidth=0.8, label="filtered")
    word = "smoothed" if one.is_smoothed else "filtered"
    axes.plot(one.mean[:, i], one.mean[:, j], ".-", color=ESTIMATE, linewidth=1, markersize=3, label=word)
    _ellipses(axes, one, i, j)
    axes.plot(*one.mean[0, [i, j]], "o", color=ESTIMATE, markersize=5, markerfacecolor="white")
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
        axes.plot(*ring, color=ESTIMATE, linewidth=0.6, alpha=0.5)

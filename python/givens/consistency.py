"""Whether a filter is as good as it says."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

from givens import _native
from givens._arrays import Array

if TYPE_CHECKING:
    from givens.estimates import Estimates

__all__ = ["Consistency", "Scored", "consistency_of"]


class Scored(NamedTuple):
    """What the rows of a run that were taken in say of its filter."""

    nis: Array
    nis_dof: npt.NDArray[np.int64]
    innovation: Array
    innovation_cov: Array

    @classmethod
    def of(cls, rows: _native.Estimates) -> Scored:
        """Of all rows: those beyond the gate as if nothing had been measured there."""
        if not rows.gated.any():
            return cls(rows.nis, rows.nis_dof, rows.innovation, rows.innovation_cov)
        nis = np.where(rows.gated, np.nan, rows.nis)
        innovation = np.where(rows.gated[:, None], np.nan, rows.innovation)
        return cls(nis, np.where(rows.gated, 0, rows.nis_dof), innovation, rows.innovation_cov)


@dataclass(frozen=True)
class Consistency:
    """The size of the innovations against what the filter expects, and whether they follow from each other.

    Attributes
    ----------
    verdict : str
        ``"consistent"``, ``"overconfident"``, ``"underconfident"``, or ``"unknown"`` where nothing was measured.
    ratio : float
        Mean NIS for each degree of freedom: 1 of a filter that is right.
    band : (float, float)
        The central 95 % of what a filter that is right has.
    dof : int
        Degrees of freedom: measures of all rows together.
    correlation : float
        Of normalised innovations with those of the row before: 0 of a filter that is right.
    correlation_bound : float
        Beyond it in 5 % of cases.
    """

    verdict: str
    ratio: float
    band: tuple[float, float]
    dof: int
    text: str
    correlation: float
    correlation_bound: float

    @property
    def is_white(self) -> bool:
        """Whether innovations are unrelated to those before, as far as one can tell."""
        return not abs(self.correlation) > self.correlation_bound

    @property
    def _lines(self) -> list[str]:
        """What is said, in parts: of size, with its numbers, and of what innovations follow from."""
        size = self.text
        if not np.isfinite(self.correlation):
            return [size]
        words = "unrelated to those before"
        if not self.is_white:
            words = "related to those before: the model may miss something"
            # of the size alone, that is
            size = size.replace("consistent:", "consistent in size:") if self.verdict == "consistent" else size
        numbers = f"correlation {self.correlation:.3f}, bound {self.correlation_bound:.3f}"
        return [size, f"innovations {words} ({numbers})"]

    def __str__(self) -> str:
        return "; ".join(self._lines)

    def _repr_html_(self) -> str:
        from html import escape

        return f"<p>{escape(str(self))}</p>"


def consistency_of(runs: Iterable[Estimates]) -> Consistency:
    """Of several runs together."""
    scored: list[Scored] = [one.__dict__["_scored"] for one in runs]
    nis = np.concatenate([np.empty(0), *(np.asarray(one.nis) for one in scored)])
    dof = np.concatenate([np.empty(0, dtype=np.int64), *(np.asarray(one.nis_dof) for one in scored)])
    found = _native.consistency(nis, dof)
    correlation, pairs = _lagged(scored)
    bound = 1.959964 / np.sqrt(pairs) if pairs else float("nan")
    low, high = found["band"]
    return Consistency(
        found["verdict"], found["ratio"], (low, high), found["dof"], found["text"], correlation, float(bound)
    )


def _lagged(runs: Iterable[Scored]) -> tuple[float, int]:
    """The correlation of whitened innovations with those of the row before, component by component."""
    product, square, pairs = 0.0, 0.0, 0
    for one in runs:
        white = _whitened(one)
        now, before = white[1:], white[:-1]
        both = np.isfinite(now) & np.isfinite(before)
        product += float(np.sum(now[both] * before[both]))
        square += float(np.sum(now[both] ** 2 + before[both] ** 2)) / 2
        pairs += int(both.sum())
    return (product / square if square > 0 else float("nan")), pairs


def _whitened(one: Scored) -> Array:
    """Innovations divided by their standard deviations."""
    variance = np.diagonal(one.innovation_cov, axis1=1, axis2=2)
    with np.errstate(all="ignore"):
        scaled: Array = one.innovation / np.sqrt(variance)
    return scaled

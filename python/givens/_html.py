"""Estimates as a notebook shows them."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from givens.estimates import Estimates

__all__ = ["estimates_html"]

_SHOWN = 6


def estimates_html(one: Estimates) -> str:
    """A table of the first and the last rows, and what the run says of itself."""
    header = "".join(f"<th>{escape(name)}</th>" for name in ("time", *one.state, "NIS"))
    kept = range(len(one)) if len(one) <= 2 * _SHOWN else [*range(_SHOWN), -1, *range(len(one) - _SHOWN, len(one))]
    gap = f"<tr><td colspan='{len(one.state) + 2}'>⋮</td></tr>"
    body = "".join(gap if k < 0 else _row(one, k) for k in kept)
    kind = "smoothed" if one.is_smoothed else "filtered"
    words = (
        f"{len(one)} rows, {kind} by {one.method}; log-likelihood {one.total_log_likelihood:.4f}; {one.consistency()}"
    )
    failed = f"<p><b>{escape(str(one.failed))}</b></p>" if one.failed is not None else ""
    return f"<table><thead><tr>{header}</tr></thead><tbody>{body}</tbody></table><p>{escape(words)}</p>{failed}"


def _row(one: Estimates, k: int) -> str:
    std = one.std[k]
    cells = [f"{mean:.6g} ± {std[i]:.2g}" for i, mean in enumerate(one.mean[k])]
    time = str(one.time[k]) if one.time.dtype.kind == "M" else f"{one.time[k]:.6g}"
    nis = "" if np.isnan(one.nis[k]) else f"{one.nis[k]:.3g}"
    return "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in (time, *cells, nis)) + "</tr>"

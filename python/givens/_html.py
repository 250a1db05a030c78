"""Models, estimates and listings as a notebook shows them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import partial
from html import escape
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from givens.batch import Batch
    from givens.estimates import Estimates
    from givens.gaussian import Gaussian

__all__ = ["batch_html", "estimates_html", "fields_html", "gaussian_html", "listing_html"]

_SHOWN = 6


def estimates_html(one: Estimates) -> str:
    """A table of the first and the last rows, and what the run says of itself."""
    table = _table(("time", *one.state, "NIS"), len(one), lambda k: _row(one, k))
    kind = "smoothed" if one.is_smoothed else "filtered"
    words = (
        f"{len(one)} rows, {kind} by {one.method}; log-likelihood {one.total_log_likelihood:.4f}; {one.consistency()}"
    )
    words += _beyond([one])
    failed = f"<p><b>{escape(str(one.failed))}</b></p>" if one.failed is not None else ""
    return f"{table}<p>{escape(words)}</p>{failed}"


def batch_html(batch: Batch) -> str:
    """A table of the first and the last tracks, and what they say together."""
    table = _table(("track", "rows", "from", "to", "log-likelihood", "NIS / dof", ""), len(batch), partial(_run, batch))
    rows, total = sum(map(len, batch)), float(np.sum(batch.total_log_likelihood))
    words = f"{len(batch)} tracks, {rows} rows, {len(batch.failed)} failed; log-likelihood {total:.4f}; "
    return f"{table}<p>{escape(words + str(batch.consistency()) + _beyond(batch))}</p>"


def _beyond(runs: Iterable[Estimates]) -> str:
    """How many rows were not taken in."""
    gated = sum(int(np.count_nonzero(one.gated)) for one in runs)
    return f"; {gated} rows beyond the gate" if gated else ""


def gaussian_html(one: Gaussian) -> str:
    """A table of means and standard deviations, with correlations where there are any."""
    n, std = len(one), one.std
    known = np.where(std > 0, std, 1.0)
    correlation = one.cov / np.outer(known, known)
    related = bool((correlation - np.diag(np.diag(correlation))).any())
    header = ("", "mean", "std", *(f"corr. {j}" for j in range(n - 1) if related))

    def cells(i: int) -> list[str]:
        below = [f"{correlation[i, j]:.3g}" if j < i else "" for j in range(n - 1) if related]
        return [str(i), f"{one.mean[i]:.6g}", f"{std[i]:.3g}", *below]

    return _table(header, n, cells)


def listing_html(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table of all rows."""
    return _table(header, len(rows), lambda k: rows[k], len(rows))


def fields_html(name: str, fields: Sequence[tuple[str, str]]) -> str:
    """What a model is made of: one line for each field that has a value."""
    rows = "".join(f"<tr><th>{escape(key)}</th><td>{escape(value)}</td></tr>" for key, value in fields if value)
    return f"<table><caption>{name}</caption>{rows}</table>"


def _table(header: Sequence[str], rows: int, cells: Callable[[int], Iterable[str]], ends: int = _SHOWN) -> str:
    """A table of the first and the last rows."""
    head = "".join(f"<th>{escape(name)}</th>" for name in header)
    kept = range(rows) if rows <= 2 * ends else [*range(ends), -1, *range(rows - ends, rows)]
    gap = f"<td colspan='{len(header)}'>⋮</td>"
    lines = (gap if k < 0 else "".join(f"<td>{escape(cell)}</td>" for cell in cells(k)) for k in kept)
    body = "".join(f"<tr>{line}</tr>" for line in lines)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _run(batch: Batch, k: int) -> Iterable[str]:
    one = batch[k]
    ends = [_time(one, at) for at in (0, -1)] if len(one) else ["", ""]
    ratio = one.consistency().ratio
    failed = f"failed at row {one.failed.row}" if one.failed is not None else ""
    nis = "" if np.isnan(ratio) else f"{ratio:.3f}"
    return str(batch.track_ids[k]), str(len(one)), *ends, f"{one.total_log_likelihood:.4f}", nis, failed


def _time(one: Estimates, k: int) -> str:
    return str(one.time[k]) if one.time.dtype.kind == "M" else f"{one.time[k]:.6g}"


def _row(one: Estimates, k: int) -> Iterable[str]:
    std = one.std[k]
    cells = [f"{mean:.6g} ± {std[i]:.2g}" for i, mean in enumerate(one.mean[k])]
    nis = "" if np.isnan(one.nis[k]) else f"{one.nis[k]:.3g}"
    return _time(one, k), *cells, nis

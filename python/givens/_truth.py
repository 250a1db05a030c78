"""True states beside estimates."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from givens._arrays import Array, shape_error, unmasked
from givens._capsules import framed
from givens._frames import numbers_by_name
from givens.errors import InputError

if TYPE_CHECKING:
    from givens.estimates import Estimates

__all__ = ["truth_of", "truths_of"]


def truth_of(one: Estimates, truth: Any, argument: str = "truth") -> Array:
    """True states of the rows of a run; those behind its failure are left out."""
    known = numbers_by_name("truth", framed("truth", truth), one.state, "state")
    rows, n = one.__dict__["_rows"], len(one.state)
    if known.shape == (rows,) and n == 1:
        known = known.reshape(-1, 1)
    if known.shape not in ((rows, n), (len(one), n)):
        remedy = f"one row for each row of the estimates, one column for each of {', '.join(one.state)}"
        if known.shape == (n, rows):
            remedy = f"rows are times: {argument}={argument}.T"
        raise shape_error(argument, known.shape, f"({rows}, {n})", remedy)
    return known[: len(one)]


def truths_of(runs: Sequence[Estimates], truth: Any) -> list[Array]:
    """Of each track."""
    each = list(unmasked(truth)) if hasattr(truth, "__len__") else [truth]
    if len(each) != len(runs):
        states = f", {len(runs[0].state)}" if runs else ""
        raise InputError(
            f"`truth` is of {len(each)} tracks, not {len(runs)}",
            argument="truth",
            remedy=f"give one for each: a list, or an array of shape ({len(runs)}, rows{states})",
        )
    return [truth_of(one, true, f"truth[{k}]") for k, (one, true) in enumerate(zip(runs, each, strict=True))]

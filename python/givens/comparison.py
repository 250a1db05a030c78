"""Several methods over the same data."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt

from givens import _native
from givens._arrays import Array
from givens._capsules import framed
from givens._doubts import about
from givens._names import known_name
from givens._scalars import mapping, shown
from givens._truth import truth_of, truths_of
from givens.batch import Batch
from givens.consistency import Consistency, consistency_of
from givens.errors import InputError, MethodError, StepError, TraceError
from givens.estimates import Estimates
from givens.gaussian import Gaussian
from givens.registry import methods as methods_of
from givens.running import filter

__all__ = ["Compared", "Comparison", "compare"]

#: Seconds of a run that is timed again.
_QUICK = 0.2


@dataclass(frozen=True, eq=False)
class Compared:
    """How one method fared.

    Attributes
    ----------
    method : str
    seconds_per_row : float
        Of the whole call; the best of three if it is quick.
    rows : int
        Rows that it finished.
    log_likelihood : float
        Of all rows that it finished, as `consistency`: not to be compared with that of a method that finished others.
    consistency : Consistency
    rmse : ndarray, shape (n,), or None
        Of each state, against the truth: over the rows that all methods finished, but for those that finished none.
    nees : float or None
        Mean NEES for each degree of freedom: 1 of a filter that is right.
    failed : list of StepError or MethodError
        A `MethodError` of a method that does not go with the model, which has not run at all.
    estimates : Estimates or Batch
    scored : int
        Rows over which `rmse` and `nees` are taken.
    """

    method: str
    seconds_per_row: float
    rows: int
    log_likelihood: float
    consistency: Consistency
    rmse: Array | None
    nees: float | None
    failed: list[StepError | InputError]
    estimates: Estimates | Batch | None
    scored: int = 0


class Comparison(list[Compared]):
    """Methods side by side, shown as a table."""

    state: tuple[str, ...] = ()

    def rows(self) -> list[dict[str, Any]]:
        """The table, one dict for each method."""
        table = []
        scored = any(one.rmse is not None for one in self)
        for one in self:
            row: dict[str, Any] = {"method": one.method, "rows": one.rows, "failed": len(one.failed)}
            row |= {"log-likelihood": one.log_likelihood, "NIS/dof": one.consistency.ratio}
            verdict = one.consistency.verdict if one.estimates is not None else "not run"
            row |= {"verdict": verdict, "µs/row": 1e6 * one.seconds_per_row}
            if scored:
                row["rows scored"] = one.scored
                # a method that has not run has no errors
                rmse = np.full(len(self.state), np.nan) if one.rmse is None else one.rmse
                row |= {f"{name} RMSE": value for name, value in zip(self.state, rmse, strict=True)}
                row["NEES/dof"] = float("nan") if one.nees is None else one.nees
            table.append(row)
        return table

    def to_pandas(self) -> Any:
        """The table."""
        from givens._lazy import wanted

        return wanted("pandas").DataFrame(self.rows()).set_index("method")

    def _cells(self) -> list[list[str]]:
        table = self.rows()
        header = list(table[0]) if table else []
        shown = [[f"{v:.4g}" if isinstance(v, float) else str(v) for v in row.values()] for row in table]
        return [header, *shown]

    def __repr__(self) -> str:
        cells = self._cells()
        widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
        first = [f"{line[0]:<{widths[0]}}" for line in cells] if widths else []
        rest = ["  ".join(f"{c:>{w}}" for c, w in zip(line[1:], widths[1:], strict=True)) for line in cells]
        return "\n".join(f"{name}  {others}" for name, others in zip(first, rest, strict=False))

    def _repr_html_(self) -> str:
        from givens._html import listing_html

        header, *body = self._cells()
        return listing_html(header, body)


def compare(
    model: Any,
    sensors: Any,
    t: Any,
    z: Any = None,
    *,
    prior: Gaussian | Sequence[Gaussian] | Mapping[Any, Gaussian] | None = None,
    methods: Sequence[str],
    truth: npt.ArrayLike | None = None,
    options: Mapping[str, Mapping[str, Any]] | None = None,
    **common: Any,
) -> Comparison:
    """Runs several filters over the same data.

    Parameters
    ----------
    model, sensors, t, z, prior
        As for `filter`.
    methods : sequence of str
        Their names.
    truth : array_like, shape (rows, n), or (runs, rows, n), optional
        True states, NaN where they are not known; gives RMSE and NEES.
    options : mapping, optional
        Options of single methods: ``{"sr-ukf": {"kappa": 0}}``.
    **common
        Other arguments of `filter`, and options of all methods.

    Returns
    -------
    Comparison
        One entry for each method; a method that fails says so there; so does one that does not go with the model, if
        another one does.

    Raises
    ------
    InputError
        For arguments that cannot serve, and a name that no method has.

    Examples
    --------
    >>> import givens as gv
    >>> import numpy as np
    >>> model = gv.Transition(lambda t, dt, x: np.sin(x), noise_cov=[[0.1]], state=["x"])
    >>> sensor = gv.Sensor(lambda t, x: x**2, measures=["y"], std=[0.5])
    >>> prior = gv.Gaussian([1.0], std=[0.5])
    >>> drawn = gv.simulate(model, sensor, np.arange(50.0), prior=prior, seed=1)
    >>> table = gv.compare(model, sensor, drawn.t, drawn.z, prior=prior, methods=["ekf", "sr-ckf"], truth=drawn.x)
    >>> [(one.method, one.rows) for one in table]
    [('ekf', 50), ('sr-ckf', 50)]
    """
    options = mapping("options", options, 'options={"sr-ukf": {"kappa": 0}}')
    if isinstance(methods, str) or not isinstance(methods, Iterable) or not list(methods):
        raise InputError(f"`methods` is {shown(methods)}", argument="methods", remedy='write methods=["ekf", "sr-ckf"]')
    for name in methods:
        if not isinstance(name, str):
            raise InputError(
                f"`methods` holds {shown(name)}", argument="methods", remedy='write methods=["ekf", "sr-ckf"]'
            )
    for name in options:
        known_name("options", name, tuple(methods), "method among `methods`")
    # what lends its columns may do so only once
    t, z, truth = framed("t", t), framed("z", z), framed("truth", truth)
    found = Comparison()
    refused: InputError | None = None
    for name in methods:
        own = mapping("options", options.get(name), 'options={"sr-ukf": {"kappa": 0}}')
        arguments = {"prior": prior, "method": name, **common, **own}
        try:
            with about(name):
                run, seconds = _timed(model, sensors, t, z, arguments)
        except (MethodError, TraceError) as error:
            if not _of_method(name, error):
                raise
            refused = refused or error
            found.append(_refused(name, error))
            continue
        if seconds < _QUICK:
            # the first run has prepared the model's derivatives for all that follow
            with about(None):
                seconds = min(seconds, *(_timed(model, sensors, t, z, arguments)[1] for _ in range(2)))
        found.append(_compared(name, run, seconds))
        found.state = run.state
    if refused is not None and all(one.estimates is None for one in found):
        raise refused
    if truth is not None:
        found[:] = _scored(found, truth)
    return found


def _of_method(name: str, error: InputError) -> bool:
    """Whether an error is of a method that exists and does not go with the model; of its options it is the user's."""
    known = {word for method in methods_of() for word in (method.name, *method.aliases)}
    return name in known and (isinstance(error, TraceError) or getattr(error, "option", None) is None)


def _refused(name: str, error: InputError) -> Compared:
    nan = float("nan")
    return Compared(name, nan, 0, nan, consistency_of([]), None, None, [error], None)


def _timed(model: Any, sensors: Any, t: Any, z: Any, arguments: Mapping[str, Any]) -> tuple[Estimates | Batch, float]:
    """A run as far as it goes, and the seconds it took, without those that it was looked at for doubts."""
    _native.looked_for()
    begun = perf_counter()
    try:
        run: Estimates | Batch = filter(model, sensors, t, z, **arguments)
    except StepError as error:
        run = error.finished
    seconds = perf_counter() - begun
    return run, seconds - _native.looked_for()


def _compared(name: str, run: Estimates | Batch, seconds: float) -> Compared:
    each = _each(run)
    rows = sum(map(len, each))
    failed: list[StepError | InputError] = [one.failed for one in each if one.failed is not None]
    total = float(sum(one.total_log_likelihood for one in each))
    return Compared(name, seconds / max(rows, 1), rows, total, consistency_of(each), None, None, failed, run)


def _each(run: Estimates | Batch) -> list[Estimates]:
    return list(run) if isinstance(run, Batch) else [run]


def _scored(table: Sequence[Compared], truth: Any) -> list[Compared]:
    """With errors against the truth, all of them over the same rows: those that no method lacks."""
    runs = [one.estimates for one in table if one.estimates is not None]
    finished = [[len(one) for one in _each(run)] for run in runs if any(map(len, _each(run)))]
    rows = np.min(finished, axis=0).tolist() if finished else []
    return [
        one if one.estimates is None else replace(one, **_accuracy(one.estimates, truth, rows if one.rows else []))
        for one in table
    ]


def _accuracy(run: Estimates | Batch, truth: Any, rows: Sequence[int]) -> dict[str, Any]:
    """Over the first `rows` of each track."""
    each = _each(run)
    known = truths_of(each, truth) if isinstance(run, Batch) else [truth_of(each[0], truth)]
    rows = rows or [0] * len(each)

    def first(arrays: Iterable[Array], *shape: int) -> Array:
        return np.concatenate([np.empty((0, *shape)), *(array[:k] for array, k in zip(arrays, rows, strict=True))])

    n = len(run.state)
    mean, cov = first((one.mean for one in each), n), first((one.cov for one in each), n, n)
    found = _native.accuracy(mean, cov, first(known, n))
    nees = found["nees"] / found["nees_dof"] if found["nees_dof"] else float("nan")
    return {"rmse": found["rmse"], "nees": nees, "scored": max(found["rows"], default=0)}

"""Monte-Carlo studies: many runs of simulated trajectories, in parts that can be sent elsewhere."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from inspect import signature
from itertools import pairwise
from typing import Any, ParamSpec, TypeVar

import numpy as np

from givens import _native
from givens._arrays import Array
from givens._join import join
from givens._lazy import wanted
from givens._method import choose
from givens._names import known_name
from givens._plan import read_prior, with_parameters
from givens._scalars import MOST_RUNS, mapping, seed_of, shown, threads_of, whole
from givens._sent import Sent
from givens.batch import Batch
from givens.errors import GivensError, InputError, StepError
from givens.gaussian import Gaussian
from givens.running import filter, smooth
from givens.simulation import simulate

__all__ = ["Study", "study"]

_P = ParamSpec("_P")
_R = TypeVar("_R")

#: Runs that are simulated and estimated at once.
_TOGETHER = 256


class Study(Sent):
    """Runs of a simulated experiment, each by several methods: ``study(range(100))`` gives a table of a hundred.

    A run is drawn from a stream of its own, keyed by the seed and its number, so that its row is the same to the bit
    whatever runs stand beside it, on whatever machine of one instruction set. A study is small and can be pickled.
    Where it has come by pickle it computes on one thread, unless it was made with `threads`.

    Attributes
    ----------
    methods : tuple of str
    runs : int
        How many there are.
    seed : int
    """

    _word = "study"
    #: Some engines ask what they call for its name.
    __name__ = "study"

    def __init__(
        self,
        model: Any,
        sensors: Any,
        t: Any,
        *,
        prior: Gaussian,
        methods: Sequence[str],
        runs: int,
        seed: int,
        goal: str = "filter",
        params: Mapping[str, Any] | None = None,
        options: Mapping[str, Mapping[str, Any]] | None = None,
        threads: int | None = None,
        substeps: int = 16,
        **common: Any,
    ) -> None:
        if goal not in ("filter", "smooth"):
            raise InputError(f"`goal` is {shown(goal)}", argument="goal", remedy="one of 'filter', 'smooth'")
        if "lag" in common:
            raise InputError(
                "`lag` is given to a study, whose smoothers see all rows",
                argument="lag",
                remedy="leave it out, or call gv.smooth(…, lag=…) with what gv.simulate gives",
            )
        named = isinstance(methods, Sequence) and not isinstance(methods, str) and len(methods) > 0
        if not named or not all(isinstance(name, str) for name in methods) or len(set(methods)) < len(methods):
            raise InputError(
                f"`methods` is {shown(methods)}",
                argument="methods",
                remedy='write methods=["ekf", "sr-ckf"], each once',
            )
        self._model, self._sensors = with_parameters(model, sensors, mapping("params", params, "params={name: value}"))
        self._t, self._prior, self._goal = np.array(t), prior, goal
        own_options = mapping("options", options, 'options={"sr-ukf": {"kappa": 0}}')
        for name in own_options:
            known_name("options", name, tuple(methods), "method among `methods`")
        self._options = {name: dict(mapping("options", own, "options={…}")) for name, own in own_options.items()}
        self._common, self._substeps = dict(common), whole("substeps", substeps, 1)
        self.methods, self.runs, self.seed = tuple(methods), whole("runs", runs, 1, MOST_RUNS), seed_of(seed)
        self._asked = threads_of(threads)
        joined = join(self._model, self._sensors)
        self.state = joined.states
        read_prior(self._model, prior, joined.states)
        for name in self.methods:
            beside = {key: value for key, value in self._common.items() if key not in ("u", "t0")}
            choose(self._model, joined, name, {**beside, **self._options.get(name, {})})

    def ranges(self, parts: int) -> list[range]:
        """The runs in so many parts."""
        parts = min(whole("parts", parts, 1), self.runs)
        bounds = [self.runs * k // parts for k in range(parts + 1)]
        return [range(*bound) for bound in pairwise(bounds)]

    def __call__(self, runs: Any = None) -> Any:
        """Does some of the runs; without an argument all of them.

        Parameters
        ----------
        runs : range, sequence of int, or a table with the column ``run`` or ``id``
            Their numbers, from 0.

        Returns
        -------
        pyarrow.Table
            A row for each run and method: ``run``, ``method``, ``rows`` that were finished, ``rmse_…`` of each state,
            ``nees`` and ``nis`` for each degree of freedom, ``log_likelihood``, and ``error`` of a run that failed.
        """
        arrow = wanted("pyarrow")
        found: dict[str, list[Any]] = {name: [] for name, _ in self._columns()}
        for first, count in _stretches(self._numbers(runs)):
            for start in range(first, first + count, _TOGETHER):
                for row in self._some(start, min(_TOGETHER, first + count - start)):
                    for name, column in found.items():
                        column.append(row[name])
        kinds = {int: arrow.int64(), float: arrow.float64(), str: arrow.string()}
        schema = arrow.schema([(name, kinds[kind]) for name, kind in self._columns()])
        return arrow.table(found, schema=schema)

    def _columns(self) -> list[tuple[str, type]]:
        errors = [(f"rmse_{name}", float) for name in self.state]
        scores = [("nees", float), ("nis", float), ("log_likelihood", float), ("error", str)]
        return [("run", int), ("method", str), ("rows", int), *errors, *scores]

    def _numbers(self, runs: Any) -> list[int]:
        if runs is None:
            runs = range(self.runs)
        if hasattr(runs, "columns") and hasattr(runs, "__arrow_c_stream__"):
            runs = wanted("pyarrow").table(runs)
        names = getattr(runs, "column_names", None)
        if names is not None:
            column = next((name for name in ("run", "id") if name in names), None)
            if column is None:
                raise InputError(
                    "the table has no column `run`",
                    argument="runs",
                    remedy="name the column of the runs' numbers `run`",
                )
            runs = runs[column].to_pylist()
        if isinstance(runs, (str, bytes)) or not isinstance(runs, Iterable):
            raise InputError(f"`runs` is {shown(runs)}", argument="runs", remedy="give their numbers: range(100)")
        return [whole("runs", run, 0, self.runs - 1) for run in runs]

    def _some(self, first: int, count: int) -> list[dict[str, Any]]:
        """The rows of runs that follow each other. What is raised in one is told there, and costs no other."""
        try:
            return self._together(first, count)
        except InputError:
            raise
        except Exception as error:
            if count > 1:
                half = count // 2
                return [*self._some(first, half), *self._some(first + half, count - half)]
            said = error.message if isinstance(error, GivensError) else f"{type(error).__name__}: {error}"
            nothing = {name: None for name, _ in self._columns()}
            said = f"simulation: {said}" if isinstance(error, GivensError) else f"raised: {said}"
            return [{**nothing, "run": first, "method": name, "rows": 0, "error": said} for name in self.methods]

    def _together(self, first: int, count: int) -> list[dict[str, Any]]:
        place = {name: self._common[name] for name in ("u", "t0") if name in self._common}
        drawn = simulate(
            self._model,
            self._sensors,
            self._t,
            prior=self._prior,
            seed=self.seed,
            runs=count,
            first_run=first,
            substeps=self._substeps,
            threads=self.threads,
            **place,
        )
        batches: list[Any] = []
        for name in self.methods:
            run = filter if self._goal == "filter" else smooth
            own = {**self._common, **self._options.get(name, {})}
            own = {"prior": self._prior, "method": name, "threads": self.threads, **own}
            batches.append(run(self._model, self._sensors, drawn.t, drawn.z, **own))
        return [
            {"run": first + k, "method": name, **self._scores(batch, k, drawn.x[k])}
            for k in range(count)
            for name, batch in zip(self.methods, batches, strict=True)
        ]

    def _scores(self, batch: Batch, k: int, truth: Array) -> dict[str, Any]:
        one = batch[k]
        made = len(one)
        score = _native.accuracy(one.mean, one.cov, truth[:made])
        spread = one.consistency()
        nees = score["nees"] / score["nees_dof"] if score["nees_dof"] else None
        return {
            "rows": made,
            **{f"rmse_{name}": float(rmse) for name, rmse in zip(self.state, score["rmse"], strict=True)},
            "nees": nees,
            "nis": float(spread.ratio) if made else None,
            "log_likelihood": float(one.total_log_likelihood),
            "error": None if one.failed is None else _said(one.failed, k),
        }

    @staticmethod
    def summary(tables: Any) -> dict[str, dict[str, Any]]:
        """For each method: how many runs, how many of them failed, and the mean and its standard error of each number.

        Parameters
        ----------
        tables : pyarrow.Table or list of them
            What calls have given, in any order. Runs that failed count in ``failed`` alone.
        """
        arrow = wanted("pyarrow")
        if isinstance(tables, (list, tuple)) and not tables:
            raise InputError("`tables` is empty", argument="tables", remedy="give what calls of a study have given")
        table = arrow.concat_tables(tables) if isinstance(tables, (list, tuple)) else tables
        # sums do not depend on how the runs were cut
        if "run" not in getattr(table, "column_names", ()):
            raise InputError("this is no table of a study", argument="tables", remedy="give what its calls have given")
        table = table.sort_by([("run", "ascending"), ("method", "ascending")])
        found: dict[str, dict[str, Any]] = {}
        methods = np.array(table["method"].to_pylist(), dtype=object)
        wrong = np.array(table["error"].is_valid())
        numbers = [name for name in table.column_names if name not in ("run", "method", "rows", "error")]
        runs = table["run"].to_numpy()
        for method in dict.fromkeys(methods):
            of = methods == method
            # a part that was done twice counts once
            of[np.flatnonzero(of)[1:]] = np.diff(runs[of]) > 0
            one: dict[str, Any] = {"runs": int(of.sum()), "failed": int((of & wrong).sum())}
            for name in numbers:
                values = table[name].to_numpy()[of & ~wrong].astype(float)
                values = values[~np.isnan(values)]
                mean = float(values.mean()) if len(values) else float("nan")
                error = float(values.std(ddof=1) / np.sqrt(len(values))) if len(values) > 1 else float("nan")
                one[name] = (mean, error)
            found[method] = one
        return found

    def __repr__(self) -> str:
        return f"Study({self.runs} runs, seed={self.seed}, methods={list(self.methods)})"


def _signed_as(made: Callable[_P, _R]) -> Callable[[Callable[..., _R]], Callable[_P, _R]]:
    """A function that hands on all that it is given, with the signature of what it hands it to."""

    def signed(function: Callable[..., _R]) -> Callable[_P, _R]:
        vars(function)["__signature__"] = signature(made)
        return function

    return signed


@_signed_as(Study)
def study(*given: Any, **named: Any) -> Study:
    """Describes a Monte-Carlo study; nothing is computed yet.

    Parameters
    ----------
    model, sensors, t
        As for `simulate`.
    prior : Gaussian
        The true state at the beginning is drawn from it, and every method begins in it.
    methods : sequence of str
        Their names.
    runs : int
        How many.
    seed : int
        Equal seeds give equal runs.
    goal : str
        ``"filter"`` or ``"smooth"``.
    params : mapping, optional
        Values of parameters by name.
    options : mapping, optional
        Options of single methods: ``{"sr-ukf": {"kappa": 0}}``.
    threads : int, optional
        By default as many as there are cores, and one where the study has come by pickle.
    substeps : int, optional
        As for `simulate`.
    **common
        `u` and `t0` as for `simulate`, and options of all methods.

    Examples
    --------
    >>> import givens as gv
    >>> model = gv.Transition(lambda t, dt, x: x, noise_cov=[[0.1]], state=["x"])
    >>> sensor = gv.Sensor(lambda t, x: x, measures=["z"], std=[1.0])
    >>> prior = gv.Gaussian([0], std=[1])
    >>> study = gv.study(model, sensor, range(20), prior=prior, methods=["sr-ckf", "ekf"], runs=100, seed=1)
    >>> parts = [study(part) for part in study.ranges(4)]  # anywhere
    >>> sorted(study.summary(parts)["ekf"])
    ['failed', 'log_likelihood', 'nees', 'nis', 'rmse_x', 'runs']
    """
    return Study(*given, **named)


def _said(failed: StepError, track: int) -> str:
    """A failure, without its place among the runs that were computed together."""
    words = failed.message.removeprefix(f"track {track}, ")
    return f"{failed.fault}: {words}" + (f"; {failed.remedy}" if failed.remedy else "")


def _stretches(numbers: Sequence[int]) -> list[tuple[int, int]]:
    """Numbers that follow each other, as first ones and counts."""
    found: list[tuple[int, int]] = []
    for number in numbers:
        if found and number == sum(found[-1]):
            found[-1] = (found[-1][0], found[-1][1] + 1)
        else:
            found.append((number, 1))
    return found

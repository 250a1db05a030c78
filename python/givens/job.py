"""Runs over tables of many tracks, as objects that can be sent to where the tables are."""

from __future__ import annotations

import hashlib
import json
import os
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from givens import _native
from givens._doubts import warn
from givens._join import Joined, join
from givens._lazy import wanted
from givens._method import choose
from givens._plan import Goal, read_prior, with_parameters
from givens._scalars import mapping, shown, text, threads_of, whole
from givens._sent import Sent, sendable
from givens.errors import GivensError, InputError
from givens.gaussian import Gaussian
from givens.model_file import ModelFile

__all__ = ["BatchJob", "FailedTrack", "FileJob", "Summary", "split_errors"]

#: So many doubts about one table are told.
_DOUBTS = 3
_LAYOUTS = ("wide", "covariances", "tidy")
_FORMATS = ("parquet", "csv", "jsonl")


class FailedTrack(NamedTuple):
    """A track that failed."""

    #: Its name; None for a row that names none, and in a table without tracks.
    track_id: str | None
    #: When, as its table gives times; None where its rows were wrong, or it could not begin.
    time: str | None
    #: In a word: that of `StepError.fault`, or input, beginning, raised.
    reason: str
    #: In words, with the row of the table, counted from one, and the remedy.
    message: str
    #: The file that it stands in, of a run over files.
    file: str | None = None


@dataclass(frozen=True)
class Summary:
    """What came of tables, of one or of many: ``sum(summaries, Summary())``."""

    tracks: int = 0
    rows: int = 0
    log_likelihood: float = 0.0
    failed: tuple[FailedTrack, ...] = ()
    #: Of computing, on all threads; those of several tables are added.
    seconds: float = 0.0
    files: int = 0

    def __radd__(self, other: object) -> Summary:
        # `sum` begins with 0
        return self if other == 0 else NotImplemented

    def __add__(self, other: Summary) -> Summary:
        if not isinstance(other, Summary):
            return NotImplemented
        return Summary(
            self.tracks + other.tracks,
            self.rows + other.rows,
            self.log_likelihood + other.log_likelihood,
            self.failed + other.failed,
            self.seconds + other.seconds,
            self.files + other.files,
        )

    @property
    def reasons(self) -> dict[str, int]:
        """How many tracks failed for which reason."""
        return dict(Counter(track.reason for track in self.failed))

    @property
    def rows_per_second(self) -> float:
        """Rows in a second of one process."""
        return self.rows / self.seconds if self.seconds > 0 else float("nan")

    def __str__(self) -> str:
        reasons = ", ".join(f"{count} {reason}" for reason, count in self.reasons.items())
        return (
            f"{self.rows} rows of {self.tracks} tracks, {len(self.failed)} failed"
            + (f" ({reasons})" if reasons else "")
            + f", log-likelihood {self.log_likelihood:.3f}, {self.rows_per_second:.0f} rows a second of a process"
        )


class _Stream:
    """What lends a stream of record batches, once."""

    def __init__(self, capsule: object) -> None:
        self._capsule = capsule

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        return self._capsule


class BatchJob(Sent):
    """A filter or a smoother over tables of tracks: ``job(table)`` gives the table of the answers.

    Jobs are made by `Sde.batch_job`, `Transition.batch_job` and `ModelFile.batch_job`. They are small and can be
    pickled, so that Ray, Dask, Spark or `multiprocessing` may send them to tables on other machines: a file, or a
    group of rows, that holds whole tracks. The answers of a track do not depend on the rows beside it, to the bit.

    Where a job has come by pickle it computes on one thread, unless it was made with `threads`: engines run one task
    for each core. Elsewhere it takes all cores.

    Attributes
    ----------
    goal : str
        ``"filter"`` or ``"smooth"``.
    output : str
        ``"wide"``, ``"covariances"`` or ``"tidy"``.
    threads : int or None
        How many it computes on; None is all cores.

    Examples
    --------
    >>> import givens as gv
    >>> import pyarrow as pa
    >>> model = gv.Transition(lambda t, dt, x: x, noise_cov=lambda t, dt: [[dt]], state=["x"])
    >>> sensor = gv.Sensor(lambda t, x: x, measures=["z"], std=[1.0])
    >>> job = model.batch_job(sensor, prior=gv.Gaussian([0], std=[10]), goal="smooth")
    >>> job(pa.table({"track_id": [7, 7, 8], "time": [0.0, 1.0, 0.0], "z": [1.0, 2.0, 5.0]})).column_names
    ['time', 'track_id', 'x', 'x_std', 'nis', 'nis_dof', 'log_likelihood', 'error']
    """

    _word = "job"
    #: Some engines ask what they call for its name.
    __name__ = "batch_job"

    def __init__(
        self,
        model: Any,
        sensors: Any,
        *,
        prior: Gaussian | Callable[[Any, Any], Gaussian] | None = None,
        goal: str = "filter",
        lag: int | None = None,
        method: str | None = None,
        output: str = "wide",
        t0: float | None = None,
        params: Mapping[str, Any] | None = None,
        threads: int | None = None,
        **options: Any,
    ) -> None:
        if output not in _LAYOUTS:
            raise InputError(
                f"`output` is {shown(output)}", argument="output", remedy=f"one of {', '.join(map(repr, _LAYOUTS))}"
            )
        if goal not in ("filter", "smooth"):
            raise InputError(f"`goal` is {shown(goal)}", argument="goal", remedy="one of 'filter', 'smooth'")
        if lag is not None and goal == "filter":
            raise InputError("`lag` is given to a filter", argument="lag", remedy='write goal="smooth"')
        if t0 is not None and isinstance(model, ModelFile):
            raise InputError(
                "`t0` is given beside a model file, which says itself when its belief holds",
                argument="t0",
                remedy="write `time` into [state] of the file",
            )
        self._model, self._sensors = with_parameters(model, sensors, mapping("params", params, "params={name: value}"))
        self._prior, self._t0, self._method, self._options = prior, _start(t0), method, dict(options)
        self.goal, self.output = goal, output
        self._lag = None if lag is None else whole("lag", lag)
        self._asked = threads_of(threads)
        self._made: tuple[Joined, _native.Choice] | None = None
        self._ready()

    def _ready(self) -> tuple[Joined, _native.Choice]:
        if self._made is None:
            joined = join(self._model, self._sensors)
            choice = choose(self._model, joined, self._method, self._options)
            if not callable(self._prior) and not (self._prior is None and isinstance(self._model, ModelFile)):
                read_prior(self._model, self._prior, joined.states)
            _refuse_names(joined.states, self.output)
            self._made = joined, choice
        return self._made

    def __getstate__(self) -> dict[str, Any]:
        return {**super().__getstate__(), "_made": None, "_prior": sendable("prior", self._prior)}

    def __call__(self, table: Any) -> Any:
        """The answers of a table, as a `pyarrow.Table`.

        Parameters
        ----------
        table : pyarrow.Table, pyarrow.RecordBatch, or whatever has ``__arrow_c_stream__``; or the path of a file
            With the columns ``time``, one for each measure, and, if there are such, ``track_id``, ``sensor`` and
            ``u_…`` for controls. The rows of a track are all there, in order of time. Of a path, a CSV or a Parquet
            file.

        Returns
        -------
        pyarrow.Table
            The columns that the command ``givens`` writes, and ``error``: null but in a row for each track that failed,
            which stands behind the others and has its ``track_id``, the time if it can be told, and why. `split_errors`
            takes them apart.

        Raises
        ------
        InputError
            For a table that has not the columns of the model. What is wrong with a row or a step fails its track alone.
        """
        return self.run(table)[0]

    def run(self, table: Any) -> tuple[Any, Summary]:
        """The answers of a table as `__call__` gives them, and what there is to say of them."""
        arrow = wanted("pyarrow")
        capsule, summary = self._answers(self._read(table))
        return arrow.table(_Stream(capsule)), summary

    def into(self, folder: str | os.PathLike[str], *, format: str | None = None, resume: bool = False) -> FileJob:
        """The same for files: ``job.into("answers")(path)`` writes ``answers/NAME`` and gives its `Summary`.

        Parameters
        ----------
        folder : path
            Where the answers go; it is made if it is not there.
        format : str, optional
            ``"parquet"``, ``"csv"`` or ``"jsonl"``; by default that of each file.
        resume : bool
            Whether a file whose answers are there, by the same job from the same rows, is left out: its summary is the
            one of then, which is kept in ``answers/_summaries``.
        """
        return FileJob(self, folder, format, resume)

    def _names(self) -> Any:
        """What a native table knows of the model; a model file knows it by itself."""
        joined, _ = self._ready()
        if isinstance(self._model, ModelFile):
            return None
        sensors = [(name, list(joined.measures[place])) for name, place in joined.sensors.items()]
        controls = [f"u_{name}" for name in joined.controls]
        step = getattr(self._model, "step", None)
        return list(joined.states), controls, sensors, self._t0, step, self._fingerprint()

    def _fingerprint(self) -> str:
        joined, _ = self._ready()
        parts = [part for part, _ in (*joined.motion, *joined.measuring)]
        said = [
            (part.argument, [] if part.traced is None else (part.traced.tape.instructions, part.traced.nodes))
            for part in parts
        ]
        values = joined.native.parameters.tolist()
        return hashlib.sha256(repr((joined.states, joined.measures, said, values)).encode()).hexdigest()[:16]

    def _identity(self) -> str:
        """Tells the job from others."""
        prior: Any = self._prior
        if isinstance(prior, Gaussian):
            prior = (prior.mean.tolist(), prior.cov.tolist())
        elif callable(prior):
            prior = f"{prior.__module__}.{getattr(prior, '__qualname__', type(prior).__qualname__)}"
        model = self._model
        if isinstance(model, ModelFile):
            of: Any = (model._text, sorted(model.parameters.items()))
        else:
            of = (self._fingerprint(), repr(self._model), repr(self._sensors))
        how = (self.goal, self._lag, self._method, sorted(self._options.items()), self.output, self._t0)
        return hashlib.sha256(repr((_native.VERSION, of, prior, how)).encode()).hexdigest()

    def _read(self, table: Any) -> _native.TrackTable:
        native, names = self._ready()[0].native, self._names()
        if isinstance(table, (str, os.PathLike)):
            return _native.TrackTable.read(native, _path("table", table), names)
        if not hasattr(table, "__arrow_c_stream__") and hasattr(table, "to_struct_array"):
            table = wanted("pyarrow").Table.from_batches([table])
        if not hasattr(table, "__arrow_c_stream__"):
            raise InputError(
                f"`table` is {type(table).__name__}, which lends no columns",
                argument="table",
                remedy="give a table of pyarrow, polars, pandas or duckdb, or the path of a file",
            )
        return _native.TrackTable.lent(native, table.__arrow_c_stream__(), names)

    def _answers(self, table: _native.TrackTable, path: str | None = None) -> tuple[object, Summary]:
        joined, choice = self._ready()
        goal = self._goal()
        prior, unbegun = self._priors(table, joined)
        capsule, said = table.answers(
            joined.native, choice, goal.word, goal.value, self.output, prior, unbegun, self.threads, path
        )
        answers = "" if path is None else f"answers in {path}: "
        doubts = [doubt for doubt in said["doubts"] if doubt[1]]
        warn((answers + doubt, grave) for doubt, grave in doubts[:_DOUBTS])
        failed = tuple(_failed(*track, file=path) for track in said["failed"])
        return capsule, Summary(said["tracks"], said["rows"], said["log_likelihood"], failed, said["seconds"], 1)

    def _goal(self) -> Goal:
        if self.goal == "filter":
            return Goal("filter")
        return Goal("interval") if self._lag is None else Goal("lag", float(self._lag))

    def _priors(self, table: _native.TrackTable, joined: Joined) -> tuple[Any, list[tuple[int, str]]]:
        """The beliefs in which the tracks begin, and those that have none."""
        if self._prior is None and isinstance(self._model, ModelFile):
            return None, []
        if not callable(self._prior):
            return read_prior(self._model, self._prior, joined.states), []
        n, unbegun = len(joined.states), []
        means, covs = np.zeros((len(table), n)), np.zeros((len(table), n, n))
        for k in range(len(table)):
            try:
                means[k], covs[k] = read_prior(self._model, self._prior(*table.track(k)), joined.states)
            except Exception as error:
                # what is wrong with one track must not end the task of all
                said = f"{type(error).__name__}: {error}"
                if isinstance(error, GivensError):
                    said = f"{error.message}; {error.remedy}" if error.remedy else error.message
                unbegun.append((k, f"its prior: {said}"))
        return (means, covs), unbegun

    def __repr__(self) -> str:
        method = self._method or getattr(self._model, "method", None)
        threads = f", threads={self.threads}" if self.threads is not None else ""
        came = " (it came by pickle)" if self._came and self._asked is None else ""
        named = f", method={method!r}" if method else ""
        return f"BatchJob({self.goal}{named}, output={self.output!r}{threads}{came})"


class FileJob:
    """A job over files: ``file_job(path)`` writes the answers of a file into a folder and gives its `Summary`.

    The file is written whole or not at all, and is byte for byte the one that ``givens filter FOLDER -o ANSWERS``
    writes with a model from a file. Tracks that failed have their finished rows in it, and stand in `Summary.failed`;
    the summary is kept in ``_summaries`` beside the answers.
    """

    #: Some engines ask what they call for its name.
    __name__ = "file_job"

    def __init__(self, job: BatchJob, folder: str | os.PathLike[str], format: str | None, resume: bool) -> None:
        if format is not None and format not in _FORMATS:
            raise InputError(
                f"`format` is {shown(format)}", argument="format", remedy=f"one of {', '.join(map(repr, _FORMATS))}"
            )
        if format in ("csv", "jsonl") and job.output != "wide":
            raise InputError(
                f"`output` is {job.output!r}, which is for Parquet", argument="format", remedy='write format="parquet"'
            )
        self.job, self.folder, self.format, self.resume = job, Path(_path("folder", folder)), format, resume

    def path(self, file: str | os.PathLike[str]) -> Path:
        """Where the answers of a file go: its own name, with the ending of the format."""
        name = Path(_path("file", file)).name
        if not name:
            raise InputError(f"`file` is {shown(file)}", argument="file", remedy="give the path of a file")
        stem, _, ending = name.rpartition(".")
        known = ending in _FORMATS and stem
        if known and self.format in (None, ending):
            return self.folder / name
        return self.folder / f"{stem if known else name}.{self.format or 'parquet'}"

    def __call__(self, file: str | os.PathLike[str]) -> Summary:
        """Writes the answers of a file.

        Raises
        ------
        InputError
            For a file that cannot be read, has not the columns of the model, or whose answers would stand in the place
            of others.
        OSError
            Where the answers cannot be written.
        """
        path, own = self.path(file), self._own(file)
        if path.exists() and os.path.exists(file) and path.samefile(file):
            raise InputError(
                f"`folder` is that of the data: {path} would be overwritten", argument="folder", remedy="name another"
            )
        kept = self.folder / "_summaries" / f"{path.name}.json"
        before = _kept(kept)
        if before is not None and path.exists() and before["file"] != own["file"]:
            raise InputError(
                f"{path} holds the answers of {before['file']}",
                argument="file",
                remedy="give the files different names, or name another folder",
            )
        written = path.stat().st_size if path.exists() else None
        if self.resume and before is not None and before == {**before, **own, "written": written}:
            failed = tuple(FailedTrack(*track) for track in before["failed"])
            tracks, rows, log_likelihood, seconds = before["sums"]
            return Summary(tracks, rows, log_likelihood, failed, seconds, 1)
        kept.parent.mkdir(parents=True, exist_ok=True)
        _, summary = self.job._answers(self.job._read(file), str(path))
        failed = tuple(track._replace(file=os.fspath(file)) for track in summary.failed)
        summary = Summary(summary.tracks, summary.rows, summary.log_likelihood, failed, summary.seconds, 1)
        sums = [summary.tracks, summary.rows, summary.log_likelihood, summary.seconds]
        said = {**own, "written": path.stat().st_size, "sums": sums, "failed": failed}
        partial = kept.with_name(f"{kept.name}.{os.getpid()}.partial")
        partial.write_text(json.dumps(said))
        partial.replace(kept)
        return summary

    def _own(self, file: str | os.PathLike[str]) -> dict[str, Any]:
        """Tells the rows and the job from others."""
        name = os.path.abspath(file)
        about = os.stat(file) if os.path.exists(file) else None
        state = None if about is None else [about.st_size, about.st_mtime_ns]
        return {"file": name, "state": state, "job": self.job._identity()}

    def __repr__(self) -> str:
        return f"FileJob({self.job!r}, {str(self.folder)!r})"


def _path(argument: str, path: Any) -> str:
    """A path as text."""
    if not isinstance(path, (str, os.PathLike)) or not isinstance(os.fspath(path), str):
        raise InputError(f"`{argument}` is {shown(path)}, not a path", argument=argument, remedy="give a path as text")
    return text(argument, os.fspath(path), "a path", "give a path as text", "give the file a name that is UTF-8")


def _kept(path: Path) -> dict[str, Any] | None:
    """What was written about answers before; None where it cannot be read."""
    try:
        found = json.loads(path.read_text())
    except (OSError, ValueError):
        return None
    whole = isinstance(found, dict) and {"file", "state", "job", "written", "sums", "failed"} <= set(found)
    return found if whole else None


def split_errors(table: Any) -> tuple[Any, Any]:
    """Takes the answers of a `BatchJob` apart: those of the rows, and the tracks that failed.

    Parameters
    ----------
    table : pyarrow.Table
        From one call, or from several below each other; or what another library has made of it.

    Returns
    -------
    (pyarrow.Table, pyarrow.Table)
        The answers without the column ``error``; and ``track_id``, if there is one, ``time``, ``reason``, ``error``.
    """
    compute = wanted("pyarrow.compute")
    table = _with_errors(table)
    wrong = compute.is_valid(table["error"])
    answers = table.filter(compute.invert(wrong)).drop_columns(["error"])
    failed = table.filter(wrong)
    words = compute.split_pattern(failed["error"], ": ", max_splits=1)
    if compute.any(compute.less(compute.list_value_length(words), 2)).as_py():
        raise InputError(
            f"the column `error` holds {shown(failed['error'][0].as_py())}, which is no reason of a job",
            argument="table",
            remedy="give the table of a job's answers as it is",
        )
    reasons, messages = (compute.list_element(words, k) for k in (0, 1))
    keys = [name for name in ("track_id", "time") if name in table.column_names]
    errors = failed.select(keys).append_column("reason", reasons).append_column("error", messages)
    return answers, errors


def _with_errors(table: Any) -> Any:
    """A `pyarrow.Table`, whatever the answers became on the way, with the column `error` as words."""
    arrow = wanted("pyarrow")
    remedy = "give the table of a job's answers; a file has none, and its failures stand in its Summary"
    if not isinstance(table, arrow.Table):
        lends = hasattr(table, "__arrow_c_stream__") or hasattr(table, "__arrow_c_array__")
        try:
            table = arrow.table(table) if lends else None
        except (arrow.ArrowException, TypeError, ValueError):
            table = None
        if table is None:
            raise InputError("`table` is no table of answers", argument="table", remedy=remedy)
    if table.column_names.count("error") != 1:
        found = "several columns" if "error" in table.column_names else "no column"
        raise InputError(f"the table has {found} `error`", argument="table", remedy=remedy)
    place = table.column_names.index("error")
    of = table.schema.field(place).type
    words = of.value_type if arrow.types.is_dictionary(of) else of
    if words not in (arrow.null(), arrow.string(), arrow.large_string(), arrow.string_view()):
        raise InputError(f"the column `error` holds {of}, not words", argument="table", remedy=remedy)
    column = table["error"]
    if arrow.types.is_dictionary(of):
        # a dictionary of string views, as those of polars, has no cast of its own
        words = [(chunk.indices, chunk.dictionary.cast(arrow.string())) for chunk in column.chunks]
        plain = [arrow.DictionaryArray.from_arrays(*of_chunk) for of_chunk in words]
        column = arrow.chunked_array(plain, arrow.dictionary(of.index_type, arrow.string()))
    return table.set_column(place, "error", column.cast(arrow.string()))


def _failed(track_id: str | None, time: str | None, said: str, file: str | None) -> FailedTrack:
    reason, _, message = said.partition(": ")
    return FailedTrack(track_id, time, reason, message, file)


def _start(t0: Any) -> float | None:
    if t0 is None:
        return None
    if isinstance(t0, bool) or not isinstance(t0, (int, float, np.integer, np.floating)) or not np.isfinite(t0):
        raise InputError(
            f"`t0` is {shown(t0)}",
            argument="t0",
            remedy="give seconds: of tables with dates, those after the first row of each track",
        )
    return float(t0)


def _refuse_names(states: Iterable[str], output: str) -> None:
    taken = ["time", "track_id", "sensor", "nis", "nis_dof", "log_likelihood", "gated", "error"]
    if output == "tidy":
        return
    if output == "covariances":
        taken.append("cov")
    names = list(states)
    count = Counter([*taken, *names, *(f"{name}_std" for name in names)])
    for name in names:
        if count[name] > 1:
            raise InputError(
                f"the state `{name}` and a column of the answers would be one",
                argument="output",
                component=name,
                remedy='name the state otherwise, or write output="tidy"',
            )

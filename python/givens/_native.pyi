"""The native half: flat functions and classes over arrays of float64; import `givens` instead.

Lengths: n states, d measures of all sensors together, c controls, K rows, q noises. Arrays may lie in memory as they
like; those that come back are row by row and cannot be written to. A missing measure is NaN. Wrong arguments raise
`givens.errors.InputError`, wrong methods `MethodError`, model files with errors `ModelError`, steps that fail `StepError`.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final, Literal, NotRequired, TypedDict, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "VERSION",
    "ArrowTable",
    "Choice",
    "Estimates",
    "Filter",
    "Function",
    "Graph",
    "Model",
    "TrackTable",
    "accuracy",
    "arrow_stream",
    "consistency",
    "looked_for",
    "methods",
    "options",
    "read_tracks",
    "run",
    "run_batch",
    "sample",
    "simulate",
]

VERSION: Final[str]

_Array = NDArray[np.float64]
_Kind = Literal["discrete", "continuous"]
_Column = Literal["number", "whole", "date", "zoned", "duration", "text", "other"]
# track, row, time, what is doubtful, how many rows are for that reason, and whether it is grave
_Doubt = tuple[int, int, float, str, int, bool]
_Goal = Literal["filter", "interval", "lag", "point"]
# states, columns of controls, sensors with their measures, when the prior holds, the length of a step, the model's sum
_Names = tuple[list[str], list[str], list[tuple[str, list[str]]], float | None, float | None, str]

class _SensorParts(TypedDict):
    name: str
    columns: list[str]
    measures: list[int] | Function
    angles: NotRequired[list[float | None]]
    std: NotRequired[list[int] | Function | None]
    cov: NotRequired[list[int] | Function | None]
    jacobian: NotRequired[Function | None]

class _Sensor(TypedDict):
    name: str
    columns: list[str]
    angles: list[float | None]

class _Entry(TypedDict):
    name: str
    aliases: list[str]
    about: str
    kind: _Kind
    rule: str
    form: str
    time_update: str
    sources: list[str]
    options: list[str]

class _Failure(TypedDict):
    row: int | None
    time: float
    step: int
    fault: str
    matrix: str | None
    pivot: int | None
    quantity: str | None
    component: str | None
    mean: _Array | None
    message: str
    remedy: str | None

class _Consistency(TypedDict):
    verdict: Literal["unknown", "consistent", "overconfident", "underconfident"]
    ratio: float
    band: tuple[float, float]
    dof: int
    text: str

class _Accuracy(TypedDict):
    rmse: _Array
    coverage: _Array
    rows: list[int]
    nees: float
    nees_dof: float
    nees_rows: int

class _Track(TypedDict):
    id: str | None
    origin: str | None
    time: _Array
    z: _Array
    u: _Array
    #: Which sensor each row names; their number where it names none.
    sensor: NDArray[np.int64]
    line: NDArray[np.int64]
    t0: float
    mean: _Array
    cov: _Array
    row: int
    started: bool

class _Answered(TypedDict):
    tracks: int
    rows: int
    log_likelihood: float
    seconds: float
    failed: list[tuple[str | None, str | None, str]]
    doubts: list[tuple[str, bool]]

class _Tracks(TypedDict):
    tracks: list[_Track]
    ignored: list[str]
    has_track_id: bool
    has_sensor: bool

@final
class ArrowTable:
    """A table that another library lends by Arrow's PyCapsule protocol."""

    @staticmethod
    def read(capsule: object) -> ArrowTable:
        """Reads to its end what the ``__arrow_c_stream__`` of a table gives."""

    def __len__(self) -> int:
        """Rows."""

    @property
    def names(self) -> list[str]: ...
    def column(self, index: int) -> tuple[_Column, str, Any]:
        """What a column holds, the unit of times, and the values.

        number: float64, NaN where there is null; without a copy, and read-only, if the column is one array of float64
        without nulls. whole: int64 or uint64. date, zoned (in UTC), duration: int64, −2⁶³ where there is null. text: a
        list of str and None. other: the name of a type that is not read.
        """

@final
class TrackTable:
    """A table of tracks that was read for a model. A track with a wrong row is left out, and named where answers are."""

    @staticmethod
    def lent(model: Model, capsule: object, names: _Names | None = None) -> TrackTable:
        """Reads to its end what the ``__arrow_c_stream__`` of a table gives; without names, for a model from a file."""

    @staticmethod
    def read(model: Model, path: str, names: _Names | None = None) -> TrackTable:
        """Reads a CSV or a Parquet file."""

    def __len__(self) -> int:
        """Tracks."""

    def track(self, index: int) -> tuple[_Array, _Array]:
        """Times (rows,) and measurements (rows, d) of a track."""

    def answers(
        self,
        model: Model,
        choice: Choice,
        goal: _Goal,
        goal_value: float | None,
        layout: str,
        prior: tuple[_Array, _Array] | None = None,
        unbegun: list[tuple[int, str]] | None = None,
        threads: int | None = None,
        path: str | None = None,
    ) -> tuple[object, _Answered]:
        """Runs all tracks: a capsule ``arrow_array_stream`` of the answers, or None where they were written to `path`.

        `prior`: a mean (n,) and a covariance (n, n), or one of each for each track; without it, where the model's file
        says. `unbegun`: tracks that have none, and why.
        """

@final
class Graph:
    """Expressions in which equal subexpressions are one node, known by its number."""

    def __new__(cls) -> Graph: ...
    def __len__(self) -> int: ...
    def state(self, index: int) -> int:
        """A component of the state."""

    def time(self) -> int:
        """Time."""

    def step(self) -> int:
        """The length of the step."""

    def control(self, index: int) -> int:
        """A control."""

    def parameter(self, index: int) -> int:
        """A parameter."""

    def constant(self, value: float) -> int:
        """A number."""

    def unary(self, operation: str, a: int) -> int:
        """An operation on one number: neg, abs, sign, floor, sqrt, exp, log, log10, sin, …"""

    def binary(self, operation: str, a: int, b: int) -> int:
        """An operation on two numbers: add, sub, mul, div, pow, atan2, hypot, min, max, less, …"""

    def power(self, a: int, exponent: int) -> int:
        """A whole power."""

    def select(self, condition: int, yes: int, no: int) -> int:
        """One of two values by a condition."""

    def constant_value(self, node: int) -> float | None:
        """The number that a node always is, or None."""

    def is_condition(self, node: int) -> bool:
        """Whether a node is a comparison, or made of comparisons."""

    def evaluate(self, nodes: Sequence[int], x: _Array, t: float, dt: float, u: _Array, p: _Array) -> _Array:
        """The values of nodes at one point."""

@final
class Function:
    """A function of a model that is called, not traced: it takes the place of a list of nodes.

    It has no derivatives but those of a `jacobian`; methods that take others are refused.
    """

    @staticmethod
    def callable(function: Callable[[float, float, _Array, _Array, _Array], Any]) -> Function:
        """A function f(t, dt, x, u, p) of Python.

        It is called with all points at once, x of shape (n, points), and gives an array of shape (d, points). A noise
        (diffusion, noise_cov, std, cov) is called for one point and gives its entries, row by row or as a matrix; x is
        empty but for a diffusion. A jacobian gives d × n for one point. An exception ends the run and is raised to the
        user unchanged, with a note that tells row and time.
        """

    @staticmethod
    def address(
        address: int, owner: object, *, step: bool = False, parameters: Sequence[int] | None = None
    ) -> Function:
        """A function of C, such as numba's `cfunc`, at an address.

        ``void f(double t, const double *x, const double *p, double *out)``, with `step`
        ``void f(double t, double dt, const double *x, const double *p, double *out)``. `p` holds the
        `parameters` of the model, by their places, or all of them, and the controls behind them. It is called from any
        thread. `owner` is kept alive as long as the function may be called. A wrong
        address, or a function that reads or writes beyond its arrays, ends the program.
        """

@final
class Model:
    """A model with its sensors, of any origin."""

    @staticmethod
    def continuous(
        graph: Graph,
        states: Sequence[str],
        controls: int,
        parameters: Sequence[float],
        drift: Sequence[int] | Function,
        diffusion: Sequence[int] | Function,
        noises: int,
        sensors: Sequence[_SensorParts],
        *,
        jacobian: Function | None = None,
        varies: Literal["never", "time", "state"] = "state",
    ) -> Model:
        """A model of drift (n nodes) and diffusion (n × noises nodes, row by row).

        `varies` says what a diffusion that is called depends on; of nodes it is found out.
        """

    @staticmethod
    def discrete(
        graph: Graph,
        states: Sequence[str],
        controls: int,
        parameters: Sequence[float],
        transition: Sequence[int] | Function,
        noise_cov: Sequence[int] | Function,
        step: float | None,
        sensors: Sequence[_SensorParts],
        *,
        jacobian: Function | None = None,
    ) -> Model:
        """A model of transition (n nodes) and noise covariance (n × n nodes, or none)."""

    @staticmethod
    def read(path: str, parameters: Mapping[str, float] | None = None) -> Model:
        """A model file, with other values for some of its parameters."""

    @staticmethod
    def parse(text: str, name: str = "model", parameters: Mapping[str, float] | None = None) -> Model:
        """The text of a model file; errors call it `name`."""

    def with_parameters(self, values: _Array) -> Model:
        """The same model with other values of all parameters; a model file is evaluated anew."""

    @property
    def kind(self) -> _Kind: ...
    @property
    def states(self) -> list[str]: ...
    @property
    def measures(self) -> list[str]:
        """Columns of all sensors, in the order in which z stacks them."""

    @property
    def sensors(self) -> list[_Sensor]: ...
    @property
    def controls(self) -> int: ...
    @property
    def control_names(self) -> list[str]:
        """Of a model file; empty for others."""

    @property
    def parameters(self) -> _Array: ...
    @property
    def parameter_names(self) -> list[str]:
        """Of a model file; empty for others."""

    @property
    def step(self) -> float | None:
        """The fixed length of a step."""

    @property
    def noises(self) -> int | None:
        """Columns of the diffusion that are not zero throughout; None for a discrete model."""

    @property
    def file(self) -> str | None: ...
    @property
    def prior(self) -> tuple[_Array, _Array] | None:
        """Mean and covariance of a model file; NaN and zero for states that `start` finds."""

    @property
    def time(self) -> float | None:
        """When the prior of a model file holds; None: at the first row."""

    @property
    def start(self) -> list[str]:
        """The states that `start` of a model file finds."""

    @property
    def method(self) -> str | None:
        """The method of a model file."""

    @property
    def options(self) -> dict[str, str | float | bool]:
        """Parts and options of a model file."""

    def begin(self, time: _Array, z: _Array, u: _Array | None = None) -> tuple[float, _Array, _Array, int, bool]:
        """Where rows of a model file's track begin: t0, mean, cov, the row there or the first after, and whether `start`
        has read that row, which is not to be used again then.
        """

    def drift(self, t: float, x: _Array, u: _Array | None = None) -> _Array:
        """f(t, x, u), length n."""

    def diffusion(self, t: float, x: _Array, u: _Array | None = None) -> _Array:
        """G(t, x, u), n × q, without columns that are zero throughout."""

    def transition(self, t: float, dt: float, x: _Array, u: _Array | None = None) -> _Array:
        """f(t, dt, x, u), length n."""

    def noise_cov(self, t: float, dt: float, u: _Array | None = None) -> _Array:
        """Q(t, dt, u), n × n."""

    def measure(self, t: float, x: _Array, u: _Array | None = None) -> _Array:
        """h(t, x, u) of all sensors, length d."""

    def measurement_noise(self, t: float, u: _Array | None = None) -> _Array:
        """The lower-triangular root of R(t, u) of all sensors, d × d."""

@final
class Choice:
    """A method of the registry with its parts and options."""

    def __new__(cls, method: str | None, options: Mapping[str, object], kind: _Kind) -> Choice: ...
    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str:
        """The name, and the parts that were set otherwise."""

    @property
    def gate(self) -> float | None:
        """The probability of its gate, if it has one."""

    @property
    def kind(self) -> _Kind: ...
    def parts(self, states: int) -> dict[str, str | float]:
        """Parts and options with their values, for a model of so many states."""

    def check(self, model: Model) -> None:
        """Raises MethodError if the method does not go with the model."""

@final
class Estimates:
    """What a run has learnt, row by row; the arrays are the object's own and cannot be written to."""

    def __len__(self) -> int: ...
    @property
    def time(self) -> _Array:
        """(K,)"""

    @property
    def mean(self) -> _Array:
        """(K, n), filtered or smoothed."""

    @property
    def cov(self) -> _Array:
        """(K, n, n)"""

    @property
    def factor(self) -> _Array:
        """(K, n, n): lower-triangular roots of `cov`; of a square-root method its own."""

    @property
    def filtered_mean(self) -> _Array:
        """(K, n); of a filter the same array as `mean`."""

    @property
    def filtered_cov(self) -> _Array: ...
    @property
    def predicted_mean(self) -> _Array: ...
    @property
    def predicted_cov(self) -> _Array: ...
    @property
    def innovation(self) -> _Array:
        """(K, d); NaN where a component was missing."""

    @property
    def innovation_cov(self) -> _Array:
        """(K, d, d)"""

    @property
    def nis(self) -> _Array:
        """(K,); NaN where nothing was measured."""

    @property
    def nis_dof(self) -> NDArray[np.int64]:
        """(K,)"""

    @property
    def log_likelihood(self) -> _Array:
        """(K,), of each row's own measurement."""

    @property
    def gated(self) -> NDArray[np.bool_]:
        """(K,), whether a row was beyond the gate."""

    @property
    def total_log_likelihood(self) -> float:
        """Of all measurements that were taken in, also of those whose row gives no estimate."""

    @property
    def smoothed(self) -> bool: ...
    @property
    def at(self) -> Estimates | None:
        """The states at the times asked for; None if none were."""

    @property
    def failure(self) -> _Failure | None:
        """Why the run ended before its last row; the rows before stand in the arrays."""

    @property
    def doubts(self) -> list[_Doubt]:
        """What is doubtful about it; of a batch its own list is of all tracks."""

class _Snapshot(TypedDict):
    time: float
    step: int
    mean: _Array
    factor: _Array
    cov: _Array
    moved: _Array
    floor: _Array
    controls: _Array | None
    parameters: _Array
    work: tuple[int, int, int, int]
    innovation: _Array
    innovation_cov: _Array
    nis: float
    nis_dof: int
    log_likelihood: float
    gated: bool

@final
class Filter:
    """A filter that is stepped by hand; a step that fails raises StepError and leaves the belief of the last that did not."""

    @staticmethod
    def start(model: Model, choice: Choice, mean: _Array, cov: _Array, t0: float) -> Filter:
        """Starts from a belief at `t0`; `cov` may be the standard deviations, length n."""

    @staticmethod
    def resume(model: Model, choice: Choice, snapshot: _Snapshot) -> Filter:
        """Goes on, to the bit, where another one of the same model and method was when its snapshot was taken."""

    def predict(self, t: float) -> None:
        """Moves the belief to time `t`."""

    def update(self, z: _Array) -> None:
        """Teaches the belief a measurement of all sensors, length d; NaN where a component is missing."""

    def set_controls(self, u: _Array) -> None:
        """Sets the controls, which hold until they are set again."""

    @property
    def time(self) -> float: ...
    @property
    def mean(self) -> _Array: ...
    @property
    def cov(self) -> _Array: ...
    @property
    def factor(self) -> _Array:
        """The lower-triangular root of `cov`."""

    @property
    def innovation(self) -> _Array:
        """Of the last measurement, length d; NaN where a component was missing, and before the first."""

    @property
    def innovation_cov(self) -> _Array: ...
    @property
    def nis(self) -> float: ...
    @property
    def nis_dof(self) -> int: ...
    @property
    def log_likelihood(self) -> float:
        """Of the last measurement; 0 if nothing was measured, or taken in."""

    @property
    def gated(self) -> bool:
        """Whether the last measurement was beyond the gate."""

    def snapshot(self) -> _Snapshot:
        """All that the filter carries, as plain data."""

def run(
    model: Model,
    choice: Choice,
    mean: _Array,
    cov: _Array,
    t0: float | None,
    time: _Array,
    z: _Array,
    u: _Array | None = None,
    goal: _Goal = "filter",
    goal_value: float | None = None,
    at: _Array | None = None,
) -> Estimates:
    """Runs a method over the rows of one trajectory: time (K,), z (K, d), u (K, c).

    `cov` is the covariance of the belief at `t0` (None: at the first row), or its standard deviations, length n.
    `goal_value` is the number of rows of a lag, or the time of a point.
    """

def looked_for() -> float:
    """Seconds that this thread has looked for doubts about its runs, since it was last asked."""

def run_batch(
    tracks: Sequence[
        tuple[
            Model,
            Choice,
            _Array,
            _Array,
            float | None,
            _Array,
            _Array,
            _Array | None,
            _Array | None,
        ]
    ],
    goal: _Goal = "filter",
    goal_value: float | None = None,
    threads: int | None = None,
) -> tuple[list[Estimates], list[_Doubt]]:
    """Runs tracks (model, choice, mean, cov, t0, time, z, u, at), each as `run` does, on threads.

    An estimate does not depend on the other tracks, nor on the number of threads. A track that fails says so in its own
    `failure`. Models with functions of Python run on one thread. Besides the estimates: what is doubtful about them.
    """

def sample(
    model: Model,
    choice: Choice,
    mean: _Array,
    cov: _Array,
    t0: float | None,
    time: _Array,
    z: _Array,
    u: _Array | None = None,
    *,
    draws: int,
    seed: int,
    track: int = 0,
) -> _Array:
    """Draws trajectories (draws, K, n) from the joint distribution of the states at all rows, given all of them.

    At each row they have the mean and covariance of the smoother. Draw i depends on seed, track and i, not on how many
    there are. A step that fails raises StepError.
    """

def simulate(
    model: Model,
    mean: _Array,
    cov: _Array,
    t0: float | None,
    time: _Array,
    seed: int,
    runs: int = 1,
    *,
    z: _Array | None = None,
    u: _Array | None = None,
    track: int = 0,
    substeps: int = 16,
    threads: int | None = None,
    first_run: int = 0,
) -> tuple[_Array, _Array]:
    """Draws states (runs, K, n) and measurements (runs, K, d) at these times; where `z` is NaN, so are the latter.

    Continuous models move in `substeps` steps for each gap: by the Itô–Taylor scheme of order 1.5, or by Euler and
    Maruyama where the diffusion depends on the state or a function that is called has no derivatives.
    """

def arrow_stream(columns: Sequence[tuple[str, str, object]]) -> object:
    """A capsule ``arrow_array_stream`` with one record batch of columns: name, kind and values.

    number: float64 (rows,), null where NaN. whole: int64 (rows,). D, s, ms, us, ns: dates as int64 (rows,) since 1970, in
    no zone; s UTC, ms UTC, us UTC, ns UTC: in UTC. text: a list of str, and int64 that say in how many rows each of them
    stands.
    """

def consistency(nis: _Array, nis_dof: NDArray[np.int64]) -> _Consistency:
    """The mean NIS of rows against its 95 % band."""

def accuracy(mean: _Array, cov: _Array, truth: _Array) -> _Accuracy:
    """Estimates (K, n) and (K, n, n) against a truth (K, n), NaN where that is not known."""

def read_tracks(model: Model, path: str) -> _Tracks:
    """Reads a table of measurements for a model from a file; - is standard input."""

def methods() -> list[_Entry]:
    """The registry."""

def options() -> list[tuple[str, str, str]]:
    """Every part and option: its name, what it is, who reads it."""

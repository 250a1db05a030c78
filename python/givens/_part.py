"""One function of a model, whatever it was given as: numbers, a traced function, or one that is called."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from givens._arrays import Array
from givens._called import Called, called
from givens._compiled import is_compiled
from givens._native import Function, Graph
from givens._scalars import shown
from givens._symbolic import is_symbolic, of_sympy
from givens._trace.arguments import Arguments, read_arguments
from givens._trace.place import Place, of_function
from givens._trace.steep import Steep
from givens._trace.tape import Tape
from givens._trace.traced import Sizes, Traced
from givens.errors import InputError, TraceError

if TYPE_CHECKING:
    from givens._trace.derivatives import Watch

__all__ = ["Part", "Request", "is_function"]


@dataclass(frozen=True)
class Request:
    """How a part of a model is to be read."""

    #: The argument that brings it.
    argument: str
    #: What stands at the positions of its call, and what may.
    required: tuple[str, ...]
    optional: tuple[str, ...] = ()
    #: Names of its results, where each has one.
    names: tuple[str, ...] = ()
    #: Names of states and controls, by which a SymPy expression knows them.
    states: tuple[str, ...] = ()
    controls: tuple[str, ...] = ()
    #: Values for its parameters.
    parameters: Mapping[str, object] = field(default_factory=dict)
    trace: bool = True
    #: Whether a function that is called takes all points at once.
    vectorized: bool = False
    may_call: bool = True
    check_at: Array | None = None

    @property
    def sizes(self) -> Sizes:
        """Lengths of state and controls."""
        return Sizes(len(self.states), len(self.controls))

    @property
    def _written(self) -> str:
        return f"write def {self.argument}({', '.join(self.required)}): return […]"

    def read(self, given: Any) -> Part:
        """Makes the part."""
        if is_symbolic(given):
            given = of_sympy(self.argument, given, self.required, self.states, self.controls, self.parameters)
        if not is_function(given):
            if "x" in self.required:
                said = f"`{self.argument}` is not a function: {shown(given)}"
                remedy = self._written
                # no function stands below
                if isinstance(given, int) and given >= 4096:
                    remedy += "; of an address, ctypes.CFUNCTYPE(None, …)(address) makes a function"
                raise InputError(said, argument=self.argument, remedy=remedy)
            if given is None:
                said, remedy = f"`{self.argument}` is missing", f"give numbers, or {self._written}"
                raise InputError(said, argument=self.argument, remedy=remedy)
            return Part(self.argument, _numbers(self.argument, given))
        if is_compiled(given) and not self.may_call:
            raise InputError(
                f"`{self.argument}` is a function of C, and can only be one that is traced, or numbers",
                argument=self.argument,
                remedy=self._written,
            )
        if self.may_call and (is_compiled(given) or not self.trace):
            return Part(self.argument, called=called(self, given))
        # what knows symbols is a third of the package, and a model file needs none of it
        from givens._trace.check import compare
        from givens._trace.derivatives import compare_slopes
        from givens._trace.tracer import trace

        arguments = read_arguments(self.argument, given, self.required, self.optional, self.parameters)
        try:
            traced = trace(given, arguments, self.sizes, self.names)
            compare(given, traced, self.sizes, self.names, self.check_at)
            steep = compare_slopes(given, traced, self.sizes, self.names, self.check_at)
        except TraceError as error:
            error.argument = self.argument
            if not self.may_call and error.remedy is not None:
                error.remedy = error.remedy.replace(", or pass trace=False", "").replace("; or pass trace=False", "")
            raise
        return Part(self.argument, traced, place=of_function(given), steep=steep, names=self.names, sizes=self.sizes)


@dataclass(frozen=True)
class Part:
    """A function of a model."""

    argument: str
    traced: Traced | None = None
    called: Called | None = None
    #: Where a function that is traced stands, what its results are called, and of which lengths its arguments are.
    place: Place = field(default_factory=Place)
    names: tuple[str, ...] = ()
    sizes: Sizes | None = None
    #: What to say to those who take its derivatives, if they are not the function's.
    steep: Steep | None = None
    #: What compares its derivatives with it, made when it is first asked for.
    _watch: list[Watch] = field(default_factory=list, compare=False, repr=False)

    def __getstate__(self) -> dict[str, Any]:
        # what is native cannot travel
        return {**self.__dict__, "_watch": []}

    @property
    def shape(self) -> tuple[int, ...] | None:
        """Of its result; None if that is not known."""
        return self.traced.shape if self.traced is not None else self.called.shape if self.called is not None else None

    @property
    def parameters(self) -> dict[str, Array]:
        """By name, with the values that they had when the part was made."""
        if self.traced is not None:
            return self.traced.arguments.parameters
        return self.called.parameters if self.called is not None else {}

    @property
    def is_number(self) -> bool:
        """Whether it is the same everywhere."""
        return self.traced is not None and not self._inputs

    @property
    def is_fixed(self) -> bool:
        """Whether it is the same everywhere but for its parameters."""
        return self.traced is not None and all(kind == "parameter" for kind, _ in self._inputs)

    @property
    def reads_state(self) -> bool:
        """Whether it depends on the state, as far as its expressions tell."""
        return self.traced is not None and any(kind == "state" for kind, _ in self._inputs)

    @property
    def _inputs(self) -> set[tuple[str, int]]:
        assert self.traced is not None
        return self.traced.tape.inputs(self.traced.nodes)

    def value(self, t: float = 0.0, dt: float = 0.0, u: float = 0.0) -> Array:
        """Its numbers at a moment, all controls of one value; of a part that does not depend on the state."""
        assert self.traced is not None
        empty, graph = np.empty(0), Graph()
        controls = np.full(1 + max((at for kind, at in self._inputs if kind == "control"), default=-1), u)
        nodes = self.traced.tape.lay_into(graph, self.traced.nodes)
        found = graph.evaluate(nodes, empty, t, dt, controls, self.traced.arguments.values)
        return found.reshape(self.traced.shape)

    @cached_property
    def has_kinks(self) -> bool:
        """Whether its derivatives may be others than its function's at points that have not been tried."""
        if self.traced is None or self.sizes is None or not self.reads_state:
            return False
        from givens._trace.derivatives import has_kinks

        return has_kinks(self.traced)

    def steep_at(self, t: float, x: Array, u: Array, p: Array) -> Steep | None:
        """What to say to those who take its derivatives at this point, its parameters being `p`."""
        if self.steep is not None or not self.has_kinks:
            return self.steep
        if not self._watch:
            from givens._trace.derivatives import Watch

            assert self.traced is not None
            assert self.sizes is not None
            self._watch.append(Watch(self.traced, self.sizes, self.names, self.place))
        return self._watch[0].at(t, x, u, p)

    @property
    def nodes(self) -> tuple[int, ...]:
        """The instructions of its results; none for a function that is called."""
        return self.traced.nodes if self.traced is not None else ()

    def constant(self, value: float) -> int:
        """The instruction of a number on its tape."""
        assert self.traced is not None
        return self.traced.tape.constant(value)

    def constant_of(self, node: int) -> float | None:
        """The number that an instruction always gives, or None."""
        return self.traced.tape.constant_value(node) if self.traced is not None else None

    def reshaped(self, nodes: Sequence[int], shape: tuple[int, ...]) -> Part:
        """With other results, which are instructions of the same tape."""
        assert self.traced is not None
        traced = Traced(self.traced.tape, tuple(nodes), shape, self.traced.arguments)
        return replace(self, traced=traced, _watch=[])

    def into(self, graph: Graph, places: Mapping[str, slice]) -> list[int] | Function:
        """As the native half takes it: nodes of the graph, or a function; parameters stand in these places."""
        if self.called is not None:
            return self.called.native(places)
        assert self.traced is not None
        flat = [k for name in self.parameters for k in range(places[name].start, places[name].stop)]
        return self.traced.tape.lay_into(graph, self.traced.nodes, flat)


def _numbers(argument: str, given: Any) -> Traced:
    from givens._arrays import numbers

    array = numbers(argument, given)
    if not np.isfinite(array).all():
        raise InputError(f"`{argument}` is not finite: {array[~np.isfinite(array)][0]}", argument=argument)
    tape = Tape()
    return Traced(tape, tuple(tape.constant(value) for value in array.ravel()), array.shape, Arguments((), {}))


def is_function(given: object) -> bool:
    """Whether an argument is a function, by itself or by its address."""
    return callable(given) or is_compiled(given)

"""Models in continuous time."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy.typing as npt

from givens._arrays import shape_error
from givens._compiled import is_compiled
from givens._dynamics import Dynamics, begin, noise_request, parameters_of, read_jacobian
from givens._names import ordered
from givens._part import Part, Request
from givens._symbolic import is_symbolic, symbols_in
from givens._trace.arguments import reads_state

__all__ = ["Sde"]


class Sde(Dynamics):
    """A model in continuous time: dx = f(t, x) dt + G dβ, with a standard Wiener process β.

    Parameters
    ----------
    drift : callable
        ``drift(t, x)``, or ``drift(t, x, u)`` with controls, gives n values: a list, an array, or a table by the names
        of the states. `x` is an array of length n, `u` one of the controls. Arguments with a default, and those after
        ``*``, are parameters: numbers or arrays of floats. It is written in NumPy or `math`, called twice with symbols,
        and compared with what came out of that at random points; it runs natively from then on. Values that it reads
        from elsewhere, and defaults that are no numbers, are those of this moment. A list of SymPy expressions in the
        names of the states, and a function of C, numba's ``cfunc`` or a function pointer of ctypes, serve as well.
    diffusion : array_like, mapping or callable
        G per square-root unit time: its diagonal, shape (n,), or all of it, (n, q); a table by the names of the states,
        where those left out have none. Numbers, or ``diffusion(t)``, ``(t, u)``, ``(t, x)``, ``(t, x, u)``, told apart
        by the name of the second argument: `u` is the controls, any other the state.
    state : sequence of str
        Names of the states, in order.
    controls : sequence of str, optional
        Names of the controls.
    parameters : mapping, optional
        Values of parameters, in place of their defaults.
    trace : bool, optional
        False calls the drift while the filter runs, at a large cost in time; for one that branches on values. The
        diffusion is traced in any case.
    vectorized : bool, optional
        True calls a drift that is not traced with all points at once, `x` of shape (n, points), for results of the
        same shape; otherwise it is called point by point.
    jacobian : callable, optional
        ∂f/∂x of a drift that is not traced, (n, n), called as the drift is.
    check_at : array_like, shape (n,), optional
        A state at and around which the trace is compared with the function, beside the random ones.

    Raises
    ------
    TraceError
        For a function that cannot be traced, with the line and how to write it.
    InputError
        For arguments that do not fit together.

    Examples
    --------
    >>> import givens as gv
    >>> import numpy as np
    >>> def drift(t, x, *, mu=2.0):
    ...     return [x[1], mu * (1 - x[0] ** 2) * x[1] - x[0]]
    >>> model = gv.Sde(drift, diffusion={"v": 0.3}, state=["x", "v"])
    >>> model
    Sde(drift, state=[x, v], noises=1, parameters=(mu=2))
    >>> model.with_params(mu=3.0).parameters["mu"]
    3.0
    """

    __slots__ = ()

    def __init__(
        self,
        drift: Callable[..., Any] | Sequence[Any],
        *,
        diffusion: npt.ArrayLike | Mapping[str, float] | Callable[..., Any],
        state: Sequence[str],
        controls: Sequence[str] = (),
        parameters: Mapping[str, object] | None = None,
        trace: bool = True,
        vectorized: bool = False,
        jacobian: Callable[..., Any] | None = None,
        check_at: npt.ArrayLike | None = None,
    ) -> None:
        common = begin(state, controls, parameters, trace, vectorized, check_at)
        states: tuple[str, ...] = common["states"]
        u = ("u",) if common["controls"] else ()
        moves = Request("drift", ("t", "x"), u, states, **common).read(drift)
        check_length(moves, states)
        parts = {"drift": moves, "diffusion": _diffusion(diffusion, states, u, common)}
        self._put(
            state=states,
            controls=common["controls"],
            jacobian=read_jacobian(jacobian, moves, common, ("t", "x")),
            _parts=parts,
            _parameters=parameters_of([part.parameters for part in parts.values()], common["parameters"]),
            _joined={},
        )

    @property
    def kind(self) -> str:
        """``"continuous"``."""
        return "continuous"

    @property
    def noises(self) -> int:
        """Columns of G that are not zero throughout."""
        part = self._parts["diffusion"]
        columns = part.shape[1] if part.shape else 0
        return sum(any(part.constant_of(k) != 0.0 for k in part.nodes[j::columns]) for j in range(columns))

    def _table(self) -> list[tuple[str, str]]:
        return [
            ("drift", self._parts["drift"].place.function or "called"),
            ("state", f"[{', '.join(self.state)}]"),
            ("controls", f"[{', '.join(self.controls)}]" if self.controls else ""),
            ("noises", str(self.noises)),
            ("parameters", f"({self._shown_parameters()})" if self._parameters else ""),
        ]


def check_length(part: Part, states: tuple[str, ...]) -> None:
    """A function of motion gives one value for each state."""
    n, shape = len(states), part.shape
    if shape is None or shape == (n,):
        return
    column = len(shape) == 2 and 1 in shape and n in shape
    raise shape_error(
        part.argument,
        shape,
        f"({n},): one value for each of {', '.join(states)}",
        "return a vector: np.ravel(…)" if column else "return one value for each state, in their order",
    )


def _diffusion(given: Any, states: tuple[str, ...], u: tuple[str, ...], common: dict[str, Any]) -> Part:
    n = len(states)
    if isinstance(given, Mapping):
        given = [0.0 if entry is None else entry for entry in ordered("diffusion", given, states, "state")]
    if is_symbolic(given):
        state_like = not symbols_in(given).isdisjoint(states)
    else:
        state_like = callable(given) and not is_compiled(given) and reads_state("diffusion", given)
    part = noise_request("diffusion", ("t", "x") if state_like else ("t",), u, common).read(given)
    shape = part.shape
    if shape == () and n == 1:
        return part.reshaped(part.nodes, (1, 1))
    if shape == (n,):
        zero = part.constant(0.0)
        return part.reshaped([part.nodes[i] if i == k else zero for i in range(n) for k in range(n)], (n, n))
    if shape is None or len(shape) != 2 or shape[0] != n:
        raise shape_error(
            "diffusion",
            shape or (),
            f"({n},), the diagonal of G, nor ({n}, noises), all of it",
            "a diagonal has one value for each state; all of G has one row for each",
        )
    return part

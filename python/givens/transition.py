"""Models in discrete time."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy.typing as npt

from givens._arrays import shape_error
from givens._covariance import check_covariance
from givens._dynamics import Dynamics, begin, noise_request, parameters_of, read_jacobian
from givens._part import Part, Request
from givens._scalars import positive
from givens.sde import check_length

__all__ = ["Transition"]


class Transition(Dynamics):
    """A model in discrete time: x' = f(t, dt, x) + w, w ~ N(0, Q).

    Parameters
    ----------
    f : callable
        ``f(t, dt, x)``, or ``f(t, dt, x, u)`` with controls, gives the n states a time `dt` after `t`. How functions
        are read is told at `Sde`.
    noise_cov : array_like or callable
        Q, (n, n): numbers, or ``noise_cov(t, dt)`` or ``(t, dt, u)``.
    state : sequence of str
        Names of the states, in order.
    step : float, optional
        The length of one transition: a gap is then a whole number of them, and `dt` is the step. Without it, `f`
        and `noise_cov` are applied once over each gap.
    controls, parameters, trace, vectorized, jacobian, check_at
        As for `Sde`; a function of C is ``void f(double t, double dt, const double *x, const double *p, double *out)``.

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
    >>> def f(t, dt, x):
    ...     return [x[0] + dt * x[1], x[1]]
    >>> def noise(t, dt, *, q=0.1):
    ...     return q * np.array([[dt**3 / 3, dt**2 / 2], [dt**2 / 2, dt]])
    >>> gv.Transition(f, noise_cov=noise, state=["x", "v"])
    Transition(f, state=[x, v], parameters=(q=0.1))
    """

    __slots__ = ("step",)

    step: float | None

    def __init__(
        self,
        f: Callable[..., Any] | Sequence[Any],
        *,
        noise_cov: npt.ArrayLike | Callable[..., Any],
        state: Sequence[str],
        step: float | None = None,
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
        if step is not None:
            step = positive("step", step, "a step is longer than 0")
        moves = Request("f", ("t", "dt", "x"), u, states, **common).read(f)
        check_length(moves, states)
        parts = {"f": moves, "noise_cov": _noise(noise_cov, states, u, common, step)}
        self._put(
            state=states,
            controls=common["controls"],
            step=None if step is None else float(step),
            jacobian=read_jacobian(jacobian, moves, common, ("t", "dt", "x")),
            _parts=parts,
            _parameters=parameters_of([part.parameters for part in parts.values()], common["parameters"]),
            _joined={},
        )

    @property
    def kind(self) -> str:
        """``"discrete"``."""
        return "discrete"

    def _key(self) -> tuple[Any, ...]:
        return (*super()._key(), self.step)

    def _table(self) -> list[tuple[str, str]]:
        return [
            ("f", self._parts["f"].place.function or "called"),
            ("state", f"[{', '.join(self.state)}]"),
            ("step", "" if self.step is None else f"{self.step:g}"),
            ("controls", f"[{', '.join(self.controls)}]" if self.controls else ""),
            ("parameters", f"({self._shown_parameters()})" if self._parameters else ""),
        ]


def _noise(given: Any, states: tuple[str, ...], u: tuple[str, ...], common: dict[str, Any], step: float | None) -> Part:
    n = len(states)
    part = noise_request("noise_cov", ("t", "dt"), u, common).read(given)
    if n == 1 and part.shape in ((), (1,)):
        part = part.reshaped(part.nodes, (1, 1))
    if part.shape != (n, n):
        remedy = "noise_cov=np.diag(…) makes one of variances" if part.shape == (n,) else None
        raise shape_error("noise_cov", part.shape or (), f"({n}, {n})", remedy)
    check_covariance("noise_cov", part, "state", states, step)
    return part

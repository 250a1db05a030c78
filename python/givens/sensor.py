"""What is measured."""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from givens._arrays import shape_error
from givens._covariance import check_covariance, check_deviations
from givens._dynamics import Parametric, called_at_once, noise_request, read_jacobian
from givens._measuring import near, periods, spread
from givens._measuring import parameters as parameters_known
from givens._names import listed, names_of
from givens._part import Part, Request, is_function
from givens._scalars import shown, text
from givens._symbolic import is_symbolic
from givens._trace.place import of_function
from givens.errors import InputError

__all__ = ["Sensor"]


class Sensor(Parametric):
    """A sensor: z = h(t, x) + v, v ~ N(0, R).

    Parameters
    ----------
    h : callable
        ``h(t, x)``, or ``h(t, x, u)`` where the model has controls, gives d values: a list, an array, or a table by the
        names of the measures. How functions are read is told at `Sde`; a sensor is traced with the model that it is
        first used with, for only that knows the length of `x`.
    measures : sequence of str
        Names of the measures, in order.
    std : array_like, mapping or callable
        Standard deviations of the errors, shape (d,), or a table by the names of the measures: numbers, or ``std(t)``
        or ``std(t, u)``.
    cov : array_like or callable
        In place of `std`: R, shape (d, d), if errors are correlated.
    angles : sequence of str or mapping, optional
        Measures that are angles in radians, or a table of their periods: ``{"az": 360.0}``. Their differences are
        wrapped everywhere.
    name : str, optional
        By which measurements and errors name the sensor.
    parameters, trace, vectorized, jacobian, check_at
        As for `Sde`; a jacobian has shape (d, n).

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
    >>> def h(t, x):
    ...     return [np.hypot(x[0], x[2]), np.arctan2(x[2], x[0])]
    >>> gv.Sensor(h, measures=["range", "bearing"], std=[10, 0.003], angles=["bearing"], name="radar")
    Sensor(h, name=radar, measures=[range, bearing], std=[10.0, 0.003], angles=[bearing])
    """

    __slots__ = ("_given", "_noise", "_periods", "_traces", "check_at", "measures", "name", "trace", "vectorized")

    name: str
    measures: tuple[str, ...]
    trace: bool
    vectorized: bool
    check_at: Any
    _given: dict[str, Any]
    _noise: str
    _periods: tuple[float | None, ...]
    _traces: dict[Any, dict[str, Part]]

    def __init__(
        self,
        h: Callable[..., Any] | Sequence[Any],
        *,
        measures: Sequence[str],
        std: npt.ArrayLike | Mapping[str, float] | Callable[..., Any] | None = None,
        cov: npt.ArrayLike | Callable[..., Any] | None = None,
        angles: Sequence[str] | Mapping[str, float] = (),
        name: str = "sensor",
        parameters: Mapping[str, object] | None = None,
        trace: bool = True,
        vectorized: bool = False,
        jacobian: Callable[..., Any] | None = None,
        check_at: npt.ArrayLike | None = None,
    ) -> None:
        name = text("name", name, "a name", 'write name="radar"')
        columns = names_of("measures", measures, example='["range", "bearing"]')
        if not columns:
            raise InputError("`measures` names nothing", argument="measures", remedy='write measures=["range"]')
        if (std is None) == (cov is None):
            said = "neither `std` nor `cov`" if std is None else "`std` and `cov` at once"
            raise InputError(
                f"the sensor `{name}` has {said}",
                argument="std",
                component=name,
                remedy="give the standard deviations of its errors, std=[…], or else their covariance, cov=[[…]]",
            )
        if not (is_function(h) or is_symbolic(h)):
            raise InputError(f"`h` is not a function: {shown(h)}", argument="h", remedy="write def h(t, x): return […]")
        noise = "std" if cov is None else "cov"
        errors = spread(noise, std if cov is None else cov, columns)
        given = {"h": h, noise: errors, "jacobian": jacobian, "parameters": dict(parameters or {})}
        self._put(
            name=name,
            measures=columns,
            trace=trace,
            vectorized=called_at_once(vectorized, trace),
            check_at=check_at,
            _given=given,
            _noise=noise,
            _periods=periods(angles, columns),
            _traces={},
            _parameters=parameters_known(given, noise),
        )

    @property
    def angles(self) -> dict[str, float]:
        """The measures that are angles, with their periods."""
        return {name: period for name, period in zip(self.measures, self._periods, strict=True) if period is not None}

    def _traced(self, states: tuple[str, ...], controls: tuple[str, ...]) -> dict[str, Part]:
        """Its functions, for a model of these states and controls."""
        key = states, controls
        if key not in self._traces:
            self._traces[key] = self._read(states, controls)
        return self._traces[key]

    def _read(self, states: tuple[str, ...], controls: tuple[str, ...]) -> dict[str, Part]:
        if "h" not in self._given:
            known = listed(", ".join(states) for states, _ in self._traces)
            raise InputError(
                f"the sensor `{self.name}` was pickled for a model with the states {known}, not {', '.join(states)}",
                argument="sensors",
                component=self.name,
                remedy="pickle it with a function that can be imported, or before it is used",
            )
        u = ("u",) if controls else ()
        common = {"states": states, "controls": controls, "parameters": self._given["parameters"]}
        common |= {"trace": self.trace, "vectorized": self.vectorized, "check_at": near(self.check_at, states)}
        request = Request("h", ("t", "x"), u, self.measures, **common)
        parts = {"h": request.read(self._given["h"])}
        d, shape = len(self.measures), parts["h"].shape
        if shape == () and d == 1:
            parts["h"] = parts["h"].reshaped(parts["h"].nodes, (1,))
        elif shape is not None and shape != (d,):
            column = len(shape) == 2 and 1 in shape and d in shape
            raise shape_error(
                "h",
                shape,
                f"({d},): one value for each of {', '.join(self.measures)}",
                "return a vector: np.ravel(…)" if column else "return one value for each measure, in their order",
            )
        parts[self._noise] = self._noise_part(u, common)
        if self._given["jacobian"] is not None:
            jacobian = read_jacobian(self._given["jacobian"], parts["h"], common, ("t", "x"))
            assert jacobian is not None
            parts["jacobian"] = jacobian
        return parts

    def _noise_part(self, u: tuple[str, ...], common: dict[str, Any]) -> Part:
        noise, d = self._noise, len(self.measures)
        part = noise_request(noise, ("t",), u, common).read(self._given[noise])
        wanted = (d,) if noise == "std" else (d, d)
        if d == 1 and part.shape in ((), (1,), (1, 1)):
            part = part.reshaped(part.nodes, wanted)
        if part.shape != wanted:
            raise shape_error(noise, part.shape or (), f"{wanted} for the measures {', '.join(self.measures)}")
        if noise == "std":
            check_deviations(noise, part, self.measures)
        else:
            check_covariance(noise, part, "measure", self.measures)
        return part

    def __eq__(self, other: object) -> bool:
        return self._key() == other._key() if isinstance(other, Sensor) else NotImplemented

    def __hash__(self) -> int:
        return hash((self.name, self.measures))

    def _key(self) -> tuple[Any, ...]:
        values = [(name, value.tobytes()) for name, value in self._parameters.items()]
        spread = self._given.get(self._noise)
        shown = spread.tobytes() if isinstance(spread, np.ndarray) else id(spread)
        return (
            self.name,
            self.measures,
            self._noise,
            self._periods,
            values,
            shown,
            id(self._given.get("h", self._traces)),
        )

    def __getstate__(self) -> dict[str, Any]:
        """Traces are plain data; a function that was not traced yet must be one that can be imported."""
        fields = {name: getattr(self, name) for cls in type(self).__mro__ for name in getattr(cls, "__slots__", ())}
        if self._traces and all(part.called is None for parts in self._traces.values() for part in parts.values()):
            fields["_given"] = {"parameters": self._given["parameters"]}
            return fields
        try:
            pickle.dumps(self._given)
        except Exception as error:
            raise InputError(
                f"the sensor `{self.name}` cannot be pickled yet: {error}",
                argument="h",
                component=self.name,
                remedy="use it once, which traces it, or write its functions with `def` in a module",
            ) from None
        return fields

    def __setstate__(self, fields: dict[str, Any]) -> None:
        self._put(**fields)

    def __copy__(self) -> Self:
        return self

    def _table(self) -> list[tuple[str, str]]:
        spread = self._given.get(self._noise)
        shown = str(spread.tolist()) if isinstance(spread, np.ndarray) else ""
        angles = [n if p == 2 * math.pi else f"{n}: {p:g}" for n, p in self.angles.items()]
        return [
            ("h", of_function(self._given["h"]).function or "expressions" if "h" in self._given else "traced"),
            ("name", self.name if self.name != "sensor" else ""),
            ("measures", f"[{', '.join(self.measures)}]"),
            (self._noise, shown),
            ("angles", f"[{', '.join(angles)}]" if angles else ""),
            ("parameters", f"({self._shown_parameters()})" if self._parameters else ""),
        ]

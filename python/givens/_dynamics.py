"""What the models of motion have in common."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any, Self

import numpy as np

from givens._arrays import Array
from givens._batched import Batched
from givens._names import known_name, listed, names_of
from givens._part import Part, Request
from givens._trace.arguments import parameter_value
from givens.errors import InputError

__all__ = ["Dynamics", "Parametric", "begin", "called_at_once", "noise_request", "parameters_of", "read_jacobian"]


def parameters_of(tables: Iterable[Mapping[str, Array]], given: Mapping[str, object]) -> dict[str, Array]:
    """The parameters of several functions together, those of one name with one value."""
    found: dict[str, Array] = {}
    for table in tables:
        for name, value in table.items():
            if name in found and not np.array_equal(found[name], value):
                raise InputError(
                    f"the parameter `{name}` is {found[name]} in one function and {value} in another",
                    argument="parameters",
                    component=name,
                    remedy=f"give both the same default, or one value for both: parameters={{'{name}': …}}",
                )
            found[name] = value
    for name in given:
        known_name("parameters", name, tuple(found), "parameter of the functions")
    return found


def changed(parameters: Mapping[str, Array], values: Mapping[str, object]) -> dict[str, Array]:
    """Parameters with other values for some."""
    new = dict(parameters)
    for name, value in values.items():
        known_name("with_params", name, tuple(parameters), "parameter")
        array = parameter_value("with_params", name, value)
        if array.shape != new[name].shape:
            raise InputError(
                f"`with_params`: `{name}` has shape {array.shape}, not {new[name].shape}",
                argument="with_params",
                component=name,
                remedy="give as many numbers as it had",
            )
        new[name] = array
    return new


class Parametric:
    """Something with parameters that cannot be changed, only copied with other values."""

    __slots__ = ("_parameters",)

    _parameters: dict[str, Array]

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(
            f"a {type(self).__name__} cannot be changed; with_params(…) gives a copy with other parameters"
        )

    def _put(self, **fields: object) -> None:
        for name, value in fields.items():
            object.__setattr__(self, name, value)

    @property
    def parameters(self) -> Mapping[str, Any]:
        """The parameters by name: floats, and arrays that cannot be written to."""
        plain = {name: value if value.ndim else float(value) for name, value in self._parameters.items()}
        return MappingProxyType(plain)

    def with_params(self, **values: object) -> Self:
        """A copy with other values for some parameters; nothing is traced again.

        Parameters
        ----------
        **values
            Numbers, or arrays of the same shape as before, by name.
        """
        twin = object.__new__(type(self))
        for cls in type(self).__mro__:
            for name in getattr(cls, "__slots__", ()):
                object.__setattr__(twin, name, getattr(self, name))
        object.__setattr__(twin, "_parameters", changed(self._parameters, values))
        return twin

    def _table(self) -> list[tuple[str, str]]:
        raise NotImplementedError

    def __repr__(self) -> str:
        (_, function), *rest = self._table()
        inner = ", ".join([function, *(f"{key}={value}" for key, value in rest if value)])
        return f"{type(self).__name__}({inner})"

    def _repr_html_(self) -> str:
        from givens._html import fields_html

        return fields_html(type(self).__name__, self._table())

    def _shown_parameters(self) -> str:
        shown = {name: value.tolist() for name, value in self._parameters.items()}
        return ", ".join(
            f"{name}={value:.6g}" if isinstance(value, float) else f"{name}={value}" for name, value in shown.items()
        )


class Dynamics(Parametric, Batched):
    """States, controls and the two functions of a model of motion."""

    __slots__ = ("_joined", "_parts", "controls", "jacobian", "state")

    state: tuple[str, ...]
    controls: tuple[str, ...]
    jacobian: Part | None
    _parts: dict[str, Part]
    _joined: dict[Any, Any]

    @property
    def kind(self) -> str:
        """``"continuous"`` or ``"discrete"``."""
        raise NotImplementedError

    def _key(self) -> tuple[Any, ...]:
        parts = [(part.argument, part.traced, id(part.called)) for part in self._parts.values()]
        values = [(name, value.tobytes()) for name, value in self._parameters.items()]
        return type(self), self.state, self.controls, parts, values

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Dynamics):
            return NotImplemented
        return self._key() == other._key()

    def __hash__(self) -> int:
        return hash((type(self), self.state, self.controls))

    def __getstate__(self) -> dict[str, Any]:
        fields = {name: getattr(self, name) for cls in type(self).__mro__ for name in getattr(cls, "__slots__", ())}
        return fields | {"_joined": {}}

    def __setstate__(self, fields: dict[str, Any]) -> None:
        self._put(**fields)


def begin(
    state: object,
    controls: object,
    parameters: Mapping[str, object] | None,
    trace: bool,
    vectorized: bool,
    check_at: Any,
) -> dict[str, Any]:
    """The fields of requests that the two kinds of models read alike."""
    states = names_of("state", state, example='["x", "vx"]')
    if not states:
        raise InputError("`state` names no state", argument="state", remedy='write state=["x", "vx"]')
    held = names_of("controls", controls, example='["thrust"]')
    both = set(states) & set(held)
    if both:
        raise InputError(
            f"{listed(sorted(both))} is both a state and a control", argument="controls", remedy="name them differently"
        )
    if check_at is not None:
        from givens._arrays import vector

        check_at = vector("check_at", check_at, states)
    return {
        "states": states,
        "controls": held,
        "parameters": dict(parameters or {}),
        "trace": trace,
        "vectorized": called_at_once(vectorized, trace),
        "check_at": check_at,
    }


def called_at_once(vectorized: bool, trace: bool) -> bool:
    """Refuses `vectorized` of a function that is traced, which no one reads."""
    if vectorized and trace:
        raise InputError(
            "`vectorized` is given, but the function is traced",
            argument="vectorized",
            remedy="leave it out, or write trace=False beside it",
        )
    return bool(vectorized)


def read_jacobian(given: Any, main: Part, common: Mapping[str, Any], required: tuple[str, ...]) -> Part | None:
    """The derivatives of a function that is called."""
    if given is None:
        return None
    if main.called is None:
        raise InputError(
            "`jacobian` is given, but the function is traced",
            argument="jacobian",
            remedy="leave it out: a traced function has exact derivatives of its own",
        )
    return Request(
        "jacobian", required, ("u",) if common["controls"] else (), **{**common, "trace": False, "vectorized": False}
    ).read(given)


def noise_request(argument: str, required: tuple[str, ...], u: tuple[str, ...], common: Mapping[str, Any]) -> Request:
    """How a noise is read: it is traced in any case, and compared nowhere in particular."""
    return Request(argument, required, u, **{**common, "trace": True, "check_at": None}, may_call=False)

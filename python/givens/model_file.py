"""Model files: models written as text, for the command and for every face of the library."""

from __future__ import annotations

import os
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from givens._batched import Batched
from givens._names import known_name
from givens._native import Model
from givens._scalars import shown
from givens._scalars import text as _text
from givens._trace.arguments import parameter_value
from givens.errors import InputError
from givens.gaussian import Gaussian

if TYPE_CHECKING:
    from givens.estimates import Estimates

__all__ = ["ModelFile", "parse_model", "read_model"]


class ModelFile(Batched):
    """A model file: model, sensors, prior or start, and method.

    `read_model` and `parse_model` make it; a function that takes a model and its sensors takes it, and None for these.

    Attributes
    ----------
    state, measures, controls : tuple of str
        Names, in order.
    parameters : mapping
        Values by name.
    prior : Gaussian or None
        The initial belief; None if `start` finds states from the first rows.
    time : float or None
        When the prior holds; None: at the first row.
    method : str or None
        The method that the file names.
    options : mapping
        Its parts and options.
    kind : str
        ``"continuous"`` or ``"discrete"``.

    Examples
    --------
    >>> import givens as gv
    >>> model = gv.parse_model('''
    ... [state]
    ... names = ["x", "v"]
    ... mean = [0, 1]
    ... std = [1, 1]
    ... [dynamics]
    ... transition = { x = "x + dt*v", v = "v" }
    ... [[sensor]]
    ... name = "ruler"
    ... measures = { length = "x" }
    ... std = { length = 0.1 }
    ... ''')
    >>> est = model.filter([0.0, 1.0], [[0.1], [1.0]])
    >>> est.mean.shape
    (2, 2)
    """

    __slots__ = ("_text", "native")

    native: Model
    _text: str

    def __init__(self, native: Model, text: str) -> None:
        object.__setattr__(self, "native", native)
        object.__setattr__(self, "_text", text)

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (self._text, self.native.file or "model", dict(self.parameters))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ModelFile):
            return NotImplemented
        return (self._text, self.parameters) == (other._text, other.parameters)

    def __hash__(self) -> int:
        return hash(self._text)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("a model file cannot be changed; with_params(…) gives a copy with other parameters")

    def __delattr__(self, name: str) -> None:
        raise AttributeError("a model file cannot be changed; with_params(…) gives a copy with other parameters")

    @property
    def state(self) -> tuple[str, ...]:
        """Names of the states."""
        return tuple(self.native.states)

    @property
    def measures(self) -> tuple[str, ...]:
        """Names of the measures of all sensors."""
        return tuple(self.native.measures)

    @property
    def controls(self) -> tuple[str, ...]:
        """Names of the controls, without ``u_``."""
        return tuple(self.native.control_names)

    @property
    def kind(self) -> str:
        """``"continuous"`` or ``"discrete"``."""
        return self.native.kind

    @property
    def parameters(self) -> Mapping[str, float]:
        """Values of the parameters by name."""
        values = map(float, self.native.parameters)
        return MappingProxyType(dict(zip(self.native.parameter_names, values, strict=True)))

    @property
    def prior(self) -> Gaussian | None:
        """The initial belief."""
        prior = self.native.prior
        return None if prior is None or self.native.start else Gaussian(*prior)

    @property
    def time(self) -> float | None:
        """When the prior holds."""
        return self.native.time

    @property
    def method(self) -> str | None:
        """The method that the file names."""
        return self.native.method

    @property
    def options(self) -> Mapping[str, Any]:
        """Its parts and options."""
        return MappingProxyType(dict(self.native.options))

    def with_params(self, **values: float) -> ModelFile:
        """A copy with other values for some parameters."""
        new = dict(self.parameters)
        for name, value in values.items():
            known_name("with_params", name, tuple(new), "parameter")
            new[name] = _float("with_params", name, value)
        return ModelFile(self.native.with_parameters(np.array(list(new.values()), dtype=float)), self._text)

    def filter(self, t: Any, z: Any = None, **options: Any) -> Estimates | Any:
        """Filters a table, the path of a CSV file, or arrays `t` and `z`; see `givens.filter`."""
        from givens.running import filter

        return filter(self, None, t, z, **options)

    def smooth(self, t: Any, z: Any = None, **options: Any) -> Estimates | Any:
        """Smooths a table, the path of a CSV file, or arrays `t` and `z`; see `givens.smooth`."""
        from givens.running import smooth

        return smooth(self, None, t, z, **options)

    def _table(self) -> list[tuple[str, str]]:
        parameters = ", ".join(f"{name}={value:g}" for name, value in self.parameters.items())
        return [
            ("file", self.native.file or ""),
            ("state", f"[{', '.join(self.state)}]"),
            ("measures", f"[{', '.join(self.measures)}]"),
            ("controls", f"[{', '.join(self.controls)}]" if self.controls else ""),
            ("parameters", f"({parameters})" if parameters else ""),
            ("method", self.method or ""),
        ]

    def __repr__(self) -> str:
        return f"ModelFile({', '.join(f'{key}={value}' for key, value in self._table() if value)})"

    def _repr_html_(self) -> str:
        from givens._html import fields_html

        return fields_html("ModelFile", self._table())


_NAME = "give the file a name that is UTF-8"
_UTF8 = 'read files as UTF-8: open(path, encoding="utf-8")'


def read_model(path: str | os.PathLike[str], **parameters: float) -> ModelFile:
    """Reads a model file.

    Parameters
    ----------
    path : str or path
        The file.
    **parameters
        Values for some of its parameters.

    Raises
    ------
    ModelError
        For a file with errors; all of them, with their places.
    """
    if not isinstance(path, (str, os.PathLike)):
        raise InputError(
            f"`path` is {shown(path)}, not a path", argument="path", remedy='write read_model("model.toml")'
        )
    named = _text("path", os.fspath(path), "a path", 'write read_model("model.toml")', _NAME)
    native = Model.read(named, _floats(parameters))
    with open(path, encoding="utf-8") as file:
        return ModelFile(native, file.read())


def parse_model(text: str, *, name: str = "model", **parameters: float) -> ModelFile:
    """Reads the text of a model file; errors call it `name`. Otherwise as `read_model`."""
    words = _text("text", text, "the text of a model file", "read files with gv.read_model(path)", _UTF8)
    called = _text("name", name, "a name", 'write name="model"')
    return ModelFile(Model.parse(words, called, _floats(parameters)), words)


def _again(text: str, name: str, parameters: dict[str, float]) -> ModelFile:
    return parse_model(text, name=name, **parameters)


def _floats(parameters: Mapping[str, float]) -> dict[str, float]:
    return {
        _text("parameters", name, "a name", "name a parameter"): _float("parameters", name, value)
        for name, value in parameters.items()
    }


def _float(argument: str, name: str, value: object) -> float:
    array = parameter_value(argument, name, value)
    if array.ndim:
        raise InputError(
            f"`{argument}`: the parameter `{name}` has shape {array.shape}, not ()",
            argument=argument,
            component=name,
            remedy="give one number",
        )
    return float(array)

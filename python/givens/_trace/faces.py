"""What stands for NumPy, `math`, SciPy's special functions and a user's modules while a function is traced.

A universal function finds its symbols by itself; `np.zeros(3)`, a list of symbols, or `math.sin` would not.
"""

from __future__ import annotations

import builtins
from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np

from givens._trace.array import boxed, has_symbols, lifted
from givens._trace.elementary import ELEMENTARY
from givens._trace.functions import call_named
from givens._trace.mathematics import of_math
from givens._trace.symbol import Sym

__all__ = ["Face", "face_of_value", "faced_builtins"]


class _Ufunc:
    """A universal function that also takes lists of symbols."""

    def __init__(self, real: np.ufunc) -> None:
        self._real = real
        self.__name__ = real.__name__

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        args = tuple(boxed(v) if isinstance(v, (list, tuple)) and has_symbols(v) else v for v in args)
        return self._real(*args, **kwargs)

    def reduce(self, array: Any, *args: Any, **kwargs: Any) -> Any:
        return self._real.reduce(boxed(array) if has_symbols(array) else array, *args, **kwargs)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._real, name)


class _IsFloat(type):
    def __instancecheck__(cls, value: object) -> bool:
        return isinstance(value, np.float64)


class _Float64(np.float64, metaclass=_IsFloat):
    """`np.float64`, which leaves symbols as they are."""

    def __new__(cls, value: Any = 0.0, /) -> Any:
        return value if isinstance(value, Sym) else np.float64(value)


class _Joined:
    """`np.r_` and `np.c_`."""

    def __init__(self, real: Any) -> None:
        self._real = real

    def __getitem__(self, key: Any) -> Any:
        parts = tuple(
            boxed([part]) if isinstance(part, Sym) else part for part in (key if isinstance(key, tuple) else (key,))
        )
        return lifted(self._real[parts])


class Face:
    """A module seen through a function that replaces what is taken from it."""

    def __init__(self, real: ModuleType, seen: Callable[[Any], Any]) -> None:
        self.__dict__.update(_real=real, _seen=seen, __name__=real.__name__)

    def __getattr__(self, name: str) -> Any:
        value = self._seen(getattr(self._real, name))
        self.__dict__[name] = value
        return value


def _function(value: Any, name: str) -> Callable[..., Any]:
    def call(*args: Any, **kwargs: Any) -> Any:
        return call_named(name, args, kwargs)

    call.__name__ = value.__name__
    return call


#: Modules that are shown with functions that know symbols.
_FACED = frozenset(("math", "numpy", "numpy.linalg", "scipy", "scipy.special"))


def face_of_value(value: Any) -> Any:
    """What stands for a value of NumPy's or `math`'s; the value itself if nothing need."""
    if isinstance(value, ModuleType):
        return Face(value, face_of_value) if value.__name__ in _FACED else value
    if isinstance(value, np.ufunc):
        return _Ufunc(value) if value.__name__ in ELEMENTARY or getattr(np, value.__name__, None) is value else value
    if value is np.float64:
        return _Float64
    if value is np.r_ or value is np.c_:
        return _Joined(value)
    module, name = getattr(value, "__module__", None), getattr(value, "__name__", None)
    if not isinstance(module, str) or not isinstance(name, str) or not callable(value) or isinstance(value, type):
        return value
    if module == "math":
        return of_math(name)
    below = f"{module}.{name}".removeprefix("numpy.")
    return _function(value, below) if _is_numpy(module) and _found(below) is value else value


def _is_numpy(module: str) -> bool:
    return module in ("numpy", "numpy.linalg")


def _found(name: str) -> Any:
    found: Any = np
    for part in name.split("."):
        found = getattr(found, part, None)
    return found


def faced_builtins(seen: Callable[[Any], Any]) -> dict[str, Any]:
    """Python's own names, with an import that shows faces."""

    def imported(name: str, globals: Any = None, locals: Any = None, fromlist: Any = (), level: int = 0) -> Any:
        return seen(builtins.__import__(name, globals, locals, fromlist, level))

    return {**vars(builtins), "__import__": imported}

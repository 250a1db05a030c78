"""The functions of `math`, for symbols as well."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from givens._trace import rounding
from givens._trace.array import has_symbols
from givens._trace.choice import isclose
from givens._trace.elementary import ELEMENTARY
from givens._trace.refuse import refuse_function
from givens._trace.symbol import power

__all__ = ["of_math"]


def _total(values: Any, start: Any = 0.0) -> Any:
    for value in values:
        start = start + value
    return start


def _product(values: Any, *, start: Any = 1.0) -> Any:
    for value in values:
        start = start * value
    return start


def _log(x: Any, base: Any = None) -> Any:
    return np.log(x) if base is None else np.log(x) / np.log(base)


def _hypot(*coordinates: Any) -> Any:
    if len(coordinates) == 2:
        return np.hypot(*coordinates)
    return np.sqrt(_total(value * value for value in coordinates))


def _remainder(x: Any, y: Any) -> Any:
    return x - y * rounding.rint(x / y)


_NAMES = {
    **{name: name for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log10", "log2", "log1p", "expm1")},
    **{
        name: name
        for name in ("sqrt", "cbrt", "exp2", "floor", "ceil", "trunc", "copysign", "fmod", "degrees", "radians")
    },
    **{name: name for name in ("erf", "erfc", "fabs", "isnan", "isfinite", "isinf")},
    **{f"a{name}": f"arc{name}" for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh")},
    "atan2": "arctan2",
}

_TABLE: dict[str, Callable[..., Any]] = {
    **{name: ELEMENTARY[known] for name, known in _NAMES.items()},
    "pow": power,
    "log": _log,
    "hypot": _hypot,
    "dist": lambda p, q: _hypot(*(a - b for a, b in zip(p, q, strict=True))),
    "fsum": _total,
    "prod": _product,
    "sumprod": lambda p, q: _total(a * b for a, b in zip(p, q, strict=True)),
    "isclose": lambda a, b, *, rel_tol=1e-9, abs_tol=0.0: isclose(a, b, rel_tol, abs_tol),
    "remainder": _remainder,
    "modf": lambda x: (x - rounding.trunc(x), rounding.trunc(x)),
}


def of_math(name: str) -> Callable[..., Any]:
    """A function of `math`'s, by its name."""
    real = getattr(math, name)

    def function(*args: Any, **kwargs: Any) -> Any:
        args = tuple(list(value) if hasattr(value, "__next__") else value for value in args)
        if not has_symbols(args):
            return real(*args, **kwargs)
        if name not in _TABLE:
            raise refuse_function(f"math.{name}")
        return _TABLE[name](*args, **kwargs)

    function.__name__ = name
    return function

"""NumPy's universal functions, called with symbols."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from givens._trace import rounding
from givens._trace.array import SymArray, boxed, has_symbols, plain, rank, unboxed
from givens._trace.elementary import ELEMENTARY
from givens._trace.refuse import refuse_argument, refuse_filling, refuse_function
from givens._trace.symbol import Sym, is_symbol

__all__ = ["call_ufunc", "elementwise", "into", "is_double", "mapped", "method_of"]

_TWO_RESULTS = {
    "divmod": (rounding.floor_divide, rounding.mod),
    "modf": (lambda a: a - rounding.trunc(a), rounding.trunc),
}


def elementwise(name: str, *inputs: Any, real: Any = None) -> Any:
    """A function element by element over what broadcasts; numbers alone go to `real`, or to NumPy's of that name."""
    function = ELEMENTARY.get(name)
    if function is None:
        raise refuse_function(f"numpy.{name}" if hasattr(np, name) else name)
    return _over(function, real or getattr(np, name), inputs)


def _over(function: Any, real: Any, inputs: tuple[Any, ...]) -> Any:
    if all(rank(value) == 0 for value in inputs):
        values: Any = [value.item() if isinstance(value, np.ndarray) else value for value in inputs]
        return function(*values) if any(map(is_symbol, values)) else real(*map(_number, values))
    grid = np.broadcast(*map(plain, inputs))
    out = np.empty(grid.shape, dtype=object)
    for at, values in zip(np.ndindex(grid.shape), grid, strict=True):
        out[at] = function(*values) if any(map(is_symbol, values)) else real(*map(_number, values))
    return out.view(SymArray)


def _number(value: Any) -> Any:
    """A number as NumPy would hold it in an array: Python's own divides by zero with an exception."""
    return np.float64(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else value


def call_ufunc(ufunc: np.ufunc, method: str, inputs: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
    """What `__array_ufunc__` is to do."""
    name = ufunc.__name__
    out = kwargs.pop("out", None)
    where = kwargs.pop("where", True)
    for ignored in ("casting", "order", "subok"):
        kwargs.pop(ignored, None)
    if not is_double(kwargs.pop("dtype", None)):
        raise refuse_argument(f"numpy.{name}", "dtype")
    if where is not True:
        raise refuse_argument(f"numpy.{name}", "where")
    result = _called(ufunc, name, method, inputs, kwargs)
    return into(out, result) if out is not None else result


def is_double(dtype: Any) -> bool:
    """Whether an argument asks for 64-bit floats, which is all that there is here, or for nothing."""
    return dtype is None or np.dtype(dtype) == np.float64


def _called(ufunc: np.ufunc, name: str, method: str, inputs: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
    from givens._trace.functions import call_named

    if method == "__call__" and name in ("matmul", "vecdot", "matvec", "vecmat"):
        return call_named(name, inputs, kwargs)
    if method == "__call__" and name in _TWO_RESULTS:
        return tuple(_over(function, _only(ufunc, k), inputs) for k, function in enumerate(_TWO_RESULTS[name]))
    if method == "__call__":
        return elementwise(name, *inputs, real=ufunc)
    if method == "outer":
        a, b = (boxed(value) for value in inputs)
        return elementwise(name, a.reshape(a.shape + (1,) * b.ndim), b)
    fold = {"add": "sum", "multiply": "prod", "maximum": "max", "minimum": "min"}
    fold |= {"logical_and": "all", "logical_or": "any", "logaddexp": "logaddexp.reduce"}
    running = {"add": "cumsum", "multiply": "cumprod"}
    if method == "reduce" and name in fold:
        kwargs.setdefault("axis", 0)
        return call_named(fold[name], inputs, kwargs)
    if method == "accumulate" and name in running:
        kwargs.setdefault("axis", 0)
        return call_named(running[name], inputs, kwargs)
    raise refuse_function(f"numpy.{name}.{method}")


def _only(ufunc: np.ufunc, k: int) -> Any:
    return lambda *values: ufunc(*values)[k]


def into(out: Any, result: Any) -> Any:
    """Writes a result where `out` says, and gives that."""
    targets = out if isinstance(out, tuple) else (out,)
    results = result if isinstance(result, tuple) else (result,)
    for target, value in zip(targets, results, strict=True):
        if target is None:
            continue
        if not isinstance(target, SymArray) and target.dtype != object and has_symbols(value):
            raise refuse_filling()
        target[...] = plain(value) if rank(value) else value
    return out[0] if isinstance(out, tuple) and len(out) == 1 else out


def method_of(symbol: Sym, name: str) -> Any:
    """The method of a symbol that NumPy's loops over objects look for, or None."""
    if name in ELEMENTARY:
        return partial(ELEMENTARY[name], symbol)
    return partial(_reduced, name, symbol) if name in ("sum", "mean", "prod", "min", "max", "clip", "ravel") else None


def _reduced(name: str, symbol: Sym, *args: Any, **kwargs: Any) -> Any:
    from givens._trace.functions import call_named

    return call_named(name, (symbol, *args), kwargs)


def mapped(function: Any, value: Any) -> Any:
    """A function of one number, element by element."""
    if rank(value) == 0:
        return function(value)
    objects = plain(value)
    out = np.empty(objects.shape, dtype=object)
    for at in np.ndindex(objects.shape):
        out[at] = function(objects[at])
    return unboxed(out)

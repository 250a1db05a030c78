"""Sums, products, extremes and norms over the axes of traced arrays."""

from __future__ import annotations

from typing import Any

import numpy as np

from givens._trace.array import SymArray, boxed, plain, unboxed
from givens._trace.refuse import refuse_argument, refuse_function
from givens._trace.symbol import is_condition, is_symbol, select
from givens._trace.universal import elementwise

__all__ = ["REDUCTIONS"]


def _pairwise(name: str, identity: Any) -> np.ufunc:
    made: np.ufunc = np.frompyfunc(lambda a, b: elementwise(name, a, b), 2, 1, identity=identity)
    return made


_MAX = _pairwise("maximum", -np.inf)
_MIN = _pairwise("minimum", np.inf)
_ALL = _pairwise("logical_and", True)
_ANY = _pairwise("logical_or", False)


def _counted(a: Any) -> Any:
    """Conditions as numbers: a sum counts them, where `+` between two is their or."""
    objects = plain(a)
    if not any(is_condition(value) for value in objects.flat):
        return objects
    return plain([select(value, 1.0, 0.0) if is_condition(value) else value for value in objects.flat]).reshape(
        objects.shape
    )


def _fold(name: str, fold: np.ufunc) -> Any:
    def reduction(
        a: Any,
        axis: Any = None,
        dtype: Any = None,
        out: Any = None,
        keepdims: Any = False,
        initial: Any = None,
        where: Any = True,
    ) -> Any:
        objects = _counted(a) if fold is np.add else plain(a)
        if axis is None and not keepdims:
            objects, axis = objects.ravel(), 0
        result = unboxed(fold.reduce(objects, axis=axis, keepdims=bool(keepdims)))
        if initial is not None and fold in (np.add, np.multiply):
            return result + initial if fold is np.add else result * initial
        if initial is not None:
            return elementwise("maximum" if fold is _MAX else "minimum", result, initial)
        return result

    return reduction


def _running(name: str, fold: np.ufunc) -> Any:
    def accumulation(a: Any, axis: Any = None, dtype: Any = None, out: Any = None) -> Any:
        objects = _counted(a) if fold is np.add else plain(a)
        if axis is None:
            objects, axis = objects.ravel(), 0
        return unboxed(fold.accumulate(objects, axis=axis))

    return accumulation


_sum = _fold("sum", np.add)
_max = _fold("max", _MAX)
_min = _fold("min", _MIN)


def _count(shape: tuple[int, ...], axis: Any) -> int:
    if axis is None:
        return int(np.prod(shape))
    axes = axis if isinstance(axis, tuple) else (axis,)
    return int(np.prod([shape[k] for k in axes]))


def mean(a: Any, axis: Any = None, dtype: Any = None, out: Any = None, keepdims: Any = False) -> Any:
    return _sum(a, axis=axis, keepdims=keepdims) / float(_count(boxed(a).shape, axis))


def average(a: Any, axis: Any = None, weights: Any = None, returned: bool = False, *, keepdims: Any = False) -> Any:
    if returned:
        raise refuse_argument("numpy.average", "returned")
    if weights is None:
        return mean(a, axis, keepdims=keepdims)
    a, weights = boxed(a), boxed(weights)
    if weights.shape != a.shape:
        weights = weights.reshape([-1 if k == axis % a.ndim else 1 for k in range(a.ndim)])
    total = _sum(weights * np.ones(a.shape), axis=axis, keepdims=keepdims)
    return _sum(a * weights, axis=axis, keepdims=keepdims) / total


def var(a: Any, axis: Any = None, dtype: Any = None, out: Any = None, ddof: float = 0, keepdims: Any = False) -> Any:
    a = boxed(a)
    deviation = a - mean(a, axis, keepdims=True) if axis is not None else a - mean(a)
    squares = _sum(deviation * deviation, axis=axis, keepdims=keepdims)
    return squares / (_count(a.shape, axis) - ddof)


def std(a: Any, axis: Any = None, dtype: Any = None, out: Any = None, ddof: float = 0, keepdims: Any = False) -> Any:
    return np.sqrt(var(a, axis, ddof=ddof, keepdims=keepdims))


def ptp(a: Any, axis: Any = None, out: Any = None, keepdims: Any = False) -> Any:
    return _max(a, axis=axis, keepdims=keepdims) - _min(a, axis=axis, keepdims=keepdims)


def norm(x: Any, ord: Any = None, axis: Any = None, keepdims: bool = False) -> Any:
    """Norms of vectors of order 1, 2, ∞ or any other; of matrices, Frobenius, 1 and ∞."""
    if is_symbol(x):
        return abs(x)
    x = boxed(x)
    if axis is None and (ord is None or x.ndim == 1):
        x, axis = (x.ravel() if ord is None and not keepdims else x), None
        if ord is None and not keepdims:
            axis = 0
    if axis is None:
        axis = 0 if x.ndim == 1 else (x.ndim - 2, x.ndim - 1)
    size = np.abs(x)
    if isinstance(axis, tuple) and len(axis) == 2:
        return _matrix_norm(size, ord, axis, keepdims)
    if ord is None or ord == 2:
        return np.sqrt(_sum(x * x, axis=axis, keepdims=keepdims))
    if ord in (np.inf, -np.inf):
        return (_max if ord > 0 else _min)(size, axis=axis, keepdims=keepdims)
    if ord == 1:
        return _sum(size, axis=axis, keepdims=keepdims)
    if isinstance(ord, (int, float)) and ord != 0:
        return _sum(size**ord, axis=axis, keepdims=keepdims) ** (1.0 / ord)
    raise refuse_function(f"numpy.linalg.norm of order {ord!r}")


def _matrix_norm(size: SymArray, ord: Any, axes: tuple[int, int], keepdims: bool) -> Any:
    if ord is None or ord == "fro":
        return np.sqrt(_sum(size * size, axis=axes, keepdims=keepdims))
    if ord in (1, np.inf):
        over = axes[0] if ord == 1 else axes[1]
        return _max(_sum(size, axis=over, keepdims=True), axis=axes, keepdims=keepdims)
    raise refuse_function(f"numpy.linalg.norm of a matrix, of order {ord!r},")


def vector_norm(x: Any, *, axis: Any = None, keepdims: bool = False, ord: Any = 2) -> Any:
    x = boxed(x)
    return norm(x.ravel(), ord) if axis is None and not keepdims else norm(x, ord, axis, keepdims)


def count_nonzero(a: Any, axis: Any = None, *, keepdims: bool = False) -> Any:
    return _sum(elementwise("not_equal", a, 0.0) + 0.0, axis=axis, keepdims=keepdims)


REDUCTIONS: dict[str, Any] = {
    "sum": _sum,
    "prod": _fold("prod", np.multiply),
    "logaddexp.reduce": _fold("logaddexp", _pairwise("logaddexp", -np.inf)),
    **dict.fromkeys(("max", "amax"), _max),
    **dict.fromkeys(("min", "amin"), _min),
    "all": _fold("all", _ALL),
    "any": _fold("any", _ANY),
    "cumsum": _running("cumsum", np.add),
    "cumprod": _running("cumprod", np.multiply),
    "mean": mean,
    "average": average,
    "var": var,
    "std": std,
    "ptp": ptp,
    "count_nonzero": count_nonzero,
    "linalg.norm": norm,
    "linalg.vector_norm": vector_norm,
}

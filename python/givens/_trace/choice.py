"""Functions that choose between values: where, select, clip, interp and their kin."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from givens._trace.array import SymArray, boxed, has_symbols, numbers, plain, rank
from givens._trace.elementary import sinc
from givens._trace.refuse import refuse, refuse_argument
from givens._trace.rounding import rint, trunc
from givens._trace.symbol import select
from givens._trace.universal import elementwise, mapped

__all__ = ["CHOICE"]


def where(condition: Any, x: Any = None, y: Any = None) -> Any:
    if x is None or y is None:
        raise refuse("np.where(condition) alone gives indices", "write np.where(condition, yes, no)")
    if rank(condition) == rank(x) == rank(y) == 0:
        return select(_item(condition), _item(x), _item(y))
    grid = np.broadcast(plain_condition(condition), plain(x), plain(y))
    out = np.empty(grid.shape, dtype=object)
    for at, (c, yes, no) in zip(np.ndindex(grid.shape), grid, strict=True):
        out[at] = select(c, yes, no)
    return out.view(SymArray)


def plain_condition(condition: Any) -> Any:
    if isinstance(condition, np.ndarray) and condition.dtype == bool:
        return condition
    return plain(condition)


def _item(value: Any) -> Any:
    value = value.item() if isinstance(value, np.ndarray) else value
    return np.float64(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else value


def select_(condlist: Sequence[Any], choicelist: Sequence[Any], default: Any = 0) -> Any:
    result: Any = float(default) if rank(default) == 0 and not has_symbols(default) else default
    for condition, choice in zip(reversed(condlist), reversed(choicelist), strict=True):
        result = where(condition, choice, result)
    return result


def piecewise(x: Any, condlist: Any, funclist: Sequence[Any], *args: Any, **kwargs: Any) -> Any:
    conditions = list(condlist) if isinstance(condlist, (list, tuple)) else [condlist]
    choices = [function(x, *args, **kwargs) if callable(function) else function for function in funclist]
    default = choices[len(conditions)] if len(choices) > len(conditions) else 0.0
    result = default
    for condition, choice in zip(conditions, choices, strict=False):
        # of conditions that overlap, the last one holds
        result = where(condition, choice, result)
    return result


def clip(a: Any, a_min: Any = None, a_max: Any = None, out: Any = None, *, min: Any = None, max: Any = None) -> Any:
    low, high = a_min if min is None else min, a_max if max is None else max
    a = a if low is None else elementwise("maximum", a, low)
    return a if high is None else elementwise("minimum", a, high)


def interp(x: Any, xp: Any, fp: Any, left: Any = None, right: Any = None, period: Any = None) -> Any:
    """Between the knots of a table of numbers; its ordinates may be symbols."""
    if has_symbols(xp) or period is not None:
        raise refuse(
            "np.interp has no expression here with knots that are not known yet, or with a period",
            "give numbers as xp; reduce x to one period with np.mod",
        )
    knots, values = numbers(xp), plain(fp)
    left = values[0] if left is None else left
    right = values[-1] if right is None else right

    def at(point: Any) -> Any:
        result = select(point == knots[-1], values[-1], right)
        for k in range(len(knots) - 2, -1, -1):
            slope = (values[k + 1] - values[k]) / (knots[k + 1] - knots[k])
            result = select(point < knots[k + 1], values[k] + slope * (point - knots[k]), result)
        return select(point < knots[0], left, result)

    return mapped(at, boxed(x) if rank(x) else _item(x))


def polyval(p: Any, x: Any) -> Any:
    total: Any = 0.0
    for coefficient in p:
        total = total * x + coefficient
    return total


def round_(a: Any, decimals: int = 0, out: Any = None) -> Any:
    """Ties to the even digit, as far as doubles hold it."""
    if decimals == 0:
        return elementwise("rint", a)
    scale = 10.0**decimals
    return mapped(lambda value: rint(value * scale) / scale, a)


def nan_to_num(x: Any, copy: bool = True, nan: Any = 0.0, posinf: Any = None, neginf: Any = None) -> Any:
    top = np.finfo(float).max
    high, low = (top if posinf is None else posinf), (-top if neginf is None else neginf)
    objects = boxed(x) if rank(x) else x
    result = where(objects == np.inf, high, where(objects == -np.inf, low, where(objects == objects, objects, nan)))
    if copy or not rank(x):
        return result
    if not isinstance(x, SymArray):
        raise refuse_argument("numpy.nan_to_num", "copy")
    x[...] = result
    return x


def isclose(a: Any, b: Any, rtol: float = 1e-05, atol: float = 1e-08, equal_nan: bool = False) -> Any:
    difference = elementwise("absolute", elementwise("subtract", a, b))
    close = elementwise("less_equal", difference, elementwise("absolute", b) * rtol + atol)
    close = elementwise("logical_and", close, elementwise("isfinite", b))
    close = elementwise("logical_or", close, elementwise("equal", a, b))
    if equal_nan:
        both = elementwise("logical_and", elementwise("isnan", a), elementwise("isnan", b))
        return elementwise("logical_or", close, both)
    return close


def linspace(start: Any, stop: Any, num: int = 50, endpoint: bool = True, dtype: Any = None) -> Any:
    parts = max(num - 1 if endpoint else num, 1)
    return boxed([start + (stop - start) * (k / parts) for k in range(num)])


CHOICE: dict[str, Any] = {
    "where": where,
    "select": select_,
    "piecewise": piecewise,
    "clip": clip,
    "interp": interp,
    "polyval": polyval,
    **dict.fromkeys(("round", "around", "round_"), round_),
    "fix": lambda x, out=None: mapped(trunc, x),
    "sinc": lambda x: mapped(sinc, x),
    "nan_to_num": nan_to_num,
    "isclose": isclose,
    "linspace": linspace,
    "real": lambda val: val,
    "imag": lambda val: np.zeros(np.shape(val)),
    "isreal": lambda x: np.ones(np.shape(x), dtype=bool),
    "real_if_close": lambda a, tol=100: a,
}

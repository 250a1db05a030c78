"""Exponentials, logarithms and hyperbolic inverses that the graph does not know, made of those it does.

Each keeps its digits wherever NumPy's does, and so do its derivatives: where a form changes, both sides have the same.
"""

from __future__ import annotations

from math import log
from typing import Any

from givens._trace.applied import apply, apply_two, polynomial
from givens._trace.rounding import rint
from givens._trace.symbol import power, select

__all__ = ["arccosh", "arcsinh", "arctanh", "exp2", "expm1", "log1p", "log2", "logaddexp", "logaddexp2"]

_LOG2 = log(2.0)
#: Beyond, x² + 1 is x².
_LARGE = 1e9


def exp2(a: Any) -> Any:
    return apply_two("pow", 2.0, a)


def log2(a: Any) -> Any:
    """Whole at the powers of two, so that its floor is their exponent."""
    value = apply("log", a) / _LOG2
    whole = rint(value)
    away = whole - value
    # a floor has no derivative: the step onto the whole number leaves the slope as it is
    onto = apply("floor", away * 2.0**60) * 2.0**-60
    return value + select(apply("abs", away) <= apply("abs", whole) * 2.0**-52, onto, 0.0)


def expm1(a: Any) -> Any:
    """exp(a) − 1, near zero as 2 sinh(a/2) exp(a/2)."""
    near = 2.0 * apply("sinh", a / 2.0) * apply("exp", a / 2.0)
    return select(apply("abs", a) < 1.0, near, apply("exp", a) - 1.0)


def log1p(a: Any) -> Any:
    """log(1 + a) without cancellation: near zero 2 artanh(a/(2 + a)), by its series."""
    s = a / (2.0 + a)
    near = 2.0 * s * polynomial(power(s, 2), [1 / (2 * k + 1) for k in range(8)])
    return select(apply("abs", a) < 0.1, near, apply("log", 1.0 + a))


def logaddexp(a: Any, b: Any) -> Any:
    return _added(a, b, 1.0)


def logaddexp2(a: Any, b: Any) -> Any:
    return _added(a, b, _LOG2)


def _added(a: Any, b: Any, unit: float) -> Any:
    """The larger one and a rest that both terms stand in where they are close, so that the slopes are their shares."""
    top, apart = apply_two("max", a, b), apply("abs", a - b) * unit
    shares = apply("exp", (a - top) * unit) + apply("exp", (b - top) * unit)
    rest = select(apart < 1.0, apply("log", shares), log1p(apply("exp", -apart))) / unit
    # two infinities of one sign have no difference
    return select(apply_two("equal", a, b) & (apply("abs", top) == float("inf")), top, top + rest)


def _odd(function: Any) -> Any:
    """Of a function that is odd, by its positive half: smooth at zero, unlike a sign times it."""

    def whole(a: Any) -> Any:
        half = function(apply("abs", a))
        return select(a < 0.0, -half, half)

    return whole


def _arcsinh(size: Any) -> Any:
    near = log1p(size + size * size / (1.0 + apply("sqrt", size * size + 1.0)))
    return select(size < _LARGE, near, apply("log", size) + _LOG2)


def arccosh(a: Any) -> Any:
    over = a - 1.0
    near = log1p(over + apply("sqrt", over * (a + 1.0)))
    return select(a < _LARGE, near, apply("log", a) + _LOG2)


arcsinh = _odd(_arcsinh)
arctanh = _odd(lambda size: 0.5 * log1p(2.0 * size / (1.0 - size)))

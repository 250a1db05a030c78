"""Elementary functions of one or two numbers that the graph does not know, made of those it does.

Every function here takes symbols or numbers, at least one of them a symbol. Unless said otherwise it agrees with NumPy
to a few units in the last place; the sign of a zero is not kept.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import log, pi
from typing import Any

from givens._trace.symbol import Scalar, Sym, binary, power, select, unary

__all__ = ["ELEMENTARY"]


def _apply(op: str, a: Scalar) -> Any:
    if isinstance(a, Sym):
        return unary(op, a)
    import numpy as np

    return getattr(np, _NUMPY.get(op, op))(a)


_NUMPY = {"asin": "arcsin", "acos": "arccos", "atan": "arctan", "neg": "negative"}


def _polynomial(x: Scalar, coefficients: Sequence[float]) -> Any:
    """By Horner's scheme; the constant first."""
    total: Any = coefficients[-1]
    for coefficient in reversed(coefficients[:-1]):
        total = total * x + coefficient
    return total


# rounding


def ceil(a: Any) -> Any:
    return -_apply("floor", -a)


def trunc(a: Any) -> Any:
    return _apply("sign", a) * _apply("floor", _apply("abs", a))


def rint(a: Any) -> Any:
    """To the nearest whole number, ties to the even one."""
    up = _apply("floor", a + 0.5)
    odd = up - 2.0 * _apply("floor", up / 2.0)
    return select((up - a == 0.5) & (odd == 1.0), up - 1.0, up)


def floor_divide(a: Any, b: Any) -> Any:
    return _apply("floor", a / b)


def mod(a: Any, b: Any) -> Any:
    """The remainder with the sign of `b`; at a jump, rounding decides on which side it lies."""
    return a - b * _apply("floor", a / b)


def fmod(a: Any, b: Any) -> Any:
    """The remainder with the sign of `a`."""
    return a - b * trunc(a / b)


# powers, exponentials, logarithms


def cbrt(a: Any) -> Any:
    return _apply("sign", a) * binary("pow", _apply("abs", a), 1.0 / 3.0)


def square(a: Any) -> Any:
    return power(a, 2)


def reciprocal(a: Any) -> Any:
    return 1.0 / a


def exp2(a: Any) -> Any:
    return binary("pow", 2.0, a)


def log2(a: Any) -> Any:
    return _apply("log", a) / log(2.0)


def expm1(a: Any) -> Any:
    """exp(a) − 1 without cancellation, as 2 sinh(a/2) exp(a/2)."""
    return 2.0 * _apply("sinh", a / 2.0) * _apply("exp", a / 2.0)


def log1p(a: Any) -> Any:
    """log(1 + a) without cancellation: near zero 2 artanh(a/(2 + a)), by its series."""
    s = a / (2.0 + a)
    near = 2.0 * s * _polynomial(power(s, 2), [1 / (2 * k + 1) for k in range(8)])
    return select(_apply("abs", a) < 0.1, near, _apply("log", 1.0 + a))


def logaddexp(a: Any, b: Any) -> Any:
    return binary("max", a, b) + log1p(_apply("exp", -_apply("abs", a - b)))


def logaddexp2(a: Any, b: Any) -> Any:
    return log2(binary("pow", 2.0, a) + binary("pow", 2.0, b))


# hyperbolic inverses


def arcsinh(a: Any) -> Any:
    size = _apply("abs", a)
    return _apply("sign", a) * log1p(size + size * size / (1.0 + _apply("sqrt", size * size + 1.0)))


def arccosh(a: Any) -> Any:
    over = a - 1.0
    return log1p(over + _apply("sqrt", over * (a + 1.0)))


def arctanh(a: Any) -> Any:
    return 0.5 * log1p(2.0 * a / (1.0 - a))


# others


def sinc(a: Any) -> Any:
    """sin(πa)/(πa); near zero by its series, whose derivative does not cancel."""
    angle = pi * a
    coefficients, factorial = [1.0], 1.0
    for k in range(1, 8):
        factorial *= -(2 * k) * (2 * k + 1)
        coefficients.append(1.0 / factorial)
    near = _polynomial(power(angle, 2), coefficients)
    return select(_apply("abs", angle) < 0.5, near, _apply("sin", angle) / angle)


def heaviside(a: Any, at_zero: Any) -> Any:
    return select(a == 0.0, at_zero, select(a < 0.0, 0.0, a - a + 1.0))


def copysign(a: Any, b: Any) -> Any:
    size = _apply("abs", a)
    return select(b < 0.0, -size, size)


def fmax(a: Any, b: Any) -> Any:
    """The larger one; a NaN gives way to the other."""
    return select(_same(a), select(_same(b), binary("max", a, b), a), b)


def fmin(a: Any, b: Any) -> Any:
    return select(_same(a), select(_same(b), binary("min", a, b), a), b)


def _same(a: Any) -> Any:
    """Whether `a` is a number."""
    return a == a


def isnan(a: Any) -> Any:
    return ~(a == a)


def isfinite(a: Any) -> Any:
    return _apply("abs", a) < float("inf")


def isinf(a: Any) -> Any:
    return _apply("abs", a) == float("inf")


def _scaled(factor: float) -> Any:
    return lambda a: a * factor


def _swapped(op: str) -> Any:
    return lambda a, b: binary(op, b, a)


def _binary(op: str) -> Any:
    return lambda a, b: binary(op, a, b)


def _unary(op: str) -> Any:
    return lambda a: unary(op, a)


def _not_equal(a: Any, b: Any) -> Any:
    return unary("not", binary("equal", a, b))


def _xor(a: Any, b: Any) -> Any:
    return binary("and", binary("or", a, b), unary("not", binary("and", a, b)))


#: What each of NumPy's universal functions does with symbols, by its name.
ELEMENTARY: dict[str, Any] = {
    **{name: _unary(name) for name in ("sign", "floor", "sqrt", "exp", "log", "log10", "sin", "cos", "tan")},
    **{name: _unary(name) for name in ("sinh", "cosh", "tanh")},
    **{f"arc{name}": _unary(f"a{name}") for name in ("sin", "cos", "tan")},
    "negative": _unary("neg"),
    "positive": lambda a: a,
    "conjugate": lambda a: a,
    "absolute": _unary("abs"),
    "fabs": _unary("abs"),
    "add": _binary("add"),
    "subtract": _binary("sub"),
    "multiply": _binary("mul"),
    "divide": _binary("div"),
    "power": power,
    "float_power": power,
    "arctan2": _binary("atan2"),
    "hypot": _binary("hypot"),
    "maximum": _binary("max"),
    "minimum": _binary("min"),
    "fmax": fmax,
    "fmin": fmin,
    "less": _binary("less"),
    "less_equal": _binary("less_equal"),
    "greater": _swapped("less"),
    "greater_equal": _swapped("less_equal"),
    "equal": _binary("equal"),
    "not_equal": _not_equal,
    **{f"{kind}_and": _binary("and") for kind in ("logical", "bitwise")},
    **{f"{kind}_or": _binary("or") for kind in ("logical", "bitwise")},
    **{f"{kind}_xor": _xor for kind in ("logical", "bitwise")},
    "logical_not": _unary("not"),
    "invert": _unary("not"),
    "ceil": ceil,
    "trunc": trunc,
    "rint": rint,
    "floor_divide": floor_divide,
    "remainder": mod,
    "fmod": fmod,
    "cbrt": cbrt,
    "square": square,
    "reciprocal": reciprocal,
    "exp2": exp2,
    "log2": log2,
    "expm1": expm1,
    "log1p": log1p,
    "logaddexp": logaddexp,
    "logaddexp2": logaddexp2,
    "arcsinh": arcsinh,
    "arccosh": arccosh,
    "arctanh": arctanh,
    "heaviside": heaviside,
    "copysign": copysign,
    "isnan": isnan,
    "isfinite": isfinite,
    "isinf": isinf,
    **{name: _scaled(pi / 180.0) for name in ("deg2rad", "radians")},
    **{name: _scaled(180.0 / pi) for name in ("rad2deg", "degrees")},
}

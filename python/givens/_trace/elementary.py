"""Elementary functions of one or two numbers that the graph does not know, made of those it does.

Every function here takes symbols or numbers, at least one of them a symbol. Unless said otherwise it agrees with NumPy
to a few units in the last place; the sign of a zero is not kept.
"""

from __future__ import annotations

import math
from math import pi
from typing import Any

from givens._trace import logarithms, rounding
from givens._trace.applied import apply, polynomial
from givens._trace.symbol import Sym, binary, power, select, unary

__all__ = ["ELEMENTARY"]


def cbrt(a: Any) -> Any:
    return apply("sign", a) * binary("pow", apply("abs", a), 1.0 / 3.0)


def _add(a: Any, b: Any) -> Any:
    return a + b if isinstance(a, Sym) else b.__radd__(a)


def _subtract(a: Any, b: Any) -> Any:
    return a - b if isinstance(a, Sym) else b.__rsub__(a)


def square(a: Any) -> Any:
    return power(a, 2)


def reciprocal(a: Any) -> Any:
    return 1.0 / a


def sinc(a: Any) -> Any:
    """sin(πa)/(πa); near zero by its series, whose derivative does not cancel."""
    angle = pi * a
    coefficients, factorial = [1.0], 1.0
    for k in range(1, 8):
        factorial *= -(2 * k) * (2 * k + 1)
        coefficients.append(1.0 / factorial)
    near = polynomial(power(angle, 2), coefficients)
    return select(apply("abs", angle) < 0.5, near, apply("sin", angle) / angle)


def heaviside(a: Any, at_zero: Any) -> Any:
    return select(a == 0.0, at_zero, select(a < 0.0, 0.0, a - a + 1.0))


def copysign(a: Any, b: Any) -> Any:
    size = apply("abs", a)
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
    return apply("abs", a) < float("inf")


def isinf(a: Any) -> Any:
    return apply("abs", a) == float("inf")


def ndtr(a: Any) -> Any:
    """The probability that a standard normal number lies below `a`, as SciPy calls it."""
    return 0.5 * apply("erfc", a * -math.sqrt(0.5))


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


#: What each of NumPy's universal functions does with symbols, and some of SciPy's, by its name.
ELEMENTARY: dict[str, Any] = {
    **{name: _unary(name) for name in ("sign", "floor", "sqrt", "exp", "log", "log10", "sin", "cos", "tan")},
    **{name: _unary(name) for name in ("sinh", "cosh", "tanh", "erf", "erfc")},
    **{f"arc{name}": _unary(f"a{name}") for name in ("sin", "cos", "tan")},
    "negative": _unary("neg"),
    "positive": lambda a: a,
    "conjugate": lambda a: a,
    "absolute": _unary("abs"),
    "fabs": _unary("abs"),
    "add": _add,
    "subtract": _subtract,
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
    "ceil": rounding.ceil,
    "trunc": rounding.trunc,
    "rint": rounding.rint,
    "floor_divide": rounding.floor_divide,
    "remainder": rounding.mod,
    "fmod": rounding.fmod,
    "cbrt": cbrt,
    "square": square,
    "reciprocal": reciprocal,
    **{name: getattr(logarithms, name) for name in logarithms.__all__},
    "ndtr": ndtr,
    "heaviside": heaviside,
    "copysign": copysign,
    "isnan": isnan,
    "isfinite": isfinite,
    "isinf": isinf,
    **{name: _scaled(pi / 180.0) for name in ("deg2rad", "radians")},
    **{name: _scaled(180.0 / pi) for name in ("rad2deg", "degrees")},
}

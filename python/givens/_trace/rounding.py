"""Whole numbers and remainders, as NumPy rounds them."""

from __future__ import annotations

from typing import Any

from givens._trace.applied import apply
from givens._trace.symbol import Sym, select

__all__ = ["ceil", "floor_divide", "fmod", "mod", "rint", "trunc"]


def ceil(a: Any) -> Any:
    return -apply("floor", -a)


def trunc(a: Any) -> Any:
    return apply("sign", a) * apply("floor", apply("abs", a))


def rint(a: Any) -> Any:
    """To the nearest whole number, ties to the even one."""
    up = apply("floor", a + 0.5)
    odd = up - 2.0 * apply("floor", up / 2.0)
    return select((up - a == 0.5) & (odd == 1.0), up - 1.0, up)


def _halves(b: Any) -> tuple[Any, Any]:
    """`b` as a sum of two numbers of at most 26 bits (Veltkamp)."""
    scaled = b * (2.0**27 + 1.0)
    high = scaled - (scaled - b)
    return high, b - high


def _divided(a: Any, b: Any) -> tuple[Any, Any]:
    """Quotient and remainder, the latter exact: its sign tells where rounding brought the quotient up by one.

    Halves of the factors have products that are exact, whether or not the machine rounds them before it subtracts.
    """
    whole = apply("floor", a / b)
    upper = apply("floor", whole * 2.0**-26 + 0.5) * 2.0**26
    lower = whole - upper
    high, low = _halves(b)
    rest = a - upper * high
    rest = rest if _is_zero(low) else rest - upper * low
    rest = rest - lower * high
    rest = rest if _is_zero(low) else rest - lower * low
    over = (rest if _is_positive(b) else apply("sign", b) * rest) < 0.0
    return select(over, whole - 1.0, whole), select(over, rest + b, rest)


def _is_zero(value: Any) -> bool:
    return not isinstance(value, Sym) and value == 0.0


def _is_positive(value: Any) -> bool:
    return not isinstance(value, Sym) and value > 0.0


def floor_divide(a: Any, b: Any) -> Any:
    return _divided(a, b)[0]


def mod(a: Any, b: Any) -> Any:
    """The remainder with the sign of `b`; NaN where `a` is so large that the quotient is no exact whole number."""
    rest = _divided(a, b)[1]
    return select(apply("abs", rest) <= apply("abs", b), rest, float("nan"))


def fmod(a: Any, b: Any) -> Any:
    """The remainder with the sign of `a`."""
    size = mod(apply("abs", a), apply("abs", b))
    return select(a < 0.0, -size, size)

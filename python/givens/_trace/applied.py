"""Operations of the graph on symbols or numbers alike."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from givens._trace.symbol import Scalar, Sym, binary, unary

__all__ = ["apply", "apply_two", "polynomial"]

_NUMPY = {
    "asin": "arcsin",
    "acos": "arccos",
    "atan": "arctan",
    "neg": "negative",
    "pow": "power",
    "max": "maximum",
    "min": "minimum",
}


def apply(op: str, a: Scalar) -> Any:
    """An operation on one symbol or number."""
    return unary(op, a) if isinstance(a, Sym) else getattr(np, _NUMPY.get(op, op))(a)


def apply_two(op: str, a: Scalar, b: Scalar) -> Any:
    """An operation on two of them."""
    if isinstance(a, Sym) or isinstance(b, Sym):
        return binary(op, a, b)
    return getattr(np, _NUMPY.get(op, op))(a, b)


def polynomial(x: Scalar, coefficients: Sequence[float]) -> Any:
    """By Horner's scheme; the constant first."""
    total: Any = coefficients[-1]
    for coefficient in reversed(coefficients[:-1]):
        total = total * x + coefficient
    return total

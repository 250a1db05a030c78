"""Products and sums in which a zero that is a plain number leaves no instruction.

`A @ x` with a constant `A` names only the elements that matter, as if it had been written by hand. It differs from
NumPy where 0 meets an infinite number or NaN, which a filter refuses anyway.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from givens._trace.array import boxed, plain
from givens._trace.symbol import Sym

__all__ = ["multiplied"]


class _Nothing:
    """A zero that takes its products along and leaves sums as they are."""

    __array_ufunc__ = None

    def __mul__(self, other: Any) -> Any:
        return self

    __rmul__ = __mul__

    def __add__(self, other: Any) -> Any:
        return other

    __radd__ = __add__


_NOTHING = _Nothing()


def multiplied(function: Any, *arrays: Any, **kwargs: Any) -> Any:
    """NumPy's `function`, which multiplies and adds, of arrays of symbols and numbers."""
    result = function(*map(_without_zeros, arrays), **kwargs)
    if isinstance(result, np.ndarray) and result.ndim:
        return boxed([_with_zeros(value) for value in result.flat]).reshape(result.shape)
    return _with_zeros(result.item() if isinstance(result, np.ndarray) else result)


def _without_zeros(array: Any) -> Any:
    objects = plain(array).copy()
    for at in np.ndindex(objects.shape):
        if not isinstance(objects[at], Sym) and objects[at] == 0.0:
            objects[at] = _NOTHING
    return objects


def _with_zeros(value: Any) -> Any:
    if isinstance(value, Sym):
        return value
    return np.float64(0.0) if isinstance(value, _Nothing) else np.float64(value)

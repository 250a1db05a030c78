"""Products, determinants and solutions of small linear systems.

Elimination would choose its pivots by values that are not known. Determinants and inverses are therefore made of
cofactors, without a division but the last one, up to six rows; what has numbers only is left to NumPy at any size.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from givens._trace.array import Objects, SymArray, boxed, has_symbols, lifted, numbers, plain, rank
from givens._trace.refuse import refuse
from givens._trace.sparse import multiplied
from givens._trace.symbol import Sym

__all__ = ["LARGEST", "LINEAR"]

#: The most rows of a matrix whose determinant is written out.
LARGEST = 6


def _product(function: Any) -> Any:
    return lambda a, b, *rest, **kwargs: multiplied(function, a, b, *rest, **kwargs)


def dot(a: Any, b: Any, out: Any = None) -> Any:
    if rank(a) == 0 or rank(b) == 0:
        return boxed(a) * b if rank(a) else a * boxed(b) if rank(b) else a * b
    return multiplied(np.dot, a, b)


def einsum(subscripts: str, *operands: Any, **kwargs: Any) -> Any:
    kwargs.pop("optimize", None)
    return multiplied(lambda *arrays: np.einsum(subscripts, *arrays), *operands)


def multi_dot(arrays: Sequence[Any], *, out: Any = None) -> Any:
    total = arrays[0]
    for array in arrays[1:]:
        total = dot(total, array)
    return total


def tensordot(a: Any, b: Any, axes: Any = 2) -> Any:
    return multiplied(np.tensordot, a, b, axes=axes)


def outer(a: Any, b: Any, out: Any = None) -> Any:
    a, b = boxed(a).ravel(), boxed(b).ravel()
    return a.reshape(-1, 1) * b


def _square(a: Any, what: str) -> Objects:
    matrix = plain(a)
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1]:
        raise np.linalg.LinAlgError(f"{what} needs a square matrix, not one of shape {matrix.shape}")
    if len(matrix) > LARGEST:
        raise refuse(
            f"{what} of {len(matrix)} rows has no expression here: at most {LARGEST} rows are written out",
            "use the structure of the matrix to make it smaller, or pass trace=False",
        )
    return matrix


def _times(a: Any, b: Any) -> Any:
    zero = not isinstance(a, Sym) and a == 0.0
    return np.float64(0.0) if zero or (not isinstance(b, Sym) and b == 0.0) else a * b


def _minors(matrix: Objects, rows: Sequence[int], columns: tuple[int, ...], known: dict[Any, Any]) -> Any:
    """The determinant of the last len(columns) of `rows` in `columns`, by its first row."""
    key = (rows[len(rows) - len(columns) :], columns)
    if key not in known:
        row = rows[len(rows) - len(columns)] if columns else 0
        total: Any = np.float64(0.0) if columns else np.float64(1.0)
        for k, column in enumerate(columns):
            rest = columns[:k] + columns[k + 1 :]
            term = _times(matrix[row, column], _minors(matrix, rows, rest, known))
            total = total - term if k % 2 else total + term
        known[key] = total
    return known[key]


def det(a: Any) -> Any:
    matrix = _square(a, "a determinant")
    n = len(matrix)
    return _minors(matrix, tuple(range(n)), tuple(range(n)), {})


def _adjugate(matrix: Objects) -> tuple[Objects, Any]:
    n = len(matrix)
    known: dict[Any, Any] = {}
    adjugate = np.empty((n, n), dtype=object)
    for i in range(n):
        rows = tuple(k for k in range(n) if k != i)
        for j in range(n):
            minor = _minors(matrix, rows, tuple(k for k in range(n) if k != j), known)
            adjugate[j, i] = -minor if (i + j) % 2 else minor
    total: Any = np.float64(0.0)
    for j in range(n):
        total = total + _times(matrix[0, j], adjugate[j, 0])
    return adjugate, total


def inv(a: Any) -> Any:
    adjugate, total = _adjugate(_square(a, "an inverse"))
    return boxed(adjugate) / total


def solve(a: Any, b: Any) -> Any:
    if not has_symbols(a):
        return multiplied(np.matmul, lifted(np.linalg.inv(numbers(a))), b)
    adjugate, total = _adjugate(_square(a, "the solution of a system"))
    return multiplied(np.matmul, adjugate, b) / total


def cholesky(a: Any, *, upper: bool = False) -> Any:
    matrix = _square(a, "a Cholesky factor")
    n = len(matrix)
    root = np.empty((n, n), dtype=object)
    root.fill(np.float64(0.0))
    for j in range(n):
        for i in range(j, n):
            rest = matrix[i, j]
            for k in range(j):
                rest = rest - _times(root[i, k], root[j, k])
            root[i, j] = np.sqrt(rest) if i == j else rest / root[j, j]
    return boxed(root.T.copy() if upper else root)


def matrix_power(a: Any, n: Any) -> Any:
    if n < 0:
        return matrix_power(inv(a), -n)
    total: Any = lifted(np.eye(boxed(a).shape[-1]))
    for _ in range(int(n)):
        total = multiplied(np.matmul, total, a)
    return total


def slogdet(a: Any) -> Any:
    value = det(a)
    return np.sign(value), np.log(np.abs(value))


def trace(a: Any, offset: int = 0, axis1: int = 0, axis2: int = 1, dtype: Any = None, out: Any = None) -> Any:
    return SymArray.sum(boxed(plain(a).diagonal(offset, axis1, axis2)), -1)


LINEAR: dict[str, Any] = {
    "dot": dot,
    "matmul": _product(np.matmul),
    "inner": _product(np.inner),
    "vdot": lambda a, b: dot(boxed(a).ravel(), boxed(b).ravel()),
    "vecdot": lambda a, b, **kwargs: SymArray.sum(boxed(boxed(a) * boxed(b)), kwargs.get("axis", -1)),
    "matvec": lambda a, b: multiplied(np.matmul, a, boxed(b)[..., None])[..., 0],
    "vecmat": lambda a, b: multiplied(np.matmul, boxed(a)[..., None, :], b)[..., 0, :],
    "kron": _product(np.kron),
    "tensordot": tensordot,
    "einsum": einsum,
    "outer": outer,
    "trace": trace,
    "linalg.multi_dot": multi_dot,
    "linalg.matmul": _product(np.matmul),
    "linalg.outer": outer,
    "linalg.trace": lambda x, *, offset=0, dtype=None: trace(x, offset, -2, -1),
    "linalg.det": det,
    "linalg.inv": inv,
    "linalg.solve": solve,
    "linalg.cholesky": cholesky,
    "linalg.matrix_power": matrix_power,
    "linalg.slogdet": slogdet,
}

"""Beliefs: a mean and a covariance."""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from givens._arrays import Array, frozen, numbers, shape_error, square
from givens._factor import first_asymmetry, lower_factor
from givens.errors import InputError

__all__ = ["Gaussian"]


class Gaussian:
    """A Gaussian belief about the state: what is known of it at one time.

    Parameters
    ----------
    mean : array_like, shape (n,)
        The mean.
    cov : array_like, shape (n, n), optional
        The covariance; it may be singular. The two triangles may differ by rounding, about 1e-12 of the standard
        deviations' product; the lower one counts.
    std : array_like, shape (n,), optional
        The standard deviations of states that are not correlated, in place of `cov`.

    Attributes
    ----------
    mean : ndarray, shape (n,)
    cov : ndarray, shape (n, n)
    std : ndarray, shape (n,)
    factor : ndarray, shape (n, n)
        The lower triangular S with S Sᵀ = `cov` and a diagonal from zero up.

    Raises
    ------
    InputError
        For shapes that do not fit, numbers that are not finite, a matrix that is no covariance.

    Examples
    --------
    >>> import givens as gv
    >>> prior = gv.Gaussian([0.0, 1.0], std=[2.0, 0.5])
    >>> prior.cov
    array([[4.  , 0.  ],
           [0.  , 0.25]])
    """

    __slots__ = ("__dict__", "_cov", "_mean")

    _mean: Array
    _cov: Array

    def __init__(
        self, mean: npt.ArrayLike, cov: npt.ArrayLike | None = None, *, std: npt.ArrayLike | None = None
    ) -> None:
        middle = np.atleast_1d(numbers("mean", mean))
        if middle.ndim != 1:
            raise shape_error("mean", middle.shape, "(n,)", "a vector has one dimension: mean=np.ravel(…)")
        if not np.isfinite(middle).all():
            at = int(np.flatnonzero(~np.isfinite(middle))[0])
            raise InputError(f"`mean[{at}]` is {middle[at]}", argument="mean", remedy="give a finite number")
        if (cov is None) == (std is None):
            said = "neither `cov` nor `std`" if cov is None else "`cov` and `std` at once"
            raise InputError(
                f"a Gaussian with {said}", argument="cov", remedy="write Gaussian(mean, cov) or Gaussian(mean, std=…)"
            )
        matrix = np.diag(_variances(std, middle.size)) if cov is None else _covariance(cov, middle.size)
        object.__setattr__(self, "_mean", frozen(middle))
        object.__setattr__(self, "_cov", frozen(matrix))

    @classmethod
    def _known(cls, mean: Array, cov: Array, factor: Array) -> Gaussian:
        """One that a filter has made, which needs no check."""
        self = object.__new__(cls)
        object.__setattr__(self, "_mean", mean)
        object.__setattr__(self, "_cov", cov)
        self.__dict__["_lower"] = factor
        return self

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("a Gaussian cannot be changed; make another one")

    def __delattr__(self, name: str) -> None:
        raise AttributeError("a Gaussian cannot be changed; make another one")

    @property
    def mean(self) -> Array:
        """The mean, shape (n,)."""
        return self._mean

    @property
    def cov(self) -> Array:
        """The covariance, shape (n, n)."""
        return self._cov

    @property
    def std(self) -> Array:
        """The standard deviations, shape (n,)."""
        return frozen(np.sqrt(np.maximum(np.diag(self._cov), 0.0)))

    @cached_property
    def _lower(self) -> Array:
        return frozen(lower_factor(self._cov)[0])

    @property
    def factor(self) -> Array:
        """The lower triangular root of the covariance, shape (n, n)."""
        return self._lower

    def __len__(self) -> int:
        return len(self._mean)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Gaussian):
            return NotImplemented
        return np.array_equal(self._mean, other._mean) and np.array_equal(self._cov, other._cov)

    def __hash__(self) -> int:
        return hash((self._mean.tobytes(), self._cov.tobytes()))

    def __reduce__(self) -> tuple[Any, ...]:
        return Gaussian, (np.array(self._mean), np.array(self._cov))

    def __repr__(self) -> str:
        off = self._cov - np.diag(np.diag(self._cov))
        mean = np.array2string(self._mean, separator=", ")
        if not off.any():
            return f"Gaussian({mean}, std={np.array2string(self.std, separator=', ')})"
        return f"Gaussian({mean}, cov={np.array2string(self._cov, separator=', ', prefix='Gaussian(')})"

    def _repr_html_(self) -> str:
        from givens._html import gaussian_html

        return gaussian_html(self)


def _variances(std: Any, n: int) -> Array:
    array = np.atleast_1d(numbers("std", std))
    if array.shape != (n,):
        one = f"the same for all is std=np.full({n}, …)" if array.size == 1 else "give one for each entry of `mean`"
        raise shape_error("std", array.shape, f"({n},), the shape of `mean`", one)
    wrong = ~(np.isfinite(array) & (array >= 0))
    if wrong.any():
        at = int(np.flatnonzero(wrong)[0])
        raise InputError(
            f"`std[{at}]` is {array[at]}",
            argument="std",
            remedy="standard deviations are finite, from 0 up",
        )
    with np.errstate(over="ignore"):
        squares: Array = array**2
    if not np.isfinite(squares).all():
        at = int(np.flatnonzero(~np.isfinite(squares))[0])
        raise InputError(
            f"`std[{at}]` is {array[at]}, whose square is no finite number",
            argument="std",
            remedy="measure the state in a larger unit",
        )
    return squares


def _covariance(cov: Any, n: int) -> Array:
    matrix = square("cov", np.reshape(cov, (1, 1)) if n == 1 and np.size(cov) == 1 else cov, n)
    if not np.isfinite(matrix).all():
        i, j = np.argwhere(~np.isfinite(matrix))[0]
        raise InputError(f"`cov[{i}, {j}]` is {matrix[i, j]}", argument="cov", remedy="give a finite number")
    apart = first_asymmetry(matrix)
    if apart is not None:
        i, j = apart
        raise InputError(
            f"`cov` is not symmetric: {matrix[i, j]} at [{i}, {j}], {matrix[j, i]} at [{j}, {i}]",
            argument="cov",
            remedy="give a symmetric matrix, such as (P + P.T) / 2 if they differ by rounding",
        )
    failed = int(lower_factor(matrix)[1])
    if failed >= 0:
        raise InputError(
            f"`cov` is not positive semidefinite at pivot {failed + 1} of {n}",
            argument="cov",
            remedy="variances are from 0 up and correlations from -1 to 1; were standard deviations meant, write std=…",
        )
    return matrix

"""Sixty-digit arithmetic on NumPy arrays of mpmath numbers."""

import mpmath
import numpy as np
from mpmath import mp, mpf

DIGITS = 60
mp.dps = DIGITS


def exact(value):
    """A double (or a nested list of them) as it is, to the last bit."""
    if isinstance(value, (list, tuple, np.ndarray)):
        array = np.empty(np.shape(value), dtype=object)
        for index in np.ndindex(array.shape):
            item = value
            for i in index:
                item = item[i]
            array[index] = mpf(item)
        return array
    return mpf(value)


def zeros(*shape):
    array = np.empty(shape, dtype=object)
    array.fill(mpf(0))
    return array


def identity(n):
    array = zeros(n, n)
    for i in range(n):
        array[i, i] = mpf(1)
    return array


def elementwise(function, arguments=1):
    return np.frompyfunc(function, arguments, 1)


def to_float(value):
    """The nearest doubles, as plain lists."""
    if isinstance(value, np.ndarray):
        return [to_float(item) for item in value]
    return None if value is None else float(value)


def lower(matrix):
    """The lower triangle, row by row, as doubles."""
    return [float(matrix[i, j]) for i in range(matrix.shape[0]) for j in range(i + 1)]


def jacobian(function, x, digits=60, step="1e-40"):
    """∂f/∂x by central differences at more digits: exact far beyond the working precision."""
    n = len(x)
    with mpmath.workdps(DIGITS + digits):
        h = mpf(step)
        points = np.repeat(x[:, None], 2 * n, axis=1)
        for i in range(n):
            points[i, i] = points[i, i] + h
            points[i, n + i] = points[i, n + i] - h
        images = function(points)
        return (images[:, :n] - images[:, n:]) / (2 * h)

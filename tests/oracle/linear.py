"""Semidefinite factorisation and division, with one convention for zero pivots."""

from mpmath import mp, mpf

from precise import zeros

# Sixty digits are carried; what is smaller than this part of a diagonal element is rounding.
ZERO = mpf("1e-40")


class NotDefinite(Exception):
    """A matrix that had to be a covariance is not one."""

    def __init__(self, matrix, pivot):
        super().__init__(f"the {matrix} is not positive definite (pivot {pivot})")
        self.matrix, self.pivot = matrix, pivot


def factor(p, matrix, scale=None):
    """Lower S with S Sᵀ = P and diagonal ≥ 0; a zero pivot has a zero column."""
    n = p.shape[0]
    s = zeros(n, n)
    for j in range(n):
        size = max(abs(p[j, j]), mpf(0) if scale is None else abs(scale[j, j]))
        pivot = p[j, j] - sum(s[j, k] ** 2 for k in range(j))
        if abs(pivot) <= ZERO * size:
            for i in range(j + 1, n):
                rest = p[i, j] - sum(s[i, k] * s[j, k] for k in range(j))
                bound = max(abs(p[i, i]), mpf(0) if scale is None else abs(scale[i, i]))
                if rest**2 > ZERO * size * bound:
                    raise NotDefinite(matrix, j)
            continue
        if pivot < 0:
            raise NotDefinite(matrix, j)
        s[j, j] = mp.sqrt(pivot)
        for i in range(j + 1, n):
            s[i, j] = (p[i, j] - sum(s[i, k] * s[j, k] for k in range(j))) / s[j, j]
    return s


def without_rounding(p, scale):
    """P with the rows and columns zero whose variance is only rounding of numbers of size `scale`."""
    p = p.copy()
    for i, size in enumerate(scale):
        if abs(p[i, i]) <= ZERO**2 * size**2:
            p[i, :], p[:, i] = mpf(0), mpf(0)
    return p


def solve_lower(s, b):
    """S⁻¹ B, a zero where the pivot is zero."""
    x = b.copy()
    for i in range(s.shape[0]):
        for k in range(i):
            x[i] = x[i] - s[i, k] * x[k]
        x[i] = x[i] / s[i, i] if s[i, i] != 0 else x[i] * 0
    return x


def solve_lower_transposed(s, b):
    """S⁻ᵀ B, a zero where the pivot is zero."""
    x = b.copy()
    n = s.shape[0]
    for i in reversed(range(n)):
        for k in range(i + 1, n):
            x[i] = x[i] - s[k, i] * x[k]
        x[i] = x[i] / s[i, i] if s[i, i] != 0 else x[i] * 0
    return x


def divide(c, s):
    """C (S Sᵀ)⁻¹, the generalised inverse that goes with the factor."""
    return solve_lower_transposed(s, solve_lower(s, c.T)).T

"""An update whose innovation covariance is nearly singular, solved in rational numbers.

n = 3, d = 2: P = I, m = 0, H = [1 1 1; 1 1 1+δ], R = δ² I, z = [1.1, 1.3] (the doubles, or the singles).
"""

import struct
from fractions import Fraction


def single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def inverse2(a):
    det = a[0][0] * a[1][1] - a[0][1] * a[1][0]
    return [[a[1][1] / det, -a[0][1] / det], [-a[1][0] / det, a[0][0] / det]]


def product(a, b):
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def posterior(delta, corner, z):
    """m and P, exactly."""
    h = [[Fraction(1)] * 3, [Fraction(1), Fraction(1), corner]]
    transposed = [list(column) for column in zip(*h)]
    s = product(h, transposed)
    for i in range(2):
        s[i][i] += delta**2
    gain = product(transposed, inverse2(s))
    mean = [row[0] for row in product(gain, [[v] for v in z])]
    moved = product(gain, h)
    cov = [[Fraction(int(i == j)) - moved[i][j] for j in range(3)] for i in range(3)]
    return mean, cov


def case(delta, corner, z):
    mean, cov = posterior(Fraction(delta), corner, [Fraction(v) for v in z])
    return {
        "delta": delta,
        "corner": float(corner),
        "mean": [float(v) for v in mean],
        "cov": [float(cov[i][j]) for i in range(3) for j in range(i + 1)],
    }


def cases():
    exponents = range(3, 13)
    out = {"f64": [], "f64_exact_corner": [], "f32": [], "f32_exact_corner": []}
    for e in exponents:
        delta = float(f"1e-{e}")
        z = [1.1, 1.3]
        out["f64"].append(case(delta, Fraction(1.0 + delta), z))
        out["f64_exact_corner"].append(case(delta, 1 + Fraction(delta), z))
        delta, z = single(delta), [single(v) for v in z]
        out["f32"].append(case(delta, Fraction(single(1.0 + delta)), z))
        out["f32_exact_corner"].append(case(delta, 1 + Fraction(delta), z))
    return out

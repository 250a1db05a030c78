"""The rules: moments of g(x), x ~ N(m, P), and the covariance of x with g(x)."""

from itertools import combinations, product

import numpy as np
from mpmath import mp, mpf

from precise import jacobian, zeros


class Points:
    """Nodes ξ (n × points), mean weights and covariance weights."""

    def __init__(self, nodes, weights, cov_weights=None):
        self.nodes, self.weights = nodes, weights
        self.cov_weights = weights if cov_weights is None else cov_weights

    def moments(self, g, m, s, move):
        x = m[:, None] + s @ self.nodes
        y = move(g(x), lambda: g(m[:, None]))
        mean = y @ self.weights
        spread = y - mean[:, None]
        weighted = spread * self.cov_weights
        return mean, weighted @ spread.T, (x - m[:, None]) @ weighted.T

    def negative(self):
        return any(w < 0 for w in self.cov_weights)


class CentralDifference:
    def __init__(self, eta):
        self.eta = eta

    def moments(self, g, m, s, move):
        n, eta = len(m), self.eta
        x = np.concatenate([m[:, None], m[:, None] + eta * s, m[:, None] - eta * s], axis=1)
        y = move(g(x), lambda: g(m[:, None]))
        centre, plus, minus = y[:, :1], y[:, 1 : n + 1], y[:, n + 1 :]
        mean = (eta**2 - n) / eta**2 * centre[:, 0] + (plus + minus).sum(axis=1) / (2 * eta**2)
        first = (plus - minus) / (2 * eta)
        second = mp.sqrt(eta**2 - 1) / (2 * eta**2) * (plus + minus - 2 * centre)
        return mean, first @ first.T + second @ second.T, s @ first.T

    def negative(self):
        return False


class Taylor:
    def moments(self, g, m, s, move):
        image = jacobian(g, m) @ s
        return g(m[:, None])[:, 0], image @ image.T, s @ image.T

    def negative(self):
        return False


def axes(n, radius):
    nodes = zeros(n, 2 * n)
    for i in range(n):
        nodes[i, i], nodes[i, n + i] = radius, -radius
    return nodes


def with_centre(nodes):
    return np.concatenate([zeros(nodes.shape[0], 1), nodes], axis=1)


def array(values):
    out = np.empty(len(values), dtype=object)
    out[:] = values
    return out


def cubature3(n):
    return Points(axes(n, mp.sqrt(n)), array([mpf(1) / (2 * n)] * (2 * n)))


def cubature5(n):
    pairs = list(combinations(range(n), 2))
    diagonal = zeros(n, 4 * len(pairs))
    radius = mp.sqrt(mpf(n + 2) / 2)
    for k, ((i, j), (a, b)) in enumerate(product(pairs, product((1, -1), repeat=2))):
        diagonal[i, k], diagonal[j, k] = a * radius, b * radius
    nodes = with_centre(np.concatenate([axes(n, mp.sqrt(n + 2)), diagonal], axis=1))
    axis, pair = mpf(4 - n) / (2 * (n + 2) ** 2), mpf(1) / (n + 2) ** 2
    return Points(nodes, array([mpf(2) / (n + 2)] + [axis] * (2 * n) + [pair] * (4 * len(pairs))))


def unscented(n, kappa):
    others = [mpf(1) / (2 * (n + kappa))] * (2 * n)
    return Points(with_centre(axes(n, mp.sqrt(n + kappa))), array([mpf(kappa) / (n + kappa)] + others))


def scaled_unscented(n, alpha, beta, kappa):
    spread = alpha**2 * (n + kappa)
    others = [1 / (2 * spread)] * (2 * n)
    centre = (spread - n) / spread
    nodes = with_centre(axes(n, mp.sqrt(spread)))
    return Points(nodes, array([centre] + others), array([centre + 1 - alpha**2 + beta] + others))


def hermite(p):
    """Roots and weights of the probabilists' Hermite polynomial: w = p! / (p He_{p−1}(x))²."""
    previous, current = [mpf(1)], [mpf(1), mpf(0)]
    for k in range(1, p):
        following = current + [mpf(0)]
        for i, c in enumerate(previous):
            following[i + 2] -= k * c
        previous, current = current, following
    roots = sorted(mp.re(r) for r in mp.polyroots(current, maxsteps=500, extraprec=400))
    if p % 2:
        roots[p // 2] = mpf(0)
    return roots, [mp.factorial(p) / (p * mp.polyval(previous, r)) ** 2 for r in roots]


def gauss_hermite(n, p):
    roots, weights = hermite(p)
    grid = list(product(range(p), repeat=n))
    nodes = zeros(n, len(grid))
    for k, index in enumerate(grid):
        for i, j in enumerate(index):
            nodes[i, k] = roots[j]
    return Points(nodes, array([mp.fprod(weights[j] for j in index) for index in grid]))


def scaled(alpha, beta, kappa):
    return lambda n: scaled_unscented(n, mpf(alpha), mpf(beta), mpf(kappa))


# name in the files → (the parts and options that select it, what builds it)
RULES = {
    "cubature3": ({"rule": "cubature3"}, cubature3),
    "cubature5": ({"rule": "cubature5"}, cubature5),
    "unscented": ({"rule": "unscented"}, lambda n: unscented(n, 3 - n)),
    "unscented_half": ({"rule": "unscented", "alpha": 0.5, "beta": 2.0, "kappa": 0.0}, scaled(0.5, 2, 0)),
    "unscented_small": ({"rule": "unscented", "alpha": 1e-3, "beta": 2.0, "kappa": 0.0}, scaled(1e-3, 2, 0)),
    "gauss_hermite2": ({"rule": "gauss-hermite", "points": 2}, lambda n: gauss_hermite(n, 2)),
    "gauss_hermite3": ({"rule": "gauss-hermite", "points": 3}, lambda n: gauss_hermite(n, 3)),
    "gauss_hermite5": ({"rule": "gauss-hermite", "points": 5}, lambda n: gauss_hermite(n, 5)),
    "central_difference": ({"rule": "central-difference"}, lambda n: CentralDifference(mp.sqrt(3))),
    "central_difference_1.5": ({"rule": "central-difference", "eta": 1.5}, lambda n: CentralDifference(mpf(1.5))),
    "taylor": ({"rule": "taylor"}, lambda n: Taylor()),
}

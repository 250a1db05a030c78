"""Textbook filters in plain NumPy: what every contestant is compared with. Slow, and written to be read."""

from __future__ import annotations

import numpy as np
from problems import SPACE_K, SPACE_R, space_drifts, space_radars


def points(mean, cov):
    """The 2 n cubature points, one a row."""
    spread = np.linalg.cholesky(cov) * np.sqrt(len(mean))
    return np.concatenate([mean + spread.T, mean - spread.T])


def update(h, noise, mean, cov, z):
    x = points(mean, cov)
    images = h(x)
    expected = images.mean(0)
    d, e = x - mean, images - expected
    s = e.T @ e / len(x) + noise
    gain = np.linalg.solve(s, (d.T @ e / len(x)).T).T
    cov = cov - gain @ s @ gain.T
    return mean + gain @ (z - expected), 0.5 * (cov + cov.T)


def discrete(f, h, q, r, mean, cov, rows):
    """Filtered means and covariances; predicted ones and cross covariances for the smoother."""
    filtered, predicted = [], []
    for z in rows:
        x = points(mean, cov)
        images = f(x)
        ahead = images.mean(0)
        d = images - ahead
        cross = (x - mean).T @ d / len(x)
        mean, cov = ahead, d.T @ d / len(x) + q
        predicted.append((mean, cov, cross))
        mean, cov = update(h, r, mean, cov, z)
        filtered.append((mean, cov))
    return filtered, predicted


def smoothed(filtered, predicted):
    """Rauch, Tung and Striebel, over what `discrete` gave."""
    out = [filtered[-1]]
    for k in range(len(filtered) - 2, -1, -1):
        (mean, cov), (ahead, ahead_cov, cross), (later, later_cov) = filtered[k], predicted[k + 1], out[-1]
        gain = np.linalg.solve(ahead_cov, cross.T).T
        out.append((mean + gain @ (later - ahead), cov + gain @ (later_cov - ahead_cov) @ gain.T))
    return out[::-1]


def moment_ode(mean, cov, rows, gap, substeps):
    """Mean and covariance by their own differential equations, in equal steps of the classic Runge-Kutta method."""

    def slopes(mean, cov):
        x = points(mean, cov)
        f = space_drifts(x)
        a = (x - mean).T @ (f - f.mean(0)) / len(x)
        return f.mean(0), a + a.T + SPACE_K

    filtered, h = [], gap / substeps
    for z in rows:
        for _ in range(substeps):
            a1, b1 = slopes(mean, cov)
            a2, b2 = slopes(mean + 0.5 * h * a1, cov + 0.5 * h * b1)
            a3, b3 = slopes(mean + 0.5 * h * a2, cov + 0.5 * h * b2)
            a4, b4 = slopes(mean + h * a3, cov + h * b3)
            mean = mean + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
            cov = cov + h / 6 * (b1 + 2 * b2 + 2 * b3 + b4)
        mean, cov = update(space_radars, SPACE_R, mean, cov, z)
        filtered.append((mean, cov))
    return filtered


def jacobian(x):
    """Of the drift, along a direction a column."""
    j = np.zeros((7, 7))
    j[0, 1] = j[2, 3] = j[4, 5] = 1.0
    j[1, 3], j[1, 6], j[3, 1], j[3, 6] = -x[6], -x[3], x[6], x[1]
    return j


def ito_taylor(mean, cov, rows, gap, substeps):
    """Step of order 1.5 (docs/algorithms.md C4, C5, simplified) of a drift that has no curvature along a noise."""
    filtered, h = [], gap / substeps
    g = np.sqrt(SPACE_K)
    for z in rows:
        for _ in range(substeps):
            x = points(mean, cov)
            f = space_drifts(x)
            ahead = np.array([p + h * q + 0.5 * h * h * (jacobian(p) @ q) for p, q in zip(x, f, strict=True)])
            along = jacobian(mean) @ g
            first, second = np.sqrt(h) * (g + 0.5 * h * along), np.sqrt(h**3 / 12) * along
            mean = ahead.mean(0)
            d = ahead - mean
            cov = d.T @ d / len(x) + first @ first.T + second @ second.T
        mean, cov = update(space_radars, SPACE_R, mean, cov, z)
        filtered.append((mean, cov))
    return filtered

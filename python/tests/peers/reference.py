"""Plain NumPy filters and smoothers, written for reading: what the peers and `givens` are measured against.

Covariance form throughout, points redrawn before every measurement, Rauch–Tung–Striebel backwards; continuous models by their moment equations and many steps of RK4. A rule is data: points
ξ (2n or 2n + 1 of them), weights of means and of covariances; the EKF is the rule without points.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Rule:
    """points: p × n."""

    points: Array
    mean_weights: Array
    cov_weights: Array


@dataclass(frozen=True)
class Answer:
    """A row for each row of data: mean (K, n), cov (K, n, n), and each row's log-likelihood."""

    mean: Array
    cov: Array
    log_likelihood: Array


def unscented(n: int, alpha: float = 1.0, beta: float = 0.0, kappa: float = 0.0) -> Rule:
    """Wan & van der Merwe 2000; with (1, 0, 0) it is the cubature rule and a centre of weight zero."""
    spread = alpha**2 * (n + kappa)
    points = np.concatenate([np.zeros((1, n)), np.eye(n), -np.eye(n)]) * np.sqrt(spread)
    weights = np.full(2 * n + 1, 0.5 / spread)
    weights[0] = 1 - n / spread
    cov_weights = weights.copy()
    cov_weights[0] += 1 - alpha**2 + beta
    return Rule(points, weights, cov_weights)


def moments(
    rule: Rule | None, g: Any, jacobian: Any, m: Array, P: Array, angles: tuple[int, ...] = ()
) -> tuple[Array, Array, Array]:
    """Mean of g, Cov[g] and Cov[x, g] for x ~ N(m, P). Images of angles are brought near g(m) first."""
    if rule is None:
        J = jacobian(m)
        return g(m), J @ P @ J.T, P @ J.T
    dx = rule.points @ np.linalg.cholesky(P).T
    y = g((m + dx).T).T  # the problems' functions take points as columns
    centre = g(m)
    for i in angles:
        y[:, i] = centre[i] + wrap(y[:, i] - centre[i])
    mean = rule.mean_weights @ y
    dy = y - mean
    return mean, dy.T @ (rule.cov_weights[:, None] * dy), dx.T @ (rule.cov_weights[:, None] * dy)


def wrap(a: Any) -> Any:
    return a - 2 * np.pi * np.floor(a / (2 * np.pi) + 0.5)


def update(problem: Any, rule: Rule | None, m: Array, P: Array, z: Array) -> tuple[Array, Array, float]:
    """The components that are there, at once; P by P − K S Kᵀ."""
    there = ~np.isnan(z)
    if not there.any():
        return m, P, 0.0
    mean, cov, cross = moments(rule, problem.measure, problem.measure_jacobian, m, P, problem.angles)
    nu = z - mean
    for i in problem.angles:
        nu[i] = wrap(nu[i])
    nu, S, cross = nu[there], (cov + problem.noise)[np.ix_(there, there)], cross[:, there]
    K = np.linalg.solve(S, cross.T).T
    fit = -0.5 * (nu @ np.linalg.solve(S, nu) + np.linalg.slogdet(2 * np.pi * S)[1])
    return m + K @ nu, symmetric(P - K @ S @ K.T), fit


def symmetric(P: Array) -> Array:
    return (P + P.T) / 2


def transition(problem: Any, rule: Rule | None, m: Array, P: Array, dt: float) -> tuple[Array, Array, Array]:
    """Predicted mean and covariance, and Cov[x, x⁺]."""
    mean, cov, cross = moments(
        rule, lambda x: problem.transition(x, dt), lambda x: problem.transition_jacobian(x, dt), m, P
    )
    return mean, cov + problem.noise_cov(dt), cross


def moment_ode(
    problem: Any, rule: Rule | None, m: Array, P: Array, dt: float, steps: int = 256
) -> tuple[Array, Array, Array]:
    """The same for a continuous model: dm = E[f], dP = C + Cᵀ + G Gᵀ with C = Cov[f, x], and X = Cov[x(t₀), x(t)] by dX = X P⁻¹ Cᵀ."""
    noise = np.diag(problem.diffusion() ** 2)

    def slope(m: Array, P: Array, X: Array) -> tuple[Array, Array, Array]:
        mean, _, cross = moments(rule, problem.drift, problem.drift_jacobian, m, P)
        return mean, cross + cross.T + noise, X @ np.linalg.solve(P, cross)

    y, h = (m, P, P), dt / steps
    for _ in range(steps):
        a = slope(*y)
        b = slope(*(v + h / 2 * d for v, d in zip(y, a)))
        c = slope(*(v + h / 2 * d for v, d in zip(y, b)))
        d = slope(*(v + h * e for v, e in zip(y, c)))
        y = tuple(v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4) for v, k1, k2, k3, k4 in zip(y, a, b, c, d))
    return y


def run(problem: Any, rule: Rule | None, redraw: bool = True) -> tuple[Answer, Answer]:
    """Filtered and smoothed. `redraw=False` is the slip of FilterPy's CKF: h sees the points that f moved, without Q."""
    step = moment_ode if hasattr(problem, "drift") else transition
    m, P, before = problem.mean, problem.cov, problem.t0
    filtered, predicted, fits = [], [], []
    for t, z in zip(problem.t, problem.z):
        cross = P
        moved = None
        if t > before:
            dt = t - before
            if not redraw and rule is not None:
                moved = problem.transition((m + rule.points @ np.linalg.cholesky(P).T).T, dt).T
            m, P, cross = step(problem, rule, m, P, dt)
        predicted.append((m, P, cross))
        m, P, fit = update(problem, rule, m, P, z) if moved is None else update_moved(problem, rule, m, P, z, moved)
        filtered.append((m, P))
        fits.append(fit)
        before = t
    smoothed = [filtered[-1]]
    for (m, P), (mp, Pp, cross) in zip(filtered[-2::-1], predicted[:0:-1]):
        G = np.linalg.solve(Pp, cross.T).T
        ms, Ps = smoothed[-1]
        smoothed.append((m + G @ (ms - mp), symmetric(P + G @ (Ps - Pp) @ G.T)))
    return answer(filtered, fits), answer(smoothed[::-1], fits)


def update_moved(problem: Any, rule: Any, m: Array, P: Array, z: Array, points: Array) -> tuple[Array, Array, float]:
    """The update with given points."""
    y = problem.measure(points.T).T
    mean = rule.mean_weights @ y
    dy, dx = y - mean, points - m
    S = dy.T @ (rule.cov_weights[:, None] * dy) + problem.noise
    K = np.linalg.solve(S, (dx.T @ (rule.cov_weights[:, None] * dy)).T).T
    fit = -0.5 * ((z - mean) @ np.linalg.solve(S, z - mean) + np.linalg.slogdet(2 * np.pi * S)[1])
    return m + K @ (z - mean), symmetric(P - K @ S @ K.T), fit


def answer(rows: list[tuple[Array, Array]], fits: list[float]) -> Answer:
    return Answer(np.array([m for m, _ in rows]), np.array([P for _, P in rows]), np.array(fits))


def by_name(n: int, method: str, options: dict[str, float]) -> Rule | None:
    """The rule of a registry name of `givens`, with the options' names there; kappa is 3 − n where none is given."""
    bare = method.removeprefix("sr-").removeprefix("cd-")
    if bare == "ekf":
        return None
    if bare in ("ckf", "ckf2"):
        return unscented(n)
    return unscented(n, options.get("alpha", 1.0), options.get("beta", 0.0), options.get("kappa", 3.0 - n))

"""The discrete-time Gaussian filter in covariance form, row by row."""

from dataclasses import dataclass, field

import numpy as np
from mpmath import mp, mpf

from linear import NotDefinite, divide, factor, solve_lower, without_rounding


def wrap(a, period):
    return a - period * mp.nint(a / period)


@dataclass
class Node:
    """The belief at one time, and the transition that leads to the next node."""

    mean: np.ndarray
    cov: np.ndarray
    following: tuple | None = None  # (predicted mean, predicted covariance, cross covariance)


@dataclass
class RowResult:
    node: int
    prior_mean: np.ndarray
    prior_cov: np.ndarray
    mean: np.ndarray
    cov: np.ndarray
    z_hat: np.ndarray
    innovation: np.ndarray
    innovation_cov: np.ndarray
    nis: object
    log_likelihood: object


@dataclass
class Run:
    nodes: list = field(default_factory=list)
    rows: list = field(default_factory=list)
    failed: dict | None = None


def predict(model, rule, mean, cov, t, dt, u):
    unmoved = lambda y, centre: y
    g = lambda x: model.transition(x, t, dt, u)
    m, p, cross = rule.moments(g, mean, factor(cov, "posterior covariance"), unmoved)
    p = without_rounding(p, m) + model.process_noise(t, dt, u)
    factor(p, "predicted covariance")
    return m, p, cross


def move_to(periods):
    """Brings the images of an angle to the branch of the image of the mean."""

    def move(y, centre):
        if not any(periods):
            return y
        reference, y = centre(), y.copy()
        for i, period in enumerate(periods):
            if period is not None:
                r = reference[i, 0]
                y[i] = [r + wrap(v - r, period) for v in y[i]]
        return y

    return move


def update(model, rule, row, mean, cov):
    """One row's measurement update; the row holds at least one measure."""
    h = lambda x: model.observe(row.present, x, row.time, row.controls)
    z_hat, p_zz, p_xz = rule.moments(h, mean, factor(cov, "predicted covariance"), move_to(row.periods))
    p_zz = p_zz + model.measurement_noise(row.present, row.time, row.controls)
    s_zz = factor(p_zz, "innovation covariance")
    d = len(row.z)
    for i in range(d):
        if s_zz[i, i] == 0:
            raise NotDefinite("innovation covariance", i)
    nu = np.array(
        [z - e if period is None else wrap(z - e, period) for z, e, period in zip(row.z, z_hat, row.periods)],
        dtype=object,
    )
    gain = divide(p_xz, s_zz)
    white = solve_lower(s_zz, nu)
    nis = sum(e**2 for e in white)
    log_det = 2 * sum(mp.log(s_zz[i, i]) for i in range(d))
    log_likelihood = -(nis + log_det + d * mp.log(2 * mp.pi)) / 2
    posterior = cov - gain @ p_zz @ gain.T
    posterior = (posterior + posterior.T) / 2
    factor(posterior, "posterior covariance", scale=cov)
    shown = np.array([e if period is None else wrap(e, period) for e, period in zip(z_hat, row.periods)], dtype=object)
    return mean + gain @ nu, posterior, shown, nu, p_zz, nis, log_likelihood


def gap_steps(model, gap):
    """How many transitions a gap takes, and the dt of each."""
    if model.step is None:
        return 1, gap
    steps = int(mp.nint(gap / model.step))
    assert abs(gap - steps * model.step) <= mpf("1e-6") * model.step
    return steps, model.step


def run_filter(model, rule, rows):
    """All rows; stops at the first failure and says where."""
    run = Run()
    time = rows[0].time if model.time is None else mpf(model.time)
    run.nodes.append(Node(model.mean, model.cov))
    controls = rows[0].controls
    for k, row in enumerate(rows):
        try:
            if row.time > time:
                steps, dt = gap_steps(model, row.time - time)
                for step in range(steps):
                    node = run.nodes[-1]
                    node.following = predict(model, rule, node.mean, node.cov, time + step * dt, dt, controls)
                    run.nodes.append(Node(*node.following[:2]))
                time = row.time
            controls = row.controls
            node = run.nodes[-1]
            prior = node.mean, node.cov
            empty = np.array([], dtype=object)
            z_hat, nu, p_zz, nis, log_likelihood = empty, empty, empty.reshape(0, 0), None, mpf(0)
            if row.present:
                node.mean, node.cov, z_hat, nu, p_zz, nis, log_likelihood = update(model, rule, row, *prior)
        except NotDefinite as error:
            run.failed = {"row": k, "time": float(row.time), "matrix": error.matrix}
            return run
        run.rows.append(
            RowResult(len(run.nodes) - 1, *prior, node.mean, node.cov, z_hat, nu, p_zz, nis, log_likelihood)
        )
    return run

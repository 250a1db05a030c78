"""The peers' filters over a rung of tests/golden/stress.json: generators of mean and covariance after every row."""

from __future__ import annotations

import numpy as np


class Rung:
    """The numbers of a rung as arrays of one type."""

    def __init__(self, of: dict, dtype: type):
        self.dtype = dtype
        self.mean, self.cov, self.h, self.r = (self.array(of[key]) for key in ("mean", "cov", "h", "r"))
        self.n, self.d = len(self.mean), len(self.r)
        self.steps = [(self.array(step["f"]), self.array(step["q"])) for step in of["steps"]]
        self.z = self.array(of["z"])
        self.period = of.get("period")
        self.repeat = of.get("repeat")

    def array(self, value):
        return np.array(value, self.dtype)

    def rows(self):
        """F, Q and z of each row."""
        if self.repeat:
            return ((*self.steps[0], self.z[0]) for _ in range(self.repeat))
        steps = self.steps * len(self.z) if len(self.steps) == 1 else self.steps
        return ((f, q, z) for (f, q), z in zip(steps, self.z, strict=True))

    def observe(self, x):
        """H of one point, or of many (state last)."""
        z = x @ self.h.T
        return z if self.period is None else np.arctan2(np.sin(z), np.cos(z))

    def difference(self, a, b):
        """The short way round, for filters that can be told so."""
        delta = np.subtract(a, b)
        return delta if self.period is None else np.remainder(delta + np.pi, 2 * np.pi) - np.pi

    def average(self, points, weights):
        """Of angles, the direction of the mean vector."""
        if self.period is None:
            return weights @ points
        return np.arctan2(weights @ np.sin(points), weights @ np.cos(points))


def root(p):
    """A lower root of a covariance that may be singular."""
    s = np.zeros_like(p)
    for j in range(len(p)):
        pivot = p[j, j] - s[j, :j] @ s[j, :j]
        if pivot > 0:
            s[j, j] = np.sqrt(pivot)
            s[j + 1 :, j] = (p[j + 1 :, j] - s[j + 1 :, :j] @ s[j, :j]) / s[j, j]
    return s


def filterpy_linear(kind):
    def run(rung):
        kf = kind(rung.n, rung.d)
        kf.x, kf.P, kf.H, kf.R = rung.mean.reshape(-1, 1).copy(), rung.cov, rung.h, rung.r
        for f, q, z in rung.rows():
            # of the square-root one, Q is factorised by Cholesky, which knows no zero matrix
            kf.F = f
            if q.any() or not hasattr(kf, "_Q1_2"):
                kf.Q = q
            else:
                kf._Q1_2 = np.zeros_like(q)
            kf.predict()
            kf.update(z.reshape(-1, 1))
            yield kf.x.ravel().copy(), kf.P.copy()

    return run


def filterpy_cubature(rung):
    from filterpy.kalman import CubatureKalmanFilter
    from filterpy.kalman.CubatureKalmanFilter import spherical_radial_sigmas

    now = {}
    kf = CubatureKalmanFilter(rung.n, rung.d, 1.0, rung.observe, lambda x, dt: now["f"] @ x, residual_z=rung.difference)
    kf.x, kf.P, kf.R = rung.mean.reshape(-1, 1).copy(), rung.cov.copy(), rung.r
    for f, q, z in rung.rows():
        now["f"], kf.Q = f, q
        kf.predict()
        # drawn anew, so that they carry the process noise
        kf.sigmas_f = spherical_radial_sigmas(kf.x, kf.P)
        kf.update(z.reshape(-1, 1))
        yield kf.x.ravel().copy(), kf.P.copy()


def filterpy_unscented(rung):
    from filterpy.kalman import MerweScaledSigmaPoints, UnscentedKalmanFilter

    now = {}
    points = MerweScaledSigmaPoints(rung.n, alpha=1.0, beta=0.0, kappa=1.0)
    kf = UnscentedKalmanFilter(
        rung.n,
        rung.d,
        1.0,
        rung.observe,
        lambda x, dt: now["f"] @ x,
        points,
        z_mean_fn=rung.average,
        residual_z=rung.difference,
    )
    kf.x, kf.P, kf.R = rung.mean.copy(), rung.cov.copy(), rung.r
    for f, q, z in rung.rows():
        now["f"], kf.Q = f, q
        kf.predict()
        kf.sigmas_f = points.sigma_points(kf.x, kf.P)
        kf.update(z)
        yield kf.x.copy(), kf.P.copy()


def turbo(kind):
    def run(rung):
        now = {}
        kf = kind(rung.n, rung.d, 1.0, hx=rung.observe, fx=lambda x, dt: x @ now["f"].T)
        kf.x, kf.P, kf.R = rung.mean, rung.cov, rung.r
        for f, q, z in rung.rows():
            now["f"], kf.Q = f, q
            kf.predict()
            kf.update(z)
            yield np.array(kf.x), np.array(kf.P)

    return run


def kalman_py_linear(square_root):
    def run(rung):
        from kalman_py import KalmanFilter

        f, q = rung.steps[0]
        kf = KalmanFilter(f, rung.h, q, rung.r, rung.mean, rung.cov, square_root=square_root)
        for f, q, z in rung.rows():
            kf.predict(f, q) if len(rung.steps) > 1 else kf.predict()
            kf.update(z)
            yield kf.x.copy(), kf.P.copy()

    return run


def kalman_py_unscented(square_root):
    def run(rung):
        from kalman_py import UnscentedKalmanFilter

        now, (_, q) = {}, rung.steps[0]
        kf = UnscentedKalmanFilter(
            lambda x, dt: x @ now["f"].T,
            rung.observe,
            q,
            rung.r,
            rung.mean,
            rung.cov,
            alpha=1.0,
            beta=0.0,
            kappa=1.0,
            residual_z=rung.difference,
            square_root=square_root,
        )
        for f, _, z in rung.rows():
            now["f"] = f
            kf.predict(1.0)
            kf.update(z)
            yield kf.x.copy(), kf.P.copy()

    return run


def cuthbert():
    import jax
    from cuthbertlib.kalman import filtering

    @jax.jit
    def row(m, s, f, q, h, r, z):
        zero = m * 0
        m, s = filtering.predict(m, s, f, zero, q)
        return filtering.update(m, s, h, z * 0, r, z)[0]

    @jax.jit
    def many(count, m, s, *more):
        return jax.lax.fori_loop(0, count, lambda _, belief: row(*belief, *more), (m, s))

    def run(rung):
        m, s, r = rung.mean, root(rung.cov), root(rung.r)
        if rung.repeat:
            f, q = rung.steps[0]
            m, s = many(rung.repeat, m, s, f, root(q), rung.h, r, rung.z[0])
            yield np.array(m), np.array(s @ s.T)
            return
        for f, q, z in rung.rows():
            m, s = row(m, s, f, root(q), rung.h, r, z)
            yield np.array(m), np.array(s @ s.T)

    return run


def dynamax_linear(rung):
    """Its first row is measured before it is predicted: its prior is ours, predicted."""
    from dynamax.linear_gaussian_ssm import inference as lg
    from jax.numpy import asarray, zeros

    n, d, rows = rung.n, rung.d, list(rung.rows())
    f, q = (np.array([row[i] for row in rows]) for i in (0, 1))
    mean, cov = f[0] @ rung.mean, f[0] @ rung.cov @ f[0].T + q[0]
    if len(rung.steps) == 1:
        f, q = rung.steps[0]
    params = lg.ParamsLGSSM(
        lg.ParamsLGSSMInitial(asarray(mean), asarray(cov)),
        lg.ParamsLGSSMDynamics(asarray(f), zeros(n), zeros((n, 0)), asarray(q)),
        lg.ParamsLGSSMEmissions(asarray(rung.h), zeros(d), zeros((d, 0)), asarray(rung.r)),
    )
    post = lg.lgssm_filter(params, asarray([row[2] for row in rows]))
    first = len(rows) - 1 if rung.repeat else 0
    yield from zip(np.array(post.filtered_means)[first:], np.array(post.filtered_covariances)[first:], strict=True)


def dynamax_unscented(rung):
    import jax.numpy as jnp
    from dynamax.nonlinear_gaussian_ssm import ParamsNLGSSM, UKFHyperParams, unscented_kalman_filter

    f, q = rung.steps[0]
    mean, cov = (jnp.asarray(x) for x in (f @ rung.mean, f @ rung.cov @ f.T + q))
    f, q, h, r = (jnp.asarray(x) for x in (f, q, rung.h, rung.r))

    def observe(x):
        z = h @ x
        return z if rung.period is None else jnp.arctan2(jnp.sin(z), jnp.cos(z))

    params = ParamsNLGSSM(mean, cov, lambda x: f @ x, q, observe, r)
    post = unscented_kalman_filter(params, jnp.asarray(rung.z), UKFHyperParams(alpha=1.0, beta=0.0, kappa=1.0))
    yield from zip(np.array(post.filtered_means), np.array(post.filtered_covariances), strict=True)

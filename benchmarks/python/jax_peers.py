"""The discrete peers that compile by JAX: dynamax, cuthbertlib."""

from __future__ import annotations

import jax_problems  # noqa: F401  (double precision, before anything else)
import jax
import jax.numpy as jnp
import numpy as np
from contest import CONTESTANT, WORKLOAD, report, serve
from workloads import discrete

f, h, q, r, mean, cov, z, every = discrete()


def points(mean, cov):
    spread = np.linalg.cholesky(cov) * np.sqrt(len(mean))
    return np.concatenate([mean + spread.T, mean - spread.T])


def dynamax():
    """Its first row is measured before it is predicted: its prior is ours, predicted."""
    from dynamax.nonlinear_gaussian_ssm import (
        ParamsNLGSSM,
        UKFHyperParams,
        unscented_kalman_filter,
        unscented_kalman_smoother,
    )

    images = np.asarray(f(jnp.asarray(points(mean, cov))))
    ahead = images.mean(0)
    ahead_cov = (images - ahead).T @ (images - ahead) / len(images) + q
    params = ParamsNLGSSM(ahead, ahead_cov, f, q, h, r)
    weights = UKFHyperParams(alpha=1.0, beta=0.0, kappa=0.0)
    fields = ["filtered_means", "filtered_covariances"]

    def run(z):
        if WORKLOAD == "W4":
            post = unscented_kalman_smoother(params, z, weights)
            return post.smoothed_means, post.smoothed_covariances
        post = unscented_kalman_filter(params, z, weights, output_fields=fields)
        return post.filtered_means, post.filtered_covariances

    return "dynamax jax", run


def cuthbert():
    """Steps of cuthbertlib in square-root form, with its cubature."""
    from cuthbertlib.kalman import filtering, smoothing
    from cuthbertlib.quadrature import cubature
    from cuthbertlib.quadrature.linearize import functional

    rule = cubature.weights(len(mean))
    root_q, root_r = np.linalg.cholesky(q), np.linalg.cholesky(r)
    start = (jnp.asarray(mean), jnp.asarray(np.linalg.cholesky(cov)))

    def step(belief, z):
        m, s = belief
        a, b, noise = functional(f, root_q, m, s, rule, mode="sqrt")
        m1, s1 = filtering.predict(m, s, a, b, noise)
        c, d, sensor = functional(h, root_r, m1, s1, rule, mode="sqrt")
        (m2, s2), _ = filtering.update(m1, s1, c, d, sensor, z)
        return (m2, s2), (m2, s2, a, b, noise)

    def run(z):
        _, (m, s, a, b, noise) = jax.lax.scan(step, start, z)
        if WORKLOAD == "W4":

            def back(later, row):
                now = smoothing.update(row[0], row[1], *later, *row[2:])[0]
                return now, now

            past = (m[:-1], s[:-1], a[1:], b[1:], noise[1:])
            _, (sm, ss) = jax.lax.scan(back, (m[-1], s[-1]), past, reverse=True)
            m, s = jnp.concatenate([sm, m[-1:]]), jnp.concatenate([ss, s[-1:]])
        return m, s @ jnp.swapaxes(s, -1, -2)

    return "cuthbertlib jax", run


packages, run = {"dynamax": dynamax, "cuthbert": cuthbert}[CONTESTANT]()
if z.ndim == 3:
    whole = jax.vmap(run)

    def run(z):
        m, p = whole(z)
        return m[:, -1], p[:, -1]

    every = 1
compiled, z = jax.jit(run), jnp.asarray(z)
steps = z.shape[0] * (z.shape[1] if z.ndim == 3 else 1)
serve(packages, steps, report(*compiled(z), every=every), lambda: jax.block_until_ready(compiled(z)))

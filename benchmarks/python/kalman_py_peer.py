"""kalman-py: its unscented filter on JAX, alpha = 1, beta = 0, kappa = 0."""

from __future__ import annotations

import jax_problems  # noqa: F401  (double precision, before anything else)
import jax
from contest import CONTESTANT, WORKLOAD, report, serve
from kalman_py import UnscentedKalmanFilter
from workloads import discrete

f, h, q, r, mean, cov, z, every = discrete()


def step(x, dt):
    return f(x)


kf = UnscentedKalmanFilter(
    step, h, q, r, mean, cov, alpha=1.0, beta=0.0, kappa=0.0, vectorized=True, square_root=CONTESTANT == "root"
)


def go():
    result = kf.filter(z, 1.0, backend="jax")
    if WORKLOAD == "W4":
        result = kf.smooth(result)
    return jax.block_until_ready((result.means, result.covs))


serve("kalman-py jax", len(z), report(*go(), every=every), go)

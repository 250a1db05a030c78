"""cd_dynamax: its unscented filter by the moment equations, alpha = 1, beta = 0, kappa = 0; steps equal or adapted."""

from __future__ import annotations

from typing import Any, NamedTuple

import jax_problems as jp
import diffrax
import jax
import jax.numpy as jnp
from cd_dynamax import ParamsCDNLGSSM, UKFHyperParams, cdnlgssm_filter
from cd_dynamax.src.continuous_discrete_nonlinear_gaussian_ssm import cdnlgssm_utils as parts
from contest import CONTESTANT, report, rows, serve
from problems import *
from reference import points


class Drift(NamedTuple):
    params: Any = None

    def f(self, x, u=None, t=None):
        return jp.space_drift(x)


class Radar(NamedTuple):
    params: Any = None

    def f(self, x, u=None, t=None):
        return jp.space_radar(x)


def slopes(mean, cov):
    x = points(mean, cov)
    f = space_drifts(x)
    a = (x - mean).T @ (f - f.mean(0)) / len(x)
    return f.mean(0), a + a.T + SPACE_K


def first_row():
    """Its first row is measured before it is predicted: its prior is ours, predicted."""
    mean, cov, h = SPACE_MEAN, SPACE_COV, SPACE_GAP / SPACE_SUBSTEPS
    for _ in range(SPACE_SUBSTEPS):
        a1, b1 = slopes(mean, cov)
        a2, b2 = slopes(mean + 0.5 * h * a1, cov + 0.5 * h * b1)
        a3, b3 = slopes(mean + 0.5 * h * a2, cov + 0.5 * h * b2)
        a4, b4 = slopes(mean + h * a3, cov + h * b3)
        mean, cov = mean + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), cov + h / 6 * (b1 + 2 * b2 + 2 * b3 + b4)
    return parts.LearnableVector(jnp.asarray(mean)), parts.LearnableMatrix(jnp.asarray(cov))


params = ParamsCDNLGSSM(
    initial=parts.ParamsLGSSMInitial(*first_row()),
    dynamics=parts.ParamsCDNLGSSMDynamics(
        drift=Drift(),
        diffusion_coefficient=parts.LearnableMatrix(jnp.eye(7)),
        diffusion_cov=parts.LearnableMatrix(jnp.asarray(SPACE_K)),
        approx_order=2,
    ),
    emissions=parts.ParamsCDNLGSSMEmissions(
        emission_function=Radar(), emission_cov=parts.LearnableMatrix(jnp.asarray(SPACE_R))
    ),
)
settings = {"solver": diffrax.Dopri5(), "dt0": SPACE_GAP / SPACE_SUBSTEPS}
if CONTESTANT == "adaptive":
    settings["stepsize_controller"] = diffrax.PIDController(rtol=1e-6, atol=1e-6)
weights = UKFHyperParams(alpha=1.0, beta=0.0, kappa=0.0, diffeqsolve_settings=settings)
z = jnp.asarray(rows("space"))
times = SPACE_GAP * jnp.arange(1.0, len(z) + 1)[:, None]
fields = ["filtered_means", "filtered_covariances"]


@jax.jit
def run(z):
    post = cdnlgssm_filter(params, z, times, weights, output_fields=fields, warn=False)
    return post.filtered_means, post.filtered_covariances


serve("cd-dynamax diffrax jax", len(z), report(*run(z), every=1), lambda: jax.block_until_ready(run(z)))

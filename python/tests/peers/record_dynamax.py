"""dynamax's answers: `python record_dynamax.py` in an environment with dynamax==1.0.3 and jax[cpu], in double precision."""

from typing import Any

import jax

jax.config.update("jax_enable_x64", True)

import jax.numpy as jnp
import numpy as np
import problems
from dynamax.linear_gaussian_ssm import LinearGaussianSSM, lgssm_smoother
from dynamax.nonlinear_gaussian_ssm import (
    ParamsNLGSSM,
    UKFHyperParams,
    extended_kalman_smoother,
    unscented_kalman_smoother,
)
from record import Recorder

recorder = Recorder("dynamax", "dynamax", "jax", "jaxlib", "numpy")


def gaps(problem: Any) -> Any:
    return np.diff(problem.t, prepend=problem.t0)


def both(name: str, method: str, posterior: Any, **options: float) -> None:
    fit = float(posterior.marginal_loglik)
    recorder.add(name, method, "filter", posterior.filtered_means, posterior.filtered_covariances, fit, **options)
    recorder.add(name, method, "smooth", posterior.smoothed_means, posterior.smoothed_covariances, fit, **options)


def linear(name: str) -> None:
    problem = problems.load(name)
    F = np.array([problem.transition_jacobian(problem.mean, dt) for dt in gaps(problem)])
    Q = np.array([problem.noise_cov(dt) for dt in gaps(problem)])
    params, _ = LinearGaussianSSM(4, 2).initialize(
        # dynamax's initial belief holds at the first row: the first gap is crossed here.
        initial_mean=jnp.array(F[0] @ problem.mean),
        initial_covariance=jnp.array(F[0] @ problem.cov @ F[0].T + Q[0]),
        dynamics_weights=jnp.array(F),  # row k leads from row k − 1 to k
        dynamics_covariance=jnp.array(Q),
        emission_weights=jnp.array(problem.measure_jacobian(problem.mean)),
        emission_covariance=jnp.array(problem.noise),
    )
    both(name, "ekf", lgssm_smoother(params, jnp.array(problem.z)))


def nonlinear(name: str, method: str, smoother: Any, **options: float) -> None:
    """The gap is an input of the transition, Q an array of one matrix a row."""
    problem = problems.load(name)
    params = ParamsNLGSSM(
        initial_mean=jnp.array(problem.mean),
        initial_covariance=jnp.array(problem.cov),
        dynamics_function=lambda x, u: problem.transition(x, u[0], jnp),
        dynamics_covariance=jnp.array([problem.noise_cov(dt) for dt in gaps(problem)]),
        emission_function=lambda x, u: problem.measure(x, jnp),
        emission_covariance=jnp.array(problem.noise),
    )
    both(name, method, smoother(params, jnp.array(problem.z), inputs=jnp.array(gaps(problem))[:, None]), **options)


def unscented(alpha: float, beta: float, kappa: float) -> Any:
    chosen = UKFHyperParams(alpha=alpha, beta=beta, kappa=kappa)
    return lambda params, z, inputs: unscented_kalman_smoother(params, z, chosen, inputs)


def main() -> None:
    linear("linear")
    nonlinear("turn", "ekf", extended_kalman_smoother)
    nonlinear("turn", "ckf", unscented(1.0, 0.0, 0.0))
    nonlinear("turn", "ukf", unscented(0.5, 2.0, 1.0), alpha=0.5, beta=2, kappa=1)
    recorder.write()


if __name__ == "__main__":
    main()

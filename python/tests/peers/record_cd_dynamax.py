"""cd-dynamax's answers on the continuous model: `python record_cd_dynamax.py` in an environment with cd-dynamax==0.5.0 and jax[cpu], in double precision and with tight tolerances."""

from typing import Any, NamedTuple

import jax

jax.config.update("jax_enable_x64", True)

import diffrax
import jax.numpy as jnp
import problems
from cd_dynamax.dynamax.linear_gaussian_ssm.inference import ParamsLGSSMInitial
from cd_dynamax.src.continuous_discrete_nonlinear_gaussian_ssm import (
    EKFHyperParams,
    ParamsCDNLGSSM,
    ParamsCDNLGSSMDynamics,
    ParamsCDNLGSSMEmissions,
    UKFHyperParams,
)
from cd_dynamax.src.continuous_discrete_nonlinear_gaussian_ssm.cdnlgssm_utils import LearnableMatrix, LearnableVector
from cd_dynamax.src.continuous_discrete_nonlinear_gaussian_ssm.inference_ekf import (
    extended_kalman_filter,
    extended_kalman_smoother,
)
from cd_dynamax.src.continuous_discrete_nonlinear_gaussian_ssm.inference_ukf import unscented_kalman_filter
from record import Recorder

recorder = Recorder("cd_dynamax", "cd-dynamax", "diffrax", "jax", "jaxlib", "numpy")
PROBLEM = problems.load("pendulum")
SOLVER = {
    "solver": diffrax.Dopri8(),
    "stepsize_controller": diffrax.PIDController(rtol=1e-11, atol=1e-13),
    "dt0": 1e-3,
    "max_steps": 10_000,
}


class Drift(NamedTuple):
    def f(self, x: Any, u: Any = None, t: Any = None) -> Any:
        return PROBLEM.drift(x, jnp)


class Measure(NamedTuple):
    def f(self, x: Any, u: Any = None, t: Any = None) -> Any:
        return PROBLEM.measure(x, jnp)


def params() -> Any:
    return ParamsCDNLGSSM(
        initial=ParamsLGSSMInitial(
            mean=LearnableVector(jnp.array(PROBLEM.mean)), cov=LearnableMatrix(jnp.array(PROBLEM.cov))
        ),
        dynamics=ParamsCDNLGSSMDynamics(
            drift=Drift(),
            diffusion_coefficient=LearnableMatrix(jnp.diag(jnp.array(PROBLEM.diffusion()))),
            diffusion_cov=LearnableMatrix(jnp.eye(3)),
            approx_order=2.0,
        ),
        emissions=ParamsCDNLGSSMEmissions(
            emission_function=Measure(), emission_cov=LearnableMatrix(jnp.array(PROBLEM.noise))
        ),
    )


def main() -> None:
    z, t = jnp.array(PROBLEM.z), jnp.array(PROBLEM.t)[:, None]
    # After the last row it predicts once more, to dt_final.
    first = EKFHyperParams(dt_final=0.1, diffeqsolve_settings=SOLVER)
    out = extended_kalman_filter(params(), z, t, first)
    recorder.add("pendulum", "cd-ekf", "filter", out.filtered_means, out.filtered_covariances, out.marginal_loglik)
    for method, options in (("cd-ckf2", {}), ("cd-ukf", {"alpha": 0.5, "beta": 2.0, "kappa": 1.0})):
        chosen = {"alpha": 1.0, "beta": 0.0, "kappa": 0.0} | options
        out = unscented_kalman_filter(
            params(), z, t, UKFHyperParams(dt_final=0.1, diffeqsolve_settings=SOLVER, **chosen)
        )
        recorder.add(
            "pendulum", method, "filter", out.filtered_means, out.filtered_covariances, out.marginal_loglik, **options
        )
    back = extended_kalman_smoother(params(), z, first, t)
    why = "its way back holds the filter's mean and covariance of a gap's beginning fixed all along the gap"
    recorder.depart(
        why, "pendulum", "cd-ekf", "smooth", back.smoothed_means, back.smoothed_covariances, back.marginal_loglik
    )
    recorder.write()


if __name__ == "__main__":
    main()

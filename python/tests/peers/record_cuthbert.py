"""cuthbert's answers, all in square roots: `python record_cuthbert.py` in an environment with cuthbert==0.1.1 and jax[cpu], in double precision.

`cuthbert.gaussian.moments` linearises a conditional mean by its derivative: the square-root EKF. The cubature filter is put together from `cuthbertlib`: quadrature, predict, update, smooth.
"""

from typing import Any

import jax

jax.config.update("jax_enable_x64", True)

import jax.numpy as jnp
import numpy as np
import problems
from cuthbert import filter as run_filter
from cuthbert import smoother as run_smoother
from cuthbert.gaussian import moments
from cuthbertlib.kalman import filtering, smoothing
from cuthbertlib.quadrature import cubature
from cuthbertlib.quadrature.linearize import functional
from record import Recorder

recorder = Recorder("cuthbert", "cuthbert", "cuthbertlib", "jax", "jaxlib", "numpy")


def gaps(problem: Any) -> Any:
    return np.diff(problem.t, prepend=problem.t0)


def root(cov: Any) -> Any:
    """Of a gap of zero: zero."""
    return np.linalg.cholesky(cov) if np.any(cov) else np.zeros_like(cov)


def square(factors: Any) -> Any:
    return np.einsum("kij,klj->kil", factors, factors)


def extended(name: str) -> None:
    problem = problems.load(name)
    chol_R = jnp.array(root(problem.noise))
    inputs = {
        "dt": jnp.array(gaps(problem)),
        "chol_Q": jnp.array([root(problem.noise_cov(dt)) for dt in gaps(problem)]),
        "z": jnp.array(problem.z),  # NaN is missing, by component
    }

    def dynamics(state: Any, row: Any) -> Any:
        return lambda x: (problem.transition(x, row["dt"], jnp), row["chol_Q"]), state.mean

    def observation(state: Any, row: Any) -> Any:
        return lambda x: (problem.measure(x, jnp), chol_R), state.mean, row["z"]

    chosen = moments.build_filter(jnp.array(problem.mean), jnp.array(root(problem.cov)), dynamics, observation)
    states = run_filter(chosen, inputs, chosen.init_prepare())
    fit = float(states.log_normalizing_constant[-1])
    recorder.add(name, "sr-ekf", "filter", states.mean[1:], square(states.chol_cov)[1:], fit)
    smooth = run_smoother(moments.build_smoother(dynamics), states)
    recorder.add(name, "sr-ekf", "smooth", smooth.mean[1:], square(smooth.chol_cov)[1:], fit)


def sigma(name: str) -> None:
    problem = problems.load(name)
    rule = cubature.weights(problem.mean.size)
    m, S = jnp.array(problem.mean), jnp.array(root(problem.cov))
    chol_R = jnp.array(root(problem.noise))

    @jax.jit
    def transition(m: Any, S: Any, dt: Any, chol_Q: Any) -> Any:
        return functional(lambda x: problem.transition(x, dt, jnp), chol_Q, m, S, rule, mode="sqrt")

    @jax.jit
    def update(m: Any, S: Any, z: Any) -> Any:
        H, d, spread = functional(lambda x: problem.measure(x, jnp), chol_R, m, S, rule, mode="sqrt")
        return filtering.update(m, S, H, d, spread, z)

    filtered, steps, fit = [], [], 0.0
    for z, dt in zip(problem.z, gaps(problem)):
        step = None
        if dt > 0:
            step = transition(m, S, dt, jnp.array(root(problem.noise_cov(dt))))
            m, S = filtering.predict(m, S, *step)
        steps.append(step)
        (m, S), row = update(m, S, jnp.array(z))
        filtered.append((m, S))
        fit += float(row)
    recorder.add(name, "sr-ckf", "filter", [m for m, _ in filtered], square([S for _, S in filtered]), fit)
    back = [filtered[-1]]
    for (m, S), step in zip(filtered[-2::-1], steps[:0:-1]):
        back.append(smoothing.update(m, S, *back[-1], *step)[0])
    back.reverse()
    recorder.add(name, "sr-ckf", "smooth", [m for m, _ in back], square([S for _, S in back]), fit)


def main() -> None:
    extended("linear")
    extended("linear-holes")
    extended("turn")
    sigma("linear-holes")
    sigma("turn")
    recorder.write()


if __name__ == "__main__":
    main()

"""FilterPy's answers: `python record_filterpy.py` in an environment with filterpy==2.0.0."""

from typing import Any

import numpy as np
import problems
from filterpy.kalman import (
    CubatureKalmanFilter,
    ExtendedKalmanFilter,
    JulierSigmaPoints,
    KalmanFilter,
    MerweScaledSigmaPoints,
    UnscentedKalmanFilter,
    unscented_transform,
)
from record import Recorder

recorder = Recorder("filterpy", "filterpy", "numpy", "scipy")


def gaps(problem: Any) -> Any:
    return np.diff(problem.t, prepend=problem.t0)


def rows(problem: Any) -> list[Any]:
    """None is FilterPy's missing measurement; it has no word for a missing component."""
    return [None if np.isnan(z).any() else z for z in problem.z]


def kalman(name: str) -> None:
    problem = problems.load(name)
    kf = KalmanFilter(4, 2)
    kf.x, kf.P, kf.R = problem.mean, problem.cov, problem.noise
    kf.H = problem.measure_jacobian(problem.mean)
    Fs = [problem.transition_jacobian(problem.mean, dt) for dt in gaps(problem)]
    Qs = [problem.noise_cov(dt) for dt in gaps(problem)]
    means, covs, fit = [], [], 0.0
    for z, F, Q in zip(rows(problem), Fs, Qs):
        kf.predict(F=F, Q=Q)
        kf.update(z)
        means.append(kf.x)
        covs.append(kf.P)
        fit += (
            0.0 if z is None else kf.log_likelihood
        )  # where z is None, FilterPy gives ln N(0; 0, S) with the S of the row before
    recorder.add(name, "ekf", "filter", means, covs, fit)
    mean, cov, _, _ = kf.rts_smoother(np.array(means), np.array(covs), Fs, Qs)
    recorder.add(name, "ekf", "smooth", mean, cov, fit)


def extended(name: str) -> None:
    problem = problems.load(name)

    class Turning(ExtendedKalmanFilter):
        """predict() multiplies by F; the way to a nonlinear f is to override predict_x."""

        def predict_x(self, u: Any = 0) -> None:
            self.x = problem.transition(self.x, self.dt)

    ekf = Turning(5, 2)
    ekf.x, ekf.P, ekf.R = problem.mean, problem.cov, problem.noise
    means, covs, fit = [], [], 0.0
    for z, dt in zip(problem.z, gaps(problem)):
        ekf.dt, ekf.Q = dt, problem.noise_cov(dt)
        ekf.F = problem.transition_jacobian(ekf.x, dt)
        ekf.predict()
        ekf.update(z, problem.measure_jacobian, problem.measure, residual=residual(name))
        means.append(ekf.x)
        covs.append(ekf.P)
        fit += ekf.log_likelihood
    recorder.add(name, "ekf", "filter", means, covs, fit)


def residual(name: str) -> Any:
    """What FilterPy's guides give for a bearing: the difference, wrapped."""

    def wrapped(a: Any, b: Any) -> Any:
        d = np.subtract(a, b)
        d[1] = (d[1] + np.pi) % (2 * np.pi) - np.pi
        return d

    return wrapped if name.endswith("west") else np.subtract


def mean_of(name: str) -> Any:
    """And for its mean: by sines and cosines."""

    def circular(sigmas: Any, weights: Any) -> Any:
        return np.array(
            [weights @ sigmas[:, 0], np.arctan2(weights @ np.sin(sigmas[:, 1]), weights @ np.cos(sigmas[:, 1]))]
        )

    return circular if name.endswith("west") else None


def unscented(name: str, method: str, points: Any, **options: float) -> None:
    problem = problems.load(name)
    n, d = problem.mean.size, problem.z.shape[1]
    ukf = UnscentedKalmanFilter(
        n, d, None, problem.measure, problem.transition, points, residual_z=residual(name), z_mean_fn=mean_of(name)
    )  # fmt: skip
    ukf.x, ukf.P, ukf.R = problem.mean, problem.cov, problem.noise
    means, covs, fit = [], [], 0.0
    for z, dt in zip(rows(problem), gaps(problem)):
        ukf.Q = problem.noise_cov(dt)
        ukf.predict(dt=dt)
        ukf.update(z)
        means.append(ukf.x)
        covs.append(ukf.P)
        fit += 0.0 if z is None else ukf.log_likelihood  # which keeps the value of the row before
    recorder.add(name, method, "filter", means, covs, fit, **options)

    # rts_smoother drops its argument Qs and uses ukf.Q for every step. It calls UT once a step, from the last: the Q of that step is put in here. Its dts[k] leads from row k to k + 1.
    backwards = iter([problem.noise_cov(dt) for dt in gaps(problem)[:0:-1]])

    def transform(sigmas: Any, Wm: Any, Wc: Any, _: Any, mean: Any, difference: Any) -> Any:
        return unscented_transform(sigmas, Wm, Wc, next(backwards), mean, difference)

    mean, cov, _ = ukf.rts_smoother(np.array(means), np.array(covs), dts=list(gaps(problem)[1:]), UT=transform)
    recorder.add(name, method, "smooth", mean, cov, fit, **options)


def cubature(name: str) -> None:
    problem = problems.load(name)
    n, d = problem.mean.size, problem.z.shape[1]
    ckf = CubatureKalmanFilter(n, d, None, problem.measure, problem.transition)
    ckf.x, ckf.P, ckf.R = problem.mean, problem.cov, problem.noise
    means, covs, fit = [], [], 0.0
    for z, dt in zip(problem.z, gaps(problem)):
        ckf.Q = problem.noise_cov(dt)
        ckf.predict(dt)
        ckf.update(z[:, None])  # its x is a column; a flat z would broadcast to a matrix
        means.append(ckf.x.ravel())
        covs.append(ckf.P)
        fit += ckf.log_likelihood
    why = "its CKF measures the points that f moved, without Q: they are not drawn anew"
    recorder.depart(why, name, "ckf", "filter", means, covs, fit)
    recorder.depart(why, name, "ckf", "filter", means, covs, fit, redraw=False)


def main() -> None:
    kalman("linear")
    kalman("linear-gaps")
    extended("turn")
    extended("turn-west")
    for name in ("linear-gaps", "turn", "turn-west"):
        n = 4 if name.startswith("linear") else 5
        unscented(name, "ckf", MerweScaledSigmaPoints(n, 1, 0, 0))
    unscented("turn", "ukf", JulierSigmaPoints(5, kappa=1), kappa=1)
    unscented("turn", "ukf", MerweScaledSigmaPoints(5, 0.5, 2, 1), alpha=0.5, beta=2, kappa=1)
    cubature("linear")
    cubature("turn")
    recorder.write()


if __name__ == "__main__":
    main()

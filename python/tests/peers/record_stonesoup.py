"""Stone Soup's answers: `python record_stonesoup.py` in an environment with stonesoup==1.9. Its own models: ConstantTurn, CartesianToBearingRange; its clock counts microseconds."""

from datetime import datetime, timedelta
from typing import Any

import numpy as np
import problems
from record import Recorder
from stonesoup.models.measurement.linear import LinearGaussian
from stonesoup.models.measurement.nonlinear import CartesianToBearingRange
from stonesoup.models.transition.linear import CombinedLinearGaussianTransitionModel, ConstantVelocity
from stonesoup.models.transition.nonlinear import ConstantTurn
from stonesoup.predictor.kalman import CubatureKalmanPredictor, KalmanPredictor, UnscentedKalmanPredictor
from stonesoup.smoother.kalman import KalmanSmoother, UnscentedKalmanSmoother
from stonesoup.types.array import StateVector
from stonesoup.types.detection import Detection
from stonesoup.types.hypothesis import SingleHypothesis
from stonesoup.types.state import GaussianState
from stonesoup.types.track import Track
from stonesoup.updater.kalman import CubatureKalmanUpdater, KalmanUpdater, UnscentedKalmanUpdater

recorder = Recorder("stonesoup", "stonesoup", "numpy", "scipy")
START = datetime(2026, 1, 1)


def models(problem: Any) -> tuple[Any, Any, list[int]]:
    """Its transition and measurement, and the order of our measures in its own (bearing first)."""
    q = problem.numbers["q"]
    if problem.name.startswith("linear"):
        velocity = CombinedLinearGaussianTransitionModel([ConstantVelocity(q), ConstantVelocity(q)])
        return velocity, LinearGaussian(4, (0, 2), problem.noise), [0, 1]
    turn = ConstantTurn(np.array([q, q]), problem.numbers["q_turn"])
    return turn, CartesianToBearingRange(5, (0, 2), problem.noise[::-1, ::-1]), [1, 0]


def run(name: str, method: str, predictor: Any, updater: Any, smoother: Any, **options: float) -> None:
    problem = problems.load(name)
    transition, measurement, order = models(problem)
    forward, update = predictor(transition), updater(measurement)
    state: Any = GaussianState(StateVector(problem.mean), problem.cov, timestamp=START + timedelta(seconds=problem.t0))
    track, fit = Track(), 0.0
    for t, z in zip(problem.t, problem.z):
        now = START + timedelta(seconds=t)
        prediction = forward.predict(state, timestamp=now)
        state = prediction
        if not np.isnan(z).any():  # it has no missing components
            detection = Detection(StateVector(z[order]), timestamp=now, measurement_model=measurement)
            expected = update.predict_measurement(prediction, measurement)
            state = update.update(SingleHypothesis(prediction, detection, expected))
            nu = np.asarray(detection.state_vector - expected.state_vector, float).ravel()
            S = np.asarray(expected.covar, float)
            fit += float(-0.5 * (nu @ np.linalg.solve(S, nu) + np.linalg.slogdet(2 * np.pi * S)[1]))
        track.append(state)
    if name == "turn-west" and method == "ckf":
        recorder.depart(
            "its cubature transform multiplies angles as numbers: wrong where they cross ±π",
            name,
            method,
            "filter",
            *arrays(track),
            fit,
        )
        return
    recorder.add(name, method, "filter", *arrays(track), fit, **options)
    back = arrays(smoother(transition).smooth(track))
    if np.isnan(problem.z).any():
        recorder.depart(
            "nothing passes back over a row without measurement: its smoothed prediction is taken for the prediction",
            name,
            method,
            "smooth",
            *back,
            fit,
        )
    else:
        recorder.add(name, method, "smooth", *back, fit, **options)


def arrays(track: Any) -> tuple[Any, Any]:
    return [np.asarray(s.state_vector, float).ravel() for s in track], [np.asarray(s.covar, float) for s in track]


def unscented(alpha: float, beta: float, kappa: float) -> tuple[Any, Any, Any]:
    words = {"alpha": alpha, "beta": beta, "kappa": kappa}
    return (
        lambda model: UnscentedKalmanPredictor(model, **words),
        lambda model: UnscentedKalmanUpdater(model, **words),
        lambda model: UnscentedKalmanSmoother(model, **words),
    )


def main() -> None:
    run("linear", "ekf", KalmanPredictor, KalmanUpdater, KalmanSmoother)
    run("linear-gaps", "ekf", KalmanPredictor, KalmanUpdater, KalmanSmoother)
    # Of cubature it has no smoother; the unscented one with (1, 0, 0) takes the same points.
    backwards = unscented(1, 0, 0)[2]
    for name in ("linear", "turn", "turn-west"):
        run(name, "ckf", CubatureKalmanPredictor, CubatureKalmanUpdater, backwards)
    for name in ("turn", "turn-west"):
        run(name, "ukf", *unscented(0.5, 2, 1), alpha=0.5, beta=2, kappa=1)
    recorder.write()


if __name__ == "__main__":
    main()

"""Stone Soup: its cubature predictor, updater and unscented smoother."""

from __future__ import annotations

from datetime import datetime, timedelta

import numpy as np
from contest import WORKLOAD, lacks, report, rows, serve
from problems import *
from stonesoup.base import Property
from stonesoup.models.base import GaussianModel
from stonesoup.models.measurement.base import MeasurementModel
from stonesoup.models.transition.base import TransitionModel
from stonesoup.predictor.kalman import CubatureKalmanPredictor
from stonesoup.types.array import CovarianceMatrix, StateVector, StateVectors
from stonesoup.types.detection import Detection
from stonesoup.types.hypothesis import SingleHypothesis
from stonesoup.types.state import GaussianState
from stonesoup.updater.kalman import CubatureKalmanUpdater

if WORKLOAD != "W1":
    lacks("it has no cubature filter for this workload")


def each(function, state):
    """Of one vector a column, or of several."""
    x = np.asarray(state.state_vector, dtype=float)
    out = function(x.T).T if x.shape[1] > 1 else function(x[:, 0])[:, None]
    return StateVectors(out) if x.shape[1] > 1 else StateVector(out)


class Turn(TransitionModel, GaussianModel):
    @property
    def ndim_state(self):
        return 5

    def function(self, state, noise=False, **kwargs):
        return each(plane_steps, state)

    def covar(self, **kwargs):
        return CovarianceMatrix(PLANE_Q)

    def rvs(self, *args, **kwargs):
        raise NotImplementedError

    def pdf(self, *args, **kwargs):
        raise NotImplementedError


class Radar(MeasurementModel, GaussianModel):
    ndim_state: int = Property(default=5)
    mapping: list = Property(default=(0, 2))

    @property
    def ndim_meas(self):
        return 2

    def function(self, state, noise=False, **kwargs):
        return each(plane_radars, state)

    def covar(self, **kwargs):
        return CovarianceMatrix(PLANE_R)

    def rvs(self, *args, **kwargs):
        raise NotImplementedError

    def pdf(self, *args, **kwargs):
        raise NotImplementedError


z, begin = rows("plane"), datetime(2026, 1, 1)
radar = Radar()
detections = [
    Detection(StateVector(row), timestamp=begin + timedelta(seconds=k + 1), measurement_model=radar)
    for k, row in enumerate(z)
]


def go():
    predictor, updater = CubatureKalmanPredictor(Turn()), CubatureKalmanUpdater(radar)
    state, means, covs = GaussianState(PLANE_MEAN, PLANE_COV, timestamp=begin), [], []
    for detection in detections:
        prediction = predictor.predict(state, timestamp=detection.timestamp)
        state = updater.update(SingleHypothesis(prediction, detection))
        means.append(np.ravel(state.mean))
        covs.append(np.array(state.covar))
    return means, covs


serve("stonesoup numpy", len(z), report(*go(), every=10), go)

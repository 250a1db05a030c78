"""Nonlinear Gaussian state estimation: filters and smoothers of the cubature family.

A model is written in ordinary NumPy and runs natively, with exact derivatives:

>>> import givens as gv
>>> import numpy as np
>>> model = gv.Sde(lambda t, x: [x[1], -np.sin(x[0])], diffusion={"rate": 0.1}, state=["angle", "rate"])
>>> sensor = gv.Sensor(lambda t, x: [np.sin(x[0])], measures=["height"], std=[0.05])
>>> t = np.arange(0.0, 5.0, 0.1)
>>> z = 0.3 * np.cos(t)[:, None]
>>> est = gv.smooth(model, sensor, t, z, prior=gv.Gaussian([0.3, 0.0], std=[0.2, 0.2]))
>>> est.mean.shape, est.std.shape
((50, 2), (50, 2))
"""

from givens import _native
from givens.batch import Batch
from givens.comparison import Compared, Comparison, compare
from givens.consistency import Consistency
from givens.errors import DoubtWarning, GivensError, InputError, MethodError, ModelError, StepError, TraceError
from givens.estimates import Estimates
from givens.gaussian import Gaussian
from givens.job import BatchJob, FailedTrack, FileJob, Summary, split_errors
from givens.merging import merge
from givens.model_file import ModelFile, parse_model, read_model
from givens.monte_carlo import Study, study
from givens.online import Filter
from givens.registry import Method, methods
from givens.running import filter, smooth
from givens.sde import Sde
from givens.sensor import Sensor
from givens.simulation import Simulated, simulate
from givens.transition import Transition

__all__ = [
    "Batch",
    "BatchJob",
    "Compared",
    "Comparison",
    "Consistency",
    "DoubtWarning",
    "Estimates",
    "FailedTrack",
    "FileJob",
    "Filter",
    "Gaussian",
    "GivensError",
    "InputError",
    "Method",
    "MethodError",
    "ModelError",
    "ModelFile",
    "Sde",
    "Sensor",
    "Simulated",
    "StepError",
    "Study",
    "Summary",
    "TraceError",
    "Transition",
    "compare",
    "filter",
    "merge",
    "methods",
    "parse_model",
    "read_model",
    "simulate",
    "smooth",
    "split_errors",
    "study",
]

__version__: str = _native.VERSION

"""Trajectories drawn from a model."""

import numpy as np
import pytest

import givens as gv


def test_a_simulation_whose_steps_are_too_long_says_so():
    fast = gv.Sde(lambda t, x: [-1000 * x[0] ** 3], diffusion=[1.0], state=["x"])
    seen = gv.Sensor(lambda t, x: x, measures=["p"], std=[1.0])
    with pytest.raises(gv.StepError, match="substeps") as caught:
        gv.simulate(fast, seen, np.arange(1.0, 20.0), prior=gv.Gaussian([30.0], std=[1.0]), seed=1)
    assert "16" in caught.value.remedy and "method" not in caught.value.remedy

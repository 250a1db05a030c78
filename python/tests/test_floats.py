"""Numbers near the end of what floats hold, and numbers that are exact."""

import numpy as np
import pytest

import givens as gv


@pytest.mark.parametrize("method", ["sr-ckf", "ckf", "sr-ekf", "sr-ukf"])
def test_a_deviation_too_large_to_be_squared_is_an_error_and_no_zero(method):
    model = gv.Transition(lambda t, dt, x: [1e10 * x[0], x[1]], noise_cov=np.zeros((2, 2)), state=["a", "b"])
    sensor = gv.Sensor(lambda t, x: [1e-10 * x[0]], measures=["z"], std=[1e140])
    prior = gv.Gaussian([0, 0], std=[1e150, 1.0])
    with pytest.raises(gv.StepError, match="predicted covariance is not positive definite at pivot 1") as caught:
        gv.filter(model, sensor, [1.0, 1.0], [[np.nan], [1e145]], prior=prior, method=method, t0=0.0)
    if method in ("sr-ckf", "sr-ekf"):
        assert "too large to be squared" in caught.value.remedy


def test_an_exact_zero_stays_zero_where_points_go_side_by_side():
    model = gv.Transition(lambda t, dt, x: [x[0], x[1]], noise_cov=np.zeros((2, 2)), state=["a", "b"])
    prior = gv.Gaussian([0.3, 0.3], np.full((2, 2), 0.01))
    found = [
        gv.filter(
            model,
            gv.Sensor(lambda t, x: [np.sqrt(x[0] * x[0] - x[1] * x[1]) + x[0]], measures=["z"], std=[0.1], trace=trace),
            [1.0],
            [[0.25]],
            prior=prior,
            t0=0.0,
        ).mean
        for trace in (True, False)
    ]
    np.testing.assert_allclose(found[0], found[1], rtol=1e-12)

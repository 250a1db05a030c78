"""Noises that are no covariances are refused when a model is made, as far as they are known then."""

import numpy as np
import pytest

import givens as gv

S, M = ["x", "y"], ["a", "b"]
PRIOR = gv.Gaussian([0.0, 0.0], std=[1.0, 1.0])
STILL = gv.Transition(lambda t, dt, x: x, noise_cov=np.eye(2), state=S)
INDEFINITE, TILTED = [[1.0, 2.0], [2.0, 1.0]], [[1.0, 0.2], [0.3, 1.0]]

RANGE = "\n  help: variances are from 0 up, and correlations from -1 to 1"
SYMMETRIC = "\n  help: give a symmetric matrix, such as (Q + Q.T) / 2 if they differ by rounding"


def moved(noise_cov, **options):
    return gv.Transition(lambda t, dt, x: x, noise_cov=noise_cov, state=S, **options)


def seen(model=STILL, **noise):
    sensor = gv.Sensor(lambda t, x: x, measures=M, **noise)
    return gv.filter(model, sensor, [0.0, 1.0], [[1.0, 1.0]] * 2, prior=PRIOR)


REFUSED = [
    (lambda: moved(INDEFINITE), "`noise_cov` is not positive semidefinite at pivot 2 (state `y`)" + RANGE),
    (lambda: moved(np.diag([-1.0, 1.0])), "`noise_cov` is not positive semidefinite at pivot 1 (state `x`)" + RANGE),
    (lambda: moved(lambda t, dt: INDEFINITE), "`noise_cov` is not positive semidefinite at pivot 2 (state `y`)" + RANGE),
    (
        lambda: moved(lambda t, dt, q=-1.0: q * np.eye(2)),
        "`noise_cov` is not positive semidefinite at pivot 1 (state `x`)" + RANGE,
    ),
    (
        lambda: gv.Transition(lambda t, dt, x: x, noise_cov=-1.0, state=["x"]),
        "`noise_cov` is not positive semidefinite at pivot 1 (state `x`)" + RANGE,
    ),
    (lambda: moved(TILTED), "`noise_cov` is not symmetric: 0.2 at [0, 1], 0.3 at [1, 0]" + SYMMETRIC),
    (
        lambda: moved(lambda t, dt, q=0.5: np.array([[1, q], [0, 1]])),
        "`noise_cov` is not symmetric: 0.5 at [0, 1], 0.0 at [1, 0]" + SYMMETRIC,
    ),
    (
        lambda: moved(lambda t, dt: dt * np.array([[1, 2], [0, 1]])),
        "`noise_cov` is not symmetric at t = 0.37, dt = 1.3: 2.6 at [0, 1], 0.0 at [1, 0]" + SYMMETRIC,
    ),
    (
        lambda: moved(lambda t, dt: dt * np.array([[1, 2], [0, 1]]), step=0.5),
        "`noise_cov` is not symmetric at t = 0.37, dt = 0.5: 1.0 at [0, 1], 0.0 at [1, 0]" + SYMMETRIC,
    ),
    (
        lambda: gv.Sensor(lambda t, x: x, measures=M, cov=INDEFINITE),
        "`cov` is not positive semidefinite at pivot 2 (measure `b`)" + RANGE,
    ),
    (lambda: seen(cov=lambda t: INDEFINITE), "`cov` is not positive semidefinite at pivot 2 (measure `b`)" + RANGE),
    (lambda: seen(cov=lambda t: TILTED), "`cov` is not symmetric: 0.2 at [0, 1], 0.3 at [1, 0]" + SYMMETRIC),
    (
        lambda: seen(cov=lambda t: np.array([[2.0, t], [0.0, 2.0]])),
        "`cov` is not symmetric at t = 0.37: 0.37 at [0, 1], 0.0 at [1, 0]" + SYMMETRIC,
    ),
    (
        lambda: seen(std=lambda t: [-1.0, 1.0]),
        "`std` of `a` is -1.0\n  help: standard deviations are finite, from 0 up",
    ),
]


@pytest.mark.parametrize(("make", "message"), REFUSED)
def test_a_noise_that_is_no_covariance_is_refused_before_it_is_used(make, message):
    with pytest.raises(gv.InputError) as caught:
        make()
    assert str(caught.value) == message


def test_a_covariance_of_a_row_is_compared_with_its_transpose_and_has_a_root():
    sensor = gv.Sensor(lambda t, x: x, measures=M, std=[1.0, 1.0], name="radar")
    for row, said in (
        (TILTED, "not symmetric in row 1: 0.2 at [0, 1], 0.3 at [1, 0]"),
        (INDEFINITE, "not positive semidefinite in row 1, at pivot 2 (measure `b`)"),
    ):
        with pytest.raises(gv.InputError) as caught:
            gv.filter(
                STILL, sensor, [0.0, 1.0], [[1.0, 1.0]] * 2, prior=PRIOR, noise={"radar": np.array([np.eye(2), row])}
            )
        assert str(caught.value).startswith(f"`noise['radar']` is {said}\n  help: ")
        assert caught.value.row == 1


def test_semidefinite_and_rounded_covariances_are_taken():
    moved(np.zeros((2, 2)))
    moved([[1.0, 1.0], [1.0, 1.0]])
    gain = np.array([[0.1, 0.7], [0.3, 1 / 3]])
    moved(gain @ gain.T)
    moved(lambda t, dt, q=0.3: (q * dt * gain) @ gain.T + (gain * q) @ (dt * gain).T)
    moved(lambda t, dt: np.sqrt(t - 1.0) * np.eye(2))
    assert len(seen(cov=[[1.0, 0.5], [0.5, 1.0]]).mean) == 2


def test_any_matrix_is_a_diffusion():
    gv.Sde(lambda t, x: -x, diffusion=INDEFINITE, state=S)
    gv.Sde(lambda t, x: -x, diffusion=TILTED, state=S)

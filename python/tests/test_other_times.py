"""What a run says of all its measurements does not hang on the times that are asked for; what takes the place of what."""

import numpy as np
import pytest

import givens as gv

MODEL = gv.Transition(lambda t, dt, x: x, noise_cov=lambda t, dt: [[0.1 * dt]], state=["x"])
SENSOR = gv.Sensor(lambda t, x: x, measures=["z"], std=[1.0])
T, Z = np.arange(6.0), np.array([[0.3], [1.1], [0.2], [np.nan], [0.9], [1.4]])
RUN = {"prior": gv.Gaussian([0.0], std=[1.0])}


@pytest.mark.parametrize("run", [gv.filter, gv.smooth])
@pytest.mark.parametrize("at", [[2.5], [2.0], [], [0.5, 1.0, 7.0]])
def test_times_that_are_asked_for_change_neither_likelihood_nor_consistency(run, at):
    plain = run(MODEL, SENSOR, T, Z, **RUN)
    for there in (run(MODEL, SENSOR, T, Z, **RUN, at=at), plain.at(at)):
        assert len(there) == len(at)
        assert there.total_log_likelihood == pytest.approx(plain.total_log_likelihood, rel=1e-14)
        assert there.consistency() == plain.consistency()
    batch = run(MODEL, SENSOR, T, np.stack([Z, Z + 0.5]), **RUN)
    there = batch.at(at) if at else run(MODEL, SENSOR, T, np.stack([Z, Z + 0.5]), **RUN, at=at)
    np.testing.assert_allclose(there.total_log_likelihood, batch.total_log_likelihood, rtol=1e-14)
    assert there.consistency().ratio == pytest.approx(batch.consistency().ratio)


@pytest.mark.parametrize("point", [0.0, 3.0, 5.0])
def test_a_point_has_the_likelihood_of_all_rows(point):
    whole = gv.filter(MODEL, SENSOR, T, Z, **RUN)
    est = gv.smooth(MODEL, SENSOR, T, Z, **RUN, point=point)
    assert est.total_log_likelihood == pytest.approx(whole.total_log_likelihood, rel=1e-14)


@pytest.mark.parametrize("goal", [{"lag": 1}, {"point": 0.0}])
def test_a_lag_or_a_point_has_no_other_times(goal):
    for z in (Z, np.stack([Z, Z])):
        with pytest.raises(gv.InputError, match=f"`at` and `{next(iter(goal))}` at once"):
            gv.smooth(MODEL, SENSOR, T, z, **RUN, **goal, at=[2.0])
        with pytest.raises(gv.InputError, match=f"`at` and `{next(iter(goal))}` at once"):
            gv.smooth(MODEL, SENSOR, T, z, **RUN, **goal).at([2.0])


def test_the_rounding_of_products_of_matrices_leaves_a_covariance():
    rng = np.random.default_rng(3)
    for n in (4, 9):
        for _ in range(50):
            a, b = rng.normal(size=(2, n, n))
            p = a @ (b @ b.T) @ a.T + np.eye(n)
            assert gv.Gaussian(np.zeros(n), p).cov == pytest.approx(p)
            gv.Gaussian(np.zeros(n), np.linalg.inv(p + 10 * np.eye(n)))
    with pytest.raises(gv.InputError, match="not symmetric"):
        gv.Gaussian([0, 0], [[1, 0.5], [0.5 + 1e-10, 1]])


def test_a_table_takes_the_place_of_times_and_measurements():
    with pytest.raises(gv.InputError, match="`t` is a table, and `z` is given besides"):
        gv.filter(MODEL, SENSOR, {"time": [0.0, 1.0], "z": [1.0, 2.0]}, Z, **RUN)


@pytest.mark.parametrize(
    ("method", "options", "title"),
    [
        ("ckf", {}, "ckf"),
        ("ckf", {"form": "square-root"}, "ckf, form square-root"),
        ("sr-ckf", {"rule": "unscented", "form": "covariance"}, "sr-ckf, rule unscented, form covariance"),
    ],
)
def test_a_method_of_other_parts_says_which(method, options, title):
    est = gv.filter(MODEL, SENSOR, T, Z, **RUN, method=method, **options)
    assert est.method == title
    assert f"method={title}" in repr(est)
    assert gv.Filter(MODEL, SENSOR, **RUN, t0=0.0, method=method, **options).method == title

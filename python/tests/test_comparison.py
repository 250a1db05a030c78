"""Methods that fail are compared over the rows that all of them finished."""

import numpy as np
import pytest

import givens as gv

# the points of a cubature rule leave the domain of the logarithm where the noise grows; a tangent does not
MODEL = gv.Transition(lambda t, dt, x: x, noise_cov=lambda t, dt: [[np.where(t > 4.5, 100.0, 0.01)]], state=["x"])
SENSOR = gv.Sensor(lambda t, x: np.log(x), measures=["z"], std=[0.1], check_at=[3.0])
T = np.arange(10.0)
TRUTH = 3.0 + 0.1 * np.sin(T)[:, None]
PRIOR = gv.Gaussian([3.0], std=[0.1])


def compared(z, truth, methods=("ekf", "sr-ckf"), **options):
    return gv.compare(MODEL, SENSOR, T, z, prior=PRIOR, methods=methods, truth=truth, **options)


def rmse(est, truth, rows):
    return np.sqrt(np.mean((est.mean[:rows] - truth[:rows]) ** 2, axis=0))


def test_errors_are_taken_over_the_rows_that_all_methods_finished():
    table = compared(np.log(TRUTH), TRUTH)
    rows = table[1].rows
    assert (table[0].rows, len(table[1].failed)) == (10, 1) and 0 < rows < 10
    for one in table:
        assert one.scored == rows
        np.testing.assert_allclose(one.rmse, rmse(one.estimates, TRUTH, rows))
    assert [row["rows scored"] for row in table.rows()] == [rows, rows]
    assert "rows scored" in repr(table)
    alone = compared(np.log(TRUTH), TRUTH, ["ekf"])[0]
    assert alone.scored == 10 and alone.rmse != table[0].rmse


def test_rows_without_a_truth_do_not_count():
    truth = np.where(T[:, None] == 1, np.nan, TRUTH)
    assert [one.scored for one in compared(np.log(TRUTH), truth, ["ekf"])] == [9]


def test_of_a_batch_each_track_has_its_own_rows():
    wild = np.log(TRUTH)
    wild[2] = 1e200
    table = compared(np.stack([np.log(TRUTH), wild]), np.stack([TRUTH, TRUTH]))
    each = [np.array([len(one) for one in found.estimates]) for found in table]
    assert [one.scored for one in table] == [np.minimum(*each).sum()] * 2
    assert each[0].tolist() == [10, 2]


def test_a_method_that_finished_no_row_does_not_take_those_of_the_others():
    prior = gv.Gaussian([3.0], std=[10.0])
    table = gv.compare(MODEL, SENSOR, T, np.log(TRUTH), prior=prior, methods=["ekf", "sr-ckf"], truth=TRUTH)
    assert [(one.rows, one.scored) for one in table] == [(10, 10), (0, 0)]
    assert np.isnan(table[1].rmse).all() and np.isfinite(table[0].rmse).all()


def test_without_a_truth_nothing_is_scored():
    table = compared(np.log(TRUTH), None)
    assert [one.scored for one in table] == [0, 0] and "rows scored" not in table.rows()[0]
    with pytest.raises(gv.InputError, match="`truth` has shape"):
        compared(np.log(TRUTH), TRUTH[:3])

"""gate=0.9999: rows beyond are rows of NaN, marked in every kind of result."""

import pickle

import numpy as np
import pytest
from test_running import LENGTH, MODEL, PRIOR, T, Z

import givens as gv

# scipy 1.17.1, chi2.ppf(0.9999, 1)
QUANTILE = 15.136705226623606
ROWS = [4, 11]


def wrong():
    z = Z.copy()
    z[ROWS] += [[50.0], [-80.0]]
    return z


def missed():
    z = Z.copy()
    z[ROWS] = np.nan
    return z


def same(found, expected):
    for name in ("mean", "cov", "factor", "filtered_mean", "predicted_mean", "log_likelihood"):
        np.testing.assert_array_equal(getattr(found, name), getattr(expected, name), err_msg=name)


@pytest.mark.parametrize("method", ["sr-cd-ckf", "cd-ukf", "sr-cd-ekf", "lskf"])
@pytest.mark.parametrize("run", [gv.filter, gv.smooth])
def test_rows_beyond_are_rows_of_nan(run, method):
    found = run(MODEL, LENGTH, T, wrong(), prior=PRIOR, method=method, gate=0.9999)
    expected = run(MODEL, LENGTH, T, missed(), prior=PRIOR, method=method)
    same(found, expected)
    assert found.gated.dtype == bool and np.flatnonzero(found.gated).tolist() == ROWS
    assert (found.nis[ROWS] > QUANTILE).all() and (found.nis_dof[ROWS] == 1).all()
    assert not found.gated.flags.writeable and not expected.gated.any()
    assert found.consistency() == expected.consistency()
    assert found.total_log_likelihood == expected.total_log_likelihood
    assert "2 beyond the gate" in repr(found) and "2 rows beyond the gate" in found._repr_html_()
    assert "gate" not in repr(expected) and "gate" not in expected._repr_html_()


@pytest.mark.parametrize(("factor", "beyond"), [(1 - 1e-9, False), (1 + 1e-9, True)])
def test_the_gate_is_at_its_quantile(factor, beyond):
    est = gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR)
    z = Z.copy()
    z[4] = Z[4] - est.innovation[4] + np.sqrt(est.innovation_cov[4, 0] * QUANTILE * factor)
    assert gv.filter(MODEL, LENGTH, T, z, prior=PRIOR, gate=0.9999).gated[4] == beyond


def test_a_batch_a_filter_by_hand_and_a_pickle_have_it():
    est = gv.filter(MODEL, LENGTH, T, wrong(), prior=PRIOR, gate=0.9999)
    batch = gv.filter(MODEL, LENGTH, T, np.stack([Z, wrong(), missed()]), prior=PRIOR, gate=0.9999)
    np.testing.assert_array_equal(batch.gated, [np.zeros(len(T)), est.gated, np.zeros(len(T))])
    np.testing.assert_allclose(batch.mean[1], batch.mean[2], rtol=1e-12)
    f = gv.Filter(MODEL, LENGTH, prior=PRIOR, t0=T[0], gate=0.9999)
    for k, t in enumerate(T):
        f.predict(t)
        f.update(wrong()[k])
        f = pickle.loads(pickle.dumps(f))
        assert f.gated == est.gated[k] and f.nis == est.nis[k], k
        np.testing.assert_array_equal(f.state.mean, est.mean[k])
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(est)).gated, est.gated)


def test_tables_have_a_column_if_there_is_a_gate():
    est = gv.filter(MODEL, LENGTH, T, wrong(), prior=PRIOR, gate=0.9999)
    frame = pytest.importorskip("pandas") and est.to_pandas()
    assert list(frame.columns)[-2:] == ["log_likelihood", "gated"]
    assert np.flatnonzero(frame["gated"]).tolist() == ROWS
    polars = pytest.importorskip("polars") and est.to_polars()
    assert polars["gated"].sum() == 2
    data = pytest.importorskip("xarray") and est.to_xarray()
    np.testing.assert_array_equal(data["gated"], est.gated)
    np.testing.assert_array_equal(est.to_dict()["gated"], est.gated)
    assert "gated" not in gv.filter(MODEL, LENGTH, T, wrong(), prior=PRIOR).to_pandas()


def test_figures_show_what_was_left_out():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    est = gv.filter(MODEL, LENGTH, T, wrong(), prior=PRIOR, gate=0.9999)
    axes = est.plot().axes[-1]
    rings = [line for line in axes.lines if line.get_label() == "beyond the gate"]
    assert len(rings) == 1 and len(rings[0].get_xdata()) == 2
    pyplot.close("all")


@pytest.mark.parametrize("gate", [0, 1, -1, 1.5])
def test_what_is_no_probability_is_refused(gate):
    with pytest.raises(gv.MethodError) as caught:
        gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, gate=gate)
    assert f"gate = {gate}: must be a probability above 0 and below 1, such as 0.9999" in str(caught.value)
    for none in (np.nan, np.inf):
        with pytest.raises(gv.MethodError, match="gate = .*: must be a number"):
            gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, gate=none)

"""Runs: what data they take, what they give back."""

import copy
import datetime
import pickle

import numpy as np
import pytest

import givens as gv

PRIOR = gv.Gaussian([1.0, 0.0], std=[1.0, 1.0])
MODEL = gv.Sde(lambda t, x, *, k=1.0: [x[1], -k * x[0]], diffusion=[0.0, 0.1], state=["x", "v"])
LENGTH = gv.Sensor(lambda t, x: x[:1], measures=["length"], std=[0.1], name="ruler")
SPEED = gv.Sensor(lambda t, x: [x[1], x[0] + x[1]], measures=["speed", "both"], std=[0.2, 0.3], name="radar")
T = np.arange(1.0, 21.0) / 2
RNG = np.random.default_rng(1)
Z = np.cos(T)[:, None] + 0.1 * RNG.normal(size=(20, 1))
Z3 = np.column_stack([Z, -np.sin(T), np.cos(T) - np.sin(T)])


def run(sensors=LENGTH, t=T, z=Z, **options):
    return gv.filter(MODEL, sensors, t, z, **{"prior": PRIOR, "t0": t[0] if np.ndim(t) == 1 else None, **options})


def same(a, b):
    np.testing.assert_array_equal(a.mean, b.mean)
    np.testing.assert_array_equal(a.cov, b.cov)


def alike(a, b):
    """The same but for rounding: one of them ran in a pack beside others."""
    np.testing.assert_allclose(a.mean, b.mean, rtol=1e-11, atol=1e-12)
    np.testing.assert_allclose(a.cov, b.cov, rtol=1e-11, atol=1e-12)


def test_missing_is_nan_or_masked_whole_or_in_part():
    z = Z3.copy()
    z[3], z[5, 1] = np.nan, np.nan
    masked = np.ma.masked_invalid(z)
    plain = run([LENGTH, SPEED], z=z)
    same(plain, run([LENGTH, SPEED], z=masked))
    none = [[None if np.isnan(v) else v for v in row] for row in z.tolist()]
    same(plain, run([LENGTH, SPEED], z=none))
    assert plain.nis_dof.tolist()[3:6] == [0, 3, 2]
    assert np.isnan(plain.nis[3]) and plain.log_likelihood[3] == 0
    assert np.isnan(plain.innovation[5, 1]) and np.isfinite(plain.innovation[5, [0, 2]]).all()


def test_measurements_by_sensor():
    same(run([LENGTH, SPEED], z={"ruler": Z3[:, :1], "radar": Z3[:, 1:]}), run([LENGTH, SPEED], z=Z3))
    z = Z3.copy()
    z[:, 1:] = np.nan
    same(run([LENGTH, SPEED], z={"ruler": Z3[:, 0]}), run([LENGTH, SPEED], z=z))


def test_sensors_at_their_own_times_are_merged():
    t, z = gv.merge({"ruler": (T[::2], Z[::2]), "radar": (T[1::2], Z3[1::2, 1:])})
    np.testing.assert_array_equal(t, T)
    est = run([LENGTH, SPEED], t=t, z=z)
    assert est.nis_dof.tolist() == [1, 2] * 10


def test_dates_are_seconds_since_the_start():
    origin = np.datetime64("2024-02-29T12:00:00")
    dates = origin + np.round(T * 1000).astype("timedelta64[ms]")
    plain, dated = run(t0=0.0), run(t=dates, t0=origin)
    same(plain, dated)
    assert dated.time.dtype.kind == "M" and dated.time[0] == dates[0]
    np.testing.assert_array_equal(dated.seconds, T)
    same(plain.at([1.25, 3.0]), dated.at([origin + np.timedelta64(1250, "ms"), origin + np.timedelta64(3, "s")]))
    listed = [datetime.datetime(2024, 2, 29, 12) + datetime.timedelta(seconds=s) for s in T]
    same(plain, run(t=listed, t0=datetime.datetime(2024, 2, 29, 12)))
    aware = [d.replace(tzinfo=datetime.UTC) for d in listed]
    same(plain, run(t=aware, t0=aware[0] - datetime.timedelta(seconds=T[0])))


def test_estimates_between_the_rows_do_not_change_the_others():
    est = run(t0=0.0)
    asked = gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, t0=0.0, at=[0.0, 0.7, *T[-2:]])
    same(asked, est.at([0.0, 0.7, *T[-2:]]))
    np.testing.assert_array_equal(asked.mean[0], PRIOR.mean)
    np.testing.assert_array_equal(asked.mean[2:], est.mean[-2:])
    smoothed = gv.smooth(MODEL, LENGTH, T, Z, prior=PRIOR, t0=0.0)
    np.testing.assert_allclose(smoothed.at(T).mean, smoothed.mean, rtol=1e-9, atol=1e-12)


def test_noise_row_by_row_is_that_of_a_sensor_which_has_it():
    std = np.linspace(0.05, 0.4, 20)
    by_function = gv.Sensor(lambda t, x: x[:1], measures=["length"], std=lambda t: [np.interp(t, T, std)], name="ruler")
    expected = run(by_function)
    for noise in (std, std[:, None], {"ruler": std[:, None]}, {"ruler": (std**2)[:, None, None]}):
        np.testing.assert_allclose(run(noise=noise).mean, expected.mean, rtol=1e-12)
    z = Z.copy()
    z[4] = np.nan
    noise = std.copy()
    noise[4] = np.nan
    assert np.isfinite(run(z=z, noise=noise).mean).all()


def test_a_batch_is_its_runs():
    z = np.stack([Z, Z + 0.1, Z - 0.2])
    batch = run(z=z)
    assert len(batch) == 3 and batch.mean.shape == (3, 20, 2) and not batch.failed
    for k in range(3):
        alike(batch[k], run(z=z[k]))
    np.testing.assert_array_equal(run(z=z, threads=1).mean, batch.mean)
    assert batch[:2].mean.shape == (2, 20, 2)


def test_a_batch_may_be_ragged():
    batch = gv.filter(MODEL, LENGTH, [T, T[:7]], [Z, Z[:7]], prior=PRIOR)
    alike(batch[1], run(t=T[:7], z=Z[:7], t0=T[0]))
    with pytest.raises(gv.InputError, match="7 to 20 rows"):
        _ = batch.mean


def test_a_batch_has_its_own_priors_and_parameters():
    priors = [PRIOR, gv.Gaussian([0.0, 0.0], std=[2.0, 2.0])]
    batch = run(z=np.stack([Z, Z]), prior=priors, params={"k": [1.0, 1.5]})
    alike(batch[0], run())
    alike(batch[1], gv.filter(MODEL.with_params(k=1.5), LENGTH, T, Z, prior=priors[1], t0=T[0]))


def test_one_track_that_fails_leaves_the_others():
    model = gv.Sde(lambda t, x: [x[1], np.log(x[0])], diffusion=[0.0, 0.1], state=["x", "v"])
    sensor = gv.Sensor(lambda t, x: x[:1], measures=["length"], std=[1e-3])
    prior = gv.Gaussian([5.0, 0.0], std=[0.1, 0.1])
    z = np.stack([np.full((5, 1), 5.0), np.array([[5.0], [5.0], [-4.0], [5.0], [5.0]])])
    batch = gv.filter(model, sensor, np.arange(5) * 0.1, z, prior=prior)
    assert [one.failed is None for one in batch] == [True, False]
    (error,) = batch.failed
    assert error.track == 1 and len(batch[1]) == error.row and batch[1].failed is error
    assert np.isnan(batch.mean[1, error.row :]).all() and np.isfinite(batch.mean[0]).all()
    with pytest.raises(gv.StepError) as caught:
        gv.filter(model, sensor, np.arange(5) * 0.1, z[1], prior=prior)
    np.testing.assert_array_equal(caught.value.finished.mean, batch[1].mean)


def table(tracks=False):
    columns = {"time": T, "length": Z3[:, 0], "speed": Z3[:, 1], "both": Z3[:, 2], "note": np.arange(20)}
    if tracks:
        columns = {name: np.concatenate([values, values]) for name, values in columns.items()}
        columns["track_id"] = np.repeat(["a", "b"], 20)
    return columns


def frames():
    def pandas(columns):
        return pytest.importorskip("pandas").DataFrame(columns)

    def polars(columns):
        return pytest.importorskip("polars").DataFrame(columns)

    def pyarrow(columns):
        return pytest.importorskip("pyarrow").table(columns)

    return [dict, pandas, polars, pyarrow]


@pytest.mark.parametrize("frame", frames(), ids=["dict", "pandas", "polars", "pyarrow"])
def test_tables_are_read_by_their_columns(frame):
    expected = run([LENGTH, SPEED], z=Z3)
    same(expected, gv.filter(MODEL, [LENGTH, SPEED], frame(table()), prior=PRIOR))
    batch = gv.filter(MODEL, [LENGTH, SPEED], frame(table(tracks=True)), prior=PRIOR)
    assert batch.track_ids == ["a", "b"]
    alike(batch.track("b"), expected)


@pytest.mark.parametrize("frame", frames(), ids=["dict", "pandas", "polars", "pyarrow"])
def test_null_is_missing_and_a_sensor_column_chooses(frame):
    columns = table()
    columns["length"] = [None if k == 3 else v for k, v in enumerate(columns["length"])]
    columns["length"] = np.array(columns["length"], dtype=float) if frame is dict else columns["length"]
    columns["sensor"] = ["ruler" if k % 2 else "radar" for k in range(20)]
    est = gv.filter(MODEL, [LENGTH, SPEED], frame(columns), prior=PRIOR)
    assert est.nis_dof.tolist() == [2, 1, 2, 0] + [2, 1] * 8


def test_a_smoother_with_a_lag_and_one_of_a_point():
    whole = gv.smooth(MODEL, LENGTH, T, Z, prior=PRIOR, t0=0.0)
    np.testing.assert_allclose(gv.smooth(MODEL, LENGTH, T, Z, prior=PRIOR, t0=0.0, lag=19).mean, whole.mean, rtol=1e-9)
    np.testing.assert_array_equal(gv.smooth(MODEL, LENGTH, T, Z, prior=PRIOR, t0=0.0, lag=0).mean, whole.filtered_mean)
    point = gv.smooth(MODEL, LENGTH, T, Z, prior=PRIOR, t0=0.0, point=T[4])
    assert len(point) == 16
    np.testing.assert_allclose(point.mean[-1], whole.mean[4], rtol=1e-8)


def test_a_filter_by_hand_is_the_filter():
    est = run([LENGTH, SPEED], z=Z3, t0=0.0)
    f = gv.Filter(MODEL, [LENGTH, SPEED], prior=PRIOR, t0=0.0)
    for k, t in enumerate(T):
        f.predict(t)
        f.update(Z3[k] if k % 2 else {"ruler": Z3[k, :1], "radar": Z3[k, 1:]})
        np.testing.assert_array_equal(f.state.mean, est.mean[k])
        np.testing.assert_array_equal(f.state.cov, est.cov[k])
        np.testing.assert_array_equal(f.innovation, est.innovation[k])
        assert (f.time, f.nis, f.nis_dof, f.log_likelihood) == (t, est.nis[k], 3, est.log_likelihood[k])


def test_one_sensor_at_a_time():
    f = gv.Filter(MODEL, [LENGTH, SPEED], prior=PRIOR, t0=0.0)
    f.predict(0.5)
    f.update([0.9], "ruler")
    assert f.nis_dof == 1
    f.update([0.1, 0.9], sensor="radar")
    assert f.nis_dof == 2


@pytest.mark.parametrize(
    "twin", [copy.copy, copy.deepcopy, lambda f: f.copy(), lambda f: pickle.loads(pickle.dumps(f))]
)
def test_a_copy_of_a_filter_goes_on_to_the_bit(twin):
    f = gv.Filter(MODEL, LENGTH, prior=PRIOR, t0=0.0, method="lskf")
    for k in range(5):
        f.predict(T[k])
        f.update(Z[k])
    other = twin(f)
    for k in range(5, 20):
        for one in (f, other):
            one.predict(T[k])
            one.update(Z[k])
    np.testing.assert_array_equal(f.state.mean, other.state.mean)
    np.testing.assert_array_equal(f.state.factor, other.state.factor)


def test_simulations_are_repeated_by_their_seed():
    one = gv.simulate(MODEL, LENGTH, T, prior=PRIOR, seed=5, t0=0.0)
    assert one.x.shape == (20, 2) and one.z.shape == (20, 1)
    many = gv.simulate(MODEL, LENGTH, T, prior=PRIOR, seed=5, t0=0.0, runs=50, threads=2)
    np.testing.assert_array_equal(many.x[0], one.x)
    np.testing.assert_array_equal(gv.simulate(MODEL, LENGTH, T, prior=PRIOR, seed=5, t0=0.0, runs=50).z, many.z)
    batch = gv.filter(MODEL, LENGTH, T, many.z, prior=PRIOR, t0=0.0)
    assert batch.consistency().verdict == "consistent"


def test_methods_are_compared():
    data = gv.simulate(MODEL, LENGTH, T, prior=PRIOR, seed=5, t0=0.0)
    table = gv.compare(
        MODEL,
        LENGTH,
        data.t,
        data.z,
        prior=PRIOR,
        t0=0.0,
        methods=["cd-ekf", "sr-cd-ckf"],
        truth=data.x,
        options={"sr-cd-ckf": {"substeps": 4}},
    )
    assert [one.method for one in table] == ["cd-ekf", "sr-cd-ckf"]
    assert all(one.rmse.shape == (2,) and one.nees > 0 and one.seconds_per_row > 0 for one in table)
    header, first, second = repr(table).splitlines()
    assert header.split()[:4] == ["method", "rows", "failed", "log-likelihood"]
    assert table._repr_html_().startswith("<table>")
    frame = pytest.importorskip("pandas") and table.to_pandas()
    assert frame.loc["cd-ekf", "rows"] == 20


def test_the_registry_is_listed():
    methods = gv.methods()
    assert {"ekf", "sr-ckf", "sr-cd-ckf", "lskf"} <= {method.name for method in methods}
    assert all(method.kind == "discrete" for method in gv.methods("discrete"))
    assert all(method.sources for method in methods)


def test_estimates_are_frozen_and_named():
    est = run()
    assert est.to_dict()["mean"] is est.mean
    with pytest.raises(AttributeError, match="cannot be changed"):
        est.mean = 1
    with pytest.raises(ValueError, match="read-only"):
        est.mean[0] = 1
    np.testing.assert_allclose(est.factor @ est.factor.swapaxes(1, 2), est.cov, rtol=1e-12)
    assert "20 rows" in repr(est) and est._repr_html_().count("<tr>") == 14


def test_samples_have_the_moments_of_the_estimates():
    est = run()
    drawn = est.sample(40_000, seed=1)
    assert drawn.shape == (40_000, 20, 2)
    np.testing.assert_allclose(drawn.mean(0), est.mean, atol=5 * est.std.max() / 200)
    np.testing.assert_allclose(np.cov(drawn[:, 7].T), est.cov[7], rtol=0.05)
    np.testing.assert_array_equal(drawn[:3], est.sample(40_000, seed=1)[:3])


def test_trajectories_of_a_smoother_obey_dynamics_without_noise():
    model = gv.Transition(lambda t, dt, x: [x[0] + dt * x[1], x[1]], noise_cov=np.zeros((2, 2)), state=["x", "v"])
    sensor = gv.Sensor(lambda t, x: x[:1], measures=["x"], std=[0.1])
    est = gv.smooth(model, sensor, T, Z, prior=gv.Gaussian([0, 0], std=[1, 1]))
    drawn = est.sample(50, seed=7)
    steps = np.diff(est.seconds)
    np.testing.assert_allclose(np.diff(drawn[..., 0]), drawn[:, :-1, 1] * steps, atol=1e-9)
    np.testing.assert_allclose(drawn[:, :1, 1] + 0 * drawn[..., 1], drawn[..., 1], atol=1e-9)
    np.testing.assert_array_equal(drawn[:3], est.sample(3, seed=7))
    assert abs(drawn[:, 0, 1].std() / est.std[0, 1] - 1) < 0.4


def test_estimates_become_tables():
    est = run()
    frame = pytest.importorskip("pandas") and est.to_pandas()
    assert list(frame.columns) == ["x", "v", "x_std", "v_std", "nis", "nis_dof", "log_likelihood"]
    assert frame.index.name == "time"
    polars = pytest.importorskip("polars") and est.to_polars()
    assert polars.columns == ["time", *frame.columns]
    data = pytest.importorskip("xarray") and est.to_xarray()
    assert dict(data.sizes) == {"time": 20, "state": 2, "state2": 2, "measure": 1, "measure2": 1}
    batch = run(z=np.stack([Z, Z]))
    assert batch.to_pandas().shape == (40, 7) and batch.to_polars().shape == (40, 9)


def test_a_library_that_is_missing_is_named_with_its_extra(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "polars", None)
    with pytest.raises(ImportError) as caught:
        run().to_polars()
    assert str(caught.value) == "polars is not installed: pip install givens[polars]"


def test_figures_are_drawn():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    figure = gv.smooth(MODEL, LENGTH, T, Z, prior=PRIOR).plot(plane=("x", "v"), truth=np.zeros((20, 2)))
    assert len(figure.axes) == 4
    matplotlib.pyplot.close(figure)


def test_consistency_has_words():
    data = gv.simulate(MODEL, LENGTH, np.arange(400) / 4, prior=PRIOR, seed=3, t0=0.0)
    good = gv.filter(MODEL, LENGTH, data.t, data.z, prior=PRIOR, t0=0.0).consistency()
    assert good.verdict == "consistent" and good.is_white
    bold = gv.Sensor(lambda t, x: x[:1], measures=["length"], std=[0.01])
    assert gv.filter(MODEL, bold, data.t, data.z, prior=PRIOR, t0=0.0).consistency().verdict == "overconfident"
    slow = MODEL.with_params(k=0.5)
    poor = gv.filter(slow, LENGTH, data.t, data.z, prior=PRIOR, t0=0.0).consistency()
    assert not poor.is_white and "the model may miss something" in str(poor)


def test_estimates_and_what_holds_them_travel():
    est = run()
    twin = pickle.loads(pickle.dumps(est))
    same(twin, est)
    with pytest.raises(gv.InputError, match="come from a pickle"):
        twin.at([1.0])
    batch = pickle.loads(pickle.dumps(run(z=np.stack([Z, Z]))))
    assert batch.mean.shape == (2, 20, 2)


def test_controls_hold_from_their_row_on_and_may_have_a_default():
    def pushed(t, x, u=None):
        return [x[1], u[0] if u is not None else 0.0]

    model = gv.Sde(pushed, diffusion=[0.0, 1e-6], state=["x", "v"], controls=["force"])
    u = np.where(T < 5, 1.0, -2.0)
    est = gv.filter(model, LENGTH, T, np.full_like(Z, np.nan), prior=PRIOR, t0=0.0, u=u)
    # the first one also holds before its row
    v = np.concatenate([[u[0] * T[0]], u[0] * T[0] + np.cumsum(u[:-1] * np.diff(T))])
    np.testing.assert_allclose(est.mean[:, 1], v, atol=1e-9)
    free = gv.Sde(pushed, diffusion=[0.0, 1e-6], state=["x", "v"])
    assert np.allclose(gv.filter(free, LENGTH, T, np.full_like(Z, np.nan), prior=PRIOR, t0=0.0).mean[:, 1], 0)



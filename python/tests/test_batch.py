"""What a batch gives of all its tracks at once."""

import copy
import pickle

import numpy as np
import pytest
from test_running import LENGTH, MODEL, PRIOR, SPEED, Z3, T, Z, run, same

import givens as gv

THREE = np.stack([Z, Z + 0.1, Z - 0.2])
DATES = np.datetime64("2024-02-29T12:00", "ms") + np.round(T * 1000).astype("timedelta64[ms]")
ARRAYS = [
    *("time", "mean", "cov", "factor", "std", "filtered_mean", "filtered_cov", "predicted_mean", "predicted_cov"),
    *("innovation", "innovation_cov", "nis", "nis_dof", "log_likelihood", "gated"),
]


def smoothed(z=THREE, t=T, **options):
    return gv.smooth(MODEL, LENGTH, t, z, **{"prior": PRIOR, **options})


def one_that_fails(**options):
    model = gv.Sde(lambda t, x: [x[1], np.log(x[0])], diffusion=[0.0, 0.1], state=["x", "v"])
    sensor = gv.Sensor(lambda t, x: x[:1], measures=["length"], std=[1e-3])
    z = np.stack([np.full((5, 1), 5.0), np.array([[5.0], [5.0], [-4.0], [5.0], [5.0]])])
    t = DATES[:5] if options.pop("dates", False) else np.arange(5) * 0.1
    return gv.filter(model, sensor, t, z, prior=gv.Gaussian([5.0, 0.0], std=[0.1, 0.1]), **options)


@pytest.mark.parametrize("name", ARRAYS)
def test_the_arrays_of_a_batch_are_those_of_its_tracks(name):
    batch = smoothed(t=DATES)
    found = getattr(batch, name)
    assert not found.flags.writeable
    np.testing.assert_array_equal(found, [getattr(one, name) for one in batch])
    assert found.dtype == getattr(batch[0], name).dtype
    np.testing.assert_array_equal(batch.to_dict()[name], found)


def test_to_dict_has_what_that_of_a_track_has():
    batch = smoothed()
    assert list(batch.to_dict()) == list(batch[0].to_dict()) == sorted(ARRAYS, key=list(batch.to_dict()).index)
    assert batch.state == ("x", "v") and batch.measures == ("length",)
    assert gv.Batch([]).to_dict() == {} and gv.Batch([]).mean.size == 0 and gv.Batch([]).state == ()


def test_behind_a_failure_arrays_are_empty():
    batch = one_that_fails(dates=True)
    row = batch.failed[0].row
    assert np.isnat(batch.time[1, row:]).all() and not np.isnat(batch.time[0]).any()
    assert np.isnan(batch.innovation_cov[1, row:]).all()
    assert (batch.nis_dof[1, row:] == 0).all() and (batch.nis_dof[0] == 1).all()


@pytest.mark.filterwarnings("ignore::givens.DoubtWarning")
def test_a_batch_at_other_times_is_its_tracks_at_them():
    batch = smoothed(t0=0.0)
    there = batch.at([0.7, 2.0, 30.0], threads=2)
    assert there.mean.shape == (3, 3, 2)
    for one, whole in zip(there, batch, strict=True):
        same(one, whole.at([0.7, 2.0, 30.0]))
    dated = smoothed(t=DATES).at(DATES[3:5])
    np.testing.assert_array_equal(dated.time, [DATES[3:5]] * 3)


def test_ragged_tracks_at_the_same_times_are_one_array():
    ragged = gv.filter(MODEL, LENGTH, [T, T[:7]], [Z, Z[:7]], prior=PRIOR)
    assert ragged.at([5.0, 6.0]).mean.shape == (2, 2, 2)
    days = np.datetime64("2020-01-01") + np.arange(4)
    late = gv.smooth(MODEL, LENGTH, [days[:2], days[1:]], [Z[:2], Z[1:4]], prior=PRIOR, point=days[1])
    with pytest.raises(gv.InputError, match="the tracks have 1 to 3 rows: `mean` cannot be one array"):
        _ = late.mean


def test_at_other_times_a_track_may_fail_and_the_others_go_on():
    there = one_that_fails().at([0.05, 0.1, 0.4])
    assert len(there[0]) == 3 and len(there[1]) == 2
    assert [error.track for error in there.failed] == [1]
    assert np.isnan(there.mean[1, 2]).all()


def test_a_part_of_a_batch_keeps_the_names_of_its_tracks():
    batch = one_that_fails()
    assert batch[1:].track_ids == [1] == [error.track for error in batch[1:].failed]
    assert batch[1:].at([0.05]).track_ids == [1]
    assert batch[1:].track(1) is batch[1]


def test_samples_of_a_batch_are_those_of_its_tracks_and_differ():
    batch = gv.smooth(MODEL, LENGTH, T, np.stack([Z, Z]), prior=PRIOR)
    drawn = batch.sample(5, seed=3)
    assert drawn.shape == (2, 5, 20, 2)
    np.testing.assert_array_equal(drawn[0], batch[0].sample(5, seed=3))
    assert (drawn[0] != drawn[1]).all()
    np.testing.assert_array_equal(batch.sample(2, seed=3), drawn[:, :2])
    filtered = run(z=np.stack([Z, Z])).sample(5, seed=3)
    assert (filtered[0] != filtered[1]).all()


def test_samples_of_tracks_of_unequal_lengths_are_a_list():
    for how in (gv.filter, gv.smooth):
        ragged = how(MODEL, LENGTH, [T, T[:7]], [Z, Z[:7]], prior=PRIOR)
        drawn = ragged.sample(2, seed=1)
        assert [one.shape for one in drawn] == [(2, 20, 2), (2, 7, 2)]
        np.testing.assert_array_equal(drawn[0], ragged[0].sample(2, seed=1))


def test_samples_behind_a_failure_are_nan():
    batch = one_that_fails()
    drawn = batch.sample(4, seed=0)
    row = batch.failed[0].row
    assert np.isnan(drawn[1, :, row:]).all() and np.isfinite(drawn[1, :, :row]).all() and np.isfinite(drawn[0]).all()


@pytest.mark.parametrize("twin", [copy.copy, copy.deepcopy])
def test_copies_of_results_can_run_again(twin):
    batch = one_that_fails()
    other = twin(batch)
    assert other.failed == batch.failed and other.failed is not batch.failed
    same(other.at([0.05])[0], batch[0].at([0.05]))
    assert twin(batch[0]) is batch[0]


def test_a_batch_that_comes_from_a_pickle_has_all_numbers_and_cannot_run_again():
    batch = gv.smooth(
        MODEL,
        [LENGTH, SPEED],
        {"time": np.tile(T, 2), **dict(zip(["length", "speed", "both"], np.tile(Z3.T, 2), strict=True))}
        | {"track_id": np.repeat(["a", "b"], 20)},
        prior=PRIOR,
    )
    other = pickle.loads(pickle.dumps(batch))
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(other, name), getattr(batch, name))
    assert other.track_ids == ["a", "b"] and other.state == batch.state
    with pytest.raises(gv.InputError, match="come from a pickle and cannot run again"):
        other.at([1.0])
    with pytest.raises(gv.InputError, match="come from a pickle and cannot draw trajectories"):
        other.sample(1, seed=1)
    failed = pickle.loads(pickle.dumps(one_that_fails()))
    assert failed.failed[0] is failed[1].failed


def test_a_batch_is_a_data_set():
    pytest.importorskip("xarray")
    batch = smoothed(t=DATES)
    data = batch.to_xarray()
    assert dict(data.sizes) == {"track": 3, "time": 20, "state": 2, "state2": 2, "measure": 1, "measure2": 1}
    np.testing.assert_array_equal(data["mean"].sel(track=1, state="v"), batch[1].mean[:, 1])
    assert set(data.data_vars) == {"rows", *batch[0].to_xarray().data_vars}
    assert data["rows"].dims == ("track",) and data["rows"].values.tolist() == [20, 20, 20]
    shifted = gv.filter(MODEL, LENGTH, [T, T + 0.1], [Z, Z], prior=PRIOR).to_xarray()
    assert shifted["time"].dims == ("track", "row") and shifted["nis"].dims == ("track", "row")
    failed = one_that_fails().to_xarray()
    assert failed.sizes["time"] == 5 and np.isnan(failed["mean"][1, -1]).all()


@pytest.mark.parametrize("times", [T, DATES])
def test_a_data_set_of_tracks_of_unequal_lengths_says_how_many_rows_each_has(times):
    pytest.importorskip("xarray")
    ragged = gv.filter(MODEL, LENGTH, [times[1:], times[:7]], [Z[1:], Z[:7]], prior=PRIOR)
    data = ragged.to_xarray()
    assert data["rows"].values.tolist() == [19, 7] and data["mean"].dims == ("track", "row", "state")
    for k, one in enumerate(ragged):
        rows = int(data["rows"][k])
        np.testing.assert_array_equal(data["cov"][k, :rows], one.cov)
        np.testing.assert_array_equal(data["time"][k, :rows], one.time)
        assert np.isnan(data["nis"][k, rows:]).all() and (data["nis_dof"][k, rows:] == 0).all()
        assert data["time"][k, rows:].isnull().all()
    shared = gv.filter(MODEL, LENGTH, [times, times[:7]], [Z, Z[:7]], prior=PRIOR).to_xarray()
    assert shared["mean"].dims == ("track", "time", "state") and shared["rows"].values.tolist() == [20, 7]
    assert np.isnan(shared["mean"][1, 7:]).all()


def test_tables_of_many_tracks_name_each_row():
    pandas = pytest.importorskip("pandas")
    batch = one_that_fails()
    frame = batch.to_pandas()
    expected = pandas.concat({k: one.to_pandas() for k, one in enumerate(batch)}, names=["track_id"])
    pandas.testing.assert_frame_equal(frame, expected)


def test_a_notebook_shows_each_track_of_a_batch():
    shown = one_that_fails()._repr_html_()
    assert shown.count("<tr>") == 3 and "failed at row" in shown and "2 tracks" in shown
    many = smoothed(z=np.stack([Z] * 20))._repr_html_()
    assert many.count("<tr>") == 14 and "20 tracks, 400 rows, 0 failed" in many
    named = gv.filter(MODEL, LENGTH, {"time": T, "length": Z[:, 0], "track_id": ["<b>"] * 20}, prior=PRIOR)
    assert "&lt;b&gt;" in named._repr_html_()


def test_a_batch_is_drawn():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    figure = smoothed(z=np.stack([Z] * 60), t=DATES).plot(plane=("x", "v"), truth=np.zeros((60, 20, 2)))
    assert len(figure.axes) == 4 and len(figure.axes[0].lines) == 2 * 50
    assert "means of 50 of 60 tracks" in figure.axes[0].get_title(loc="left")
    matplotlib.pyplot.close(figure)
    ragged = gv.filter(MODEL, LENGTH, [T, T[:7]], [Z, Z[:7]], prior=PRIOR)
    matplotlib.pyplot.close(ragged.plot(truth=[np.zeros((20, 2)), np.zeros((7, 2))]))
    matplotlib.pyplot.close(one_that_fails().plot(truth=np.zeros((2, 5, 2))))


DRAWN = {
    "turned": (
        lambda: run().plot(truth=np.zeros((2, 20))),
        "`truth` has shape (2, 20), not (20, 2)\n  help: rows are times: truth=truth.T",
    ),
    "short": (
        lambda: run().plot(truth=np.zeros((7, 2))),
        "`truth` has shape (7, 2), not (20, 2)\n"
        "  help: one row for each row of the estimates, one column for each of x, v",
    ),
    "words": (
        lambda: run().plot(truth="truth"),
        "`truth` is not an array of real numbers: it holds text\n"
        "  help: give a list of numbers, or a NumPy array of floats",
    ),
    "one of several": (
        lambda: smoothed().plot(truth=[np.zeros((20, 2)), np.zeros((20, 2)), np.zeros((20, 3))]),
        "`truth[2]` has shape (20, 3), not (20, 2)\n"
        "  help: one row for each row of the estimates, one column for each of x, v",
    ),
    "of other tracks": (
        lambda: smoothed().plot(truth=np.zeros((2, 20, 2))),
        "`truth` is of 2 tracks, not 3\n  help: give one for each: a list, or an array of shape (3, rows, 2)",
    ),
    "no plane": (lambda: run().plot(plane="xv"), "`plane` is 'xv', not two states\n  help: name two of x, v"),
    "unknown state": (
        lambda: smoothed().plot(plane=("x", "w")),
        "`plane` names `w`, which is no state\n  help: there are `x`, `v`",
    ),
    "no tracks": (lambda: gv.Batch([]).plot(), "there are no tracks to draw\n  help: draw a batch that has some"),
}


@pytest.mark.parametrize("case", DRAWN.values(), ids=DRAWN)
def test_what_cannot_be_drawn_is_told_with_its_remedy(case):
    pytest.importorskip("matplotlib").use("Agg")
    call, expected = case
    with pytest.raises(gv.InputError) as caught:
        call()
    assert str(caught.value) == expected


def test_the_truth_of_a_run_that_failed_may_have_all_its_rows():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    failed = one_that_fails()[1]
    for rows in (5, len(failed)):
        matplotlib.pyplot.close(failed.plot(truth=np.zeros((rows, 2))))
    matplotlib.pyplot.close(run().plot(truth=pytest.importorskip("pandas").DataFrame({"v": T, "x": T})))


def test_a_track_that_fails_has_answered_the_times_before():
    z = np.array([[0.0], [0.0], [1e200], [0.0]])
    model = gv.Transition(lambda t, dt, x: x, noise_cov=lambda t, dt: [[0.1 * dt]], state=["x"])
    sensor, prior = gv.Sensor(lambda t, x: x, measures=["z"], std=[1.0]), gv.Gaussian([0.0], std=[10.0])
    for how, answered in ((gv.filter, [0.5, 1.0, 1.5]), (gv.smooth, [0.5, 1.0])):
        batch = how(model, sensor, np.arange(4.0), [z, np.zeros((4, 1))], prior=prior, at=[0.5, 1.0, 1.5, 2.5])
        assert [len(one) for one in batch] == [len(answered), 4]
        assert batch[0].time.tolist() == answered and batch[0].failed.row == 2
        np.testing.assert_allclose(batch[0].mean, batch[1].mean[: len(answered)], atol=1e-12)
        assert np.isnan(batch.mean[0, len(answered) :]).all()

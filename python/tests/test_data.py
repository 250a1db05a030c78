"""Data of every make: masks, durations, dates, frames, and one number for each name."""

import datetime
import pickle
import warnings

import numpy as np
import pytest
from test_running import LENGTH, MODEL, PRIOR, RNG, SPEED, Z3, T, Z, alike, frames, run, same

import givens as gv

WALK = gv.Transition(lambda t, dt, x: x, noise_cov=np.eye(2) * 0.01, state=["a", "b"])
BOTH = gv.Sensor(lambda t, x: x, measures=["p", "q"], std=[1.0, 1.0], name="both")
PUSHED = gv.Transition(
    lambda t, dt, x, u: [x[0] + u[0], x[1] + u[1]], noise_cov=np.eye(2) * 0.01, state=["a", "b"], controls=["e", "f"]
)
SCALED = gv.Transition(lambda t, dt, x, *, w=np.array([1.0, 2.0]): x * w, noise_cov=np.eye(2) * 0.01, state=["a", "b"])
WIDE = gv.Gaussian([1.0, 1.0], std=[1.0, 1.0])
DAYS = np.array(["2020-01-01", "2020-01-02", "2020-01-04"], dtype="datetime64[D]")
Z2 = np.column_stack([np.linspace(1, 2, 3), np.linspace(100, 200, 3)])
EAST = datetime.timezone(datetime.timedelta(hours=5))


def walk(t=(0, 1, 2), z=Z2, **options):
    return gv.filter(WALK, BOTH, t, z, **{"prior": WIDE, **options})


def hidden(array, at):
    """The array with a wild number under a mask."""
    wild = np.array(array)
    wild[at] = 1e6
    mask = np.zeros(wild.shape, dtype=bool)
    mask[at] = True
    return np.ma.masked_array(wild, mask)


def test_a_mask_hides_wherever_it_stands():
    stacked = np.stack([Z, Z + 0.1])
    missing = stacked.copy()
    missing[0, 3] = np.nan
    masked = hidden(stacked, (0, 3))
    expected = run(z=missing)
    for given in (masked, list(masked), {"ruler": masked}, [{"ruler": one} for one in masked]):
        np.testing.assert_array_equal(run(z=given).mean, expected.mean)
    alike(run(z=list(masked[0])), expected[0])
    alike(run(z=[[row[0]] for row in masked[0]]), expected[0])
    u = hidden(np.zeros((3, 2)), (1, 0))
    with pytest.raises(gv.InputError, match="`u` of `e` is nan in row 1"):
        gv.filter(PUSHED, BOTH, [0, 1, 2], Z2, prior=WIDE, u=u)
    with pytest.raises(gv.InputError, match="is nan in row 1"):
        walk(noise=hidden(np.ones((3, 2)), (1, 1)))


@pytest.mark.parametrize("kind", [float, int])
def test_a_mask_hides_in_the_columns_of_a_table(kind):
    expected = walk(z=[[1, 2], [np.nan, 2], [3, 2]])
    columns = {"time": np.arange(3.0), "p": hidden(np.array([1, 2, 3], dtype=kind), 1), "q": np.full(3, 2)}
    same(gv.filter(WALK, BOTH, columns, prior=WIDE), expected)


def test_durations_are_seconds_whatever_their_unit():
    expected = walk(t=[0, 1.5, 2.5])
    ms = np.array([0, 1500, 2500])
    listed = [datetime.timedelta(milliseconds=int(k)) for k in ms]
    pandas, polars = pytest.importorskip("pandas"), pytest.importorskip("polars")
    column = pandas.Series(pandas.to_timedelta(ms, unit="ms"))
    for t in (ms.astype("timedelta64[ms]"), listed, column, polars.Series(listed), list(column)):
        found = walk(t=t)
        same(found, expected)
        assert found.seconds.tolist() == [0, 1.5, 2.5]
    for frame in frames():
        same(gv.filter(WALK, BOTH, frame({"time": column, "p": Z2[:, 0], "q": Z2[:, 1]}), prior=WIDE), expected)
    same(expected.at([0.5]), expected.at([np.timedelta64(500, "ms")]))
    f = gv.Filter(WALK, BOTH, prior=WIDE, t0=datetime.timedelta(0))
    f.predict(np.timedelta64(500, "ms"))
    assert f.time == 0.5


def test_dates_come_back_as_they_were_given():
    ns = np.array(["2020-01-01", "2023-01-01T00:00:00.123456789", "2024-01-01T00:00:00.123456789"], "datetime64[ns]")
    for given in (ns, DAYS, DAYS.astype("datetime64[ms]")):
        for found in (walk(t=given), gv.smooth(WALK, BOTH, given, Z2, prior=WIDE)):
            assert found.time.dtype == given.dtype and not found.time.flags.writeable
            np.testing.assert_array_equal(found.time, given)
        point = gv.smooth(WALK, BOTH, given, Z2, prior=WIDE, point=given[1])
        np.testing.assert_array_equal(point.time, given[1:])
        np.testing.assert_array_equal(walk(t=given, at=given[1:]).time, given[1:])
        np.testing.assert_array_equal(walk(t=given).at(given[2]).time, given[2:])
        np.testing.assert_array_equal(gv.simulate(WALK, BOTH, given, prior=WIDE, seed=1).t, given)
    days = [datetime.date(2020, 1, day) for day in (1, 2, 4)]
    assert walk(t=days).time.tolist() == days


def test_dates_with_a_zone_come_back_in_utc_to_the_nanosecond():
    pandas = pytest.importorskip("pandas")
    plain = pandas.to_datetime([0, 123_456_789, 10**9 + 1])
    zoned = plain.tz_localize("UTC").tz_convert("Europe/Berlin")
    for given in (zoned, pandas.Series(zoned), list(zoned)):
        found = walk(t=given)
        np.testing.assert_array_equal(found.time, plain.to_numpy())
        frame = found.to_pandas()
        assert (frame.index == zoned).all() and str(frame.index.tz) == "UTC"
        same(found.at(frame.index), found)
    polars = pytest.importorskip("polars")
    assert walk(t=zoned).to_polars()["time"].dtype.time_zone == "UTC"
    table = polars.DataFrame({"time": zoned.to_list(), "p": Z2[:, 0], "q": Z2[:, 1], "track_id": [1, 1, 1]})
    (one,) = gv.filter(WALK, BOTH, table, prior=WIDE, t0=zoned[0])
    np.testing.assert_array_equal(one.time, plain.to_numpy().astype("datetime64[us]"))


def test_a_point_is_the_same_date_for_tracks_that_begin_on_different_ones():
    times, z = [DAYS[:2], DAYS[1:]], [Z2[:2], Z2[1:]]
    batch = gv.smooth(WALK, BOTH, times, z, prior=WIDE, point=DAYS[1])
    for k in range(2):
        alone = gv.smooth(WALK, BOTH, times[k], z[k], prior=WIDE, point=DAYS[1])
        alike(batch[k], alone)
        assert batch[k].time[0] == DAYS[1]


@pytest.mark.parametrize("frame", frames()[1:], ids=["pandas", "polars", "pyarrow"])
def test_frames_are_read_by_the_names_of_their_columns(frame):
    swapped = frame({"q": Z2[:, 1], "p": Z2[:, 0]})
    same(walk(z=swapped), walk())
    same(walk(z={"both": swapped}), walk())
    alike(walk(z=[swapped, swapped])[1], walk())
    noise = np.column_stack([np.full(3, 0.5), np.full(3, 5.0)])
    same(walk(noise=frame({"q": noise[:, 1], "p": noise[:, 0]})), walk(noise=noise))
    u = np.column_stack([np.full(3, 0.1), np.full(3, 100.0)])
    expected = gv.filter(PUSHED, BOTH, [0, 1, 2], Z2, prior=WIDE, u=u)
    for names in (["f", "e"], ["u_f", "u_e"]):
        given = frame({names[0]: u[:, 1], names[1]: u[:, 0]})
        same(gv.filter(PUSHED, BOTH, [0, 1, 2], Z2, prior=WIDE, u=given), expected)


def test_a_frame_of_pandas_may_have_its_times_beside_its_columns():
    pandas = pytest.importorskip("pandas")
    columns = {"p": Z2[:, 0], "q": Z2[:, 1]}
    dated = gv.filter(WALK, BOTH, pandas.DataFrame(columns, index=pandas.DatetimeIndex(DAYS)), prior=WIDE)
    same(dated, walk(t=DAYS))
    named = pandas.DataFrame(columns, index=pandas.Index([0.0, 1.0, 2.0], name="time"))
    same(gv.filter(WALK, BOTH, named, prior=WIDE), walk())
    index = pandas.MultiIndex.from_arrays([["k"] * 3, [0.0, 1.0, 2.0]], names=["track_id", "time"])
    alike(gv.filter(WALK, BOTH, pandas.DataFrame(columns, index=index), prior=WIDE).track("k"), walk())
    same(walk(z=pandas.DataFrame(Z2)), walk())


def test_parameters_that_are_arrays_are_set_for_all_or_for_each():
    def scaled(z, w):
        return gv.filter(SCALED, BOTH, [0, 1, 2], z, prior=WIDE, params={"w": w})

    expected = gv.filter(SCALED.with_params(w=[1.0, 1.5]), BOTH, [0, 1, 2], Z2, prior=WIDE)
    same(scaled(Z2, [1.0, 1.5]), expected)
    alike(scaled(np.stack([Z2, Z2]), [1.0, 1.5])[1], expected)
    alike(scaled(np.stack([Z2, Z2]), np.array([[1.0, 1.0], [1.0, 1.5]]))[1], expected)


def test_noise_of_as_many_rows_as_runs_is_the_same_for_all():
    std = np.array([[0.1], [0.2], [0.3]])
    z = RNG.normal(size=(3, 3, 1))
    for noise in (std, np.stack([std] * 3), [std] * 3, {"ruler": std}):
        batch = run(t=[0, 1, 2], z=z, t0=0.0, noise=noise)
        alike(batch[2], run(t=[0, 1, 2], z=z[2], t0=0.0, noise=std))


def test_no_tracks_are_a_batch_of_none():
    assert len(gv.smooth(WALK, BOTH, [0, 1], np.empty((0, 2, 2)), prior=WIDE, point=0.0)) == 0
    assert len(gv.filter(WALK, BOTH, {"time": [], "p": [], "q": [], "track_id": []}, prior=WIDE)) == 0


def test_estimates_stay_frozen_when_they_travel():
    twin = pickle.loads(pickle.dumps(run()))
    assert not any(value.flags.writeable for value in twin.to_dict().values())
    with pytest.raises(AttributeError, match="cannot be changed"):
        del twin.nis
    with pytest.raises(AttributeError, match="cannot be changed"):
        del PRIOR.__dict__, PRIOR._mean


def test_a_table_of_many_tracks_is_that_of_each_below_the_other():
    pandas = pytest.importorskip("pandas")
    batch = run(z=np.stack([Z, Z + 0.1]))
    frame = batch.to_pandas()
    assert frame.index.names == ["track_id", "time"]
    for k, one in enumerate(batch):
        pandas.testing.assert_frame_equal(frame.loc[k], one.to_pandas())
    assert batch.to_polars()["track_id"].to_list() == [0] * 20 + [1] * 20


def test_sensors_on_different_days_are_merged_by_date():
    t, z = gv.merge({"a": (DAYS[:2], [1.0, 2.0]), "b": (DAYS[1:].astype("datetime64[h]"), [3.0, 4.0])})
    np.testing.assert_array_equal(t, DAYS)
    np.testing.assert_array_equal(z["b"].ravel(), [np.nan, 3.0, 4.0])


def named(*state):
    model = gv.Transition(lambda t, dt, x: x, noise_cov=np.eye(2), state=state)
    return gv.filter(model, BOTH, [0, 1, 2], Z2, prior=WIDE)


def pandas_frame(columns):
    return pytest.importorskip("pandas").DataFrame(columns)


DATES = 'give seconds: (dates - dates[0]) / np.timedelta64(1, "s")'
NUMBERS = "give a list of numbers, or a NumPy array of floats"
COMPLEX = "give their real parts, np.real(…), if that is all they have"
TWICE = "give the second one as a sensor of its own"
MOMENT = "give a number, or a date"
ZONE = 'give all with a time zone, or none: pandas.to_datetime(…).tz_localize("UTC")'
UTC = datetime.datetime(2020, 1, 1, tzinfo=datetime.UTC)

# what is done, the message, the remedy
CASES = [
    (lambda: walk(z=np.array([DAYS, DAYS]).T), "`z` is not an array of real numbers: it holds dates", DATES),
    (
        lambda: walk(z=np.zeros((3, 2), dtype="timedelta64[s]")),
        "`z` is not an array of real numbers: it holds durations",
        'give seconds: durations / np.timedelta64(1, "s")',
    ),
    (lambda: walk(z=Z2 + 1j), "`z` is not an array of real numbers: it holds complex numbers", COMPLEX),
    (lambda: walk(z=[["1", "2"]] * 3), "`z` is not an array of real numbers: it holds text", NUMBERS),
    (lambda: walk(z=[[1, object()]] * 3), "`z` is not an array of real numbers: it holds something else", NUMBERS),
    (
        lambda: walk(z=[[1, 2], [3], [4, 5]]),
        "`z` is not an array of real numbers: it holds parts of different lengths",
        NUMBERS,
    ),
    (
        lambda: gv.Gaussian([0, 0], std=np.ones(2, dtype="timedelta64[s]")),
        "`std` is not an array of real numbers: it holds durations",
        'give seconds: durations / np.timedelta64(1, "s")',
    ),
    (
        lambda: walk({"time": [0, 1, 2], "p": [1 + 1j] * 3, "q": [1] * 3}, None),
        "the column `p` is not an array of real numbers: it holds complex numbers",
        COMPLEX,
    ),
    (
        lambda: walk({"time": [0, 1, 2], "p": DAYS, "q": [1] * 3}, None),
        "the column `p` is not an array of real numbers: it holds dates",
        DATES,
    ),
    (
        lambda: walk({"time": [0, 1, 2], "p": [1] * 3, "q": [1] * 3, "track_id": [1.0, np.nan, 1.0]}, None),
        "`track_id` is missing in row 1",
        "name the track of each row, or leave such rows out",
    ),
    (
        lambda: walk(pandas_frame({"time": [0, 1, 2], "p": [1] * 3, "q": [1] * 3, "track_id": ["a", "a", None]}), None),
        "`track_id` is missing in row 2",
        "name the track of each row, or leave such rows out",
    ),
    (
        lambda: walk({"time": np.ma.masked_array([0.0, 1, 2], [0, 1, 0]), "p": [1] * 3, "q": [1] * 3}, None),
        "row 1: time NaN is not finite",
        "give its time, or leave the row out",
    ),
    (lambda: walk(t=np.ma.masked_array(DAYS, [0, 0, 1])), "`t` is no time at row 2", "leave the row out"),
    (
        lambda: walk(t=[UTC, __import__("pandas").NaT, UTC]),
        "`t` is no time at row 1",
        "leave the row out",
    ),
    (
        lambda: walk(t=np.array(["3000-01-01", "3000-01-02", "3000-01-03"], dtype="datetime64[D]")),
        "`t` is 3000-01-01 at row 0, which nanoseconds cannot tell",
        "dates lie from 1677-09-22 to 2262-04-10; give seconds as numbers for others",
    ),
    (
        lambda: walk(t=np.array(["1700-01-01", "1800-01-01", "2200-01-01"], dtype="datetime64[D]")),
        "`t` is 2200-01-01 at row 2, more than 292 years from 1700-01-01",
        "give seconds as numbers",
    ),
    (
        lambda: walk(t=[datetime.datetime(2020, 1, 1), UTC, UTC]),
        "`t` holds dates with a time zone and without one: row 1 is 2020-01-01 00:00:00+00:00",
        "give all of them with a time zone, or none",
    ),
    (
        lambda: walk(t=DAYS, t0=datetime.datetime(2020, 1, 1, tzinfo=EAST)),
        "`t` holds dates without a time zone, but the other times are dates with one",
        ZONE,
    ),
    (
        lambda: walk(t=DAYS, at=[UTC]),
        "`at` holds dates with a time zone, but the other times are dates without one",
        ZONE,
    ),
    (
        lambda: walk(t=["2020-01-01", "2020-01-02", "2020-01-03"]),
        "`t` holds text, not times",
        'give numbers, or dates: np.array(…, dtype="datetime64[ms]")',
    ),
    (
        lambda: walk(t=np.array([0, 1, 2], dtype="timedelta64[M]")),
        "`t` holds durations in months, which are no number of seconds",
        "give them in days, seconds or parts of those",
    ),
    (
        lambda: walk(z=pandas_frame({"p": [1] * 3, "qq": [1] * 3})),
        "`the columns of z` names `qq`, which is no measure",
        "did you mean `q`?",
    ),
    (
        lambda: walk(z=pandas_frame({"p": [1] * 3})),
        "`z` has no column `q`: it has `p`",
        "give one for each of p, q",
    ),
    (
        lambda: gv.filter(PUSHED, BOTH, [0, 1], Z2[:2], prior=WIDE, u=pandas_frame({"e": [1, 1], "u_e": [1, 1]})),
        "`u` has the column `e` twice",
        "leave one of them out, or name it otherwise",
    ),
    (
        lambda: walk(z=np.ones((2, 2, 2)), t=[0, 1], noise=np.ones((2, 2, 2))),
        "`noise` of shape (2, 2, 2) may be one for each of 2 tracks, or the same for all",
        "say so by its dimensions: give covariances of shape (2, rows, 2, 2)",
    ),
    (
        lambda: walk(z={"both": np.ones((2, 3, 2)), "other": np.ones((3, 3, 2))}),
        "`z` has measurements of 2 tracks for `both` and of 3 for `other`",
        "give NaN where a sensor is missing",
    ),
    (
        lambda: walk(t=[[0, 1], [0, 1, 2]], z=[np.ones((2, 2)), np.ones((3, 2)), np.ones((1, 2))]),
        "`t` has times of 2 tracks, `z` measurements of 3",
        "give one list for each",
    ),
    (
        lambda: gv.filter(SCALED, BOTH, [0, 1, 2], Z2, prior=WIDE, params={"w": 3.0}),
        "`params`: `w` has shape (), not (2,)",
        "give as many numbers as it had",
    ),
    (
        lambda: gv.filter(SCALED, BOTH, [0, 1, 2], np.stack([Z2] * 3), prior=WIDE, params={"w": [1.0, 2.0, 3.0]}),
        "`params`: `w` has shape (3,), not (2,), nor (3, 2), one for each track",
        "give as many numbers as it had, or as many for each track",
    ),
    (lambda: walk(params=3), "`params` is 3, not a table by name", "write params={name: value}"),
    (
        lambda: walk(prior=([1, 1], [1, 1])),
        "`prior` is a tuple of 2, not one Gaussian",
        "write gv.Gaussian(mean, cov)",
    ),
    (
        lambda: gv.Gaussian([0], std=[1e160]),
        "`std[0]` is 1e+160, whose square is no finite number",
        "measure the state in a larger unit",
    ),
    (lambda: walk(method=3), "`method` is 3, not a name", 'write method="sr-ckf"; gv.methods() lists all'),
    (lambda: walk(t0=[0, 1]), "`t0` is a list of 2, not one time", MOMENT),
    (
        lambda: gv.smooth(WALK, BOTH, [0, 1, 2], Z2, prior=WIDE, point=(0, 1)),
        "`point` is a tuple of 2, not one time",
        MOMENT,
    ),
    (
        lambda: gv.Filter(WALK, BOTH, prior=WIDE, t0=0.0).predict([1.0]),
        "`t` is a list of 1, not one time",
        MOMENT,
    ),
    (lambda: gv.Filter(WALK, BOTH, prior=WIDE, t0=None), "`t0` is missing", MOMENT),
    (
        lambda: gv.smooth(WALK, BOTH, [0, 1, 2], Z2, prior=WIDE, lag=True),
        "`lag` is True",
        "a lag is a whole number of rows, from 0 up",
    ),
    (lambda: walk(threads="2"), "`threads` is '2'", "give a whole number, from 1 up"),
    (lambda: walk(threads=-1), "`threads` is -1", "give a whole number, from 1 up"),
    (
        lambda: walk(threads=10**30),
        f"`threads` is {10**30}",
        "give a whole number, from 1 to 2147483647",
    ),
    (lambda: walk().sample(1.5, seed=1), "`n` is 1.5", "give a whole number, from 0 up"),
    (lambda: walk().sample(1, seed=-1), "`seed` is -1", "give a whole number, from 0 up"),
    (
        lambda: gv.simulate(WALK, BOTH, [0, 1], prior=WIDE, seed=2**64),
        "`seed` is 18446744073709551616",
        "give a whole number, from 0 to 18446744073709551615",
    ),
    (
        lambda: gv.simulate(WALK, BOTH, [0, 1], prior=WIDE, seed=1, substeps=2**70),
        "`substeps` is 1180591620717411303424",
        "give a whole number, from 1 to 2147483647",
    ),
    (
        lambda: gv.parse_model(3),
        "`text` is 3, not the text of a model file",
        "read files with gv.read_model(path)",
    ),
    (
        lambda: gv.parse_model("a\ud800"),
        "`text` holds '\\ud800' at character 1, which is half of one",
        'read files as UTF-8: open(path, encoding="utf-8")',
    ),
    (
        lambda: gv.read_model("a\udcff"),
        "`path` holds '\\udcff' at character 1, which is half of one",
        "give the file a name that is UTF-8",
    ),
    (
        lambda: walk({"time": 0.0, "p": [1], "q": [1]}, None),
        "the column `time` is not a list of times",
        "give one time for each row of the table",
    ),
    (
        lambda: gv.Transition(lambda t, dt, x: x, noise_cov=np.eye(2), state=["a", "b"], step="a"),
        "`step` is 'a'",
        "a step is longer than 0",
    ),
    (
        lambda: gv.compare(WALK, BOTH, [0, 1, 2], Z2, prior=WIDE, methods=["ekf"], options=3),
        "`options` is 3, not a table by name",
        'write options={"sr-ukf": {"kappa": 0}}',
    ),
    (
        lambda: gv.compare(WALK, BOTH, [0, 1, 2], Z2, prior=WIDE, methods=3),
        "`methods` is 3",
        'write methods=["ekf", "sr-ckf"]',
    ),
    (lambda: gv.read_model(None), "`path` is None, not a path", 'write read_model("model.toml")'),
    (
        lambda: gv.merge({"a": (DAYS, [1, 2, 3]), "b": ([0.0], [1])}),
        "`b` has times that are numbers, but those of `a` are dates",
        "give all alike",
    ),
    (
        lambda: gv.merge({"a": (DAYS, [1, 2, 3]), "b": ([UTC], [1])}),
        "`b` has times that are dates with a time zone, but those of `a` are dates",
        "give all alike",
    ),
    (
        lambda: gv.merge({"a": ([0.0, np.nan], [1, 2]), "b": ([np.nan], [1])}),
        "`a` has the time nan in row 1",
        "leave the row out",
    ),
    (lambda: gv.merge({"a": ([0, 0], [1, 2])}), "`a` measures twice at one time", TWICE),
    (lambda: gv.merge([1]), "`measurements` is list, not a table by sensor", 'write {"radar": (t, z), …}'),
    (
        lambda: named("time", "b").to_pandas(),
        "the state `time` and the column `time` of every table would be one column",
        "name the state otherwise in the model, or take the arrays: to_dict()",
    ),
    (
        lambda: named("a", "a_std").to_polars(),
        "the state `a_std` and the standard deviation of `a` would be one column",
        "name the state otherwise in the model, or take the arrays: to_dict()",
    ),
]


@pytest.mark.parametrize("case", CASES, ids=range(len(CASES)))
def test_data_that_cannot_serve_is_told_with_its_remedy(case):
    wrong, message, remedy = case
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(gv.InputError) as caught:
            wrong()
    assert caught.value.message == message
    assert caught.value.remedy == remedy

"""When tracks begin, each at its own time; controls beside a table."""

import numpy as np
import pytest
from test_running import LENGTH, MODEL, PRIOR, T, Z

import givens as gv

DAY = np.datetime64("2024-03-01T00:00:00", "ms")
STARTS = [-1.0, -0.25]


def alone(k, **options):
    return gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, t0=STARTS[k], **options)


def table(time=T, names=("a", "b"), **columns):
    two = {"time": np.concatenate([time, time]), "length": np.concatenate([Z[:, 0]] * 2), **columns}
    return {**two, "track_id": np.repeat(names, len(time))}


@pytest.mark.parametrize("starts", [STARTS, np.array(STARTS), {0: STARTS[0], 1: STARTS[1]}, {1: STARTS[1], 0: STARTS[0]}])
def test_each_track_begins_at_its_own_time(starts):
    for how in (gv.filter, gv.smooth):
        batch = how(MODEL, LENGTH, T, np.stack([Z, Z]), prior=PRIOR, t0=starts)
        for k, one in enumerate(batch):
            expected = how(MODEL, LENGTH, T, Z, prior=PRIOR, t0=STARTS[k])
            np.testing.assert_allclose(one.mean, expected.mean, rtol=1e-9)
            np.testing.assert_allclose(one.cov, expected.cov, rtol=1e-7)


def test_tracks_of_a_table_begin_by_their_names_and_none_at_its_first_row():
    batch = gv.filter(MODEL, LENGTH, table(), prior=PRIOR, t0={"b": STARTS[1], "a": None})
    expected = gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR)
    np.testing.assert_allclose(batch.track("a").mean, expected.mean, rtol=1e-9)
    np.testing.assert_allclose(batch.track("b").mean, alone(1).mean, rtol=1e-9)


def test_starts_that_are_dates():
    dates = DAY + (1000 * T).round().astype("m8[ms]")
    starts = [DAY + np.timedelta64(int(1000 * start), "ms") for start in STARTS]
    pandas = pytest.importorskip("pandas")
    for given in (starts, np.array(starts), pandas.Series(starts), dict(zip("ab", starts, strict=True))):
        batch = gv.filter(MODEL, LENGTH, table(dates), prior=PRIOR, t0=given)
        for k in range(2):
            np.testing.assert_allclose(batch[k].mean, alone(k).mean, rtol=1e-9)
            assert batch[k].time[0] == dates[0]


def test_starts_that_cannot_serve_are_told():
    def told(t0, **options):
        with pytest.raises(gv.InputError) as caught:
            gv.filter(MODEL, LENGTH, table(), prior=PRIOR, t0=t0, **options)
        return caught.value

    assert str(told([0.0])) == "`t0` has 1 times, but there are 2 tracks\n  help: give one for each, or one for all"
    assert "`t0` has nothing for the track 'b'" in str(told({"a": 0.0}))
    late = told({"a": -1.0, "b": 5.0})
    assert late.track == "b" and str(late).startswith("track `b`")


THRUST = gv.Sde(lambda t, x, u: [x[1], u[0]], diffusion=[0.0, 0.1], state=["x", "v"], controls=["thrust"])
PUSHES = np.linspace(-1.0, 1.0, 2 * len(T))


def test_controls_beside_a_table_go_by_its_rows():
    expected = gv.filter(THRUST, LENGTH, table(u_thrust=PUSHES), prior=PRIOR)
    same = gv.filter(THRUST, LENGTH, table(thrust=PUSHES), prior=PRIOR)
    for u in (PUSHES, PUSHES[:, None], {"thrust": PUSHES}):
        found = gv.filter(THRUST, LENGTH, table(), prior=PRIOR, u=u)
        for k in range(2):
            np.testing.assert_array_equal(found[k].mean, expected[k].mean)
            np.testing.assert_array_equal(same[k].mean, expected[k].mean)
    constant = gv.filter(THRUST, LENGTH, table(), prior=PRIOR, u={"thrust": 0.5})
    columns = gv.filter(THRUST, LENGTH, table(u_thrust=np.full(len(PUSHES), 0.5)), prior=PRIOR)
    np.testing.assert_array_equal(constant[1].mean, columns[1].mean)


def test_controls_twice_or_never_are_told():
    with pytest.raises(gv.InputError, match="^`u` is given, and the table has the column `u_thrust` as well\n  help: leave"):
        gv.filter(THRUST, LENGTH, table(u_thrust=PUSHES), prior=PRIOR, u=PUSHES)
    with pytest.raises(gv.InputError, match="^the table has no column `u_thrust` for the control `thrust`"):
        gv.filter(THRUST, LENGTH, table(), prior=PRIOR)

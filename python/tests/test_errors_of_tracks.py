"""An error in a batch names its track, and where its row stands in the table."""

import pickle

import numpy as np
import pytest
from test_running import LENGTH, MODEL, PRIOR, T, Z

import givens as gv

FIVE = T[:5]


def mixed(**changed):
    """Two tracks of five rows whose rows take turns: row k of `b` is row 2k + 1 of the table."""
    table = {"time": np.repeat(FIVE, 2), "length": np.repeat(Z[:5, 0], 2), "track_id": ["a", "b"] * 5}
    for name, (row, value) in changed.items():
        table[name] = table[name].copy()
        table[name][row] = value
    return gv.filter(MODEL, LENGTH, table, prior=PRIOR)


def many(t=None, z=None, **options):
    """Thirty tracks, of which the one numbered 17 has what is given."""
    times, measured = [FIVE] * 30, [Z[:5]] * 30
    times[17], measured[17] = FIVE if t is None else t, Z[:5] if z is None else z
    return gv.filter(MODEL, LENGTH, times, measured, **{"prior": PRIOR, **options})


def other(values, at, value):
    changed = np.array(values)
    changed[at] = value
    return changed


CASES = {
    "infinite in a table": (
        lambda: mixed(length=(5, np.inf)),
        ("b", 2),
        "track `b`, its row 2 (row 5 of the table): measure `length` is infinite\n  help: a missing component is NaN",
    ),
    "not sorted in a table": (
        lambda: mixed(time=(7, 0.1)),
        ("b", 3),
        "track `b`, its row 3 (row 7 of the table): time 0.1 ",
    ),
    "no time in a table": (
        lambda: mixed(time=(4, np.nan)),
        ("a", 2),
        "track `a`, its row 2 (row 4 of the table): time NaN is not finite",
    ),
    "infinite": (lambda: many(z=other(Z[:5], 3, np.inf)), (17, 3), "track 17, its row 3: measure `length` is infinite"),
    "wrong shape": (lambda: many(z=Z[:4]), (17, None), "track 17: `z` has shape (4, 1), not (5, 1)"),
    "wrong prior": (
        lambda: many(prior=[PRIOR] * 17 + [gv.Gaussian([1.0], std=[1.0])] + [PRIOR] * 12),
        (17, None),
        "track 17: `prior` has 1 components",
    ),
    "no prior": (lambda: many(prior=[PRIOR] * 17 + [3] + [PRIOR] * 12), (17, None), "track 17: `prior` is int"),
    "parameter": (
        lambda: many(params={"k": other(np.ones(30), 17, np.nan)}),
        (17, None),
        "track 17: `params`: the parameter `k` is NaN",
    ),
    "dates": (
        lambda: many(t=other(np.datetime64("2020-01-01") + np.arange(5), 2, np.datetime64("NaT"))),
        (17, 2),
        "track 17, its row 2: `t` is no time at row 2",
    ),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_an_error_of_a_track_names_it(case):
    wrong, (track, row), expected = case
    with pytest.raises(gv.InputError) as caught:
        wrong()
    error = caught.value
    assert str(error).startswith(expected)
    assert (error.track, error.row) == (track, row)
    assert not getattr(error, "__notes__", [])
    assert vars(pickle.loads(pickle.dumps(error))) == vars(error)


def test_a_track_alone_is_not_named():
    with pytest.raises(gv.InputError) as caught:
        gv.filter(MODEL, LENGTH, FIVE, other(Z[:5], 3, np.inf), prior=PRIOR)
    assert caught.value.track is None and str(caught.value).startswith("row 3: measure `length` is infinite")


def test_where_tracks_have_clocks_of_their_own_the_one_at_fault_is_named():
    days = np.datetime64("2020-01-01") + np.arange(5)
    bad = other(Z[:5], 1, np.inf)
    with pytest.raises(gv.InputError) as caught:
        gv.smooth(MODEL, LENGTH, [days, days - 1, days - 1], [Z[:5], Z[:5], bad], prior=PRIOR, point=days[1])
    assert caught.value.track == 2

"""What is given and said of the tracks of a batch by their names."""

from pathlib import Path

import numpy as np
import pytest
from test_running import LENGTH, MODEL, PRIOR, T, Z, same

import givens as gv

NEAR = gv.Gaussian([1.0, 0.1], std=[0.3, 0.2])


def table(names=("b", "a")):
    """Two tracks, of which the second in the alphabet comes first."""
    return {"time": np.tile(T, 2), "length": np.tile(Z[:, 0], 2), "track_id": np.repeat(names, 20)}


def run(data=None, **options):
    return gv.filter(MODEL, LENGTH, table() if data is None else data, **{"prior": PRIOR, **options})


def test_priors_and_parameters_by_track_go_to_the_track_of_that_name():
    named = run(prior={"a": PRIOR, "b": NEAR}, params={"k": {"a": 1.0, "b": 2.0}})
    assert named.track_ids == ["b", "a"]
    same(named.track("b"), run(prior=NEAR, params={"k": 2.0}).track("b"))
    same(named.track("a"), run().track("a"))


def test_lists_go_in_the_order_of_track_ids():
    listed = run(prior=[NEAR, PRIOR], params={"k": [2.0, 1.0]})
    named = run(prior={"a": PRIOR, "b": NEAR}, params={"k": {"a": 1.0, "b": 2.0}})
    assert listed.track_ids == ["b", "a"]
    for name in "ab":
        same(listed.track(name), named.track(name))


def test_tracks_without_names_are_called_by_their_numbers():
    named = gv.filter(MODEL, LENGTH, T, [Z, Z], prior={1: NEAR, 0: PRIOR}, params={"k": {0: 1.0, 1: 2.0}})
    same(named[1], gv.filter(MODEL, LENGTH, T, [Z, Z], prior=NEAR, params={"k": 2.0})[1])


MANY = {"time": np.zeros(30), "length": np.zeros(30), "track_id": [f"ship {k}" for k in range(30)]}
CASES = [
    (
        lambda: run(prior={"a": PRIOR}),
        "`prior` has nothing for the track 'b'\n  help: give one for each track",
    ),
    (
        lambda: run(data=table(("boat", "car")), prior={"bot": PRIOR, "car": PRIOR}),
        "`prior` is for the track 'bot', of which there is none\n  help: did you mean 'boat'?",
    ),
    (
        lambda: run(params={"k": {"a": 1.0, "b": 1.0, "zz": 1.0}}),
        "`params` of `k` is for the track 'zz', of which there is none\n  help: there are 'b', 'a'",
    ),
    (
        lambda: run(params={"k": {"a": 1.0, "b": [1.0, 2.0]}}),
        "`params`: `k` of the track 'b' has shape (2,), not ()\n  help: give one number",
    ),
    (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, params={"k": {"a": 1.0}}),
        "`params`: `k` is a table by track, but there is one track\n  help: give one number",
    ),
    (
        lambda: run(data=MANY, prior={"ship 0": PRIOR}),
        "`prior` has nothing for the tracks 'ship 1', 'ship 2', 'ship 3', 'ship 4', 'ship 5', … (29 in all)\n"
        "  help: give one for each track",
    ),
    (
        lambda: run(data=MANY).track("zz"),
        "there is no track 'zz'\n"
        "  help: there are 'ship 0', 'ship 1', 'ship 2', 'ship 3', 'ship 4', … (30 in all)",
    ),
]


@pytest.mark.parametrize("case", CASES, ids=range(len(CASES)))
def test_what_does_not_fit_the_tracks_is_told_with_its_remedy(case):
    wrong, expected = case
    with pytest.raises(gv.InputError) as caught:
        wrong()
    assert str(caught.value) == expected
    assert caught.value.argument in ("prior", "params", "name")


@pytest.mark.parametrize("t", [T, [T, T], np.stack([T, T])], ids=["one for all", "list", "array"])
def test_tracks_of_one_measure_may_be_vectors(t):
    expected = gv.filter(MODEL, LENGTH, T, np.stack([Z, Z + 0.1]), prior=PRIOR)
    found = gv.filter(MODEL, LENGTH, t, [Z[:, 0], Z[:, 0] + 0.1], prior=PRIOR)
    np.testing.assert_array_equal(found.mean, expected.mean)


def test_vectors_may_have_different_lengths_and_be_one_array_where_times_are():
    ragged = gv.filter(MODEL, LENGTH, [T, T[:7]], [Z[:, 0], Z[:7, 0]], prior=PRIOR)
    assert [len(one) for one in ragged] == [20, 7]
    assert len(gv.filter(MODEL, LENGTH, np.stack([T, T]), np.stack([Z[:, 0]] * 2), prior=PRIOR)) == 2


def test_rows_of_one_number_each_are_one_track():
    for rows in (list(Z), Z.tolist(), Z[:, 0].tolist()):
        assert isinstance(gv.filter(MODEL, LENGTH, T, rows, prior=PRIOR), gv.Estimates)
    assert isinstance(gv.filter(MODEL, LENGTH, [0.0], [[1.0]], prior=PRIOR), gv.Estimates)


def test_times_of_several_tracks_beside_measurements_of_one_are_told():
    both = gv.Sensor(lambda t, x: x, measures=["p", "q"], std=[0.1, 0.1])
    for t in ([T, T], [T, T[:7]]):
        with pytest.raises(gv.InputError) as caught:
            gv.filter(MODEL, both, t, [Z[:, 0], Z[:, 0]], prior=PRIOR)
        assert str(caught.value) == (
            "`t` has times of 2 tracks, but `z` is of one\n"
            "  help: give `z` for each track: a list of arrays (rows, 2)"
        )


def test_a_short_track_may_be_filled_up_with_its_last_time_and_nothing_measured():
    times, z = np.stack([T, T]), np.stack([Z, Z + 0.1])
    times[1, 7:], z[1, 7:] = T[6], np.nan
    for run in (gv.filter, gv.smooth):
        filled = run(MODEL, LENGTH, times, z, prior=PRIOR)
        alone = run(MODEL, LENGTH, T[:7], Z[:7] + 0.1, prior=PRIOR)
        np.testing.assert_allclose(filled.mean[1], alone.mean[[*range(7)] + [6] * 13], rtol=1e-9, atol=1e-12)
        assert filled.nis_dof[1].tolist() == [1] * 7 + [0] * 13


ZOO = Path(__file__).parents[2] / "examples" / "zoo" / "van_der_pol.toml"


@pytest.fixture
def two_tracks(tmp_path):
    rows = [f"{track},{time},0.5" for track in "ba" for time in (0.1, 0.2, 0.3)]
    path = tmp_path / "two.csv"
    path.write_text("\n".join(["track_id,time,z", *rows]) + "\n")
    return gv.read_model(ZOO), path


def test_a_file_of_tracks_takes_priors_by_their_names(two_tracks):
    model, path = two_tracks
    found = gv.filter(model, None, path, prior={"a": PRIOR, "b": NEAR})
    assert found.track_ids == ["b", "a"]
    same(found.track("b"), gv.filter(model, None, path, prior=NEAR).track("b"))
    same(found.track("a"), gv.filter(model, None, path, prior=PRIOR).track("a"))


@pytest.mark.parametrize("given", [{"params": {"stiffness": 3.0}}, {"u": 1}, {"noise": 1}, {"z": [1]}, {"t0": 0.0}])
def test_what_a_file_of_data_leaves_no_room_for_is_refused(two_tracks, given):
    model, path = two_tracks
    with pytest.raises(gv.InputError, match="cannot be given beside the path of a CSV file") as caught:
        gv.filter(model, None, path, **given)
    assert caught.value.argument == next(iter(given)) and caught.value.remedy

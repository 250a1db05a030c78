"""Monte-Carlo studies: the same runs however they are cut."""

import inspect
import pickle

import numpy as np
import pyarrow as pa
import pytest

import givens as gv


@pytest.fixture(scope="module")
def study():
    model = gv.Transition(lambda t, dt, x: [x[0] + 0.1 * np.sin(x[1]), x[1]], noise_cov=0.01 * np.eye(2), state=["x", "v"])
    sensor = gv.Sensor(lambda t, x: x[:1], measures=["z"], std=[0.5])
    prior = gv.Gaussian([0, 1], std=[1, 0.3])
    return gv.study(model, sensor, range(15), prior=prior, methods=["sr-ckf", "ekf"], runs=40, seed=3)


def test_any_cut_gives_the_same_table(study):
    whole = study()
    assert whole.num_rows == 80 and whole["run"].to_pylist()[:4] == [0, 0, 1, 1]
    for parts in (1, 3, 40):
        assert pa.concat_tables([study(part) for part in study.ranges(parts)]).equals(whole)
    odd = study([7, 8, 30])
    assert odd.equals(pa.concat_tables([whole.slice(14, 4), whole.slice(60, 2)]))
    assert study(pa.table({"id": [7, 8, 30]})).equals(odd)
    there = pickle.loads(pickle.dumps(study))
    assert there.threads == 1 and there(range(5)).equals(whole.slice(0, 10))


def test_scores_are_those_of_a_comparison(study):
    drawn = gv.simulate(study._model, study._sensors, range(15), prior=study._prior, seed=3, runs=40)
    [ckf, ekf] = gv.compare(study._model, study._sensors, drawn.t, drawn.z, prior=study._prior, methods=study.methods, truth=drawn.x)
    table = study()
    for one, of in ((ckf, 0), (ekf, 1)):
        squares = np.array([table[f"rmse_{name}"].to_numpy()[of::2] ** 2 for name in ("x", "v")])
        assert np.allclose(np.sqrt(squares.mean(axis=1)), list(one.rmse.values()) if hasattr(one.rmse, "values") else one.rmse)
        assert np.isclose(table["nees"].to_numpy()[of::2].mean(), one.nees)
        assert np.isclose(table["log_likelihood"].to_numpy()[of::2].sum(), one.log_likelihood)


def test_the_summary_has_means_and_their_errors(study):
    parts = [study(part) for part in study.ranges(3)]
    summary = gv.Study.summary(parts[::-1])
    assert summary == gv.Study.summary(study())
    mean, error = summary["sr-ckf"]["rmse_x"]
    values = study()["rmse_x"].to_numpy()[::2]
    assert mean == pytest.approx(values.mean()) and error == pytest.approx(values.std(ddof=1) / np.sqrt(40))
    assert summary["ekf"]["runs"] == 40 and summary["ekf"]["failed"] == 0


def test_runs_that_fail_stand_there_and_cost_no_other():
    model = gv.Transition(lambda t, dt, x: x, noise_cov=lambda t, dt: [[dt]], state=["x"])
    sensor = gv.Sensor(lambda t, x: np.sqrt(x + 6), measures=["z"], std=[0.01])
    study = gv.study(model, sensor, np.arange(10.0), prior=gv.Gaussian([0], std=[1]), methods=["sr-ckf"], runs=60, seed=1)
    whole = study()
    failed = [error for error in whole["error"].to_pylist() if error is not None]
    assert whole.num_rows == 60 and 0 < len(failed) < 30
    assert {error.partition(":")[0] for error in failed} <= {"simulation", "not-finite"}
    # a failure says the same whatever runs stand beside it
    assert pa.concat_tables([study(part) for part in study.ranges(60)]).combine_chunks().equals(whole.combine_chunks())
    summary = gv.Study.summary(whole)["sr-ckf"]
    assert summary["failed"] == len(failed) and summary["runs"] == 60
    # a part that was done twice counts once
    assert gv.Study.summary([whole, study(range(5))])["sr-ckf"] == summary


@pytest.mark.parametrize(
    ("changes", "said"),
    [({"methods": "ekf"}, "methods"), ({"methods": ["efk"]}, "ekf"), ({"runs": 0}, "runs"), ({"goal": "x"}, "goal"), ({"options": {"ukf": {}}}, "ukf"), ({"methods": ["ekf", "ekf"]}, "once"), ({"methods": 3}, "methods"), ({"prior": None}, "prior"), ({"substeps": 0}, "substeps"), ({"goal": "smooth", "lag": 2}, "`lag` is given to a study")],
)
def test_what_cannot_serve_is_told_at_once(changes, said):
    model = gv.Transition(lambda t, dt, x: x, noise_cov=[[0.1]], state=["x"])
    sensor = gv.Sensor(lambda t, x: x, measures=["z"], std=[1.0])
    usual = {"prior": gv.Gaussian([0], std=[1]), "methods": ["ekf"], "runs": 3, "seed": 1}
    with pytest.raises(gv.InputError, match=said):
        gv.study(model, sensor, range(3), **{**usual, **changes})


def test_the_signature_is_that_of_the_class():
    assert inspect.signature(gv.study) == inspect.signature(gv.Study)
    assert list(inspect.signature(gv.study).parameters)[:4] == ["model", "sensors", "t", "prior"]


def test_runs_beyond_the_last_are_refused(study):
    for wrong in ([40], [-1], "all", pa.table({"k": [1]})):
        with pytest.raises(gv.InputError, match="run"):
            study(wrong)

"""Answers that may be wrong are doubted, and told."""

import warnings

import numpy as np
import pyarrow as pa
import pytest

import givens as gv

T = np.arange(5.0)
Z = np.array([[0.5], [0.4], [np.nan], [0.3], [0.2]])
PRIOR = gv.Gaussian([2.0], std=[1.0])
SENSOR = gv.Sensor(lambda t, x: x, measures=["z"], std=[0.5])


def decay(rate, **options):
    return gv.Sde(lambda t, x: [-rate * x[0]], diffusion=[1.0], state=["x"], **options)


def quiet(work):
    with warnings.catch_warnings():
        warnings.simplefilter("error", gv.DoubtWarning)
        return work()


def test_steps_that_are_short_enough_are_not_doubted():
    assert quiet(lambda: gv.filter(decay(1.0), SENSOR, T, Z, prior=PRIOR)).doubts == ()
    assert quiet(lambda: gv.filter(decay(40.0), SENSOR, T, Z, prior=PRIOR, method="sr-cd-ckf2")).doubts == ()
    batch = quiet(lambda: gv.smooth(decay(1.0), SENSOR, T, np.stack([Z, Z]), prior=PRIOR))
    assert batch.doubts == ()


@pytest.mark.parametrize("run", [gv.filter, gv.smooth])
def test_steps_that_are_too_long_are_told_where_the_package_was_called(run):
    with pytest.warns(gv.DoubtWarning) as caught:
        est = run(decay(40.0), SENSOR, T, Z, prior=PRIOR)
    assert caught[0].filename == __file__
    (doubt,) = est.doubts
    assert str(caught[0].message) == doubt
    assert doubt.startswith("row ")
    assert "substeps=…" in doubt
    assert 'method="sr-cd-ckf2"' in doubt


def test_steps_of_a_solver_and_functions_of_python_are_looked_at_too():
    options = {"method": "sr-cd-ckf2", "solver": "rk4", "substeps": 16}
    est = quiet(lambda: gv.filter(decay(20.0, trace=False), SENSOR, T, Z, prior=PRIOR, **options))
    assert "or a solver that chooses them" in est.doubts[0]


def test_a_longest_step_beyond_the_gap_is_halved_too():
    with pytest.warns(gv.DoubtWarning, match="max_step="):
        gv.filter(decay(40.0), SENSOR, T, Z, prior=PRIOR, max_step=5.0)


def test_tracks_whose_parameters_make_them_stiff_are_found_among_others():
    model = gv.Sde(lambda t, x, *, k=1.0: [-k * x[0]], diffusion=[1.0], state=["x"])
    rates = np.where(np.arange(200) == 150, 40.0, 1.0)
    with pytest.warns(gv.DoubtWarning, match="track 150, "):
        gv.filter(model, SENSOR, T, np.stack([Z] * 200), prior=PRIOR, params={"k": rates})


def test_a_forecast_behind_the_rows_is_looked_at():
    short = 0.01 * T
    assert quiet(lambda: gv.filter(decay(40.0), SENSOR, short, Z, prior=PRIOR)).doubts == ()
    with pytest.warns(gv.DoubtWarning, match=r"row 5, t = 2: "):
        gv.filter(decay(40.0), SENSOR, short, Z, prior=PRIOR, at=[0.02, 2.0])


def test_what_a_function_raises_at_times_that_the_run_does_not_ask_for_is_no_doubt():
    def drift(t, x):
        if 32 * t % 1:
            raise KeyError(t)
        return [-x[0]]

    model = gv.Sde(drift, diffusion=[1.0], state=["x"], trace=False)
    options = {"method": "sr-cd-ckf2", "solver": "rk4", "substeps": 16}
    est = quiet(lambda: gv.filter(model, SENSOR, T[:3], Z[:3], prior=PRIOR, **options))
    assert est.doubts == ()


def test_a_comparison_warns_once_by_the_name_of_the_method():
    with pytest.warns(gv.DoubtWarning) as caught:
        gv.compare(decay(40.0), SENSOR, T, Z, prior=PRIOR, methods=["sr-cd-ckf", "sr-cd-ckf2"])
    (one,) = caught
    assert str(one.message).startswith("sr-cd-ckf: row ")


def test_steps_that_are_a_little_too_long_are_told_by_the_estimates_alone():
    est = quiet(lambda: gv.filter(decay(20.0), SENSOR, T, Z, prior=PRIOR))
    assert "with twice as many the prediction moves by 0.0" in est.doubts[0]


def test_a_doubt_is_right_about_how_far_halved_steps_move_a_prediction():
    model = decay(25.0)
    with pytest.warns(gv.DoubtWarning):
        est = gv.filter(model, SENSOR, T[:2], Z[:2], prior=PRIOR, t0=0.0)
    moved = float(est.doubts[0].split("moves by ")[1].split(" ")[0])
    found = []
    for count in (16, 33):
        f = gv.Filter(model, SENSOR, prior=gv.Gaussian(est.mean[0], est.cov[0]), t0=0.0, substeps=count)
        f.predict(1.0)
        found.append((f.state.mean[0], f.state.cov[0, 0]))
    (mean, cov), (finer, exact) = found
    assert moved == pytest.approx(max(abs(mean - finer) / np.sqrt(exact), abs(cov - exact) / exact), abs=1e-3)


def test_of_a_batch_the_track_is_named():
    with pytest.warns(gv.DoubtWarning, match="track 0, row "):
        batch = gv.filter(decay(40.0), SENSOR, T, np.stack([Z, Z]), prior=PRIOR)
    assert len(batch.doubts) == 1
    assert batch[0].doubts == ()


def test_rows_and_dates_are_those_of_the_data():
    when = np.datetime64("2026-01-01T00:00:00") + (10 * T).astype("timedelta64[s]")
    with pytest.warns(gv.DoubtWarning, match=r"row [1-4], 2026-01-01T00:00:[1-4]0"):
        est = gv.filter(decay(4.0), SENSOR, when, Z, prior=PRIOR)
    row = int(est.doubts[0].removeprefix("row ").split(",")[0])
    assert f"00:00:{10 * row}" in est.doubts[0]
    with pytest.warns(gv.DoubtWarning, match=r"row ([012]), t = (?!\1)[234]: .*of [23] rows"):
        gv.filter(decay(40.0), SENSOR, T[2:], Z[2:], prior=PRIOR, t0=1.0)


def test_a_job_warns_too():
    table = pa.table({"track_id": ["a"] * 5, "time": T, "z": [0.5, 0.4, None, 0.3, 0.2]})
    with pytest.warns(gv.DoubtWarning, match="track a, row 5, t = 4: the steps of a gap are too long"):
        decay(40.0).batch_job(SENSOR, prior=PRIOR)(table)


def test_digits_that_a_covariance_has_lost_are_told():
    model = gv.Transition(lambda t, dt, x: [x[0] + dt * x[1], x[1]], noise_cov=np.eye(2) * 1e-3, state=["x", "v"])
    sensor = gv.Sensor(lambda t, x: x[:1], measures=["z"], std=[1.0])
    prior = gv.Gaussian([0.0, 0.0], std=[1e9, 1e9])
    with pytest.warns(gv.DoubtWarning) as caught:
        gv.filter(model, sensor, T, Z, prior=prior, t0=0.0, method="ckf")
    assert {"the std of `x` so small", "`v` is known from the states before it"} == {
        part for part in ("the std of `x` so small", "`v` is known from the states before it")
        if any(part in str(one.message) for one in caught)
    }
    assert quiet(lambda: gv.filter(model, sensor, T, Z, prior=prior, t0=0.0)).doubts == ()

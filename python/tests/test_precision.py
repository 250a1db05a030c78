"""precision="f32": runs, batches, filters by hand, functions that are called, and what it cannot keep."""

import numpy as np
import pytest

import givens as gv

T = np.arange(0.0, 12.0, 0.5)
RUNS = 11


def swing(t, x, *, gravity=9.81):
    return [x[1], -gravity * np.sin(x[0])]


def shadow(t, x):
    return [np.sin(x[0])]


MODEL = gv.Sde(swing, diffusion={"rate": 0.3}, state=["angle", "rate"])
SENSOR = gv.Sensor(shadow, measures=["shadow"], std=[0.1])
PRIOR = gv.Gaussian([0.5, 0.0], std=[0.3, 0.3])
Z = gv.simulate(MODEL, SENSOR, T, prior=PRIOR, runs=RUNS, seed=3).z


def is_single(array):
    return np.array_equal(array, array.astype(np.float32).astype(np.float64))


@pytest.mark.parametrize("method", ["sr-cd-ckf", "sr-cd-ukf", "sr-cd-ekf", "lskf"])
@pytest.mark.parametrize("run", [gv.filter, gv.smooth])
def test_a_run_in_f32_is_that_in_f64_to_its_digits(run, method):
    double = run(MODEL, SENSOR, T, Z[0], prior=PRIOR, method=method)
    single = run(MODEL, SENSOR, T, Z[0], prior=PRIOR, method=method, precision="f32")
    assert single.mean.dtype == np.float64 and is_single(single.mean) and is_single(single.factor)
    error = np.abs((single.mean - double.mean) / double.std).max()
    assert 0 < error < 1e-3, error
    np.testing.assert_allclose(single.std, double.std, rtol=1e-3)
    np.testing.assert_array_equal(single.time, double.time)


def test_a_batch_in_packs_is_its_tracks_and_the_same_for_any_number_of_threads():
    def run(z, **options):
        return gv.smooth(MODEL, SENSOR, T, z, prior=PRIOR, precision="f32", **options)

    batch = run(Z, threads=1)
    np.testing.assert_array_equal(batch.mean, run(Z, threads=3).mean)
    alone = np.stack([run(z).mean for z in Z])
    assert np.abs((batch.mean - alone) / batch.std).max() < 1e-3 and is_single(batch.mean)


def test_seconds_since_1970_do_no_harm():
    late = gv.filter(MODEL, SENSOR, 1.7e9 + T, Z[0], prior=PRIOR, precision="f32")
    early = gv.filter(MODEL, SENSOR, T, Z[0], prior=PRIOR, precision="f32")
    np.testing.assert_array_equal(late.mean, early.mean)
    np.testing.assert_array_equal(late.time, 1.7e9 + T)


def test_a_filter_by_hand_is_its_run():
    whole = gv.filter(MODEL, SENSOR, T, Z[0], prior=PRIOR, precision="f32")
    by_hand = gv.Filter(MODEL, SENSOR, prior=PRIOR, t0=T[0], precision="f32")
    for k, (t, z) in enumerate(zip(T, Z[0], strict=True)):
        by_hand.predict(t)
        by_hand.update(z)
        np.testing.assert_array_equal(by_hand.state.mean, whole.mean[k])
        np.testing.assert_array_equal(by_hand.state.cov, whole.cov[k])


def test_functions_that_are_called_serve_it():
    called = gv.Sde(swing, diffusion={"rate": 0.3}, state=["angle", "rate"], trace=False)
    traced = gv.filter(MODEL, SENSOR, T, Z[0], prior=PRIOR, method="sr-cd-ckf2", precision="f32")
    found = gv.filter(called, SENSOR, T, Z[0], prior=PRIOR, method="sr-cd-ckf2", precision="f32")
    assert is_single(found.mean) and np.abs((found.mean - traced.mean) / traced.std).max() < 1e-3


def test_what_f32_cannot_keep_is_refused():
    far = gv.Gaussian([3e39, 0.0], std=[0.3, 0.3])
    with pytest.raises(gv.StepError, match=r"`angle`, 3e39, is beyond what f32 can keep") as caught:
        gv.filter(MODEL, SENSOR, T, Z[0], prior=far, precision="f32")
    assert 'precision="f64"' in str(caught.value)
    with pytest.raises(gv.MethodError, match="rtol = 1e-9: must be at least 1e-6 in f32"):
        gv.filter(MODEL, SENSOR, T, Z[0], prior=PRIOR, method="sr-cd-ckf2", rtol=1e-9, precision="f32")
    with pytest.raises(gv.MethodError, match="precision = f32: `cd-ckf` is in covariance form"):
        gv.filter(MODEL, SENSOR, T, Z[0], prior=PRIOR, method="cd-ckf", precision="f32")
    with pytest.raises(gv.MethodError, match="precision = single: no such choice"):
        gv.filter(MODEL, SENSOR, T, Z[0], prior=PRIOR, precision="single")


def test_every_method_reads_it():
    assert all("precision" in method.options for method in gv.methods())

"""Derivatives are compared once more where a run begins: at the mean of its prior, with its parameters."""

import pickle
import time

import numpy as np
import pytest

import givens as gv

STILL = gv.Transition(lambda t, dt, x: x, noise_cov=[[0.1]], state=["a"])
REFUSED = "(?s)its expressions do not have its derivatives, which `ekf` takes: .* is 1, and that of its expressions 0"


def folded(t, x, *, c=0.3):
    return np.sign(x - c) * np.abs(x - c)


def sensor(h=folded):
    return gv.Sensor(h, measures=["z"], std=[0.5])


def at(mean):
    return gv.Gaussian([mean], std=[1.0])


def run(of, mean, **options):
    return gv.filter(STILL, of, [0.0], [[0.0]], prior=at(mean), **{"method": "ekf", **options})


@pytest.mark.parametrize("c", [0.3, 0.5, 2.0, 5.0])
def test_a_kink_at_the_mean_of_the_prior_is_refused(c):
    of = sensor().with_params(c=c)
    for call in (run, lambda of, mean: gv.Filter(STILL, of, prior=at(mean), t0=0.0, method="ekf")):
        call(of, c + 0.1)
        with pytest.raises(gv.TraceError, match=REFUSED) as caught:
            call(of, c)
        assert str(caught.value).splitlines()[0].endswith(f"at t = 0, x = [{c:.17g}], parameters = [{c:.17g}]")
        assert (caught.value.argument, caught.value.function) == ("h", "folded")
    with pytest.raises(gv.TraceError, match=REFUSED):
        gv.smooth(STILL, of, [0.0], [[0.0]], prior=at(c), method="ekf")
    assert np.isfinite(run(of, c, method="sr-ckf").mean).all()


def test_a_kink_that_parameters_move_is_refused():
    assert run(sensor(), 0.0).innovation_cov.item() == pytest.approx(1.25)
    with pytest.raises(gv.TraceError, match=REFUSED):
        run(sensor().with_params(c=0.0), 0.0)
    with pytest.raises(gv.TraceError, match=REFUSED):
        run(sensor(), 0.0, params={"c": 0.0})
    z, values = np.zeros((3, 1, 1)), {"c": [0.3, 0.4, 0.0]}
    with pytest.raises(gv.TraceError, match="(?s)^track 2: .*" + REFUSED[4:]) as caught:
        gv.filter(STILL, sensor(), [0.0], z, prior=at(0.0), params=values, method="ekf")
    assert caught.value.track == 2


def test_a_kink_at_the_prior_of_a_track_is_refused_and_compare_goes_on_with_other_methods():
    z = np.zeros((3, 1, 1))
    with pytest.raises(gv.TraceError, match="track 1: "):
        gv.filter(STILL, sensor(), [0.0], z, prior=[at(0.0), at(0.3), at(1.0)], method="ekf")
    table = gv.compare(STILL, sensor(), [0.0], [[0.0]], prior=at(0.3), methods=["ekf", "sr-ckf"])
    assert [(one.method, one.rows) for one in table] == [("ekf", 0), ("sr-ckf", 1)]
    assert isinstance(table[0].failed[0], gv.TraceError)


def test_what_moves_is_compared_there_too_and_after_a_pickle():
    model = gv.Sde(folded, diffusion=[1.0], state=["a"])
    plain = sensor(lambda t, x: x)
    for of in (model, pickle.loads(pickle.dumps(model))):
        with pytest.raises(gv.TraceError, match="in folded: .* which `cd-ekf` takes"):
            gv.filter(of, plain, [0.0], [[0.0]], prior=at(0.3), method="cd-ekf")
        with pytest.raises(gv.TraceError, match="which `simulate` takes"):
            gv.simulate(of, plain, [0.0, 1.0], prior=at(0.3), seed=1)
    varied = gv.Transition(lambda t, dt, x: folded(t, x), noise_cov=[[0.1]], state=["a"])
    with pytest.raises(gv.TraceError, match="which `ekf` takes"):
        gv.filter(varied, plain, [0.0], [[0.0]], prior=at(0.3), method="ekf")


def test_a_function_of_controls_is_compared_with_those_of_the_first_row():
    model = gv.Transition(lambda t, dt, x, u: x, noise_cov=[[0.1]], state=["a"], controls=["c"])
    of = sensor(lambda t, x, u: np.sign(x - u) * np.abs(x - u))
    gv.filter(model, of, [0.0], [[0.0]], prior=at(2.0), u={"c": 1.0}, method="ekf")
    with pytest.raises(gv.TraceError, match="which `ekf` takes"):
        gv.filter(model, of, [0.0], [[0.0]], prior=at(2.0), u={"c": 2.0}, method="ekf")
    with pytest.raises(gv.TraceError, match="which `ekf` takes"):
        gv.Filter(model, of, prior=at(2.0), t0=0.0, u=[2.0], method="ekf")


def test_kinks_and_steps_at_the_prior_are_no_slopes():
    def bent(t, x):
        return np.abs(x) + np.maximum(x, 0) + np.clip(x, 0, 1) + np.floor(x) + np.where(x > 0, 1.0, 0.0)

    assert np.isfinite(run(sensor(bent), 0.0).mean).all()
    assert np.isfinite(run(sensor(bent), 1.0).mean).all()


def test_sixty_four_points_of_a_batch_are_compared_each_of_them_once(monkeypatch):
    from givens._trace.derivatives import Watch

    counted = []
    real = Watch.at
    monkeypatch.setattr(Watch, "at", lambda self, *point: counted.append(point) or real(self, *point))
    z = np.zeros((100, 1, 1))
    gv.filter(STILL, sensor(), [0.0], z, prior=[at(1.0 + k) for k in range(100)], method="ekf")
    assert len(counted) == 64
    counted.clear()
    gv.filter(STILL, sensor(lambda t, x: np.sin(x)), [0.0], z, prior=at(1.0), method="ekf")
    gv.filter(STILL, sensor(), [0.0], z, prior=at(1.0), method="sr-ckf")
    assert not counted


def test_a_comparison_takes_less_than_a_millisecond():
    n = 7

    def h(t, x, *, c=0.3):
        return [np.sign(x[i] - c) * np.abs(x[i] - c) + np.sin(x[i - 1]) for i in range(n)]

    model = gv.Transition(lambda t, dt, x: x, noise_cov=np.eye(n), state=[f"s{i}" for i in range(n)])
    of = gv.Sensor(h, measures=[f"z{i}" for i in range(n)], std=np.ones(n))
    part = of._traced(model.state, ())["h"]
    part.steep_at(0.0, np.zeros(n), np.empty(0), np.array([0.4]))
    seconds = []
    for k in range(20):
        begun = time.perf_counter()
        part.steep_at(0.0, np.full(n, 1.0 + k), np.empty(0), np.array([0.4]))
        seconds.append(time.perf_counter() - begun)
    assert min(seconds) < 1e-3


@pytest.mark.parametrize("mean", [1e3, 1e7, 3.3e9, 1e12])
def test_waves_that_a_long_step_goes_over_are_no_wrong_slope(mean):
    model = gv.Transition(lambda t, dt, x: x, noise_cov=[[0.1]], state=["x"])
    wave = gv.Sensor(lambda t, x: [np.sin(x[0]) + np.abs(x[0])], measures=["z"], std=[1.0])
    prior = gv.Gaussian([mean], std=[mean * 1e-6])
    gv.filter(model, wave, [0.0], [[mean]], prior=prior, method="ekf")


@pytest.mark.parametrize("mean", [1.0, 1e3, 1e6])
def test_a_lost_slope_is_found_far_from_zero(mean):
    model = gv.Transition(lambda t, dt, x: x, noise_cov=[[0.1]], state=["x"])
    bent = gv.Sensor(lambda t, x: [np.sign(x[0] - mean) * np.abs(x[0] - mean)], measures=["z"], std=[1.0])
    with pytest.raises(gv.TraceError, match="derivative"):
        gv.filter(model, bent, [0.0], [[0.0]], prior=gv.Gaussian([mean], std=[1.0]), method="ekf")

"""Whatever number or word stands for an argument, what refuses it is the package's own error, or it works."""

import threading
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import givens as gv

WALK = gv.Transition(lambda t, dt, x, *, k=1.0: [k * x[0], x[1]], noise_cov=np.eye(2) * 0.01, state=["a", "b"])
SWING = gv.Sde(lambda t, x, *, k=1.0: [x[1], -k * x[0]], diffusion=[0.0, 0.1], state=["a", "b"])
BOTH = gv.Sensor(lambda t, x: x, measures=["p", "q"], std=[1.0, 1.0], name="both")
PUSHED = gv.Transition(lambda t, dt, x, u: [x[0] + u[0], x[1]], noise_cov=np.eye(2), state=["a", "b"], controls=["e"])
PRIOR = gv.Gaussian([1, 1], std=[1, 1])
T, Z = [0, 1, 2], np.ones((3, 2))
FILE = """
[state]
names = ["x", "v"]
mean = [0, 0]
std = [1, 1]
[parameters]
k = 2.0
[dynamics]
drift = { x = "v", v = "-k*x" }
diffusion = { v = "0.1" }
[[sensor]]
name = "ruler"
measures = { r = "x" }
std = { r = 0.1 }
"""


def run(t=T, z=Z, model=WALK, sensors=BOTH, how=gv.filter, **options):
    return how(model, sensors, t, z, **{"prior": PRIOR, **options})


EST, SMOOTHED, BATCH = run(), run(how=gv.smooth), run(z=np.ones((2, 3, 2)))


def table(**columns):
    return gv.filter(WALK, BOTH, {"time": [0, 1], "p": [1, 1], "q": [1, 1]} | columns, prior=PRIOR)


def sde(f, **options):
    return gv.Sde(f, **{"diffusion": [1], "state": ["x"], **options})


def sensor(**options):
    return gv.Sensor(lambda t, x: x, **{"measures": ["p", "q"], "std": [1, 1], **options})


def steps(**options):
    return gv.Transition(lambda t, dt, x: x, **{"noise_cov": np.eye(2), "state": ["a", "b"], **options})


CALLS = {
    "t": lambda v: run(t=[0, 1, v]),
    "t0": lambda v: run(t0=v),
    "at": lambda v: run(at=[v]),
    "Estimates.at": lambda v: EST.at(v),
    "Batch.at": lambda v: BATCH.at(v),
    "z": lambda v: run(z=[[v, 1], [1, 1], [1, 1]]),
    "u": lambda v: run(model=PUSHED, u={"e": v}),
    "noise": lambda v: run(noise=[[v, 1]] * 3),
    "threads": lambda v: run(z=np.ones((2, 3, 2)), threads=v),
    "threads of at": lambda v: BATCH.at([1], threads=v),
    "params": lambda v: run(params={"k": v}),
    "params of tracks": lambda v: run(z=np.ones((2, 3, 2)), params={"k": [v, 1]}),
    "lag": lambda v: run(how=gv.smooth, lag=v),
    "point": lambda v: run(how=gv.smooth, point=v),
    "substeps": lambda v: run(model=SWING, substeps=v),
    "rtol": lambda v: run(model=SWING, method="cd-ukf", solver="dp5", rtol=v),
    "kappa": lambda v: run(method="ukf", kappa=v),
    "points": lambda v: run(method="qkf", points=v),
    "method": lambda v: run(method=v),
    "option": lambda v: run(**{str(v)[:9] if isinstance(v, str) else "q": v}),
    "draws": lambda v: EST.sample(v, seed=1),
    "draws of paths": lambda v: SMOOTHED.sample(v, seed=1),
    "draws of tracks": lambda v: BATCH.sample(v, seed=1),
    "seed of draws": lambda v: SMOOTHED.sample(1, seed=v),
    "track": lambda v: BATCH.track(v),
    "runs": lambda v: gv.simulate(WALK, BOTH, T, prior=PRIOR, seed=1, runs=v),
    "seed": lambda v: gv.simulate(WALK, BOTH, T, prior=PRIOR, seed=v),
    "substeps of simulate": lambda v: gv.simulate(SWING, BOTH, T, prior=PRIOR, seed=1, substeps=v),
    "t of simulate": lambda v: gv.simulate(WALK, BOTH, [0, v], prior=PRIOR, seed=1),
    "mean": lambda v: gv.Gaussian([v, 1], std=[1, 1]),
    "std": lambda v: gv.Gaussian([1, 1], std=[v, 1]),
    "cov": lambda v: gv.Gaussian([1], [[v]]),
    "Filter": lambda v: gv.Filter(WALK, BOTH, prior=PRIOR, t0=v),
    "predict": lambda v: gv.Filter(WALK, BOTH, prior=PRIOR, t0=0).predict(v),
    "update": lambda v: gv.Filter(WALK, BOTH, prior=PRIOR, t0=0).update([v, 1]),
    "sensor of update": lambda v: gv.Filter(WALK, BOTH, prior=PRIOR, t0=0).update([1, 1], v),
    "u of Filter": lambda v: gv.Filter(PUSHED, BOTH, prior=PRIOR, t0=0, u=[v]),
    "parse_model": lambda v: gv.parse_model(FILE, k=v),
    "with_params of a file": lambda v: gv.parse_model(FILE).with_params(k=v),
    "with_params": lambda v: WALK.with_params(k=v),
    "default": lambda v: sde(lambda t, x, *, k=v: [k * x[0]] if not isinstance(v, str) else x),
    "step": lambda v: steps(step=v),
    "noise_cov": lambda v: steps(noise_cov=[[v, 0], [0, 1]]),
    "diffusion": lambda v: sde(lambda t, x: x, diffusion=[v]),
    "std of a sensor": lambda v: sensor(std=[v, 1]),
    "cov of a sensor": lambda v: sensor(std=None, cov=[[v, 0], [0, 1]]),
    "angles": lambda v: sensor(angles={"p": v}),
    "a constant": lambda v: sde(lambda t, x: [v]),
    "a factor": lambda v: sde(lambda t, x: [v * x[0]]),
    "an exponent": lambda v: sde(lambda t, x: [x[0] ** v]),
    "a base": lambda v: sde(lambda t, x: [v ** x[0]]),
    "an index": lambda v: sde(lambda t, x: [x[v]]),
    "a bound": lambda v: sde(lambda t, x: np.clip(x, 0, v)),
    "check_at": lambda v: sde(lambda t, x: x, check_at=[v]),
    "called": lambda v: run(model=gv.Sde(lambda t, x: [v, v], diffusion=[1, 1], state=["a", "b"], trace=False)),
    "merge": lambda v: gv.merge({"a": ([0, v], [[1], [v]])}),
    "truth": lambda v: gv.compare(WALK, BOTH, T, Z, prior=PRIOR, methods=["ekf"], truth=[[v, 1]] * 3),
    "methods of compare": lambda v: gv.compare(WALK, BOTH, T, Z, prior=PRIOR, methods=[v]),
    "methods": lambda v: gv.methods(v),
    "time of a table": lambda v: table(time=[0, v]),
    "measure of a table": lambda v: table(p=[1, v]),
    "track_id": lambda v: table(track_id=[v, v]),
    "sensor of a table": lambda v: table(sensor=[v, v]),
    "name of a sensor": lambda v: run(sensors=sensor(name=v)),
    "name of a measure": lambda v: run(sensors=sensor(measures=[v, "q"])),
    "name of a state": lambda v: run(model=steps(state=[v, "b"])),
    "name of a control": lambda v: run(model=steps(controls=[v]), u=[[1]] * 3),
}
VALUES = [
    *(10**5000, -(10**400), 2**64, -(2**63), 2**31 - 1, 2**32 - 1, 2**32, -1, 0, 1.5, np.inf, np.nan),
    *(Decimal("1e400"), Fraction(10**400, 3), np.longdouble("1e4000"), np.uint64(2**64 - 1), True, 1j, "\ud800", None, [1]),
]
#: Those would not be refused, where there is memory enough, but take long.
LONG = {
    *((name, 2**31 - 1) for name in ("substeps", "substeps of simulate", "draws", "draws of paths", "draws of tracks")),
    *(("runs", count) for count in (2**31 - 1, 2**32 - 1)),
}


@pytest.mark.filterwarnings("ignore::givens.DoubtWarning")
@pytest.mark.parametrize("name", CALLS)
def test_what_refuses_an_absurd_value_is_an_error_of_the_package(name):
    for value in VALUES:
        if isinstance(value, int) and (name, value) in LONG:
            continue
        try:
            CALLS[name](value)
        except gv.GivensError as error:
            assert str(error)


SAID = {
    "threads": "`threads` is 4294967296\n  help: give a whole number, from 1 to 2147483647",
    "draws": "`n` is 4294967296\n  help: give a whole number, from 0 to 2147483647",
    "runs": "`runs` is 4294967296\n  help: give a whole number, from 0 to 4294967295",
}


@pytest.mark.parametrize("name", SAID)
def test_a_count_out_of_range_is_told_with_the_range(name):
    with pytest.raises(gv.InputError) as caught:
        CALLS[name](2**32)
    assert str(caught.value) == SAID[name]


HUGE = {
    "substeps": "`substeps` is a number beyond 1.8e308\n  help: give a smaller one",
    "step": "`step` is a number beyond 1.8e308\n  help: a step is longer than 0",
    "angles": "`angles`: the period of `p` is a number beyond 1.8e308\n  help: a period is longer than 0: 2π of radians, 360 of degrees",
    "with_params": "`with_params`: the parameter `k` is a number beyond 1.8e308\n  help: measure it in a larger unit",
    "z": "`z` is not an array of real numbers: it holds a number beyond 1.8e308\n  help: measure it in a larger unit",
    "seed": "`seed` is a number beyond 1.8e308\n  help: give a whole number, from 0 to 18446744073709551615",
}


@pytest.mark.parametrize("name", HUGE)
def test_a_number_that_no_float_can_tell_is_called_so(name):
    with pytest.raises(gv.InputError) as caught:
        CALLS[name](10**5000)
    assert str(caught.value) == HUGE[name]


def test_draws_for_which_there_is_no_memory_are_refused():
    long = {"t": np.arange(3000), "z": np.ones((3000, 2))}
    batch = run(t=long["t"], z=[long["z"]] * 2)
    for draw in (run(**long).sample, run(**long, how=gv.smooth).sample, batch.sample):
        with pytest.raises(gv.InputError, match="`n` is 2147483647: they need .* bytes at once, more than the") as caught:
            draw(2**31 - 1, seed=1)
        assert caught.value.remedy == "draw fewer at a time, each time with another seed"
    with pytest.raises(gv.InputError, match="`runs` is 4294967295: they need .* bytes at once"):
        gv.simulate(WALK, BOTH, long["t"], prior=PRIOR, seed=1, runs=2**32 - 1)


AT_WORK = (
    "the filter is at work: another thread, or a function of its own model, cannot use it meanwhile\n"
    "  help: give each thread a filter of its own: f.copy()"
)


@pytest.mark.parametrize(
    "use",
    [
        *(lambda f: f.time, lambda f: f.state, lambda f: f.innovation, lambda f: f.innovation_cov, lambda f: f.nis),
        *(lambda f: f.nis_dof, lambda f: f.log_likelihood, lambda f: f.copy(), lambda f: f.predict(9.0), repr),
        lambda f: f.update([1.0, 1.0]),
    ],
)
def test_a_filter_that_is_used_by_its_own_model_is_told(use):
    def drift(t, x):
        use(f)
        return 0 * x

    model = gv.Sde(drift, diffusion=[1.0, 1.0], state=["a", "b"], trace=False)
    f = gv.Filter(model, BOTH, prior=PRIOR, t0=0.0, method="cd-ukf")
    with pytest.raises(gv.InputError) as caught:
        f.predict(1.0)
    assert str(caught.value) == AT_WORK
    # the filter goes on
    assert f.time == 0.0


def test_a_filter_that_another_thread_steps_is_told():
    begun, looked, seen = threading.Event(), threading.Event(), []

    def drift(t, x):
        begun.set()
        looked.wait(5)
        return 0 * x

    model = gv.Sde(drift, diffusion=[1.0, 1.0], state=["a", "b"], trace=False)
    f = gv.Filter(model, BOTH, prior=PRIOR, t0=0.0, method="cd-ukf")

    def look():
        begun.wait(5)
        try:
            f.update([1.0, 1.0])
        except gv.InputError as error:
            seen.append(str(error))
        looked.set()

    other = threading.Thread(target=look)
    other.start()
    f.predict(1.0)
    other.join()
    assert seen == [AT_WORK] and f.time == 1.0

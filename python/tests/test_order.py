"""Functions whose arguments stand in another order than that of a model."""

import numpy as np
import pytest

import givens as gv

ONE, TWO = ["a"], ["a", "b"]


def backwards(x, t):
    return -x


def spelled_out(state, time):
    return -state


REFUSED = [
    (
        lambda: gv.Sde(backwards, diffusion=[1.0], state=ONE),
        "`drift`: backwards takes (x, t), but it is given (t, x)\n"
        "  help: write def backwards(t, x), the time first, then the state",
    ),
    (
        lambda: gv.Sde(spelled_out, diffusion=[1.0], state=ONE, trace=False),
        "`drift`: spelled_out takes (state, time), but it is given (t, x)\n"
        "  help: write def spelled_out(t, x), the time first, then the state",
    ),
    (
        lambda: gv.Sde(lambda y, t: -y, diffusion=[1.0], state=ONE),
        "`drift`: <lambda> takes (y, t), but it is given (t, x)\n"
        "  help: write lambda t, x: …, the time first, then the state",
    ),
    (
        lambda: gv.Sde(lambda x, t, u: -x, diffusion=[1.0], state=ONE, controls=["c"]),
        "`drift`: <lambda> takes (x, t, u), but it is given (t, x[, u])\n"
        "  help: write lambda t, x, u: …, the time first, then the state, then the controls",
    ),
    (
        lambda: gv.Sde(lambda x, u: -x, diffusion=[1.0], state=ONE),
        "`drift`: <lambda> takes (x, u), but it is given (t, x)\n"
        "  help: write lambda t, x: …, the time first, then the state; controls are named in controls=[…]",
    ),
    (
        lambda: gv.Transition(lambda t, x, dt: -x, noise_cov=[[1.0]], state=ONE),
        "`f`: <lambda> takes (t, x, dt), but it is given (t, dt, x)\n"
        "  help: write lambda t, dt, x: …, the time first, then the step, then the state",
    ),
    (
        lambda: gv.Sde(lambda t, x: -x, diffusion=lambda x, t: [1.0], state=ONE),
        "`diffusion`: <lambda> takes (x, t), but it is given (t, x)\n"
        "  help: write lambda t, x: …, the time first, then the state",
    ),
    (
        lambda: gv.Sde(lambda t, x: -x, diffusion=lambda x: x, state=ONE),
        "`diffusion`: <lambda> takes (x), but it is given (t, x)\n  help: write def diffusion(t, x, *, parameter=1.0)",
    ),
    (
        lambda: gv.Transition(lambda t, dt, x: x, noise_cov=lambda t, x: [[1.0]], state=ONE),
        "`noise_cov`: <lambda> takes (t, x), but it is given (t, dt)\n"
        "  help: write def noise_cov(t, dt): it may not depend on the state",
    ),
    (
        lambda: gv.Sde(lambda t, x, u: -x, diffusion=[1.0], state=ONE),
        "`drift`: <lambda> takes (t, x, u), but the model has no controls\n"
        '  help: name them with the model: controls=["thrust"]; a parameter has a default: *, u=1.0',
    ),
    (
        lambda: gv.Transition(lambda t, dt, x, control: x, noise_cov=[[1.0]], state=ONE),
        "`f`: <lambda> takes (t, dt, x, control), but the model has no controls\n"
        '  help: name them with the model: controls=["thrust"]; a parameter has a default: *, control=1.0',
    ),
]


@pytest.mark.parametrize(("make", "message"), REFUSED)
def test_names_that_contradict_their_places_are_refused(make, message):
    with pytest.raises(gv.InputError) as caught:
        make()
    assert str(caught.value) == message
    assert not isinstance(caught.value, gv.TraceError)


def test_a_sensor_is_told_of_the_controls_of_its_model():
    model = gv.Sde(lambda t, x: -x, diffusion=[1.0], state=ONE)
    sensor = gv.Sensor(lambda t, x, u: x + u, measures=["z"], std=[1.0])
    with pytest.raises(gv.InputError, match="`h`: <lambda> takes .t, x, u., but the model has no controls"):
        gv.filter(model, sensor, [0.0], [[1.0]], prior=gv.Gaussian([0.0], std=[1.0]))


def subscript(s, p):
    return [s[1], -s[0]]


def unpacked(s, p):
    a, b = s
    return [b, -a]


def looped(s, p):
    return [value for value in s]


def starred(s, p):
    return [*s]


def measured(s, p):
    return np.ones(len(s))


@pytest.mark.parametrize("function", [subscript, unpacked, looped, starred, measured])
def test_a_time_that_is_taken_for_the_state_names_the_order(function):
    name = function.__name__
    with pytest.raises(gv.TraceError) as caught:
        gv.Sde(function, diffusion=[1.0, 1.0], state=TWO)
    said = str(caught.value).partition("`: ")[2]
    assert said == (
        f"write {name}(t, x): `s` is the time, one number, and taken for an array\n"
        "  help: the time comes first, then the state"
    )


def test_a_step_that_is_taken_for_the_state_names_the_order():
    def moved(t, s, p):
        return [s[1], -s[0]]

    with pytest.raises(gv.TraceError, match=r"`: write moved\(t, dt, x\): `s` is the step, one number"):
        gv.Transition(moved, noise_cov=np.eye(2), state=TWO)


def test_other_numbers_that_are_taken_for_arrays_do_not_blame_the_order():
    with pytest.raises(gv.TraceError, match="one number is taken for an array\n  help: x and u are arrays"):
        gv.Sde(lambda t, x: x[0][1], diffusion=[1.0, 1.0], state=TWO)


def test_names_that_say_nothing_are_taken_as_they_stand():
    for drift in (lambda t, y: -y, lambda time, u: -u, lambda _, s: -s, lambda a, b: -b, lambda t, x, /: -x):
        gv.Sde(drift, diffusion=[1.0], state=ONE)

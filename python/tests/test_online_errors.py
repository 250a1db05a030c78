"""What is said of a filter that is stepped the wrong way."""

import numpy as np
import pytest

import givens as gv

RULER = gv.Sensor(lambda t, x: x[:1], measures=["z"], std=[0.1])
PRIOR = gv.Gaussian([1.0], std=[1.0])
STEPS = gv.Transition(lambda t, dt, x: x, noise_cov=[[1.0]], state=["x"], step=0.5)
FLOW = gv.Sde(lambda t, x: -x, diffusion=[0.1], state=["x"])


def test_a_prediction_into_the_past_names_the_copy():
    f = gv.Filter(FLOW, RULER, prior=PRIOR, t0=0.0)
    early = f.copy()
    f.predict(1.0)
    with pytest.raises(gv.StepError) as caught:
        f.predict(0.5)
    assert str(caught.value) == (
        "t = 1: cannot predict back to t = 0.5\n"
        "  help: give times in order, or go on from a copy() made before that time"
    )
    assert (caught.value.fault, f.time) == ("backwards", 1.0)
    early.predict(0.5)


def test_seconds_in_an_error_say_what_they_are_counted_from():
    f = gv.Filter(FLOW, RULER, prior=PRIOR, t0=np.datetime64("2021-05-01T12:00:10"))
    with pytest.raises(gv.StepError, match="cannot predict back to t = -10") as caught:
        f.predict(np.datetime64("2021-05-01T12:00:00"))
    (note,) = caught.value.__notes__
    assert note.startswith("t is in seconds since 2021-05-01T12:00:10")


def test_a_gap_between_steps_names_them():
    f = gv.Filter(STEPS, RULER, prior=PRIOR, t0=0.0)
    with pytest.raises(gv.StepError) as caught:
        f.predict(0.7)
    assert str(caught.value) == (
        "t = 0: a gap of 0.7 is not a whole number of steps of 0.5\n"
        "  help: put the times on whole steps, or write the transition in `dt` and leave `step` out"
    )

"""Words for small mistakes, each of which names what is meant."""

import numpy as np
import pytest

import givens as gv

SENSOR = gv.Sensor(lambda t, x: x, measures=["z"], std=[1.0])
PRIOR = gv.Gaussian([0.0], std=[1.0])


def model(f=lambda t, dt, x, *, k=1.0: k * x, **options):
    return gv.Transition(f, **{"noise_cov": [[0.1]], "state": ["x"], **options})


def batch(runs, **options):
    return gv.filter(model(), SENSOR, [0.0, 1.0], np.zeros((runs, 2, 1)), prior=PRIOR, **options)


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf])
def test_a_parameter_of_a_track_that_is_no_number_names_argument_parameter_and_track(wrong):
    said = "NaN" if np.isnan(wrong) else str(wrong)
    for values, track in (([1.0, wrong, 1.0], 1), ({0: 1.0, 1: 1.0, 2: wrong}, 2)):
        with pytest.raises(gv.InputError) as caught:
            batch(3, params={"k": values})
        error = caught.value
        assert str(error) == f"track {track}: `params`: the parameter `k` is {said}\n  help: give a finite number"
        assert (error.argument, error.component, error.track) == ("params", "k", track)
    for call in (gv.filter, lambda *a, **o: gv.simulate(*a[:3], seed=1, **o)):
        with pytest.raises(gv.InputError, match=f"^`params`: the parameter `k` is {said}\n  help: give a finite number$"):
            call(model(), SENSOR, [0.0], [[0.0]], prior=PRIOR, params={"k": wrong})


def test_a_noise_that_is_missing_is_told_to_be():
    with pytest.raises(gv.InputError) as caught:
        model(noise_cov=None)
    written = "give numbers, or write def noise_cov(t, dt): return […]"
    assert str(caught.value) == f"`noise_cov` is missing\n  help: {written}"
    with pytest.raises(gv.InputError, match="^`diffusion` is missing"):
        gv.Sde(lambda t, x: x, diffusion=None, state=["x"])


def test_a_track_beyond_the_last_is_told_how_many_there_are():
    for runs, words in ((3, "there are 3 tracks"), (1, "there is one track"), (0, "there are 0 tracks")):
        with pytest.raises(IndexError, match=f"^there is no track number 7: {words}, numbered from 0$"):
            batch(runs)[7]
    with pytest.raises(gv.InputError, match=r"(?s)not by names such as 'a'.*batch.track\('a'\) takes names"):
        batch(3)["a"]

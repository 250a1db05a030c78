"""The words of a figure are those of `consistency`."""

import numpy as np
import pytest

import givens as gv

WALK = gv.Transition(lambda t, dt, x: x, noise_cov=[[0.01]], state=["x"])
SENSOR = gv.Sensor(lambda t, x: x, measures=["z"], std=[1.0])
T = np.arange(200.0)
NOISE = np.random.default_rng(4).normal(size=(200, 1))
CASES = {
    "large": (9 * NOISE, "overconfident (innovations larger than expected): mean NIS "),
    "small": (0.1 * NOISE, "underconfident (innovations smaller than expected): mean NIS "),
    "right": (NOISE, "consistent: mean NIS "),
    "slow": (1.49 * np.sin(T / 3)[:, None], "consistent in size: mean NIS "),
    "nothing": (np.full((200, 1), np.nan), "nothing was measured"),
}


@pytest.mark.parametrize("case", CASES)
def test_a_figure_says_what_consistency_says(case):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    z, begins = CASES[case]
    one = gv.filter(WALK, SENSOR, T, z, prior=gv.Gaussian([0.0], std=[1.0]))
    batch = gv.filter(WALK, SENSOR, T, np.stack([z, z]), prior=gv.Gaussian([0.0], std=[1.0]))
    for of in (one, batch):
        words = str(of.consistency())
        assert of is batch or words.startswith(begins), words
        figure = of.plot()
        title = figure.axes[-1].get_title(loc="left")
        assert title.replace("\n", " ") == words.replace("; ", " ")
        assert len(title.splitlines()) == (1 if case == "nothing" else 3)
        pyplot.close(figure)
    related = "innovations related to those before: the model may miss something" in str(one.consistency())
    assert related == (case == "slow")

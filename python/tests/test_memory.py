"""What there is no memory for is refused before it is begun, where the system would end the program."""

import numpy as np
import pytest
from test_running import LENGTH, MODEL, PRIOR, T, Z

import givens as gv
from givens import _memory

PIECES = "draw fewer at a time, each time with another seed"


def test_the_system_tells_how_much_is_free():
    assert 2**20 < _memory.free() < 2**60


@pytest.mark.parametrize("how", [gv.filter, gv.smooth])
def test_draws_beyond_the_free_memory_are_refused_with_their_bytes(monkeypatch, how):
    monkeypatch.setattr(_memory, "free", lambda: 3 * 10**9)
    one = how(MODEL, LENGTH, T[:3], Z[:3], prior=PRIOR)
    batch = how(MODEL, LENGTH, T[:3], np.stack([Z[:3]] * 2), prior=PRIOR)
    each = 96 if how is gv.filter else 48 + 320
    for draw, bytes_of_one in ((one.sample, each), (batch.sample, 4 * each)):
        with pytest.raises(gv.InputError) as caught:
            draw(10**9, seed=1)
        said = f"`n` is 1000000000: they need {bytes_of_one * 1e9:.3g} bytes at once, more than the 3e+09 that are free"
        assert str(caught.value) == f"{said}\n  help: {PIECES}"
        assert caught.value.argument == "n"
    assert one.sample(100, seed=1).shape == (100, 3, 2)


def test_runs_beyond_the_free_memory_are_refused(monkeypatch):
    monkeypatch.setattr(_memory, "free", lambda: 10**8)
    with pytest.raises(gv.InputError, match=r"^`runs` is 10000000: they need 1.44e\+09 bytes at once, more than the 1e\+08"):
        gv.simulate(MODEL, LENGTH, T[:3], prior=PRIOR, seed=1, runs=10**7)
    monkeypatch.setattr(_memory, "free", lambda: None)
    assert gv.simulate(MODEL, LENGTH, T[:3], prior=PRIOR, seed=1, runs=10**6).x.shape == (10**6, 3, 2)


@pytest.mark.parametrize("tracks", [1, 4])
def test_estimates_beyond_the_free_memory_are_refused(monkeypatch, tracks):
    monkeypatch.setattr(_memory, "free", lambda: 2**26)
    rows = 400_000
    z = np.full((tracks, rows // tracks, 1), np.nan)
    with pytest.raises(gv.InputError, match=r"^the estimates of 400000 rows need 1.41e8 bytes, more than there is") as caught:
        gv.smooth(MODEL, LENGTH, np.arange(rows // tracks) + 1.0, z[0] if tracks == 1 else z, prior=PRIOR)
    assert "fewer tracks" in str(caught.value)

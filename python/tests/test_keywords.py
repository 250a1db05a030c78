"""Keywords that are no option of a method, and what was meant."""

import numpy as np
import pytest
from test_running import LENGTH, MODEL, PRIOR, T, Z

import givens as gv

NOISE = "write noise=…, row by row, or the noise into the sensor: std=[…]"
MEANT = [
    ({"priors": PRIOR}, "did you mean `prior`?"),
    ({"x0": PRIOR}, "did you mean `prior`?"),
    ({"R": np.eye(1)}, NOISE),
    ({"R": 0.1}, NOISE),
    ({"noises": Z}, "did you mean `noise`?"),
    ({"controls": np.zeros((20, 1))}, "did you mean `u`? `controls` of the model names them"),
    ({"T0": 0.0}, "did you mean `t0`?"),
    ({"thread": 2}, "did you mean `threads`?"),
    ({"param": {"k": 1.0}}, "did you mean `params`?"),
    ({"parameters": {"k": 1.0}}, "did you mean `params`?"),
    ({"substep": 3}, "did you mean `substeps`?"),
    ({"substep": [3]}, "did you mean `substeps`?"),
    ({"xyz": [3]}, "gv.methods() lists all methods with their options"),
    ({"lag": 3}, "gv.smooth takes it"),
]


@pytest.mark.parametrize("case", MEANT, ids=[str(*given) for given, _ in MEANT])
def test_the_argument_that_was_meant_is_told(case):
    given, remedy = case
    with pytest.raises(gv.MethodError) as caught:
        gv.filter(MODEL, LENGTH, T, Z, **{"prior": PRIOR, **given})
    assert caught.value.message == f"there is no option `{next(iter(given))}`"
    assert caught.value.remedy == remedy
    assert caught.value.option == next(iter(given))


def test_a_filter_by_hand_tells_it_as_well():
    with pytest.raises(gv.MethodError, match="did you mean `prior`"):
        gv.Filter(MODEL, LENGTH, prior=PRIOR, t0=0.0, priors=PRIOR)
    with pytest.raises(gv.MethodError, match="gv.filter and gv.smooth take it"):
        gv.Filter(MODEL, LENGTH, prior=PRIOR, t0=0.0, at=T)

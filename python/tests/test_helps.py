"""Mistakes of a first day, each with what to do about it."""

import numpy as np
import pytest
from test_data import PUSHED, WALK, Z2
from test_running import LENGTH, MODEL, PRIOR, T, Z

import givens as gv

BOTH = gv.Sensor(lambda t, x: x, measures=["p", "q"], std=[1.0, 1.0])
WIDE = gv.Gaussian([1.0, 1.0], std=[1.0, 1.0])


def compared(truth, z=Z):
    return gv.compare(MODEL, LENGTH, T, z, prior=PRIOR, methods=["sr-cd-ckf"], truth=truth)


CASES = {
    "at of two dimensions": (
        lambda: gv.filter(MODEL, LENGTH, T, Z, prior=PRIOR, at=np.zeros((2, 3))),
        "`at` has shape (2, 3), not (times,)\n"
        "  help: times are a vector, the same for all tracks: at=np.unique(…), or one track after the other",
    ),
    "one deviation for two": (
        lambda: gv.Gaussian([0.0, 0.0], std=1.0),
        "`std` has shape (1,), not (2,), the shape of `mean`\n  help: the same for all is std=np.full(2, …)",
    ),
    "no controls": (
        lambda: gv.filter(PUSHED, BOTH, [0, 1, 2], Z2, prior=WIDE),
        "`u` is missing: the model has the controls `e`, `f`\n"
        "  help: give u={name: value}, or an array (3, 2): one row for each time",
    ),
    "one control of two": (
        lambda: gv.filter(PUSHED, BOTH, [0, 1, 2], Z2, prior=WIDE, u={"e": 1.0}),
        "`u` has no entry `f`\n  help: give one for each of e, f",
    ),
    "no column of controls": (
        lambda: gv.filter(PUSHED, BOTH, {"time": [0, 1], "p": [1, 1], "q": [1, 1]}, prior=WIDE),
        "the table has no column `u_e` for the control `e`\n  help: add it: its values hold from their rows on; or give u=…, row by row or {name: number}",
    ),
    "truth that is short": (
        lambda: compared(np.zeros((7, 2))),
        "`truth` has shape (7, 2), not (20, 2)\n"
        "  help: one row for each row of the estimates, one column for each of x, v",
    ),
    "truth that is turned": (
        lambda: compared(np.zeros((2, 20))),
        "`truth` has shape (2, 20), not (20, 2)\n  help: rows are times: truth=truth.T",
    ),
    "truth of other tracks": (
        lambda: compared(np.zeros((3, 20, 2)), np.stack([Z, Z])),
        "`truth` is of 3 tracks, not 2\n  help: give one for each: a list, or an array of shape (2, rows, 2)",
    ),
}


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_a_mistake_is_told_with_its_remedy(case):
    wrong, expected = case
    with pytest.raises(gv.InputError) as caught:
        wrong()
    assert str(caught.value) == expected


@pytest.mark.filterwarnings("error")
def test_a_lazy_frame_is_told_to_be_collected():
    polars = pytest.importorskip("polars")
    lazy = polars.LazyFrame({"time": T, "length": Z[:, 0]})
    for t, z, name in ((lazy, None, "t"), (T, lazy, "z"), (T, {"ruler": lazy}, "z['ruler']")):
        with pytest.raises(gv.InputError) as caught:
            gv.filter(MODEL, LENGTH, t, z, prior=PRIOR)
        assert str(caught.value) == f"`{name}` is a LazyFrame, which has no rows yet\n  help: {name}.collect()"
    assert len(gv.filter(MODEL, LENGTH, lazy.collect(), prior=PRIOR)) == 20


def test_a_method_of_the_other_kind_does_not_stop_a_comparison():
    table = gv.compare(MODEL, LENGTH, T, Z, prior=PRIOR, methods=["ckf", "sr-cd-ckf", "ekf"], truth=np.zeros((20, 2)))
    assert [(one.method, one.rows, len(one.failed)) for one in table] == [("ckf", 0, 1), ("sr-cd-ckf", 20, 0), ("ekf", 0, 1)]
    assert isinstance(table[0].failed[0], gv.MethodError) and "discrete-time" in str(table[0].failed[0])
    assert [row["verdict"] == "not run" for row in table.rows()] == [True, False, True]
    assert "not run" in repr(table) and "not run" in table._repr_html_()
    pytest.importorskip("pandas")
    assert list(table.to_pandas().index) == ["ckf", "sr-cd-ckf", "ekf"]


def test_a_method_that_does_not_exist_and_methods_of_which_none_can_run_stop_it():
    with pytest.raises(gv.MethodError, match="did you mean"):
        gv.compare(MODEL, LENGTH, T, Z, prior=PRIOR, methods=["sr-cd-ckf", "sr-cd-ckff"])
    with pytest.raises(gv.MethodError, match="the model is continuous"):
        gv.compare(MODEL, LENGTH, T, Z, prior=PRIOR, methods=["ckf", "ekf"])
    with pytest.raises(gv.MethodError, match="the model is discrete"):
        gv.compare(WALK, BOTH, [0, 1, 2], Z2, prior=WIDE, methods=["cd-ckf"])

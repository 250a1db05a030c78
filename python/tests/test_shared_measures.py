"""Two sensors whose measures have one name: a table must say whose a number is."""

import numpy as np
import pytest
from test_running import MODEL, PRIOR, T, Z, same

import givens as gv

TWO = [gv.Sensor(lambda t, x: x[:1], measures=["p"], std=[0.1], name=name) for name in ("left", "right")]
COLUMNS = {"time": T, "p": Z[:, 0]}


def run(table, z=None):
    return gv.filter(MODEL, TWO, table, z, prior=PRIOR)


def test_a_number_is_not_counted_for_each_sensor_of_that_name():
    with pytest.raises(gv.InputError) as caught:
        run(COLUMNS)
    assert str(caught.value) == (
        "the column `p` may be of `left`, `right`, which all measure `p`\n"
        "  help: add a column `sensor` that names the sensor of each row, or give the measures other names"
    )
    assert caught.value.component == "p" and caught.value.argument == "z"


def test_with_a_column_of_sensors_each_has_its_own():
    named = run({**COLUMNS, "sensor": ["left", "right"] * 10})
    assert named.nis_dof.tolist() == [1] * 20
    z = np.full((20, 2), np.nan)
    z[::2, 0], z[1::2, 1] = Z[::2, 0], Z[1::2, 0]
    same(named, run(T, z))


def test_a_row_without_a_sensor_is_refused_unless_it_measures_nothing():
    sensors = ["left", "right"] * 9 + ["left", None]
    with pytest.raises(gv.InputError, match=r"^row 19 of the table names no sensor, and `p` may be of `left`, `right`"):
        run({**COLUMNS, "sensor": sensors})
    missing = np.append(Z[:-1, 0], np.nan)
    assert run({**COLUMNS, "p": missing, "sensor": sensors}).nis_dof.tolist() == [1] * 19 + [0]


def test_a_frame_of_measures_is_refused_and_one_for_each_sensor_taken():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"p": Z[:, 0]})
    with pytest.raises(gv.InputError, match=r"give a table for each sensor: z=\{name: table\}"):
        run(T, frame)
    same(run(T, {"left": frame, "right": frame}), run(T, np.hstack([Z, Z])))

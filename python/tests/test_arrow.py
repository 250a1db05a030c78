"""Tables in and out by Arrow's PyCapsule protocol."""

import datetime
import decimal
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_batch import DATES, one_that_fails
from test_data import BOTH, PUSHED, WIDE, Z2, walk
from test_running import LENGTH, MODEL, PRIOR, SPEED, Z3, T, Z, alike, run, same

import givens as gv
from givens import _native
from givens._capsules import LentTable

COLUMNS = ["time", "x", "v", "x_std", "v_std", "nis", "nis_dof", "log_likelihood"]


class Lends:
    """An object of which nothing is known but that it lends its columns, once."""

    def __init__(self, table):
        self.table = table

    def __arrow_c_stream__(self, requested_schema=None):
        table, self.table = self.table, None
        return table.__arrow_c_stream__(requested_schema)


def arrow(columns, **options):
    return pytest.importorskip("pyarrow").table(columns, **options)


def lent(of):
    return LentTable("t", _native.ArrowTable.read(of.__arrow_c_stream__()))


def missing():
    z = Z.copy()
    z[3] = np.nan
    return z


# out


def test_estimates_are_a_table_of_arrow():
    pa = pytest.importorskip("pyarrow")
    est = run(z=missing())
    table = pa.table(est)
    assert table.column_names == COLUMNS
    assert [str(field.type) for field in table.schema] == ["double"] * 6 + ["int64", "double"]
    for name, frame in est.to_pandas().reset_index().items():
        np.testing.assert_array_equal(table[name].to_numpy(), frame)
    assert table["nis"].null_count == 1 and table["nis"][3].as_py() is None
    assert sum(column.null_count for column in table.columns) == 1
    # a schema that is asked for is a wish
    assert pa.table(est, schema=table.schema).equals(table)
    pa.table(est).validate(full=True)


def test_a_batch_is_one_table_that_names_its_tracks():
    pa = pytest.importorskip("pyarrow")
    batch = one_that_fails()
    table = pa.table(batch)
    assert table.column_names == ["track_id", *COLUMNS]
    assert table["track_id"].to_pylist() == [0] * 5 + [1] * len(batch[1])
    np.testing.assert_array_equal(table["x"].to_numpy(), np.concatenate([one.mean[:, 0] for one in batch]))
    assert len(table.to_batches()) == 1
    named = gv.filter(MODEL, LENGTH, [T, T[:7]], [Z, Z[:7]], prior=PRIOR)
    for names, kind in ((["a", "ü"], "large_string"), ([2**62, -1], "int64"), ([0.5, 1.0], "double")):
        named.track_ids = names
        column = pa.table(named)["track_id"]
        assert str(column.type) == kind and column.to_pylist() == [names[0]] * 20 + [names[1]] * 7
    assert pa.table(gv.Batch([])).shape == (0, 0)


@pytest.mark.parametrize("names", [["a", 1], [True, False], [2**63, 0], [datetime.timedelta(1)] * 2])
def test_tracks_that_cannot_be_one_column_are_told(names):
    batch = gv.filter(MODEL, LENGTH, [T, T], [Z, Z], prior=PRIOR)
    batch.track_ids = names
    with pytest.raises(gv.InputError, match="the tracks are named by .*, which cannot be one column") as caught:
        batch.__arrow_c_stream__()
    assert caught.value.argument == "track_id" and "by words, or all by whole numbers" in caught.value.remedy


@pytest.mark.parametrize(
    ("unit", "kind"),
    [("D", "date32[day]"), ("h", "timestamp[s]"), ("s", "timestamp[s]"), ("ms", "timestamp[ms]")]
    + [("us", "timestamp[us]"), ("ns", "timestamp[ns]")],
)
def test_dates_are_those_that_were_given(unit, kind):
    pa = pytest.importorskip("pyarrow")
    days = (np.datetime64("1960-01-01", "D") + np.arange(3) * 9000).astype(f"datetime64[{unit}]")
    column = pa.table(walk(t=days))["time"]
    assert str(column.type) == kind
    np.testing.assert_array_equal(column.to_numpy(), days)


def test_dates_with_a_zone_are_in_utc():
    pa, pandas = pytest.importorskip("pyarrow"), pytest.importorskip("pandas")
    zoned = pandas.to_datetime([0, 123_456_789, 10**9 + 1]).tz_localize("Europe/Berlin")
    est = walk(t=zoned)
    assert str(pa.table(est)["time"].type) == "timestamp[ns, tz=UTC]"
    (again,) = gv.filter(gv.Transition(lambda t, dt, x: x, noise_cov=np.eye(2), state=["a", "b"]), BOTH,
                         Lends(pa.table({"time": zoned, "p": Z2[:, 0], "q": Z2[:, 1], "track_id": [1, 1, 1]})),
                         prior=WIDE, t0=zoned[0])  # fmt: skip
    np.testing.assert_array_equal(again.time, est.time)
    assert str(pa.table(again)["time"].type) == "timestamp[ns, tz=UTC]"


def test_polars_duckdb_and_pandas_read_results():
    polars, duckdb = pytest.importorskip("polars"), pytest.importorskip("duckdb")
    est, batch = run(z=missing(), t=DATES), one_that_fails(dates=True)
    for of in (est, batch):
        frame = polars.DataFrame(of)
        assert frame.equals(of.to_polars())
        pandas = of.to_pandas().reset_index()
        assert frame.columns == list(pandas.columns) and frame.height == len(pandas)
    assert polars.DataFrame(est)["nis"].null_count() == 1
    found = duckdb.sql("select count(*), avg(nis), max(time) from est").fetchall()
    assert found == [(20, pytest.approx(np.nanmean(est.nis)), est.time[-1].item())]
    rows = duckdb.sql("select track_id, count(nis) from batch group by all order by 1").fetchall()
    assert rows == [(0, 5), (1, len(batch[1]))]


def test_no_library_is_needed_to_lend_or_to_borrow():
    program = """
import sys
for name in ("pyarrow", "pandas", "polars"):
    sys.modules[name] = None
import numpy as np
import givens as gv
model = gv.Transition(lambda t, dt, x: x, noise_cov=[[0.1]], state=["x"])
sensor = gv.Sensor(lambda t, x: x, measures=["x"], std=[1.0])
est = gv.filter(model, sensor, [0, 1, 2], [[0.1], [np.nan], [0.2]], prior=gv.Gaussian([0], std=[1]))
class Lends:
    def __arrow_c_stream__(self, requested_schema=None):
        return est.__arrow_c_stream__(requested_schema)
again = gv.filter(model, sensor, Lends(), prior=gv.Gaussian([0], std=[1]))
np.testing.assert_array_equal(again.time, est.time)
np.testing.assert_array_equal(again.innovation[0], est.mean[0])
print(len(again))
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stdout == "3\n", done.stderr


def test_a_stream_that_nobody_reads_is_released():
    est = run()
    for _ in range(3):
        capsule = est.__arrow_c_stream__()
        assert "arrow_array_stream" in repr(capsule)
        del capsule
    capsule = est.__arrow_c_stream__()
    _native.ArrowTable.read(capsule)
    with pytest.raises(gv.InputError, match="input stream is already released"):
        _native.ArrowTable.read(capsule)


@given(
    rows=st.lists(st.tuples(st.floats(), st.integers(-(2**63), 2**63 - 1), st.text(max_size=5)), max_size=20),
    unit=st.sampled_from(["s", "ms", "us", "ns"]),
)
def test_what_is_lent_comes_back(rows, unit):
    f, i, words = (list(column) for column in zip(*rows, strict=True)) if rows else ([], [], [])
    i, ones = np.array(i, dtype=np.int64), np.ones(len(rows), dtype=np.int64)
    columns = [("f", "number", np.array(f, dtype=float)), ("i", "whole", i), (unit, unit, i), ("w", "text", (words, ones))]
    table = _native.ArrowTable.read(_native.arrow_stream(columns))
    assert table.names == ["f", "i", unit, "w"] and len(table) == len(rows)
    np.testing.assert_array_equal(table.column(0)[2], f)
    np.testing.assert_array_equal(table.column(1)[2], i)
    assert table.column(2)[:2] == ("date", unit)
    np.testing.assert_array_equal(table.column(2)[2], i)
    assert table.column(3)[2] == words


# in


def table_of_three():
    return {"time": T, "length": Z3[:, 0], "speed": Z3[:, 1], "both": Z3[:, 2], "note": [[1.0]] * 20}


def test_a_table_that_only_lends_is_read_by_its_columns():
    expected = run([LENGTH, SPEED], z=Z3)
    same(expected, gv.filter(MODEL, [LENGTH, SPEED], Lends(arrow(table_of_three())), prior=PRIOR))
    tracks = {name: [*values, *values] for name, values in table_of_three().items()}
    for names in (["a", "b"], [7, 2**60 + 1]):
        batch = gv.filter(MODEL, [LENGTH, SPEED], Lends(arrow({**tracks, "track_id": np.repeat(names, 20)})), prior=PRIOR)
        assert batch.track_ids == names
        alike(batch.track(names[1]), expected)
    z = Lends(arrow({"both": Z3[:, 2], "length": Z3[:, 0], "speed": Z3[:, 1]}))
    same(run([LENGTH, SPEED], z=z), expected)
    by_sensor = {"ruler": Lends(arrow({"length": Z[:, 0]})), "radar": Lends(arrow({"both": Z3[:, 2], "speed": Z3[:, 1]}))}
    same(run([LENGTH, SPEED], z=by_sensor), expected)
    alike(run(z=[Lends(arrow({"length": Z[:, 0]})) for _ in range(2)])[1], run())
    same(gv.smooth(MODEL, LENGTH, Lends(arrow({"t": T, "length": Z[:, 0]})), prior=PRIOR), gv.smooth(MODEL, LENGTH, T, Z, prior=PRIOR))


def test_every_library_lends_what_is_read():
    polars, duckdb, pandas = (pytest.importorskip(name) for name in ("polars", "duckdb", "pandas"))
    columns = {"time": DATES, "length": missing()[:, 0], "sensor": ["ruler"] * 20}
    frame = polars.DataFrame(columns, nan_to_null=True)
    assert frame["length"].null_count() == 1
    relation = duckdb.sql("select time, length::decimal(30, 20) as length, sensor::enum('ruler') as sensor from frame")
    parts = polars.concat([frame[:7], frame[7:]], rechunk=False)
    for of in (frame, parts, frame.with_columns(polars.col("sensor").cast(polars.Categorical)), pandas.DataFrame(columns)):
        same(gv.filter(MODEL, [LENGTH, SPEED], Lends(of), prior=PRIOR), gv.filter(MODEL, [LENGTH, SPEED], of, prior=PRIOR))
    alone = run([LENGTH, SPEED], t=DATES, z=np.column_stack([missing(), np.full((20, 2), np.nan)]))
    for of in (relation, Lends(relation)):
        found = gv.filter(MODEL, [LENGTH, SPEED], of, prior=PRIOR)
        np.testing.assert_allclose(found.mean, alone.mean, rtol=1e-12)
        np.testing.assert_array_equal(found.time, alone.time)
    np.testing.assert_allclose(run(z=relation.project("length")).mean, run(z=missing()).mean, rtol=1e-12)


def test_controls_noise_and_truth_may_be_lent():
    u = np.column_stack([np.full(3, 0.1), np.full(3, 100.0)])
    expected = gv.filter(PUSHED, BOTH, [0, 1, 2], Z2, prior=WIDE, u=u)
    same(gv.filter(PUSHED, BOTH, [0, 1, 2], Z2, prior=WIDE, u=Lends(arrow({"u_f": u[:, 1], "u_e": u[:, 0]}))), expected)
    noise = np.column_stack([np.full(3, 0.5), np.full(3, 5.0)])
    given_noise = Lends(arrow({"q": noise[:, 1], "p": noise[:, 0]}))
    same(walk(noise=given_noise), walk(noise=noise))
    truth = {"v": np.zeros(20), "x": np.ones(20)}
    tables = [
        gv.compare(MODEL, LENGTH, *data, prior=PRIOR, methods=["cd-ekf", "lskf"], truth=true)
        for data, true in (
            ((T, Z), np.column_stack([truth["x"], truth["v"]])),
            ((Lends(arrow({"time": T, "length": Z[:, 0]})),), Lends(arrow(truth))),
        )
    ]
    assert [one.nees for one in tables[0]] == [one.nees for one in tables[1]]
    drawn = [gv.simulate(MODEL, LENGTH, T, prior=PRIOR, seed=1, noise=n).z for n in (Z**2 + 1, Lends(arrow({"length": Z[:, 0] ** 2 + 1})))]
    np.testing.assert_array_equal(*drawn)


def test_numbers_without_nulls_are_not_copied():
    pa = pytest.importorskip("pyarrow")
    numbers = np.arange(1000.0)
    column = lent(pa.table({"a": numbers}))["a"]
    assert column.ctypes.data == numbers.ctypes.data and not column.flags.writeable
    with pytest.raises(ValueError, match="WRITEABLE"):
        column.setflags(write=True)
    sliced = lent(pa.table({"a": numbers}).slice(10, 5))["a"]
    assert sliced.ctypes.data == numbers.ctypes.data + 80 and sliced.tolist() == [10, 11, 12, 13, 14]
    # what is looked at stays when all else is gone
    own = lent(pa.table({"a": pa.array([1.5, 2.5, 3.5])}))["a"]
    assert own.tolist() == [1.5, 2.5, 3.5]
    assert lent(pa.table({"a": pa.array([1.0, None])}))["a"].tolist()[0] == 1.0


def kinds():
    pa = pytest.importorskip("pyarrow")
    day = datetime.datetime(2024, 2, 29, 12, 0, 1)
    whole = [pa.array([1, 200 % 127, 3], type=of()) for of in (pa.int8, pa.int16, pa.int32, pa.int64, pa.uint8, pa.uint16, pa.uint32, pa.uint64)]
    floats = [pa.array([1.5, None, -2.0], type=of) for of in (pa.float32(), pa.float64())]
    floats.append(pa.array(np.array([1.5, np.nan, -2.0], dtype=np.float16)))
    decimals = [
        pa.array([decimal.Decimal("1.50"), None, decimal.Decimal("-2.00")], type=of)
        for of in (pa.decimal32(5, 2), pa.decimal64(10, 2), pa.decimal128(30, 2))
    ]
    words = [pa.array(["a", None, "ü"], type=of) for of in (pa.string(), pa.large_string(), pa.string_view())]
    words.append(pa.array(["a", None, "ü"]).dictionary_encode())
    dates = [pa.array([day, None, day], type=pa.timestamp(unit)) for unit in ("s", "ms", "us", "ns")]
    durations = [pa.array([1, None, 2], type=pa.duration(unit)) for unit in ("s", "ms", "us", "ns")]
    stamp = np.array([day, "NaT", day], dtype="datetime64[us]")
    yield from ((array, [1, 73, 3]) for array in whole)
    yield from ((array, [1.5, np.nan, -2.0]) for array in (*floats, *decimals))
    yield from ((array, np.array(["a", None, "ü"], dtype=object)) for array in words)
    yield from ((array, stamp) for array in dates)
    yield from ((array, np.array([1, "NaT", 2], dtype=f"timedelta64[{array.type.unit}]")) for array in durations)
    yield pa.array([day.date(), None, day.date()], type=pa.date32()), stamp.astype("datetime64[D]")
    yield pa.array([day.date(), None, day.date()], type=pa.date64()), stamp.astype("datetime64[D]")
    yield pa.array([True, None, False]), [1.0, np.nan, 0.0]
    yield pa.array([1, None, 3]), [1.0, np.nan, 3.0]
    yield pa.array([1, None, 2**63], type=pa.uint64()), [1.0, np.nan, 2.0**63]
    yield pa.array([2**63, 0, 2**64 - 1], type=pa.uint64()), np.array([2**63, 0, 2**64 - 1], dtype=np.uint64)
    yield pa.array([None, None, None]), [np.nan] * 3
    yield pa.array([5, None, 5]).dictionary_encode(), [5, np.nan, 5]
    yield pa.array([None, None, None], type=pa.string()).dictionary_encode(), np.array([None] * 3)
    yield pa.chunked_array([[1.0], [], [None, 3.0]]), [1.0, np.nan, 3.0]
    yield pa.chunked_array([], type=pa.float64()), []


@pytest.mark.parametrize("case", list(kinds()) if "pyarrow" in sys.modules or pytest.importorskip("pyarrow") else [], ids=lambda case: str(case[0].type))
def test_columns_of_every_kind_are_read(case):
    array, expected = case
    found = lent(arrow({"a": array}))["a"]
    found = found.array if hasattr(found, "aware") else found
    np.testing.assert_array_equal(found, expected)
    assert found.dtype.kind != "O" or array.type != "double"


def test_what_cannot_be_borrowed_is_told():
    pa = pytest.importorskip("pyarrow")

    def told(t, **options):
        with pytest.raises(gv.InputError) as caught:
            gv.filter(MODEL, LENGTH, t, prior=PRIOR, **options)
        return caught.value

    error = told(Lends(arrow({"time": [0.0], "length": [[1.0]]})))
    assert str(error) == (
        "the column `length` holds List(Float64), which is neither numbers, dates nor words\n"
        "  help: cast it where the table is made"
    )
    assert (error.argument, error.component) == ("t", "length")
    error = told(Lends(arrow([[0.0], [1.0], [2.0]], names=["time", "length", "length"])))
    assert str(error) == "`t` has the column `length` twice\n  help: leave one of them out, or name it otherwise"
    error = told(Lends(pa.chunked_array([[1.0]])))
    assert error.argument == "t" and error.remedy == "give a table with named columns"
    assert error.message.startswith("`t`: the table could not be read: ")
    error = told(Lends(arrow({"time": ["now"], "length": [1.0]})))
    assert "holds text, not times" in error.message
    error = told(Lends(arrow({"time": [0.0], "length": [datetime.date(2024, 1, 1)]})))
    assert "the column `length` is not an array of real numbers: it holds dates" in error.message
    error = told(Lends(arrow({"time": [0.0], "width": [1.0]})))
    assert "has none of the measures `length`: it has `time`, `width`" in error.message

    class Empty:
        def __arrow_c_stream__(self, requested_schema=None):
            return 1

    assert told(Empty()).message == "`t`: `__arrow_c_stream__` gives no capsule with a stream"

    def broken():
        yield pa.record_batch({"time": [0.0], "length": [1.0]})
        raise RuntimeError("the disk is full")

    schema = pa.schema([("time", pa.float64()), ("length", pa.float64())])
    error = told(pa.RecordBatchReader.from_batches(schema, broken()))
    assert "the table could not be read" in error.message and "the disk is full" in error.message

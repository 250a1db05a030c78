"""Tables of other libraries: nulls, columns of one name, columns that are no numbers, tracks named by dates."""

import numpy as np
import pytest
from test_running import LENGTH, MODEL, PRIOR, T, Z

import givens as gv


def test_a_record_batch_has_nulls_as_a_table_has():
    pa = pytest.importorskip("pyarrow")
    columns = {"time": [0.0, 1.0, 2.0], "length": [1.0, None, 2.0]}
    found, expected = (gv.filter(MODEL, LENGTH, kind(columns), prior=PRIOR) for kind in (pa.record_batch, pa.table))
    np.testing.assert_array_equal(found.mean, expected.mean)
    assert found.nis_dof.tolist() == [1, 0, 1]


@pytest.mark.parametrize(
    "name, said",
    [
        ("length", "the column `length` is not an array of real numbers: it holds {0}\n  help: cast it where the table is made"),
        ("time", "`time` is not an array of real numbers: it holds {0}\n  help: cast it where the table is made"),
        (
            "sensor",
            "the column `sensor` is no list of names: no array holds {0}\n  help: name them by words or whole numbers",
        ),
    ],
)
def test_a_union_is_no_column(name, said):
    pa = pytest.importorskip("pyarrow")
    union = pa.UnionArray.from_sparse(pa.array([0, 0], pa.int8()), [pa.array([1.0, 2.0])])
    columns = {"time": pa.array([0.0, 1.0]), "length": pa.array([0.0, 1.0]), name: union}
    for table in (columns, pa.table(columns)):
        with pytest.raises(gv.InputError) as caught:
            gv.filter(MODEL, LENGTH, table, prior=PRIOR)
        assert str(caught.value) == said.format(union.type)
    with pytest.raises(gv.InputError, match="`z` is not an array of real numbers: it holds sparse_union"):
        gv.filter(MODEL, LENGTH, [0.0, 1.0], union, prior=PRIOR)


def test_two_columns_of_one_name_are_told():
    pa, pandas = pytest.importorskip("pyarrow"), pytest.importorskip("pandas")
    number = pa.array([0.0, 1.0])
    for name, names in (("length", ["time", "length", "length"]), ("time", ["time", "time", "length"])):
        table = pa.Table.from_arrays([number] * 3, names=names)
        for given in (table, pandas.DataFrame(np.zeros((1, 3)), columns=names)):
            with pytest.raises(gv.InputError) as caught:
                gv.filter(MODEL, LENGTH, given, prior=PRIOR)
            remedy = "leave one of them out, or name it otherwise"
            assert str(caught.value) == f"`t` has the column `{name}` twice\n  help: {remedy}"
    others = pa.Table.from_arrays([number] * 4, names=["time", "length", "note", "note"])
    assert len(gv.filter(MODEL, LENGTH, others, prior=PRIOR)) == 2


DAYS = np.array(["2024-01-01", "2024-01-02"], dtype="M8[ns]")


def table_of(kind):
    columns = {"time": [0.0, 1.0], "length": [1.0, 2.0], "track_id": DAYS}
    if kind == "polars":
        polars = pytest.importorskip("polars")
        return polars.DataFrame(columns)
    if kind == "pyarrow":
        pa = pytest.importorskip("pyarrow")
        return pa.table({**columns, "track_id": pa.array(DAYS)})
    return pytest.importorskip("pandas").DataFrame(columns) if kind == "pandas" else columns


@pytest.mark.parametrize("kind", ["numpy", "pandas", "polars", "pyarrow"])
def test_tracks_named_by_nanoseconds_keep_their_names(kind):
    pa, pandas = pytest.importorskip("pyarrow"), pytest.importorskip("pandas")
    table = table_of(kind)
    batch = gv.filter(MODEL, LENGTH, table, prior=PRIOR)
    assert [one.track_id for one in batch] == list(DAYS)
    assert batch.track(DAYS[1]) is batch[1] and batch.track(pandas.Timestamp("2024-01-02")) is batch[1]
    assert pa.table(batch).schema.field("track_id").type == pa.timestamp("ns")
    assert batch.to_pandas().index.levels[0].dtype == "M8[ns]"
    found = gv.filter(MODEL, LENGTH, table, prior={pandas.Timestamp(day): PRIOR for day in DAYS})
    np.testing.assert_array_equal(found[1].mean, batch[1].mean)


def test_tracks_named_by_dates_are_a_column_of_dates():
    pa, pandas = pytest.importorskip("pyarrow"), pytest.importorskip("pandas")
    for kind in (pa.date32(), pa.timestamp("us"), pa.timestamp("ns", "UTC")):
        column = pa.array(DAYS).cast(pa.timestamp("ns", "UTC") if "UTC" in str(kind) else kind)
        table = pa.table({"time": [0.0, 1.0], "length": [1.0, 2.0], "track_id": column})
        given = table.to_pandas() if "UTC" in str(kind) else table
        exported = pa.table(gv.filter(MODEL, LENGTH, given, prior=PRIOR))
        assert exported.column("track_id").combine_chunks() == column
    aware = pandas.DataFrame({"time": pandas.to_datetime(T[:2], unit="s", utc=True), "length": Z[:2, 0], "track_id": DAYS})
    schema = pa.table(gv.filter(MODEL, LENGTH, aware, prior=PRIOR)).schema
    assert [str(field.type) for field in schema][:2] == ["timestamp[ns]", "timestamp[ns, tz=UTC]"]


def test_ctrl_c_in_what_lends_a_table_is_ctrl_c():
    pa = pytest.importorskip("pyarrow")
    schema = pa.schema([("time", pa.float64()), ("length", pa.float64())])

    def rows(raised):
        yield pa.record_batch({"time": [0.0], "length": [1.0]})
        raise raised

    for raised, expected in ((KeyboardInterrupt, KeyboardInterrupt), (ValueError("no KeyboardInterrupt"), gv.InputError)):
        with pytest.raises(expected):
            gv.filter(MODEL, LENGTH, pa.RecordBatchReader.from_batches(schema, rows(raised)), prior=PRIOR)

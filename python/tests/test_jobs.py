"""Jobs over tables of tracks: the answers of a run, of any cut, wherever they are computed."""

import copy
import os
import pickle
import re
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import fleet
import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet
import pytest

import givens as gv


def still(t, dt, x):
    return x


def own(t, x):
    return x


def walk(**changes):
    model = gv.Transition(still, noise_cov=lambda t, dt: [[dt]], state=["x"])
    sensor = gv.Sensor(own, measures=["z"], std=[1.0])
    return model, sensor, gv.Gaussian([0], std=[10])


def table(tracks=3, rows=4, **columns):
    ids = np.repeat(np.arange(tracks), rows)
    time = np.tile(np.arange(rows, dtype=float), tracks)
    z = np.sin(ids + time)
    return pa.table({"track_id": ids, "time": time, "z": z, **columns})


@pytest.fixture(scope="module")
def job():
    model, sensor, prior = walk()
    return model.batch_job(sensor, prior=prior, goal="smooth", output="covariances")


def test_answers_are_those_of_a_run(job):
    model, sensor, prior = walk()
    given = table()
    answers, errors = gv.split_errors(job(given))
    batch = gv.smooth(model, sensor, given, prior=prior)
    assert answers["x"].to_pylist() == batch.mean.ravel().tolist()
    assert answers["x_std"].to_pylist() == batch.std.ravel().tolist()
    assert answers["cov"].to_pylist() == [[p] for p in batch.cov.ravel()]
    assert answers["log_likelihood"].to_pylist() == batch.log_likelihood.ravel().tolist()
    assert answers["track_id"].to_pylist() == given["track_id"].to_pylist()
    assert errors.num_rows == 0 and errors.column_names == ["track_id", "time", "reason", "error"]


def test_the_answers_of_a_part_are_a_part_of_the_answers(job):
    given = table(tracks=40)
    whole = job(given)
    parts = [job(given.slice(start, 4 * size)) for start, size in ((0, 1), (4, 7), (32, 13), (84, 19))]
    assert pa.concat_tables(parts).equals(whole)
    assert whole.equals(job(given.to_batches(max_chunksize=5)[0].from_pylist(given.to_pylist())))


@pytest.mark.parametrize("of", [pa.Table.to_batches, lambda t: [t.to_pandas()], lambda t: [pa.RecordBatchReader.from_batches(t.schema, t.to_batches())]])
def test_tables_of_any_kind_are_read(job, of):
    given = table()
    [one] = of(given)
    assert job(one).equals(job(given))


def test_times_and_numbers_of_tracks_are_lent_on_without_a_copy(job):
    given = table(tracks=50)
    answers = job(given)

    def address(of, name):
        [chunk] = of[name].chunks
        return chunk.buffers()[1].address

    for name in ("time", "track_id"):
        assert address(answers, name) == address(given, name)
    # and NumPy's memory is what the table was made of
    time = np.arange(4.0)
    lent = pa.table({"time": time, "z": np.zeros(4)})
    assert address(job(lent), "time") == time.__array_interface__["data"][0]


def test_layouts(job):
    model, sensor, prior = walk()
    given = table()
    wide = model.batch_job(sensor, prior=prior, goal="smooth")(given)
    tidy = model.batch_job(sensor, prior=prior, goal="smooth", output="tidy")(given)
    assert wide.drop_columns(["error"]).equals(job(given).drop_columns(["cov", "error"]).cast(wide.drop_columns(["error"]).schema))
    assert tidy.column_names == ["time", "track_id", "state", "mean", "std", "error"]
    assert tidy["mean"].to_pylist() == wide["x"].to_pylist()
    about = {key.decode(): value.decode() for key, value in wide.schema.metadata.items()}
    assert about["givens.states"] == "x" and about["givens.version"] == gv.__version__ and len(about["givens.model"]) == 16


def test_a_track_that_fails_is_a_row_and_leaves_the_others():
    model, sensor, prior = walk()
    job = model.batch_job(sensor, prior=prior)
    given = table(tracks=4)
    rows = given.to_pylist()
    rows[5]["time"] = -1.0  # of track 1, unsorted
    rows[9]["z"] = float("inf")  # of track 2
    rows[14]["track_id"] = None
    wrong = pa.Table.from_pylist(rows, schema=given.schema)
    result, summary = job.run(wrong)
    answers, errors = gv.split_errors(result)
    assert answers["track_id"].to_pylist() == [0] * 4 + [3] * 3
    assert answers["x"].to_pylist()[:4] == job(given)["x"].to_pylist()[:4]
    assert errors["track_id"].to_pylist() == [1, 2, None]
    assert errors["reason"].to_pylist() == ["input"] * 3
    said = errors["error"].to_pylist()
    assert "row 6" in said[0] and "sort the rows" in said[0]
    assert "row 10" in said[1] and "finite" in said[1]
    assert "row 15" in said[2] and "track_id" in said[2]
    assert summary.reasons == {"input": 3} and summary.tracks == 5 and summary.rows == 7
    assert "3 failed (3 input)" in str(summary)


def test_a_step_that_fails_tells_its_row_and_time():
    model = gv.Transition(lambda t, dt, x: np.sqrt(x + 9), noise_cov=[[0.01]], state=["x"])
    sensor = gv.Sensor(own, measures=["z"], std=[1.0])
    job = model.batch_job(sensor, prior=gv.Gaussian([3], std=[10]))
    rows = 40
    given = pa.table(
        {
            "track_id": ["calm"] * rows + ["wild"] * rows,
            "time": np.tile(np.arange(rows, dtype=float), 2),
            "z": np.repeat([3.0, -500.0], rows),
        }
    )
    result, summary = job.run(given)
    answers, errors = gv.split_errors(result)
    [failed] = summary.failed
    assert failed.track_id == "wild" and errors["track_id"].to_pylist() == ["wild"]
    of_wild = sum(name == "wild" for name in answers["track_id"].to_pylist())
    assert 0 < of_wild < rows and f"row {rows + of_wild + 1}: " in failed.message
    assert float(failed.time) == errors["time"].to_pylist()[0] == of_wild
    assert sum(name == "calm" for name in answers["track_id"].to_pylist()) == rows


def raising(t, x):
    if x[0] > 5:
        raise ValueError("above five")
    return x


def test_what_a_function_raises_fails_its_track():
    model, _, prior = walk()
    sensor = gv.Sensor(raising, measures=["z"], std=[1e-3], trace=False)
    job = model.batch_job(sensor, prior=gv.Gaussian([0], std=[1]))
    given = pa.table({"track_id": [1, 1, 2, 2], "time": [0.0, 1.0, 0.0, 1.0], "z": [9.0, 9.0, 0.0, 0.0]})
    answers, errors = gv.split_errors(job(given))
    assert errors["track_id"].to_pylist() == [1] and errors["reason"].to_pylist() == ["raised"]
    assert "above five" in errors["error"].to_pylist()[0]
    assert answers["track_id"].to_pylist()[-2:] == [2, 2]


def first_fix(t, z):
    if z[0, 0] < -0.9:
        raise ValueError("not here")
    return gv.Gaussian([z[0, 0]], std=[1.0 + t[0]])


def test_a_prior_may_be_a_function_of_the_track():
    model, sensor, _ = walk()
    given = table(tracks=6)
    answers, errors = gv.split_errors(model.batch_job(sensor, prior=first_fix)(given))
    begun = [k for k in range(6) if np.sin(k) >= -0.9]
    assert errors["track_id"].to_pylist() == [k for k in range(6) if k not in begun]
    assert errors["reason"].to_pylist() == ["beginning"] and "not here" in errors["error"].to_pylist()[0]
    of = given.filter(pa.array([k in begun for k in given["track_id"].to_pylist()]))
    priors = [gv.Gaussian([np.sin(k)], std=[1.0]) for k in begun]
    assert answers["x"].to_pylist() == gv.filter(model, sensor, of, prior=priors).mean.ravel().tolist()


def test_a_job_is_small_and_keeps_what_it_is(job):
    there = pickle.loads(pickle.dumps(job))
    assert len(pickle.dumps(job)) < 4096
    assert there(table()).equals(job(table()))
    assert job.threads is None and there.threads == 1 and "it came by pickle" in repr(there)
    model, sensor, prior = walk()
    asked = pickle.loads(pickle.dumps(model.batch_job(sensor, prior=prior, threads=3)))
    assert asked.threads == 3


def test_a_prior_without_a_name_is_sent_whole_or_refused(monkeypatch):
    model, sensor, _ = walk()
    given, scale = table(), 2.0
    job = model.batch_job(sensor, prior=lambda t, z: gv.Gaussian([z[0, 0]], std=[scale]))
    there = pickle.loads(pickle.dumps(job))
    assert there(given).equals(job(given)) and copy.copy(job)(given).equals(job(given))
    monkeypatch.setitem(sys.modules, "cloudpickle", None)
    with pytest.raises(gv.InputError, match="`prior` cannot be sent: .*lambda.*(?s:.)*write it with `def` at the top"):
        pickle.dumps(job)


def test_another_version_is_refused(job, monkeypatch):
    data = pickle.dumps(job)
    monkeypatch.setattr(gv._native, "VERSION", "9.9", raising=True)
    with pytest.raises(gv.InputError, match=r"made by givens .* and this is 9\.9"):
        pickle.loads(data)


def test_jobs_run_in_other_processes(job):
    given = table(tracks=10)
    parts = [given.slice(0, 20), given.slice(20, 20)]
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        there = list(pool.map(job, parts))
    assert pa.concat_tables(there).equals(job(given))


def test_dates_stay_dates():
    model, sensor, prior = walk()
    job = model.batch_job(sensor, prior=prior)
    instants = np.array(["2026-03-01T12:00:00", "2026-03-01T12:00:01"], dtype="datetime64[ns]")
    given = pa.table({"time": pa.array(instants, pa.timestamp("ns", "UTC")), "z": [1.0, 2.0]})
    answers = job(given)
    assert answers["time"].equals(given["time"])
    seconds = job(pa.table({"time": [0.0, 1.0], "z": [1.0, 2.0]}))
    assert answers["x"].equals(seconds["x"])


def test_the_columns_of_a_part_do_not_depend_on_its_rows():
    model, sensor, prior = walk()
    job = model.batch_job(sensor, prior=prior)
    instants = pa.array(np.array([1, 0, 0, 1], dtype="datetime64[s]"), pa.timestamp("us", "UTC"))
    given = pa.table({"track_id": [7, 7, 8, 8], "time": instants, "z": [1.0, 2.0, 3.0, 4.0]})
    parts = [job(given.slice(start, rows)) for start, rows in ((0, 2), (2, 2), (4, 0))]
    answers, errors = gv.split_errors(pa.concat_tables(parts))
    assert answers["track_id"].to_pylist() == [8, 8] and errors["track_id"].to_pylist() == [7]
    assert answers["time"].to_pylist() == given["time"].slice(2).to_pylist()


@pytest.mark.parametrize("names", [pa.array([2**64 - 1, 2**64 - 1, 5, 5], pa.uint64()), pa.array([7, 7, 8, 8], pa.int16())])
def test_names_that_are_whole_numbers_stay_so(names, tmp_path):
    model, sensor, prior = walk()
    job = model.batch_job(sensor, prior=prior)
    given = pa.table({"track_id": names, "time": [1.0, 0.0, 0.0, 1.0], "z": [1.0, 2.0, 3.0, 4.0]})
    answers, errors = gv.split_errors(job(given))
    assert answers["track_id"].to_pylist() == names[2:].to_pylist() and errors["track_id"].to_pylist() == [names[0].as_py()]
    kind = pa.uint64() if names.type == pa.uint64() else pa.int64()
    assert answers["track_id"].type == errors["track_id"].type == kind
    pyarrow.parquet.write_table(given, tmp_path / "given.parquet")
    job.into(tmp_path / "answers")(tmp_path / "given.parquet")
    assert pyarrow.parquet.read_table(tmp_path / "answers/given.parquet")["track_id"].to_pylist() == answers["track_id"].to_pylist()


def test_controls_and_sensors_are_columns():
    model = gv.Transition(lambda t, dt, x, u: x + dt * u, noise_cov=[[0.1]], state=["x"], controls=["push"])
    sensors = [gv.Sensor(own, measures=["a"], std=[1.0], name="one"), gv.Sensor(own, measures=["b"], std=[2.0], name="two")]
    job = model.batch_job(sensors, prior=gv.Gaussian([0], std=[1]))
    given = pa.table({"time": [0.0, 1.0], "sensor": ["one", "two"], "a": [1.0, None], "b": [None, 2.0], "u_push": [1.0, 1.0]})
    answers = job(given)
    batch = gv.filter(model, sensors, given, prior=gv.Gaussian([0], std=[1]))
    assert answers["x"].to_pylist() == batch.mean.ravel().tolist() and answers["sensor"].to_pylist() == ["one", "two"]
    with pytest.raises(gv.InputError, match="u_push"):
        job(given.drop_columns(["u_push"]))


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"output": "long"}, "output"),
        ({"goal": "interval"}, "goal"),
        ({"lag": 3}, "filter"),
        ({"t0": np.datetime64("2026-01-01")}, "seconds"),
        ({"prior": None}, "prior"),
        ({"method": "sr-cfk"}, "sr-ckf"),
        ({"threads": 0}, "threads"),
    ],
)
def test_what_cannot_serve_is_told_when_the_job_is_made(changes, said):
    model, sensor, prior = walk()
    with pytest.raises(gv.InputError, match=said):
        model.batch_job(sensor, **{"prior": prior, **changes})


def test_names_that_would_be_two_columns_are_refused():
    model = gv.Transition(still, noise_cov=[[1.0]], state=["error"])
    sensor = gv.Sensor(own, measures=["z"], std=[1.0])
    with pytest.raises(gv.InputError, match="`error`"):
        model.batch_job(sensor, prior=gv.Gaussian([0], std=[1]))
    twice = gv.Transition(still, noise_cov=np.eye(2), state=["x", "x_std"])
    with pytest.raises(gv.InputError, match="`x_std`"):
        twice.batch_job(gv.Sensor(lambda t, x: x[:1], measures=["z"], std=[1.0]), prior=gv.Gaussian([0, 1], std=[1, 1]))
    model.batch_job(sensor, prior=gv.Gaussian([0], std=[1]), output="tidy")(pa.table({"time": [0.0], "z": [0.0]}))


def test_a_table_without_the_columns_is_an_error(job):
    with pytest.raises(gv.InputError, match="`z`"):
        job(table().drop_columns(["z"]))
    with pytest.raises(gv.InputError, match="lends no columns"):
        job([1, 2])


@pytest.mark.parametrize(
    ("column", "values", "said"),
    [
        ("z", pa.array(["1", "2"]), "`z` holds Utf8"),
        ("track_id", pa.array([1.0, 1.0]), "cast it to int64"),
        ("track_id", pa.nulls(2), "leave the column out"),
    ],
)
def test_a_column_of_a_wrong_type_is_one_error(job, column, values, said):
    given = table(tracks=1, rows=2)
    with pytest.raises(gv.InputError, match=said):
        job(given.set_column(given.column_names.index(column), column, values))


def test_what_is_no_table_of_answers_is_told(job):
    right = job(table())
    column = right.column_names.index("error")
    for wrong, said in [
        (right.set_column(column, "error", pa.array([[1]] * right.num_rows)), "holds list<item: int64>"),
        (right.set_column(column, "error", pa.array([1] * right.num_rows)), "holds int64, not words"),
        (right.set_column(column, "error", pa.array(["x"] * right.num_rows)), "holds 'x', which is no reason"),
        (right.append_column("error", right["error"]), "several columns `error`"),
        (right.drop_columns(["error"]), "no column `error`"),
        (job.run(table()), "no table of answers"),
        (right["error"], "no table of answers"),
    ]:
        with pytest.raises(gv.InputError, match=re.escape(said)) as caught:
            gv.split_errors(wrong)
        assert "answers" in caught.value.remedy


def test_answers_are_taken_apart_whatever_they_became(job):
    given = table().to_pylist()
    given[5]["time"] = -1.0
    right = job(pa.Table.from_pylist(given))
    answers, errors = gv.split_errors(right)
    words = right["error"]
    column = right.column_names.index("error")
    assert errors.num_rows == 1
    others = [right.set_column(column, "error", words.cast(of)) for of in (pa.large_string(), pa.string_view())]
    others += [right.set_column(column, "error", words.dictionary_encode()), right.combine_chunks().to_batches()[0]]
    coded = words.combine_chunks().dictionary_encode()
    views = pa.DictionaryArray.from_arrays(coded.indices, coded.dictionary.cast(pa.string_view()))
    others.append(right.set_column(column, "error", views))
    for other in others:
        assert gv.split_errors(other)[0].equals(answers) and gv.split_errors(other)[1].equals(errors)
    pandas = pytest.importorskip("pandas")
    frame = gv.split_errors(right.to_pandas())
    assert isinstance(right.to_pandas(), pandas.DataFrame)
    assert frame[0]["x"].to_pylist() == answers["x"].to_pylist() and frame[1]["error"].to_pylist() == errors["error"].to_pylist()


def test_what_is_no_table_or_is_given_twice_is_told(job):
    for wrong in (pa.array([1, 2]), pa.chunked_array([[1, 2]])):
        with pytest.raises(gv.InputError) as caught:
            job(wrong)
        assert "table" in caught.value.remedy
    model = fleet.model()
    for given, said in (({"t0": 1.0}, "`t0` is given beside"), ({"sensors": walk()[1]}, "`sensors` are given beside")):
        with pytest.raises(gv.InputError, match=said):
            model.batch_job(**given)
    with pytest.raises(gv.InputError, match="`sensors` are given beside"):
        model.batch_job(walk()[1])
    model, sensor, prior = walk()
    with pytest.raises(gv.InputError, match="prior"):
        model.batch_job(sensor)
    with pytest.raises(gv.InputError, match="sensor"):
        model.batch_job(prior=prior)


def test_a_late_beginning_is_told_in_words_of_python():
    model, sensor, prior = walk()
    _, errors = gv.split_errors(model.batch_job(sensor, prior=prior, t0=5.0)(table(tracks=1)))
    [said] = errors["error"].to_pylist()
    assert "`t0`" in said and "[state]" not in said


# some vessels are silent for half an hour, too long for sixteen steps
@pytest.mark.filterwarnings("ignore::givens.DoubtWarning")
def test_files_are_written_as_the_command_writes_them(tmp_path):
    command = os.environ.get("GIVENS_COMMAND") or Path(__file__).parents[2] / "target/debug/givens"
    if not Path(command).exists():
        pytest.skip("the command is not built: cargo build -p givens-cli")
    files = fleet.write_files(tmp_path / "data", 3, 2)
    model = fleet.model()
    job = model.batch_job(goal="smooth", output="covariances")
    summaries = [job.into(tmp_path / "answers")(file) for file in files]
    arguments = [model.native.file, tmp_path / "data", "-o", tmp_path / "command", "--layout", "covariances"]
    subprocess.run([command, "smooth", *arguments], check=True, capture_output=True)
    written = fleet.bytes_of((tmp_path / "answers").glob("*.parquet"))
    assert written == fleet.bytes_of((tmp_path / "command").iterdir())
    assert set(written) == {file.name for file in files}
    # the same table in memory
    answers, errors = gv.split_errors(job(pyarrow.parquet.read_table(files[0])))
    there = pyarrow.parquet.read_table(tmp_path / "answers" / files[0].name)
    assert answers.cast(there.schema).equals(there) and errors.num_rows == sum(len(one.failed) for one in summaries[:1])
    total = sum(summaries, gv.Summary())
    # rows before a vessel's first whole report have empty lines
    rows = [pyarrow.parquet.read_table(tmp_path / "answers" / file.name)["east"] for file in files]
    assert total.files == 2 and total.rows == sum(len(column) - column.null_count for column in rows)


def test_files_that_are_done_are_left_out(tmp_path, job):
    data = tmp_path / "data"
    data.mkdir()
    for k in range(2):
        pyarrow.parquet.write_table(table(), data / f"{k}.parquet")
    run = job.into(tmp_path / "answers", resume=True)
    first = run(data / "0.parquet")
    before = (tmp_path / "answers/0.parquet").stat().st_mtime_ns
    again, other = run(data / "0.parquet"), run(data / "1.parquet")
    assert again == first and (first.rows, other.rows) == (12, 12)
    assert (tmp_path / "answers/0.parquet").stat().st_mtime_ns == before
    with pytest.raises(gv.InputError, match="overwritten"):
        job.into(data)(data / "0.parquet")
    as_text = walk()[0].batch_job(walk()[1], prior=walk()[2]).into(tmp_path / "text", format="csv")
    as_text(data / "0.parquet")
    assert pyarrow.csv.read_csv(tmp_path / "text/0.csv").num_rows == 12
    with pytest.raises(gv.InputError, match="Parquet"):
        job.into(tmp_path, format="csv")
    with pytest.raises(gv.InputError, match="no such file"):
        job.into(tmp_path / "answers")(data / "9.parquet")
    assert sorted(file.name for file in (tmp_path / "answers").iterdir()) == ["0.parquet", "1.parquet", "_summaries"]
    with pytest.raises(gv.InputError, match="overwritten"):
        job.into(data, resume=True)(data / "0.parquet")


def test_what_was_done_counts_only_for_the_same_job_and_rows(tmp_path):
    model, sensor, prior = walk()
    wrong = table().to_pylist()
    wrong[1]["z"] = float("inf")
    pyarrow.parquet.write_table(pa.Table.from_pylist(wrong), tmp_path / "a.parquet")
    run = model.batch_job(sensor, prior=prior).into(tmp_path / "answers", resume=True)
    first = run(tmp_path / "a.parquet")
    assert len(first.failed) == 1 and run(tmp_path / "a.parquet") == first
    # another job
    other = model.batch_job(sensor, prior=prior, goal="smooth", output="covariances").into(tmp_path / "answers", resume=True)
    other(tmp_path / "a.parquet")
    assert "cov" in pyarrow.parquet.read_schema(tmp_path / "answers/a.parquet").names
    # other rows
    pyarrow.parquet.write_table(table(), tmp_path / "a.parquet")
    assert other(tmp_path / "a.parquet").failed == ()
    # another file of the same name
    (tmp_path / "more").mkdir()
    pyarrow.parquet.write_table(table(), tmp_path / "more/a.parquet")
    with pytest.raises(gv.InputError, match="holds the answers of"):
        other(tmp_path / "more/a.parquet")
    assert run.path("day.1").name == "day.1.parquet" and run.path("b.csv").name == "b.csv"


def test_an_empty_table_has_empty_answers(job):
    result, summary = job.run(table().slice(0, 0))
    assert result.num_rows == 0 and result.schema.names == job(table()).schema.names
    assert (summary.tracks, summary.rows) == (0, 0)


def test_nothing_is_imported_that_is_not_needed():
    program = "import sys, givens; print(sorted({'pyarrow', 'pandas', 'ray', 'distributed'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"

"""Jobs on Ray, where it is installed: `pip install givens[ray]`. It is large, and CI goes without it."""

import os
import signal

import fleet
import pyarrow as pa
import pytest

import givens as gv

ray = pytest.importorskip("ray")

COPIES, FILES = 200, 20


# what Ray itself leaves open or will change is not ours
pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.fixture(scope="module")
def cluster():
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False, runtime_env={"working_dir": None})
    yield ray
    ray.shutdown()


def test_a_worker_that_is_killed_in_mid_job_changes_no_byte(tmp_path, cluster):
    files = fleet.write_files(tmp_path / "data", COPIES, FILES)
    job = fleet.model().batch_job()
    alone = sum(map(job.into(tmp_path / "alone"), files), gv.Summary())
    written = fleet.bytes_of((tmp_path / "alone").glob("*.parquet"))
    run = job.into(tmp_path / "answers")
    there = tmp_path / "workers"
    there.mkdir()

    @ray.remote(max_retries=3)
    def task(file):
        (there / str(os.getpid())).touch()
        return run(file)

    tasks = [task.remote(file) for file in files]
    ray.wait(tasks, num_returns=3)
    os.kill(int(next(there.iterdir()).name), signal.SIGKILL)
    summaries = ray.get(tasks)
    assert fleet.bytes_of((tmp_path / "answers").glob("*.parquet")) == written
    total = sum(summaries, gv.Summary())
    assert (total.tracks, total.rows, total.log_likelihood) == (alone.tracks, alone.rows, alone.log_likelihood)
    assert len(list(there.iterdir())) > 2


def test_map_batches_gives_the_table_of_one_process(tmp_path, cluster):
    import ray.data

    files = fleet.write_files(tmp_path / "data", 6, 3)
    job = fleet.model().batch_job(goal="smooth")
    data = ray.data.read_parquet([os.fspath(file) for file in files], override_num_blocks=3)
    answers = data.map_batches(job, batch_format="pyarrow", batch_size=None)
    table = pa.concat_tables(ray.get(answers.to_arrow_refs()))
    alone = pa.concat_tables([job(pa.parquet.read_table(file)) for file in files])
    order = [("track_id", "ascending"), ("time", "ascending")]
    assert table.select(alone.column_names).replace_schema_metadata().sort_by(order).equals(
        alone.replace_schema_metadata().sort_by(order)
    )


def test_a_study_is_the_same_there(cluster):
    import ray.data

    model = gv.Transition(lambda t, dt, x: x, noise_cov=[[0.1]], state=["x"])
    sensor = gv.Sensor(lambda t, x: x, measures=["z"], std=[1.0])
    study = gv.study(model, sensor, range(30), prior=gv.Gaussian([0], std=[1]), methods=["sr-ckf"], runs=50, seed=1)
    found = ray.data.range(50, override_num_blocks=4).map_batches(study, batch_format="pyarrow", batch_size=None)
    table = pa.concat_tables(ray.get(found.to_arrow_refs())).sort_by("run")
    assert table.equals(study())

"""Jobs on Dask: two workers on the vessels of New York, one of them killed in mid-job."""

import os
import signal
import time

import fleet
import pyarrow as pa
import pyarrow.parquet
import pytest

import givens as gv

distributed = pytest.importorskip("distributed")

# some vessels are silent for half an hour, too long for sixteen steps
pytestmark = pytest.mark.filterwarnings("ignore::givens.DoubtWarning")

#: Copies of the vessels, and the files that they lie in.
COPIES, FILES = 200, 20


@pytest.fixture(scope="module")
def cluster():
    settings = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with (
        distributed.LocalCluster(silence_logs=50, **settings) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def identity():
    return os.getpid()


def test_a_worker_that_is_killed_in_mid_job_changes_no_byte(tmp_path, cluster):
    files = fleet.write_files(tmp_path / "data", COPIES, FILES)
    job = fleet.model().batch_job()
    alone = sum(map(job.into(tmp_path / "alone"), files), gv.Summary())
    written = fleet.bytes_of((tmp_path / "alone").glob("*.parquet"))
    before = set(cluster.run(os.getpid).values())
    run = job.into(tmp_path / "answers")
    tasks = cluster.map(run, files, pure=False)
    while sum(task.done() for task in tasks) < 3:
        time.sleep(0.02)
    assert not all(task.done() for task in tasks)
    os.kill(min(before), signal.SIGKILL)
    summaries = cluster.gather(tasks)
    after = set(cluster.run(os.getpid).values())
    assert min(before) not in after
    assert fleet.bytes_of((tmp_path / "answers").glob("*.parquet")) == written
    there = sum(summaries, gv.Summary())
    assert (there.tracks, there.rows, there.files) == (alone.tracks, alone.rows, FILES)
    assert there.log_likelihood == alone.log_likelihood
    assert [track._replace(file=None) for track in there.failed] == [track._replace(file=None) for track in alone.failed]


def test_tables_and_studies_are_the_same_there(tmp_path, cluster):
    job = fleet.model().batch_job(goal="smooth")
    table = fleet.reports()
    cut = table["track_id"].index(150).as_py()
    parts = [table.slice(0, cut), table.slice(cut)]
    # Dask takes two slices of one table for the same argument, unless it is told not to look
    there = cluster.gather(cluster.map(job, parts, pure=False))
    assert pa.concat_tables(there).equals(job(table))
    model = gv.Transition(lambda t, dt, x: x, noise_cov=[[0.1]], state=["x"])
    sensor = gv.Sensor(lambda t, x: x, measures=["z"], std=[1.0])
    study = gv.study(model, sensor, range(30), prior=gv.Gaussian([0], std=[1]), methods=["sr-ckf"], runs=50, seed=1)
    assert pa.concat_tables(cluster.gather(cluster.map(study, study.ranges(7)))).equals(study())

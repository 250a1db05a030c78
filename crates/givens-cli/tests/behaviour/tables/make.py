"""Writes the tables of this folder, as pyarrow 26.0.1 does: `python make.py`.

`damaged.parquet` is one of pyarrow's too, of which bits were turned at random until its footer told an impossible place.
"""

import datetime as dt

import pyarrow as pa
import pyarrow.parquet as pq

UTC = dt.timezone.utc
start = dt.datetime(2026, 3, 1, 12, tzinfo=UTC)
at = [start + dt.timedelta(seconds=s) for s in (0, 0, 1.5, 2.25, 3, 4)]
z = [1.0, 2.0, None, 2.5, float("nan"), 3.0]
dates = pa.table(
    {
        "time": pa.array(at, pa.timestamp("us", "UTC")),
        "track_id": pa.array(["a", "b", "a", "b", "a", "b"]).dictionary_encode(),
        "z": pa.array(z, pa.float64(), from_pandas=False),
        "note": pa.array([[1], [2], [], None, [3], [4]], pa.list_(pa.int64())),
    }
)
pq.write_table(dates, "dates.parquet", compression="snappy", row_group_size=2)
whole = pa.table(
    {
        "time": pa.array([0, 0, 2, 2, 3, 4], pa.int32()),
        "track_id": pa.array([7, 12, 7, 12, 7, 12], pa.int64()),
        "z": pa.array([1, 2, None, 2.5, None, 3], pa.float32()),
    }
)
pq.write_table(whole, "whole.parquet", compression="zstd")
wrong = pa.table(
    {
        "time": pa.array([0.0, 1.0, 0.5, 2.0]),
        "z": pa.array([1.0, float("inf"), 2.0, 3.0]),
    }
)
pq.write_table(wrong, "wrong.parquet", compression="none")
pq.write_table(whole, "gzip.parquet", compression={"time": "none", "track_id": "none", "z": "gzip"})
floats = pa.table({"time": [0.0, 0.0], "track_id": pa.array([1.0, 2.0]), "z": [1.0, 2.0]})
pq.write_table(floats, "float_ids.parquet", compression="none")
blanks = pa.table({"time": [0.0, 0.0, 1.0, 1.0], "track_id": ["a", "b", "a ", " b"], "z": [1.0, 2.0, 3.0, 4.0]})
pq.write_table(blanks, "blanks.parquet", compression="none")
words = pa.table({"time": pa.array([0.0, None]), "z": pa.array([["x"], ["y"]])})
pq.write_table(words, "lists.parquet")

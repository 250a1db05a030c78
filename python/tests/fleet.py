"""The vessels of the example `fleet`, and copies of them with noise, for tests of jobs."""

from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

import givens as gv

FOLDER = Path(__file__).parents[2] / "examples/fleet"


def model():
    return gv.read_model(FOLDER / "fleet.toml")


def reports():
    """The reports as they are, each vessel's together."""
    return pyarrow.csv.read_csv(FOLDER / "reports.csv").sort_by([("track_id", "ascending"), ("time", "ascending")])


def copies(count, seed=1):
    """Copies of the vessels, which report as if each had been elsewhere by a few metres."""
    table, draw = reports(), np.random.default_rng(seed)
    for k in range(count):
        columns = {name: table[name].to_numpy() for name in table.column_names}
        columns["track_id"] = columns["track_id"] + 1000 * k
        for name in ("east_fix", "north_fix"):
            columns[name] = columns[name] + 5 * draw.standard_normal(table.num_rows)
        yield pa.table(columns)


def write_files(folder, count, files):
    """So many copies in so many files."""
    folder.mkdir()
    tables = list(copies(count))
    for k in range(files):
        part = pa.concat_tables(tables[k::files])
        pyarrow.parquet.write_table(part, folder / f"part-{k:03}.parquet")
    return sorted(folder.iterdir())


def bytes_of(files):
    """Each file by its name."""
    return {file.name: file.read_bytes() for file in sorted(files)}


def rows_of(file):
    """How many rows a file has."""
    return pyarrow.parquet.read_metadata(file).num_rows

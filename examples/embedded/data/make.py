"""Writes what the host program runs over and what it must find: `python examples/embedded/data/make.py`.

Needs NumPy alone. The rows are the first of the benchmark's inputs, in single precision; the answers are those of the
benchmark's textbook program in double precision (covariances, no square roots), which shares no code with givens.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
BENCHMARKS = HERE.parents[2] / "benchmarks"
sys.path.insert(0, str(BENCHMARKS / "python"))

import problems as p  # noqa: E402
from reference import discrete, ito_taylor, smoothed  # noqa: E402

ROWS, LAG = 100, 10


def write(name, rows, number):
    """An array of arrays, as Rust writes it."""
    lines = ["    [" + ", ".join(number(v) for v in row) + "]," for row in rows]
    (HERE / f"{name}.array").write_text("[\n" + "\n".join(lines) + "\n]\n")


def measured(name):
    """The first rows of an input, in single precision, which is also what the textbook is given."""
    rows = np.loadtxt(BENCHMARKS / "inputs" / f"{name}.csv", delimiter=",", skiprows=1, max_rows=ROWS)
    single = rows.astype(np.float32)
    write(f"{name}_rows", single, lambda v: str(v))
    return single.astype(float)


def expected(name, beliefs):
    """Means, then standard deviations."""
    rows = [np.concatenate([mean, np.sqrt(np.diag(cov))]) for mean, cov in beliefs]
    write(name, rows, lambda v: f"{v:.9e}")


def main():
    rows = measured("plane")
    filtered, predicted = discrete(p.plane_steps, p.plane_radars, p.PLANE_Q, p.PLANE_R, p.PLANE_MEAN, p.PLANE_COV, rows)
    expected("plane_filtered", filtered)
    # the state ten rows ago, given all rows until now: the last step of a way back that begins anew at every row
    ways = (smoothed(filtered[k - LAG : k + 1], predicted[k - LAG : k + 1]) for k in range(LAG, ROWS))
    expected("plane_lagged", [way[0] for way in ways])

    rows = measured("space_fast")
    expected("space_filtered", ito_taylor(p.SPACE_MEAN, p.SPACE_COV, rows, p.P1_GAP, p.P1_SUBSTEPS))


if __name__ == "__main__":
    main()

"""Draws the fixed inputs and computes what the textbook makes of them: `python benchmarks/python/inputs.py`.

Needs NumPy alone, and writes into `benchmarks/inputs`. Its README tells each file.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from problems import *
from reference import discrete, ito_taylor, moment_ode, smoothed, update

OUT = Path(__file__).parents[1] / "inputs"


def write(name, columns, rows):
    """A header, then numbers that read back exactly."""
    (OUT / f"{name}.csv").parent.mkdir(exist_ok=True)
    lines = [",".join(columns), *(",".join(repr(float(v)) for v in row) for row in rows)]
    (OUT / f"{name}.csv").write_text("\n".join(lines) + "\n")


def expected(name, beliefs, every=1):
    """Mean and variances of every `every`-th belief, one a line."""
    rows = [np.concatenate([mean, np.diag(cov)]) for mean, cov in beliefs[every - 1 :: every]]
    n = len(rows[0]) // 2
    write(f"expected/{name}", [f"m{i}" for i in range(n)] + [f"v{i}" for i in range(n)], rows)


def plane(rng, tracks, steps):
    """Measurements of drawn turns, tracks x steps x 2."""
    x = PLANE_MEAN + rng.standard_normal((tracks, 5)) * np.sqrt(np.diag(PLANE_COV))
    q, r, rows = np.linalg.cholesky(PLANE_Q), np.sqrt(np.diag(PLANE_R)), []
    for _ in range(steps):
        x = plane_steps(x) + rng.standard_normal((tracks, 5)) @ q.T
        rows.append(plane_radars(x) + rng.standard_normal((tracks, 2)) * r)
    return np.stack(rows, 1)


def space(rng, rows, gap, divisions=400):
    """Measurements of a turn in space, drawn in small steps by Euler and Maruyama."""
    x, h, g, r, out = SPACE_MEAN.copy(), gap / divisions, np.sqrt(np.diag(SPACE_K)), np.sqrt(np.diag(SPACE_R)), []
    for _ in range(rows):
        for _ in range(divisions):
            x = x + h * space_drift(x) + np.sqrt(h) * g * rng.standard_normal(7)
        out.append(space_radar(x) + rng.standard_normal(3) * r)
    return np.array(out)


def circle(rng, n, rows):
    """A prior mean and measurements of Lorenz-96."""
    x = 8.0 + 0.01 * rng.standard_normal(n)
    for _ in range(200):
        x = circle_steps(x)
    mean, out = x + rng.standard_normal(n) * np.sqrt(CIRCLE_P), []
    for _ in range(rows):
        x = circle_steps(x) + rng.standard_normal(n) * np.sqrt(CIRCLE_Q)
        out.append(circle_radars(x) + rng.standard_normal(n // 2) * np.sqrt(CIRCLE_R))
    return mean, np.array(out)


def main():
    rng = np.random.default_rng(20240611)
    one, many = plane(rng, 1, 1000)[0], plane(rng, 1000, 100).astype("<f4")
    write("plane", ["range", "bearing"], one)
    many.tofile(OUT / "plane_tracks.f32")
    in_plane = (plane_steps, plane_radars, PLANE_Q, PLANE_R, PLANE_MEAN, PLANE_COV)
    filtered, predicted = discrete(*in_plane, one)
    expected("W1", filtered, every=10)
    expected("W4", smoothed(filtered, predicted), every=10)
    expected("W2", [discrete(*in_plane, z)[0][-1] for z in many.astype(float)])

    rows = space(rng, 30, SPACE_GAP)
    write("space", ["range", "azimuth", "elevation"], rows)
    expected("W3a", moment_ode(SPACE_MEAN, SPACE_COV, rows, SPACE_GAP, SPACE_SUBSTEPS))
    in_space = (space_steps, space_radars, SPACE_QD, SPACE_R, SPACE_MEAN, SPACE_COV)
    expected("W3b", discrete(*in_space, rows)[0])

    for n, steps in CIRCLE_ROWS.items():
        mean, z = circle(rng, n, steps)
        write(f"circle_{n}_prior", ["mean"], mean[:, None])
        write(f"circle_{n}", [f"z{i}" for i in range(n // 2)], z)
        noises = (CIRCLE_Q * np.eye(n), CIRCLE_R * np.eye(n // 2), mean, CIRCLE_P * np.eye(n))
        expected(f"W5-{n}", discrete(circle_steps, circle_radars, *noises, z)[0][-1:])

    rows = space(rng, 200, P1_GAP)
    write("space_fast", ["range", "azimuth", "elevation"], rows)
    expected("P1", ito_taylor(SPACE_MEAN, SPACE_COV, rows, P1_GAP, P1_SUBSTEPS), every=10)
    belief, still = (SPACE_MEAN, SPACE_COV), space_radar(SPACE_MEAN)
    rows = still + rng.standard_normal((200, 3)) * np.sqrt(np.diag(SPACE_R))
    write("space_still", ["range", "azimuth", "elevation"], rows)
    for z in rows:
        belief = update(space_radars, SPACE_R, *belief, z)
    expected("P2", [belief])


if __name__ == "__main__":
    main()

"""The Kalman filter of each rung of stress_cases.py in sixty digits, and what the rounding of its numbers costs.

A filter that reads the numbers in f32 cannot answer better than they are there. So there is an answer for the numbers in `f64` and
one for those in `f32`, and beside each its cost: the largest change, over `TRIALS` random changes of every number by half a spacing,
in units of the answer's own standard deviations. `cost` is of the numbers of the problem; `points` is of those and of the points at
which a filter that takes no derivatives asks the model, and of what it is told there.
"""

import random
import struct

import numpy as np
from linear import divide, factor
from mpmath import mp, mpf
from precise import elementwise, exact, identity, lower, to_float, zeros
from stress_cases import CASES

TRIALS = 6
#: The cost from which on an answer is not determined by the numbers: a hundredth of a standard deviation.
UNDETERMINED = 1e-2
#: Half a spacing, relatively.
HALF = {"f64": 2.0**-53, "f32": 2.0**-24}
NUMBERS = ("mean", "cov", "h", "r", "z")


def single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def each(function, value):
    return [each(function, item) for item in value] if isinstance(value, list) else function(value)


def changed(rung, function):
    """The rung with `function` of each number in it; symmetric matrices stay so."""
    out = {key: each(function, rung[key]) for key in NUMBERS}
    out["steps"] = [{key: each(function, step[key]) for key in ("f", "q")} for step in rung["steps"]]
    for holder, key in [(out, "cov"), (out, "r"), *((step, "q") for step in out["steps"])]:
        m = holder[key]
        holder[key] = [[m[max(i, j)][min(i, j)] for j in range(len(m))] for i in range(len(m))]
    return out


def turns(rung):
    """By how many periods each measurement is short of the heading that it is of."""
    x, all_turns = rung["mean"], []
    for k, z in enumerate(rung["z"]):
        f = rung["steps"][min(k, len(rung["steps"]) - 1)]["f"]
        x = [sum(float(a) * b for a, b in zip(row, x)) for row in f]
        of = [sum(float(a) * b for a, b in zip(row, x)) for row in rung["h"]]
        all_turns.append([round((m - float(v)) / rung["period"]) for m, v in zip(of, z)])
    return all_turns


def update(m, p, h, r, z):
    """Joseph's form, which keeps P a covariance."""
    gain = divide(p @ h.T, factor(h @ p @ h.T + r, "innovation covariance"))
    left = identity(len(m)) - gain @ h
    return m + gain @ (z - h @ m), left @ p @ left.T + gain @ r @ gain.T


def through_points(m, p, f, q, h, r, z, moved):
    """One row by the third-degree cubature rule, which is the Kalman filter but for the rounding of points and images."""
    n = len(m)
    scale = mp.sqrt(n)

    def points(m, p):
        spread = scale * factor(p, "covariance")
        return moved(np.concatenate([m[:, None] + spread, m[:, None] - spread], axis=1))

    def centred(images):
        mean = images.sum(axis=1) / (2 * n)
        return mean, (images - mean[:, None]) / mp.sqrt(2 * n)

    m, spread = centred(moved(f @ points(m, p)))
    p = spread @ spread.T + q
    x = points(m, p)
    (zm, zs), (_, xs) = centred(moved(h @ x)), centred(x)
    gain = divide(xs @ zs.T, factor(zs @ zs.T + r, "innovation covariance"))
    rest = xs - gain @ zs
    return m + gain @ (z - zm), rest @ rest.T + gain @ r @ gain.T


def filtered(rung, numbers, moved=None):
    """Mean and covariance after each row; by points, with their rounding, if `moved` is given."""
    m, p = exact(numbers["mean"]), exact(numbers["cov"])
    h, r = exact(numbers["h"]), exact(numbers["r"])
    steps = [(exact(step["f"]), exact(step["q"])) for step in numbers["steps"]]
    if "repeat" in rung:
        return [steady(*steps[0], h, r, exact(numbers["z"][0]))]
    cycles = turns(rung) if "period" in rung else [[0] * len(h)] * len(rung["z"])
    out = []
    for k, (z, turned) in enumerate(zip(numbers["z"], cycles)):
        f, q = steps[min(k, len(steps) - 1)]
        # once around is 2π as the float holds it, the period that a filter is told
        z = exact(z) + mpf(rung.get("period", 0.0)) * exact([float(t) for t in turned])
        if moved is None:
            m, p = update(f @ m, f @ p @ f.T + q, h, r, z)
        else:
            m, p = through_points(m, p, f, q, h, r, z, moved)
        out.append((m, p))
    return out


def inverse2(a):
    det = a[0, 0] * a[1, 1] - a[0, 1] * a[1, 0]
    out = zeros(2, 2)
    out[0, 0], out[1, 1], out[0, 1], out[1, 0] = a[1, 1] / det, a[0, 0] / det, -a[0, 1] / det, -a[1, 0] / det
    return out


def steady(f, q, h, r, z):
    """The limit under equal rows: the algebraic Riccati equation by doubling, and the mean that stays where it is."""
    a, g, x = f.T, h.T @ h / r[0, 0], q
    for _ in range(64):
        across = a @ inverse2(identity(2) + g @ x)
        g, x, a = g + across @ g @ a.T, x + a.T @ x @ inverse2(identity(2) + g @ x) @ a, across @ a
    gain = divide(x @ h.T, factor(h @ x @ h.T + r, "innovation covariance"))
    left = (identity(2) - gain @ h) @ f
    again = (identity(2) - gain @ h) @ x
    rest = f @ again @ f.T + q - x
    assert max(abs(v) for v in rest.ravel()) < mpf("1e-45") * max(abs(v) for v in x.ravel()), "not the limit"
    return inverse2(identity(2) - left) @ (gain @ z), again


def distance(found, answer):
    """The largest error of a mean or a covariance, in standard deviations of the answer."""
    worst = mpf(0)
    for (m, p), (m0, p0) in zip(found, answer):
        n = len(m0)
        sigma = [mp.sqrt(p0[i, i]) if p0[i, i] > mpf("1e-60") else mpf(0) for i in range(n)]
        for i in range(n):
            worst = max(worst, abs(m[i] - m0[i]) / (sigma[i] or max(1, abs(m0[i]))))
            for j in range(n):
                worst = max(worst, abs(p[i, j] - p0[i, j]) / ((sigma[i] * sigma[j]) or 1))
    return worst


def answers(rung, precision, seed):
    """Of the numbers as the precision holds them."""
    numbers = changed(rung, single if precision == "f32" else float)
    answer = filtered(rung, numbers)
    draw, cost, points = random.Random(seed), mpf(0), mpf(0)

    def move(v):
        return mpf(v) * (1 + mpf(HALF[precision]) * draw.choice((-1, 1)))

    for _ in range(TRIALS):
        moved = changed(numbers, move)
        cost = max(cost, distance(filtered(rung, moved), answer))
        points = max(points, cost, distance(filtered(rung, moved, elementwise(move)), answer))
    costs = {"cost": float(f"{float(cost):.2e}"), "points": float(f"{float(points):.2e}")}
    return costs | {"rows": [{"mean": to_float(m), "cov": lower(p)} for m, p in answer]}


def cases():
    """By name, what d is and the rungs; a precision whose numbers do not determine the answer is left out of a rung."""
    out = {}
    for make, ladder, about in CASES:
        rungs = []
        for d in ladder:
            rung = make(d)
            for precision in HALF:
                answer = answers(rung, precision, f"{make.__name__} {d} {precision}")
                if answer["cost"] <= UNDETERMINED:
                    rung[precision] = answer
            rungs.append(rung)
        name = make.__name__ if make.__name__ != "gaps" else ("short_gaps" if ladder[0] < 1 else "long_gaps")
        out[name] = {"about": about, "rungs": rungs}
    return out

"""The ladders of golden/stress.json: linear problems that grow harder rung by rung.

A rung is a dict of plain floats: the prior (`mean`, `cov`), `times`, per row a step (`f`, `q`; one for all, or one a row), the sensor
(`h`, `r`), measurements `z`; `repeat` runs the one row again and again, `period` makes the measures angles, and `a`, `g` are the
continuous model whose step is exact.
"""

import math
import random

from mpmath import exp, lu_solve, matrix, mpf


def ladder(first, last, step=1):
    """The powers of ten between two exponents, both included."""
    step = step if last >= first else -step
    return [float(f"1e{e}") for e in range(first, last + (1 if step > 0 else -1), step)]


def eye(n, scale=1.0):
    return [[scale if i == j else 0.0 for j in range(n)] for i in range(n)]


def diagonal(entries):
    return [[float(x) if i == j else 0.0 for j in range(len(entries))] for i, x in enumerate(entries)]


def wander(t, q):
    """A speed that wanders, over a gap `t`: the exact F and Q, rounded once."""
    t, q = mpf(t), mpf(q)
    cov = [[q * t**3 / 3, q * t**2 / 2], [q * t**2 / 2, q * t]]
    return {"f": [[1.0, float(t)], [0.0, 1.0]], "q": [[float(x) for x in row] for row in cov]}


def rung(d, mean, cov, times, steps, h, r, truth, seed, period=None, **more):
    """Measurements of `truth`, which moves without noise, with errors of the sensor's size."""
    errors, z, x = random.Random(seed), [], list(truth)
    for k in range(len(times)):
        f = steps[min(k, len(steps) - 1)]["f"]
        x = [sum(a * b for a, b in zip(row, x)) for row in f]
        row = []
        for i, of in enumerate(h):
            e = round(errors.gauss(0, 1), 2)
            value = sum(a * b for a, b in zip(of, x)) + math.sqrt(r[i][i]) * e
            row.append(value if period is None else math.remainder(value, period))
        z.append(row)
    out = {"d": d, "mean": mean, "cov": cov, "times": times, "steps": steps, "h": h, "r": r, "z": z}
    return out | ({} if period is None else {"period": period}) | more


def seconds(count):
    return [float(k) for k in range(1, count + 1)]


def nearly_singular(d):
    """Two sums of three states that differ by d of one of them; without noise of their own but d."""
    still = {"f": eye(3), "q": eye(3, 0.0)}
    h = [[1.0, 1.0, 1.0], [1.0, 1.0, 1.0 + d]]
    return rung(d, [0.0] * 3, eye(3), [1.0], [still], h, eye(2, d * d), [0.3, -0.5, 0.8], 1)


def vague(d):
    """A prior variance d of position and speed."""
    return rung(d, [0.0, 0.0], eye(2, d), seconds(8), [wander(1, 0.1)], [[1.0, 0.0]], [[1.0]], [1.0, 0.5], 2)


def zero_and_vague(d):
    """The same beside a third state that is known exactly, an offset of the sensor."""
    step = wander(1, 0.1)
    f = [[*row, 0.0] for row in step["f"]] + [[0.0, 0.0, 1.0]]
    q = [[*row, 0.0] for row in step["q"]] + [[0.0, 0.0, 0.0]]
    steps = [{"f": f, "q": q}]
    h, cov = [[1.0, 0.0, 1.0]], diagonal([d, d, 0.0])
    return rung(d, [0.0, 0.0, 2.0], cov, seconds(8), steps, h, [[1.0]], [1.0, 0.5, 2.0], 3)


def precise(d):
    """A sensor of variance d beside a process noise of 0.1."""
    return rung(d, [0.0, 0.0], eye(2), seconds(8), [wander(1, 0.1)], [[1.0, 0.0]], [[d]], [0.3, -0.2], 4)


def hidden(d):
    """Two states that are only seen as their sum and forget at rates that differ by d; vague at first."""
    step = {"f": diagonal([1.0, 1.0 - d]), "q": eye(2, 0.0)}
    return rung(d, [0.0, 0.0], eye(2, 100 / d**2), seconds(12), [step], [[1.0, 1.0]], [[1.0]], [1.0, 0.5], 5)


def outlier(d):
    """The fourth of eight measurements is off by d standard deviations."""
    out = rung(d, [0.0, 0.0], eye(2), seconds(8), [wander(1, 0.1)], [[1.0, 0.0]], [[1.0]], [0.3, -0.2], 6)
    out["z"][3][0] += d
    return out


def crossing(d):
    """A heading that turns and is measured within ±180 degrees; d is its standard deviation at first, in degrees."""
    sigma, step = math.radians(d), wander(1, 1e-4)
    cov, mean = diagonal([sigma**2, 0.01]), [3.1, 0.7]
    r = [[0.0025]]
    return rung(d, mean, cov, seconds(30), [step], [[1.0, 0.0]], r, [3.1 + sigma / 2, 0.75], 7, period=math.tau)


def gaps(d):
    """Gaps of one and of d in turn."""
    pattern, times = [1.0, d, 1.0, d, d, 1.0, d, 1.0], []
    for gap in pattern:
        times.append((times[-1] if times else 0.0) + gap)
    exact = [mpf(b) - mpf(a) for a, b in zip([0.0, *times], times)]
    steps = [wander(gap, 0.1) for gap in exact]
    flow = {"a": [[0.0, 1.0], [0.0, 0.0]], "g": [[0.0], [math.sqrt(0.1)]]}
    return rung(d, [0.0, 0.0], eye(2, 100.0), times, steps, [[1.0, 0.0]], [[1.0]], [1.0, 0.5], 8, **flow)


def stiff(d):
    """A fast state that follows a slow one at the rate d."""
    a, g = [[-d, d], [0.0, -0.1]], diagonal([0.3 * math.sqrt(d), 0.3])
    # the stationary covariance X of dx = A x dt + G dβ: A X + X Aᵀ + G Gᵀ = 0, of its three entries
    rate, slow = mpf(d), mpf(-0.1)
    left = matrix([[-2 * rate, 2 * rate, 0], [0, slow - rate, rate], [0, 0, 2 * slow]])
    x, y, w = lu_solve(left, matrix([-mpf(g[0][0]) ** 2, 0, -mpf(g[1][1]) ** 2]))
    fast, slowly = exp(-rate), exp(slow)
    across = rate * (slowly - fast) / (rate + slow)
    top = x * fast**2 + 2 * y * fast * across + w * across**2
    q = [[x - top, y - (y * fast + w * across) * slowly], [0, w * (1 - slowly**2)]]
    q[1][0] = q[0][1]
    step = {"f": [[float(fast), float(across)], [0.0, float(slowly)]], "q": [[float(v) for v in row] for row in q]}
    h, r = [[1.0, 0.0]], [[0.01]]
    return rung(d, [0.0, 0.0], eye(2), seconds(6), [step], h, r, [0.5, 0.5], 9, a=a, g=g, only="continuous")


def long_run(d):
    """A hundred thousand rows with process noise d, to the steady state."""
    out = rung(d, [0.0, 0.0], eye(2), [1.0], [wander(1, d)], [[1.0, 0.0]], [[1.0]], [1.0, 0.0], 10, repeat=100000)
    out["z"] = [[1.0]]
    return out


#: Name, its ladder, and what d is.
CASES = [
    (nearly_singular, ladder(-1, -13), "P_zz singular but for d"),
    (vague, ladder(2, 30, 2), "initial variance d"),
    (zero_and_vague, ladder(2, 30, 2), "initial variances d, d and 0"),
    (precise, ladder(-2, -24, 2), "R = d"),
    (hidden, ladder(-1, -14), "rates of forgetting that differ by d"),
    (outlier, ladder(1, 15), "one measurement d standard deviations off"),
    (crossing, [1.0, 5.0, 10.0, 20.0, 30.0], "a heading across ±180°, known to d degrees at first"),
    (gaps, ladder(-1, -9), "gaps of 1 and d in turn, d short"),
    (gaps, ladder(1, 9), "gaps of 1 and d in turn, d long"),
    (stiff, ladder(0, 9), "drift of rate d"),
    (long_run, ladder(-2, -14, 2), "100000 rows, process noise d"),
]

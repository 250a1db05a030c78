"""The answers of stress.json by another road: all measurements and the last state as one Gaussian, conditioned at once."""

import json

import numpy as np
from mpmath import mp, mpf

import stress
from linear import divide, factor
from precise import exact, zeros


def at_once(rung, numbers):
    """The last state given all measurements; the largest matrix has a row for each of them."""
    f, q = ([exact(step[key]) for step in numbers["steps"]] for key in ("f", "q"))
    h, r = exact(numbers["h"]), exact(numbers["r"])
    n, d, rows = h.shape[1], h.shape[0], len(numbers["z"])
    mean, own = exact(numbers["mean"]), exact(numbers["cov"])
    # images[k][j]: the covariance of the states at rows k and j, before any measurement
    means, images = [], [[]]
    for k in range(rows):
        step = min(k, len(f) - 1)
        mean, own = f[step] @ mean, f[step] @ own @ f[step].T + q[step]
        means.append(h @ mean)
        images.append([f[step] @ of for of in images[-1]] + [own])
    images = images[1:]
    s = zeros(rows * d, rows * d)
    for k in range(rows):
        for j in range(k + 1):
            block = h @ images[k][j] @ h.T
            s[k * d : (k + 1) * d, j * d : (j + 1) * d] = block + (r if j == k else 0 * r)
            s[j * d : (j + 1) * d, k * d : (k + 1) * d] = s[k * d : (k + 1) * d, j * d : (j + 1) * d].T
    across = np.concatenate([images[-1][j] @ h.T for j in range(rows)], axis=1)
    turned = stress.turns(rung) if "period" in rung else [[0] * d] * rows
    z = exact(numbers["z"]) + mpf(rung.get("period", 0.0)) * exact([[float(t) for t in row] for row in turned])
    gain = divide(across, factor(s, "covariance of all measurements"))
    return mean + gain @ (z.reshape(-1) - np.concatenate(means)), own - gain @ across.T


def main(golden):
    worst = 0
    for name, case in json.loads((golden / "stress.json").read_text()).items():
        for rung in case["rungs"]:
            if "repeat" in rung:
                continue
            for precision in ("f64", "f32"):
                if precision not in rung:
                    continue
                numbers = stress.changed(rung, stress.single if precision == "f32" else float)
                # the two roads cancel different terms: a hundred and twenty digits leave more than a double of each
                with mp.workdps(120):
                    m, p = at_once(rung, numbers)
                last = rung[precision]["rows"][-1]
                n = len(m)
                truth = zeros(n, n)
                for i in range(n):
                    for j in range(n):
                        truth[i, j] = mpf(last["cov"][max(i, j) * (max(i, j) + 1) // 2 + min(i, j)])
                error = stress.distance([(m, p)], [(exact(last["mean"]), truth)])
                # a mean far from zero in its own standard deviations is stored to so many of them
                stored = max(abs(x) / mp.sqrt(truth[i, i]) for i, x in enumerate(m) if truth[i, i] > 0)
                error /= 1 + stored
                worst = max(worst, error)
                if error > 1e-15:
                    print(f"{name}, d = {rung['d']}, {precision}: {float(error):.1e}")
                    return False
    print(f"stress, all measurements at once: {float(worst):.1e}")
    return True

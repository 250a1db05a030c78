"""The square-root form in doubles, by echelon triangularisation and downdates: only to check the covariance form."""

import numpy as np

from filtering import gap_steps, move_to, wrap
from linear import NotDefinite
from precise import exact
from rules import CentralDifference, Points, jacobian

EPS = np.finfo(float).eps


def doubles(array):
    return np.array(array, dtype=float)


def triangle(a):
    """Echelon Tria of the rows of `a`: a row with nothing left uses up no reflection."""
    a = np.array(a, dtype=float)
    rows, columns = a.shape
    out, used = np.zeros((rows, rows)), 0
    for j in range(rows):
        rest = a[j, used:]
        norm = np.linalg.norm(rest)
        if norm <= columns * EPS * np.linalg.norm(a[j]):
            a[j, used:] = 0.0
        else:
            v = rest.copy()
            v[0] += np.copysign(norm, v[0])
            v /= np.linalg.norm(v)
            a[j:, used:] -= 2 * np.outer(a[j:, used:] @ v, v)
            a[j:, used] *= np.sign(a[j, used])
            out[j:, j] = a[j:, used]
            used += 1
    return out


def downdate(l, v, name):
    """L Lᵀ − v vᵀ; `name(k)` is the matrix that pivot k belongs to."""
    l, v = l.copy(), v.copy()
    for k in range(len(v)):
        # the square of the pivot is known to the rounding of the row, times what is subtracted from what
        small = 64 * EPS * np.linalg.norm(l[k, : k + 1])
        size = max(l[k, k], abs(v[k]))
        square = (l[k, k] - v[k]) * (l[k, k] + v[k])
        if size <= small:
            l[k:, k] = 0.0
        elif square < -small * size:
            raise NotDefinite(name(k), k)
        elif square <= small * size:
            l[k:, k] = 0.0
            return l
        else:
            r = np.sqrt(square)
            c, s = r / l[k, k], v[k] / l[k, k]
            l[k, k] = r
            l[k + 1 :, k] = (l[k + 1 :, k] - s * v[k + 1 :]) / c
            v[k + 1 :] = c * v[k + 1 :] - s * l[k + 1 :, k]
    return l


def spread(rule, g, m, s, move=lambda y, centre: y):
    """Mean, and weighted deviations out and in, with the sign of every column."""
    n = len(m)
    at = lambda x: doubles(g(exact(x)))
    centre = lambda: at(m[:, None])
    if isinstance(rule, Points):
        nodes, weights, cov_weights = doubles(rule.nodes), doubles(rule.weights), doubles(rule.cov_weights)
        y = doubles(move(at(m[:, None] + s @ nodes), centre))
        # from one image, so that what is the same at all points has no deviation, not even by rounding
        mean = y[:, 0] + (y - y[:, :1]) @ weights
        roots = np.sqrt(np.abs(cov_weights))
        return mean, (y - mean[:, None]) * roots, (s @ nodes) * roots, np.sign(cov_weights)
    if isinstance(rule, CentralDifference):
        eta = float(rule.eta)
        y = doubles(move(at(np.hstack([m[:, None], m[:, None] + eta * s, m[:, None] - eta * s])), centre))
        g0, plus, minus = y[:, :1], y[:, 1 : n + 1], y[:, n + 1 :]
        mean = (eta**2 - n) / eta**2 * g0[:, 0] + (plus + minus).sum(axis=1) / (2 * eta**2)
        second = np.sqrt(eta**2 - 1) / (2 * eta**2) * (plus + minus - 2 * g0)
        return mean, np.hstack([(plus - minus) / (2 * eta), second]), np.hstack([s, 0 * s]), np.ones(2 * n)
    return centre()[:, 0], doubles(jacobian(g, exact(m))) @ s, s, np.ones(n)


def block(out, inside, signs, noise, name):
    """Tria([out noise; inside 0]), downdated by the columns of negative sign."""
    whole = np.vstack([out, inside])
    extra = np.vstack([noise, np.zeros((inside.shape[0], noise.shape[1]))])
    l = triangle(np.hstack([whole[:, signs > 0], extra]))
    for j in np.flatnonzero(signs < 0):
        l = downdate(l, whole[:, j], name)
    return l


def back_divide(b, l):
    """B L⁻¹, a zero column where the pivot is zero."""
    x = b.copy()
    for j in reversed(range(l.shape[0])):
        x[:, j] -= x[:, j + 1 :] @ l[j + 1 :, j]
        x[:, j] = x[:, j] / l[j, j] if l[j, j] else 0.0
    return x


def root(p):
    """A root of a covariance matrix that may be singular."""
    p = doubles(p)
    s = np.zeros_like(p)
    for j in range(len(p)):
        pivot = p[j, j] - s[j, :j] @ s[j, :j]
        if pivot > 64 * len(p) * EPS * p[j, j]:
            s[j, j] = np.sqrt(pivot)
            s[j + 1 :, j] = (p[j + 1 :, j] - s[j + 1 :, :j] @ s[j, :j]) / s[j, j]
    return s


def run(model, rule, rows):
    """Rows (predicted, filtered, smoothed: mean and factor; innovation root), or where it failed."""
    m, s = doubles(model.mean), root(model.cov)
    time, controls = (rows[0].time if model.time is None else exact(float(model.time))), rows[0].controls
    steps_back, beliefs, results, n = [], [(m, s)], [], model.n
    for k, row in enumerate(rows):
        try:
            if row.time > time:
                steps, dt = gap_steps(model, row.time - time)
                for step in range(steps):
                    at = time + step * dt
                    g = lambda x: model.transition(x, at, dt, controls)
                    mean, out, inside, signs = spread(rule, g, m, s)
                    noise = root(model.process_noise(at, dt, controls))
                    l = block(out, inside, signs, noise, lambda i: "predicted covariance" if i < n else "conditional")
                    steps_back.append((mean, back_divide(l[n:, :n], l[:n, :n]), l[n:, n:]))
                    m, s = mean, l[:n, :n]
                    beliefs.append((m, s))
                time = row.time
            controls = row.controls
            predicted, d, log_likelihood = (m, s), len(row.z), 0.0
            if row.present:
                h = lambda x: model.observe(row.present, x, row.time, row.controls)
                full = [(i, j) for i, sensor in enumerate(model.sensors) for j in range(len(sensor.measures))]
                noise = root(model.measurement_noise(full, row.time, row.controls))[
                    [full.index(p) for p in row.present]
                ]
                z_hat, out, inside, signs = spread(rule, h, m, s, move_to(row.periods))
                name = lambda i: "innovation covariance" if i < d else "posterior covariance"
                l = block(out, inside, signs, noise, name)
                nu = np.array(
                    [float(z - e if p is None else wrap(z - e, p)) for z, e, p in zip(row.z, exact(z_hat), row.periods)]
                )
                white = np.linalg.solve(l[:d, :d], nu)
                log_likelihood = -(white @ white + d * np.log(2 * np.pi)) / 2 - np.log(np.diag(l)[:d]).sum()
                m, s = m + l[d:, :d] @ white, l[d:, d:]
                beliefs[-1] = (m, s)
        except NotDefinite as error:
            return results, {"row": k, "matrix": error.matrix}
        results.append([len(beliefs) - 1, predicted, (m, s), log_likelihood])
    smoothed = {len(beliefs) - 1: (m, s)}
    for k in reversed(range(len(beliefs) - 1)):
        ahead, gain, rest = steps_back[k]
        m, s = smoothed[k + 1]
        smoothed[k] = beliefs[k][0] + gain @ (m - ahead), triangle(np.hstack([rest, gain @ s]))
    return [result + [smoothed[result[0]]] for result in results], None

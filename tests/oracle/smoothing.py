"""Fixed-interval, fixed-lag and fixed-point smoothing of a filtered run, in covariance form."""

from linear import NotDefinite, divide, factor


def gains(run):
    """The smoother gain of every transition."""
    return [
        divide(node.following[2], factor(node.following[1], "predicted covariance"))
        for node in run.nodes
        if node.following is not None
    ]


def conditional_failure(run):
    """The first transition k → k+1 after which Cov[x_k given x_{k+1}] = P − G P⁻ Gᵀ is indefinite, or None.

    The covariance form never needs that matrix to be one; the square-root form has to take its root.
    """
    for k, gain in enumerate(gains(run)):
        node = run.nodes[k]
        try:
            factor(node.cov - gain @ node.following[1] @ gain.T, "conditional covariance", scale=node.cov)
        except NotDefinite:
            return k
    return None


def backwards(run, gain, last, mean, cov, first=0):
    """Yields (node, mean, covariance) from node `last`, where the belief is given, down to node `first`."""
    yield last, mean, cov
    for k in reversed(range(first, last)):
        node = run.nodes[k]
        m, p, _ = node.following
        mean = node.mean + gain[k] @ (mean - m)
        cov = node.cov + gain[k] @ (cov - p) @ gain[k].T
        yield k, mean, cov


def fixed_interval(run):
    """Smoothed mean and covariance of every node."""
    last = len(run.nodes) - 1
    smoothed = {k: (m, p) for k, m, p in backwards(run, gains(run), last, run.nodes[last].mean, run.nodes[last].cov)}
    return [smoothed[k] for k in range(last + 1)]


def given(run, gain, at, until):
    """The state at row `at`, given the rows up to `until`."""
    row = run.rows[until]
    *_, (_, mean, cov) = backwards(run, gain, row.node, row.mean, row.cov, first=run.rows[at].node)
    return mean, cov


def fixed_lag(run, lag):
    """Every row, given itself and the next `lag` rows."""
    gain, last = gains(run), len(run.rows) - 1
    return [given(run, gain, i, min(i + lag, last)) for i in range(last + 1)]


def fixed_point(run, at):
    """Row `at` (counted from 0), given the rows up to `at`, `at` + 1, … in turn."""
    gain = gains(run)
    return [given(run, gain, at, k) for k in range(at, len(run.rows))]

"""The data of every scenario: drawn from its own model with a fixed seed, or taken from discrete.json."""

import json
from random import Random

import numpy as np
from mpmath import mpf

from filtering import gap_steps, wrap
from linear import factor
from model import Row

ALL = object()
NOTHING = ()


class Plan:
    """When rows stand, what is measured in each, and what drives the model.

    rows: (time, measures) or (time, sensor, measures); ALL measures, some by name, or NOTHING.
    truth: the true start, or None for a draw from the prior. rules: only these. hard: rules that plain downdates in doubles cannot serve (checks.py).
    """

    def __init__(self, seed, rows, truth=None, control=None, rules=None, hard=(), lag=False):
        self.seed, self.truth, self.control = seed, truth, control
        self.rules, self.hard, self.lag = rules, hard, lag
        self.rows = [row if len(row) == 3 else (row[0], None, row[1]) for row in rows]


def every(dt, count, start=0.0):
    return [(start + dt * (k + 1), ALL) for k in range(count)]


def torque(t):
    return round(1.5 if int(t / 0.6) % 2 else -1.0, 1)


# α = 1e-3 loses ten digits: by its weights, doubles cannot tell a zero pivot from its rounding then. In growing_rank the
# smoother of any rule with a negative weight downdates by a column that is zero but for rounding. Fifty digits can.
SMALL = ("unscented_small",)
RADAR, POSITION = ("range", "bearing"), ("px", "py")
PLANS = {
    "missing": Plan(
        1,
        [
            (1.0, ALL),
            (2.0, ("range", "px", "py")),
            (3.0, ("bearing",)),
            (4.0, POSITION),
            (5.0, NOTHING),
            (6.0, ("range", "py")),
            (7.5, ("px",)),
            (8.0, RADAR),
            (10.0, ("bearing", "py")),
            (11.0, NOTHING),
            (12.0, NOTHING),
            (13.0, ("range", "bearing", "px")),
            (13.5, ALL),
            (15.0, ("py",)),
        ],
        lag=True,
    ),
    "crossing": Plan(2, every(4.0, 20), truth=[-1080, 2, 20, 58, 0.155], lag=True),
    "degrees": Plan(3, every(2.0, 12, 10.0), truth=[15, -2.5, -1000, 5], lag=True),
    "three_d": Plan(4, every(1.0, 12), lag=True),
    "driven": Plan(
        5,
        [(t, ALL) for t in (0.7, 0.75, 0.9, 1.3, 1.4, 1.45, 1.85, 1.9, 2.2, 2.3, 2.65, 2.7, 3.0, 3.1)],
        control=torque,
        lag=True,
    ),
    "fixed_step": Plan(6, [(t, ALL) for t in (0.25, 1.0, 1.5, 3.0, 3.25, 4.25, 5.0, 5.5, 6.75, 7.0)], lag=True),
    "known_state": Plan(7, every(2.0, 10)),
    "duplicated_state": Plan(8, every(0.5, 10), hard=SMALL),
    "no_noise": Plan(9, every(0.5, 12), hard=SMALL),
    "contracting": Plan(18, every(1.0, 40), rules=("cubature3", "unscented", "central_difference", "taylor")),
    "growing_rank": Plan(10, every(1.0, 10), hard=SMALL + ("unscented", "unscented_half")),
    "reentry": Plan(
        11,
        every(0.5, 60),
        truth=[61000, 3048, 4.49e-4],
        rules=["cubature3", "gauss_hermite3", "central_difference", "taylor"],
    ),
    "innovation_fails": Plan(12, every(1.0, 4)),
    "posterior_fails": Plan(13, every(1.0, 4), truth=[2, 0.5, -0.5, 0.3, 0.2]),
    "predicted_fails": Plan(14, every(1.0, 4)),
    "conditional_fails": Plan(17, every(1.0, 4)),
    "prediction_rows": Plan(
        15,
        [
            (0.1, NOTHING),
            (0.2, ALL),
            (0.3, NOTHING),
            (0.45, NOTHING),
            (0.5, ALL),
            (0.6, ALL),
            (0.65, NOTHING),
            (0.8, ALL),
            (1.0, NOTHING),
            (1.1, ALL),
            (1.2, NOTHING),
            (1.5, NOTHING),
        ],
        lag=True,
    ),
    "one_time": Plan(
        16,
        [
            (2.0, "west", ALL),
            (2.0, "east", ALL),
            (3.0, "west", ALL),
            (4.0, "east", ALL),
            (4.0, "west", ALL),
            (5.5, "east", ("bearing",)),
            (6.0, "west", NOTHING),
            (7.0, "west", ALL),
            (7.0, "east", ALL),
        ],
    ),
}


def gaussian(random, mean, cov):
    s = factor(cov, "simulated covariance")
    return mean + s @ np.array([mpf(random.gauss(0.0, 1.0)) for _ in mean], dtype=object)


def record(plan, model, time, sensor, measures):
    """The row as its line will stand in the file, measurements still to come."""
    fields = {"time": repr(time)}
    if any(row[1] for row in plan.rows):
        fields["sensor"] = sensor or ""
    if plan.control:
        fields["u_torque"] = repr(plan.control(time))
    for s in model.sensors:
        for name in s.measures:
            here = sensor in (None, s.name) and (measures is ALL or name in measures)
            fields[name] = "0.0" if here else fields.get(name, "")
    return fields


def simulate(plan, model):
    """The lines of the data file as dictionaries."""
    random = Random(plan.seed)
    records = [record(plan, model, *row) for row in plan.rows]
    rows = [Row(model, fields) for fields in records]
    x = gaussian(random, model.mean, model.cov) if plan.truth is None else np.array([mpf(v) for v in plan.truth])
    time, controls = mpf(model.time), rows[0].controls
    for fields, row in zip(records, rows):
        if row.time > time:
            steps, dt = gap_steps(model, row.time - time)
            for step in range(steps):
                at = time + step * dt
                x = gaussian(
                    random, model.transition(x[:, None], at, dt, controls)[:, 0], model.process_noise(at, dt, controls)
                )
        time, controls = row.time, row.controls
        if not row.present:
            continue
        h = model.observe(row.present, x[:, None], row.time, row.controls)[:, 0]
        z = gaussian(random, h, model.measurement_noise(row.present, row.time, row.controls))
        for name, value, period in zip(row.measures, z, row.periods):
            fields[name] = repr(float(value if period is None else wrap(value, period)))
    return records


def published(scenario, golden, model):
    """The measurements of a scenario of discrete.json, at times 1, 2, …"""
    z = json.loads((golden / "discrete.json").read_text())["scenarios"][scenario]["z"]
    names = model.sensors[0].measures
    return [{"time": repr(float(k + 1))} | {n: repr(v) for n, v in zip(names, row)} for k, row in enumerate(z)]

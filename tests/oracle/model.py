"""A model file and its data, read as the design describes them."""

import csv
import tomllib
from pathlib import Path

import numpy as np
from mpmath import mp, mpf

from expressions import column, evaluate, parse
from precise import exact, zeros


def in_order(entry, names):
    """Lists stand in order, tables go by name."""
    return entry if isinstance(entry, list) else [entry[name] for name in names]


class Sensor:
    def __init__(self, table):
        self.name = table["name"]
        self.measures = list(table["measures"])
        self.functions = [parse(text) for text in table["measures"].values()]
        self.std = [parse(s) for s in in_order(table["std"], self.measures)] if "std" in table else None
        self.cov = [[parse(c) for c in row] for row in table["cov"]] if "cov" in table else None
        angles = table.get("angles", [])
        periods = {name: None for name in angles} if isinstance(angles, list) else angles
        self.periods = [
            (2 * mp.pi if periods[name] is None else mpf(periods[name])) if name in periods else None
            for name in self.measures
        ]

    def noise(self, names):
        if self.cov is not None:
            return np.array([[evaluate(c, names) for c in row] for row in self.cov], dtype=object)
        r = zeros(len(self.std), len(self.std))
        for i, std in enumerate(self.std):
            r[i, i] = evaluate(std, names) ** 2
        return r


class Model:
    def __init__(self, path):
        self.file = tomllib.loads(Path(path).read_text())
        state, dynamics = self.file["state"], self.file["dynamics"]
        self.names = state["names"]
        self.n = len(self.names)
        self.time = state.get("time")
        self.mean = exact(in_order(state["mean"], self.names))
        if "cov" in state:
            self.cov = exact(state["cov"])
        else:
            self.cov = zeros(self.n, self.n)
            for i, std in enumerate(in_order(state["std"], self.names)):
                self.cov[i, i] = mpf(std) ** 2
        self.parameters = {name: mpf(value) for name, value in self.file.get("parameters", {}).items()}
        self.let = {name: parse(text) for name, text in self.file.get("let", {}).items()}
        self.next = [parse(text) for text in in_order(dynamics["transition"], self.names)]
        self.noise_cov = [[parse(q) for q in row] for row in dynamics["noise_cov"]]
        self.step = mpf(dynamics["step"]) if "step" in dynamics else None
        self.sensors = [Sensor(table) for table in self.file["sensor"]]

    def _names(self, x, t, dt, u):
        names = dict(self.parameters) | u | {"t": t, "dt": dt}
        if x is not None:
            names |= dict(zip(self.names, x))
        for name, tree in self.let.items():
            try:
                names[name] = evaluate(tree, names)
            except KeyError:  # needs the state, and noise may not ask for it
                pass
        return names

    def transition(self, x, t, dt, u):
        """f at the columns of `x` (n × points)."""
        names = self._names(x, t, dt, u)
        return np.array([column(evaluate(tree, names), x.shape[1]) for tree in self.next], dtype=object)

    def process_noise(self, t, dt, u):
        names = self._names(None, t, dt, u)
        return np.array([[evaluate(q, names) for q in row] for row in self.noise_cov], dtype=object)

    def observe(self, present, x, t, u):
        """The measures `present`, pairs (sensor, component), at the columns of `x`. A measure knows no dt."""
        names = self._names(x, t, mpf("nan"), u)
        return np.array(
            [column(evaluate(self.sensors[s].functions[i], names), x.shape[1]) for s, i in present], dtype=object
        )

    def measurement_noise(self, present, t, u):
        names = self._names(None, t, mpf("nan"), u)
        full = [sensor.noise(names) for sensor in self.sensors]
        return np.array([[full[s][i, j] if s == q else mpf(0) for q, j in present] for s, i in present], dtype=object)


class Row:
    """One line of the data: time, controls, the measures that are there (model order) and their values."""

    def __init__(self, model, record):
        self.time = mpf(float(record["time"]))
        self.sensor = record.get("sensor") or None
        self.controls = {name: mpf(float(value)) for name, value in record.items() if name.startswith("u_")}
        self.present, self.z = [], []
        for s, sensor in enumerate(model.sensors):
            if self.sensor not in (None, sensor.name):
                continue
            for i, name in enumerate(sensor.measures):
                if record.get(name):
                    self.present.append((s, i))
                    self.z.append(mpf(float(record[name])))
        self.measures = [model.sensors[s].measures[i] for s, i in self.present]
        self.periods = [model.sensors[s].periods[i] for s, i in self.present]


def read_rows(model, path):
    with open(path, newline="") as file:
        return [Row(model, record) for record in csv.DictReader(file)]

"""Models that the tests of the native half share."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from givens._native import Choice, Function, Graph, Model

GOLDEN = Path(__file__).parents[2] / "tests" / "golden"

#: A mass on a spring that is measured by its distance from a point one unit beside it.
SPRING = """
[state]
names = ["x", "v"]
time = 0.0
mean = [1, 0]
std = [0.3, 0.2]
[parameters]
k = 2.0
q = 0.1
[dynamics]
drift = { x = "v", v = "-k*sin(x)" }
diffusion = { v = "q" }
[[sensor]]
name = "range"
measures = { r = "hypot(x, 1)" }
std = [0.1]
"""

#: The same in steps of any length, by Euler.
STEPS = SPRING.replace('drift = { x = "v", v = "-k*sin(x)" }', 'transition = { x = "x + dt*v", v = "v - dt*k*sin(x)" }')
STEPS = STEPS.replace('diffusion = { v = "q" }', 'noise_cov = [["0", "0"], ["0", "q^2*dt"]]')

TIME: NDArray[np.float64] = np.arange(1, 21) * 0.1
Z: NDArray[np.float64] = (1.4 + 0.1 * np.sin(9 * TIME))[:, None]
MEAN: NDArray[np.float64] = np.array([1.0, 0.0])
STD: NDArray[np.float64] = np.array([0.3, 0.2])


class Nodes:
    """The graph of the spring."""

    def __init__(self) -> None:
        g = self.graph = Graph()
        x, v, dt = g.state(0), g.state(1), g.step()
        k, q = g.parameter(0), g.parameter(1)
        zero, one = g.constant(0.0), g.constant(1.0)
        force = g.unary("neg", g.binary("mul", k, g.unary("sin", x)))
        self.drift = [v, force]
        self.diffusion = [zero, q]
        step = [g.binary("mul", dt, v), g.binary("mul", dt, force)]
        self.transition = [g.binary("add", x, step[0]), g.binary("add", v, step[1])]
        self.noise_cov = [zero, zero, zero, g.binary("mul", g.power(q, 2), dt)]
        self.range = [g.binary("hypot", x, one)]
        self.std = [g.constant(0.1)]

    def sensors(self, **other: Any) -> list[Any]:
        return [{"name": "range", "columns": ["r"], "measures": self.range, "std": self.std} | other]


def continuous(sensor: dict[str, Any] | None = None, **other: Any) -> Model:
    """The spring, traced, with other parts."""
    nodes = Nodes()
    parts: dict[str, Any] = {"drift": nodes.drift, "diffusion": nodes.diffusion, "noises": 1}
    sensors = nodes.sensors(**(sensor or {}))
    return Model.continuous(nodes.graph, ["x", "v"], 0, [2.0, 0.1], sensors=sensors, **(parts | other))


def discrete(sensor: dict[str, Any] | None = None, **other: Any) -> Model:
    """The spring in steps, traced, with other parts."""
    nodes = Nodes()
    parts: dict[str, Any] = {"transition": nodes.transition, "noise_cov": nodes.noise_cov, "step": None}
    sensors = nodes.sensors(**(sensor or {}))
    return Model.discrete(nodes.graph, ["x", "v"], 0, [2.0, 0.1], sensors=sensors, **(parts | other))


def drift(t: float, dt: float, x: Any, u: Any, p: Any) -> Any:
    return np.stack([x[1], -p[0] * np.sin(x[0])])


def drift_jacobian(t: float, dt: float, x: Any, u: Any, p: Any) -> Any:
    return [[0, 1], [-p[0] * np.cos(x[0, 0]), 0]]


def transition(t: float, dt: float, x: Any, u: Any, p: Any) -> Any:
    return x + dt * drift(t, dt, x, u, p)


def transition_jacobian(t: float, dt: float, x: Any, u: Any, p: Any) -> Any:
    return np.eye(2) + dt * np.array(drift_jacobian(t, dt, x, u, p), dtype=float)


def distance(t: float, dt: float, x: Any, u: Any, p: Any) -> Any:
    return np.hypot(x[:1], 1)


def distance_jacobian(t: float, dt: float, x: Any, u: Any, p: Any) -> Any:
    return [[x[0, 0] / np.hypot(x[0, 0], 1), 0]]


def called(function: Any) -> Function:
    return Function.callable(function)


def choose(method: str | None, kind: Any = "discrete", **options: Any) -> Choice:
    return Choice(method, options, kind)

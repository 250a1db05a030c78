"""The problems on which `givens`, its peers and `reference.py` are compared.

A problem is one model with one set of data, drawn once: `python draw.py` writes `problems.json`, everything else reads it. The functions take the array module as `xp`, so that the
peers built on JAX run the very same lines.
"""

import hashlib
import json
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
FILE = Path(__file__).with_name("problems.json")
SEED = 20261121


@dataclass(frozen=True)
class Problem:
    """Rows (t, z), NaN where missing; the initial belief N(mean, cov) at t0; R; which measures are angles; the numbers of the model."""

    name: str
    t0: float
    t: Array
    z: Array
    mean: Array
    cov: Array
    noise: Array
    angles: tuple[int, ...] = ()
    numbers: dict[str, float] = field(default_factory=dict)


class Linear(Problem):
    """Constant velocity in the plane, states (x, vx, y, vy); both positions are measured with correlated errors."""

    def transition(self, x: Any, dt: Any, xp: ModuleType = np) -> Any:
        return xp.stack([x[0] + dt * x[1], x[1], x[2] + dt * x[3], x[3]])

    def transition_jacobian(self, x: Array, dt: float) -> Array:
        step = np.array([[1.0, dt], [0.0, 1.0]])
        return np.kron(np.eye(2), step)

    def noise_cov(self, dt: float) -> Array:
        return np.kron(np.eye(2), self.numbers["q"] * np.array([[dt**3 / 3, dt**2 / 2], [dt**2 / 2, dt]]))

    def measure(self, x: Any, xp: ModuleType = np) -> Any:
        return xp.stack([x[0], x[2]])

    def measure_jacobian(self, x: Array) -> Array:
        return np.eye(4)[[0, 2]]


class Turn(Problem):
    """Coordinated turn, states (x, vx, y, vy, w), seen in range and bearing; w stays away from zero."""

    def transition(self, x: Any, dt: Any, xp: ModuleType = np) -> Any:
        w = x[4]
        a, b = xp.sin(w * dt) / w, (1 - xp.cos(w * dt)) / w
        c, s = xp.cos(w * dt), xp.sin(w * dt)
        return xp.stack(
            [x[0] + a * x[1] - b * x[3], c * x[1] - s * x[3], x[2] + b * x[1] + a * x[3], s * x[1] + c * x[3], w]
        )

    def transition_jacobian(self, x: Array, dt: float) -> Array:
        _, vx, _, vy, w = x
        s, c = np.sin(w * dt), np.cos(w * dt)
        a, b = s / w, (1 - c) / w
        da, db = (dt * c - a) / w, (dt * s - b) / w
        return np.array(
            [
                [1, a, 0, -b, da * vx - db * vy],
                [0, c, 0, -s, -dt * (s * vx + c * vy)],
                [0, b, 1, a, db * vx + da * vy],
                [0, s, 0, c, dt * (c * vx - s * vy)],
                [0, 0, 0, 0, 1],
            ]
        )

    def noise_cov(self, dt: float) -> Array:
        cov = np.zeros((5, 5))
        cov[:4, :4] = np.kron(np.eye(2), self.numbers["q"] * np.array([[dt**3 / 3, dt**2 / 2], [dt**2 / 2, dt]]))
        cov[4, 4] = self.numbers["q_turn"] * dt
        return cov

    def measure(self, x: Any, xp: ModuleType = np) -> Any:
        return xp.stack([xp.sqrt(x[0] ** 2 + x[2] ** 2), xp.arctan2(x[2], x[0])])

    def measure_jacobian(self, x: Array) -> Array:
        r = np.hypot(x[0], x[2])
        return np.array([[x[0] / r, 0, x[2] / r, 0, 0], [-x[2] / r**2, 0, x[0] / r**2, 0, 0]])


class Pendulum(Problem):
    """A damped pendulum in continuous time, states (angle, rate, k), k = g / length unknown; the bob's horizontal position, sin(angle), is measured now and then."""

    def drift(self, x: Any, xp: ModuleType = np) -> Any:
        return xp.stack([x[1], -x[2] * xp.sin(x[0]) - self.numbers["damping"] * x[1], 0 * x[2]])

    def drift_jacobian(self, x: Array) -> Array:
        return np.array([[0, 1, 0], [-x[2] * np.cos(x[0]), -self.numbers["damping"], -np.sin(x[0])], [0, 0, 0]])

    def diffusion(self) -> Array:
        """The diagonal of G."""
        return np.array([0.0, self.numbers["g_rate"], self.numbers["g_k"]])

    def measure(self, x: Any, xp: ModuleType = np) -> Any:
        return xp.stack([xp.sin(x[0])])

    def measure_jacobian(self, x: Array) -> Array:
        return np.array([[np.cos(x[0]), 0, 0]])


KINDS: dict[str, type[Problem]] = {
    "linear": Linear,
    "linear-gaps": Linear,
    "linear-holes": Linear,
    "turn": Turn,
    "turn-west": Turn,
    "pendulum": Pendulum,
}


def load(name: str) -> Any:
    """The problem of this name, as it stands in `problems.json`."""
    one = json.loads(FILE.read_text())["problems"][name]
    arrays = {key: np.array(one[key], dtype=float) for key in ("t", "z", "mean", "cov", "noise")}
    return KINDS[name](name, one["t0"], angles=tuple(one["angles"]), numbers=one["numbers"], **arrays)


def digest() -> str:
    """Of the data: answers recorded for others are refused."""
    return hashlib.sha256(FILE.read_bytes()).hexdigest()

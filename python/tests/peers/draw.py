"""Draws the data of the problems, once: `python draw.py` writes `problems.json`. NumPy only."""

import json
from typing import Any

import numpy as np
from problems import FILE, SEED, Array, Linear, Pendulum, Problem, Turn

ROWS = 30


def discrete(model: Any, rng: np.random.Generator, x: Array) -> Array:
    """One measurement for each row, from the true initial state x at t0."""
    z, before = [], model.t0
    for t in model.t:
        if (dt := t - before) > 0:
            x = rng.multivariate_normal(model.transition(x, dt), model.noise_cov(dt))
        z.append(rng.multivariate_normal(model.measure(x), model.noise))
        before = t
    return np.array(z)


def continuous(model: Any, rng: np.random.Generator, x: Array, steps: int = 200) -> Array:
    """The same by Euler–Maruyama, `steps` to a gap."""
    z, before = [], model.t0
    for t in model.t:
        dt = (t - before) / steps
        for _ in range(steps if dt > 0 else 0):
            x = x + dt * model.drift(x) + np.sqrt(dt) * model.diffusion() * rng.standard_normal(x.size)
        z.append(rng.multivariate_normal(model.measure(x), model.noise))
        before = t
    return np.array(z)


def written(problem: Problem, z: Array, **changed: Any) -> dict[str, Any]:
    """As JSON; NaN is null."""
    rows = [[None if np.isnan(number) else number for number in row] for row in z.tolist()]
    plain = {key: getattr(problem, key).tolist() for key in ("t", "mean", "cov", "noise")}
    return {"t0": problem.t0, **plain, "z": rows, "angles": list(problem.angles), "numbers": problem.numbers} | changed


def main() -> None:
    rng = np.random.default_rng(SEED)
    none = np.empty((0, 0))
    # Gaps are exact in binary and in microseconds (Stone Soup's clock).
    t = np.cumsum(rng.choice([0.5, 0.75, 1.0, 1.25, 2.0], ROWS))
    cov = np.array([[4, 0.5, 0.3, 0], [0.5, 1, 0, 0.1], [0.3, 0, 9, -0.4], [0, 0.1, -0.4, 1]])
    linear = Linear(
        "linear", 0.0, t, none, np.array([0, 1, 5, -0.5]), cov, np.array([[2.25, 0.6], [0.6, 4]]), numbers={"q": 0.4}
    )
    z = discrete(linear, rng, rng.multivariate_normal(linear.mean, linear.cov))
    gaps, holes = z.copy(), z.copy()
    gaps[[4, 11, 12]] = np.nan
    holes[[4, 11, 12]] = np.nan
    holes[7, 0] = holes[20, 1] = holes[21, 1] = np.nan
    out = {"linear": written(linear, z), "linear-gaps": written(linear, gaps), "linear-holes": written(linear, holes)}

    t = np.concatenate([[0], np.cumsum(rng.choice([0.5, 1.0, 1.5, 2.0], ROWS - 1))])
    mean, std = np.array([2500, -40, -600, 45, 0.05]), np.array([30, 5, 30, 5, 0.01])
    numbers = {"q": 0.1, "q_turn": 1e-6}
    turn = Turn("turn", 0.0, t, none, mean, np.diag(std**2), np.diag([15.0**2, 0.004**2]), (1,), numbers)
    z = discrete(turn, rng, rng.multivariate_normal(mean, turn.cov))
    out["turn"] = written(turn, z)
    # The same turned by half a circle: the bearing crosses ±π.
    west = np.column_stack([z[:, 0], np.where(z[:, 1] > 0, z[:, 1] - np.pi, z[:, 1] + np.pi)])
    out["turn-west"] = written(turn, west, mean=(mean * [-1, -1, -1, -1, 1]).tolist())

    t = np.concatenate([[0], np.cumsum(rng.uniform(0.1, 0.6, ROWS - 1).round(2))])
    numbers = {"damping": 0.2, "g_rate": 0.2, "g_k": 0.1}
    cov = np.diag(np.array([0.2, 0.4, 0.8]) ** 2)
    swing = Pendulum("pendulum", 0.0, t, none, np.array([1.0, 0, 9.0]), cov, np.array([[0.05**2]]), (), numbers)
    out["pendulum"] = written(swing, continuous(swing, rng, rng.multivariate_normal(swing.mean, cov)))

    lines = [
        f'  "{name}": {{\n' + ",\n".join(f'    "{key}": {json.dumps(value)}' for key, value in one.items()) + "\n  }"
        for name, one in out.items()
    ]
    FILE.write_text(f'{{"seed": {SEED}, "numpy": "{np.__version__}", "problems": {{\n' + ",\n".join(lines) + "\n}}\n")


if __name__ == "__main__":
    main()

"""`givens` against the answers of independent packages, and against plain NumPy (peers/README.md).

A tolerance belongs to the peer: a few times the distance of its own answers from `reference.py`, measured when they were recorded. `givens` itself must be as near to the reference as rounding
and its solvers allow.
"""

import json
import sys
from pathlib import Path
from typing import Any

import givens as gv
import numpy as np
import pytest

PEERS = Path(__file__).with_name("peers")
sys.path.insert(0, str(PEERS))

import problems
import record

NAMES = ["filterpy", "dynamax", "cuthbert", "stonesoup", "cd_dynamax"]
FILES = {name: json.loads((PEERS / f"{name}.json").read_text()) for name in NAMES}
ANSWERS = [(peer, name) for peer in NAMES for name in FILES[peer]["answers"]]

# Largest distance allowed: means in standard deviations, covariances in σᵢσⱼ, the log-likelihood's sum.
ROUNDING = (3e-12, 3e-12, 3e-12)
CIRCULAR = (1e-5, 1e-6, 2e-5)  # means of bearings by sines and cosines
TOLERANCES = {
    ("filterpy", "turn-west filter ckf"): CIRCULAR,
    ("filterpy", "turn-west smooth ckf"): CIRCULAR,
    # 1e-9 is added to the diagonal of every matrix that is solved with: innovation covariances from 2.25 up,
    ("dynamax", "linear"): (3e-8, 3e-8, 1e-9),
    # against a bearing's variance of 1.6e-5 and a turn rate's of 1e-6,
    ("dynamax", "turn"): (3e-3, 6e-3, 5e-4),
    # and against a measurement's variance of 2.5e-3.
    ("cd_dynamax", "pendulum"): (2e-6, 3e-6, 3e-6),
    ("stonesoup", "linear filter ckf"): (1e-11, 1e-11, 1e-11),  # covariances as the difference of second moments
    ("stonesoup", "linear smooth ckf"): (1e-11, 1e-11, 1e-11),
    ("stonesoup", "turn filter ckf"): (1e-3, 1e-3, 2e-3),  # circular means, but products of the angles as they are
    ("stonesoup", "turn smooth ckf"): (1e-3, 1e-3, 2e-3),
    ("stonesoup", "turn"): CIRCULAR,
    ("stonesoup", "turn-west"): CIRCULAR,
}


def tolerance(peer: str, name: str) -> tuple[float, float, float]:
    """Of the answer, else of its problem, else rounding."""
    return TOLERANCES.get((peer, name)) or TOLERANCES.get((peer, name.split()[0])) or ROUNDING


def model(problem: Any) -> gv.Transition | gv.Sde:
    """Written as a user would, not with the functions of the problem: these are the reference's and the peers'."""
    if isinstance(problem, problems.Linear):
        steady = gv.Transition(constant_velocity, noise_cov=velocity_noise, state=["x", "vx", "y", "vy"])
        return steady.with_params(**problem.numbers)
    if isinstance(problem, problems.Turn):
        turning = gv.Transition(turn, noise_cov=turn_noise, state=["x", "vx", "y", "vy", "w"])
        return turning.with_params(**problem.numbers)
    return gv.Sde(pendulum, diffusion=problem.diffusion(), state=["angle", "rate", "k"])


def constant_velocity(t, dt, x):
    return [x[0] + dt * x[1], x[1], x[2] + dt * x[3], x[3]]


def velocity_noise(t, dt, q=1.0):
    block = q * np.array([[dt**3 / 3, dt**2 / 2], [dt**2 / 2, dt]])
    return np.block([[block, np.zeros((2, 2))], [np.zeros((2, 2)), block]])


def turn(t, dt, x):
    px, vx, py, vy, w = x
    a, b = np.sin(w * dt) / w, (1 - np.cos(w * dt)) / w
    return [
        px + a * vx - b * vy,
        np.cos(w * dt) * vx - np.sin(w * dt) * vy,
        py + b * vx + a * vy,
        np.sin(w * dt) * vx + np.cos(w * dt) * vy,
        w,
    ]


def turn_noise(t, dt, q=1.0, q_turn=1.0):
    cov = np.zeros((5, 5))
    cov[:4, :4] = velocity_noise(t, dt, q)
    cov[4, 4] = q_turn * dt
    return cov


def pendulum(t, x):
    angle, rate, k = x
    return [rate, -k * np.sin(angle) - 0.2 * rate, 0.0]


def sensor(problem: Any) -> gv.Sensor:
    if isinstance(problem, problems.Linear):
        return gv.Sensor(lambda t, x: [x[0], x[2]], measures=["x", "y"], cov=problem.noise)
    if isinstance(problem, problems.Turn):
        std = np.sqrt(np.diag(problem.noise))
        return gv.Sensor(radar, measures=["range", "bearing"], std=std, angles=["bearing"])
    return gv.Sensor(lambda t, x: [np.sin(x[0])], measures=["east"], std=np.sqrt(problem.noise[0]))


def radar(t, x):
    return [np.hypot(x[0], x[2]), np.arctan2(x[2], x[0])]


def ours(problem: Any, goal: str, method: str, **options: float) -> Any:
    if method.removeprefix("sr-").startswith("cd-"):
        options = {"rtol": 1e-10} | options
    run = gv.smooth if goal == "smooth" else gv.filter
    prior = gv.Gaussian(problem.mean, problem.cov)
    return run(
        model(problem), sensor(problem), problem.t, problem.z, prior=prior, t0=problem.t0, method=method, **options
    )


def assert_near(one: dict[str, Any], other: Any, allowed: tuple[float, float, float]) -> None:
    for what, far, most in zip(
        ("means", "covariances", "log-likelihood"), record.distance(one, other), allowed, strict=True
    ):
        assert far is None or far <= most, f"{what}: {far:.1e} apart, {most:.1e} allowed"


@pytest.mark.parametrize("peer", NAMES)
def test_the_answers_were_recorded_for_the_data_that_stand_here(peer: str) -> None:
    assert FILES[peer]["problems_sha256"] == problems.digest()


@pytest.mark.parametrize(("peer", "name"), ANSWERS)
def test_the_answer_of_a_peer_is_ours_to_what_the_peer_allows(peer: str, name: str) -> None:
    one = FILES[peer]["answers"][name]
    problem = problems.load(one["problem"])
    assert_near(one, ours(problem, one["goal"], one["method"], **one["options"]), tolerance(peer, name))


@pytest.mark.parametrize(
    ("peer", "name"), [(peer, name) for peer, name in ANSWERS if peer in ("filterpy", "stonesoup", "cuthbert")]
)
def test_both_forms_agree_with_the_peer(peer: str, name: str) -> None:
    one = FILES[peer]["answers"][name]
    method = one["method"].removeprefix("sr-")
    other = method if one["method"].startswith("sr-") else f"sr-{method}"
    assert_near(one, ours(problems.load(one["problem"]), one["goal"], other, **one["options"]), tolerance(peer, name))


QUESTIONS = [
    (problem, method, options)
    for problem in ("linear-holes", "turn", "turn-west")
    for method, options in (
        ("ekf", {}),
        ("ckf", {}),
        ("ukf", {}),
        ("ukf", {"kappa": 1.0}),
        ("ukf", {"alpha": 0.5, "beta": 2.0, "kappa": 1.0}),
    )
] + [("pendulum", method, options) for method, options in (("cd-ekf", {}), ("cd-ckf2", {}), ("cd-ukf", {"kappa": 1.0}))]


@pytest.mark.parametrize("goal", ["filter", "smooth"])
@pytest.mark.parametrize(("problem", "method", "options"), QUESTIONS)
def test_plain_numpy_comes_to_the_same(problem: str, method: str, options: dict[str, float], goal: str) -> None:
    ask = {"problem": problem, "goal": goal, "method": method, "options": options}
    answer = record.by_reference(ask)
    one = ask | {"mean": answer.mean, "cov_lower": lower(answer.cov), "log_likelihood": np.sum(answer.log_likelihood)}
    # The continuous reference takes 256 steps of RK4 to a gap; ours is asked for 1e-10.
    assert_near(
        one, ours(problems.load(problem), goal, method, **options), (3e-9, 3e-9, 3e-9) if "cd-" in method else ROUNDING
    )


def lower(cov: Any) -> Any:
    return cov[:, *np.tril_indices(cov.shape[1])]


@pytest.mark.parametrize(("peer", "name"), ANSWERS)
def test_no_tolerance_is_thirty_times_what_the_peer_needs(peer: str, name: str) -> None:
    """Where rounding is not all: a tolerance that hides a mistake would stand out here."""
    allowed = tolerance(peer, name)
    if allowed is not ROUNDING and "smooth" in name:  # one tolerance serves filter and smoother: the smoother needs it
        one = FILES[peer]["answers"][name]
        far = record.distance(one, record.by_reference(one))
        assert all(f <= a for f, a in zip(far, allowed, strict=True)), far
        assert any(a <= 30 * f for f, a in zip(far, allowed, strict=True)), far

"""The numbers of `tests/golden`, through the native half."""

from __future__ import annotations

import json
from functools import cache
from typing import Any

import numpy as np
import pytest
from native_models import GOLDEN

from givens._native import Choice, Estimates, Model, read_tracks, run

ROADS = [
    {"form": "covariance"},
    {"form": "square-root", "update": "joint"},
    {"form": "square-root", "update": "separate"},
]

#: Scenario: the bounds of `tests/tests/golden_oracle.rs`, of filter and smoothers.
BOUNDS = {
    "missing": (1e-12, 3e-12),
    "crossing": (5e-13, 1e-12),
    "degrees": (3e-13, 1e-12),
    "driven": (3e-13, 3e-13),
    "fixed_step": (3e-13, 3e-13),
}


@cache
def scenario(name: str) -> tuple[Model, dict[str, Any], dict[str, Any]]:
    model = Model.read(str(GOLDEN / name / "model.toml"))
    (track,) = read_tracks(model, str(GOLDEN / name / "data.csv"))["tracks"]
    return model, dict(track), json.loads((GOLDEN / name / "expected.json").read_text())


def solve(name: str, rule: str, road: dict[str, str], goal: Any, value: float | None = None) -> Estimates:
    model, track, expected = scenario(name)
    choice = Choice("ckf", expected["filters"][rule]["options"] | road, "discrete")
    u = track["u"] if model.controls else None
    return run(model, choice, track["mean"], track["cov"], track["t0"], track["time"], track["z"], u, goal, value)


def whole(triangle: list[float]) -> Any:
    n = (int((8 * len(triangle) + 1) ** 0.5) - 1) // 2
    full = np.zeros((n, n))
    full[np.tril_indices(n)] = triangle
    return full + full.T - np.diag(np.diag(full))


def error(mean: Any, cov: Any, golden_mean: list[float], golden_cov: list[float]) -> float:
    """The larger error of mean and covariance, in standard deviations."""
    expected = whole(golden_cov)
    sigma = np.sqrt(np.diag(expected))
    mean_scale = np.where(sigma > 0, sigma, np.maximum(1, np.abs(golden_mean)))
    cov_scale = np.outer(sigma, sigma)
    cov_scale[cov_scale == 0] = 1
    errors = np.abs(mean - np.array(golden_mean)) / mean_scale
    return max(float(np.max(errors, initial=0)), float(np.max(np.abs(cov - expected) / cov_scale, initial=0)))


@pytest.mark.parametrize("road", ROADS, ids=["covariance", "joint", "separate"])
@pytest.mark.parametrize("name", BOUNDS)
@pytest.mark.parametrize(
    "rule", ["cubature3", "cubature5", "unscented", "gauss_hermite3", "central_difference", "taylor"]
)
def test_filters_and_smoothers_give_the_numbers_of_the_oracle(name: str, rule: str, road: dict[str, str]) -> None:
    filter_bound, smoother_bound = BOUNDS[name]
    golden = scenario(name)[2]["filters"][rule]
    est = solve(name, rule, road, "filter")
    assert est.failure is None
    assert len(est) == len(golden["nis"])
    for k in range(len(est)):
        there = ~np.isnan(est.innovation[k])
        found = [
            (est.predicted_mean[k], est.predicted_cov[k], "predicted_mean", "predicted_cov"),
            (est.mean[k], est.cov[k], "filtered_mean", "filtered_cov"),
            (est.innovation[k][there], est.innovation_cov[k][np.ix_(there, there)], "innovation", "innovation_cov"),
        ]
        for mean, cov, mean_name, cov_name in found:
            assert error(mean, cov, golden[mean_name][k], golden[cov_name][k]) < filter_bound
        scores = [(est.log_likelihood[k], golden["log_likelihood"][k])]
        if golden["nis"][k] is None:
            assert np.isnan(est.nis[k])
            assert est.nis_dof[k] == 0
        else:
            scores.append((est.nis[k], golden["nis"][k]))
        for value, expected in scores:
            assert abs(value - expected) <= filter_bound * max(1, abs(expected))
    est = solve(name, rule, road, "interval")
    for k in range(len(est)):
        assert error(est.mean[k], est.cov[k], golden["smoothed_mean"][k], golden["smoothed_cov"][k]) < smoother_bound


@pytest.mark.parametrize("road", ROADS, ids=["covariance", "joint", "separate"])
@pytest.mark.parametrize("name", BOUNDS)
def test_fixed_lag_and_fixed_point_give_the_numbers_of_the_oracle(name: str, road: dict[str, str]) -> None:
    golden = scenario(name)[2]["filters"]["cubature3"]
    time = scenario(name)[1]["time"]
    goals = [("lag5", "lag", 5.0), ("point5", "point", float(time[min(4, len(time) - 1)]))]
    for part, goal, value in goals:
        est = solve(name, "cubature3", road, goal, value)
        assert len(est) == len(golden[part]["mean"])
        for k in range(len(est)):
            found = error(est.mean[k], est.cov[k], golden[part]["mean"][k], golden[part]["cov"][k])
            assert found < BOUNDS[name][1]


@pytest.mark.parametrize("name", ["innovation_fails", "posterior_fails", "predicted_fails"])
def test_a_run_fails_at_the_row_and_matrix_of_the_oracle_and_keeps_the_rows_before(name: str) -> None:
    failures = 0
    for rule, golden in scenario(name)[2]["filters"].items():
        for road in ROADS:
            est = solve(name, rule, road, "filter")
            if "failed" not in golden:
                assert est.failure is None
                continue
            failures += 1
            assert est.failure is not None
            found = {key: est.failure[key] for key in ("row", "time", "matrix")}  # type: ignore[literal-required]
            assert found == {key: golden["failed"][key] for key in found}
            assert len(est) == golden["failed"]["row"]
            assert est.failure["fault"] == "not-positive"
            assert "--" not in str(est.failure["remedy"])
    assert failures > 0

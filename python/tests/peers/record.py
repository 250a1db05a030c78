"""What the recording scripts share: how values are written, and how far they are from `reference.py`."""

import json
import platform
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import problems
import reference

HERE = Path(__file__).parent


class Recorder:
    """Collects one peer's answers; `write` makes its JSON and prints the table of distances."""

    def __init__(self, peer: str, *packages: str) -> None:
        self.peer = peer
        self.answers: dict[str, dict[str, Any]] = {}
        self.departures: dict[str, dict[str, Any]] = {}
        self.versions = {"python": platform.python_version()} | {name: version(name) for name in packages}

    def add(
        self, problem: str, method: str, goal: str, mean: Any, cov: Any, log_likelihood: float | None, **options: float
    ) -> None:
        """An answer under the words of `givens`: a registry name, its options, `filter` or `smooth`. Log-likelihood: the sum of all rows."""
        name, one = entry(problem, method, goal, mean, cov, log_likelihood, options)
        self.answers[name] = one

    def depart(self, why: str, *args: Any, redraw: bool = True, **options: float) -> None:
        """An answer of another algorithm than the name says: only how far it is from the reference is kept. With `redraw=False`, from the reference that departs alike."""
        name, one = entry(*args, options)
        self.departures[name + ("" if redraw else ", points not redrawn")] = {
            "why": why,
            "far": distance(one, by_reference(one, redraw)),
        }

    def write(self) -> None:
        """A row of numbers to a line. Covariances are their lower triangles, row by row."""
        entries = []
        for name, one in self.answers.items():
            parts = []
            for key, value in one.items():
                if key in ("mean", "cov_lower"):
                    parts.append(f'  "{key}": [\n' + ",\n".join(f"   {json.dumps(row)}" for row in value) + "]")
                else:
                    parts.append(f'  "{key}": {json.dumps(value)}')
            entries.append(f' "{name}": {{\n' + ",\n".join(parts) + "}")
        head = {"versions": self.versions, "problems_sha256": problems.digest()}
        departures = ",\n".join(f"  {json.dumps(name)}: {json.dumps(one)}" for name, one in self.departures.items())
        text = (
            json.dumps(head)[:-1]
            + f', "departures": {{\n{departures}\n }},\n "answers": {{\n'
            + ",\n".join(entries)
            + "\n}}\n"
        )
        (HERE / f"{self.peer}.json").write_text(text)
        print(f"{self.peer}: " + ", ".join(f"{key} {value}" for key, value in self.versions.items()))
        print("| answer | mean, in σ | covariance, in σᵢσⱼ | log-likelihood |\n|---|---|---|---|")
        for name, one in self.answers.items():
            print(line(name, distance(one, by_reference(one))))
        for name, one in self.departures.items():
            print(line(f"({name})", one["far"]))


def entry(
    problem: str, method: str, goal: str, mean: Any, cov: Any, log_likelihood: float | None, options: dict[str, float]
) -> tuple[str, dict[str, Any]]:
    """The answer's name, and the answer as it is written."""
    words = ",".join(f"{key}={value:g}" for key, value in options.items())
    name = f"{problem} {goal} {method}" + (f" {words}" if words else "")
    mean, cov = np.asarray(mean, float), np.asarray(cov, float)
    rows, n = len(problems.load(problem).t), mean.shape[1]
    assert mean.shape == (rows, n) and cov.shape == (rows, n, n), (name, mean.shape, cov.shape)
    return name, {
        "problem": problem, "goal": goal, "method": method, "options": options,
        "log_likelihood": None if log_likelihood is None else float(log_likelihood),
        "mean": mean.tolist(), "cov_lower": cov[:, *np.tril_indices(n)].tolist(),
    }  # fmt: skip


def line(name: str, far: tuple[float, float, float | None]) -> str:
    """A row of the table."""
    return f"| {name} | {far[0]:.0e} | {far[1]:.0e} | " + ("– |" if far[2] is None else f"{far[2]:.0e} |")


def by_reference(one: dict[str, Any], redraw: bool = True) -> reference.Answer:
    """The reference's answer to the same question."""
    return _both(one["problem"], one["method"], tuple(one["options"].items()), redraw)[one["goal"] == "smooth"]


@cache
def _both(
    name: str, method: str, options: tuple[tuple[str, float], ...], redraw: bool
) -> tuple[reference.Answer, reference.Answer]:
    problem = problems.load(name)
    return reference.run(problem, reference.by_name(problem.mean.size, method, dict(options)), redraw)


def distance(one: dict[str, Any], other: Any) -> tuple[float, float, float | None]:
    """The largest over rows and components: of means in standard deviations, of covariances in σᵢσⱼ, and of the summed log-likelihood."""
    mean, lower = np.array(one["mean"]), np.array(one["cov_lower"])
    n = mean.shape[1]
    i, j = np.tril_indices(n)
    std = np.sqrt(np.diagonal(other.cov, axis1=1, axis2=2))
    means = np.max(np.abs(mean - other.mean) / std)
    covs = np.max(np.abs(lower - np.asarray(other.cov)[:, i, j]) / (std[:, i] * std[:, j]))
    fit = one["log_likelihood"]
    return float(means), float(covs), None if fit is None else float(abs(fit - np.sum(other.log_likelihood)))

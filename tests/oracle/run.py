"""Writes the golden files, or checks that they still are what this program computes.

python3 tests/oracle/run.py            [SCENARIO …]   write tests/golden/*/{data.csv,expected.json}
python3 tests/oracle/run.py --check    [SCENARIO …]   recompute and compare, write nothing
python3 tests/oracle/run.py --self-test               the oracle against independent truths (see checks.py)
"""

import argparse
import json
import sys
from pathlib import Path

import ill_conditioned
import stress
from filtering import run_filter
from model import Model, read_rows
from precise import lower, to_float
from rules import RULES
from simulate import PLANS, published, simulate
from smoothing import conditional_failure, fixed_interval, fixed_lag, fixed_point

GOLDEN = Path(__file__).resolve().parent.parent / "golden"
LAG = 5
POINT = 5
LAGGED = ("cubature3", "taylor")
MOST_POINTS = 4000


def moments(beliefs):
    return {"mean": [to_float(m) for m, _ in beliefs], "cov": [lower(p) for _, p in beliefs]}


def one_filter(model, rows, name, lagged):
    options, rule = RULES[name]
    run = run_filter(model, rule(model.n), rows)
    out = {
        "options": options,
        "predicted_mean": [to_float(r.prior_mean) for r in run.rows],
        "predicted_cov": [lower(r.prior_cov) for r in run.rows],
        "predicted_measurement": [to_float(r.z_hat) for r in run.rows],
        "innovation": [to_float(r.innovation) for r in run.rows],
        "innovation_cov": [lower(r.innovation_cov) for r in run.rows],
        "nis": [to_float(r.nis) for r in run.rows],
        "log_likelihood": [float(r.log_likelihood) for r in run.rows],
        "filtered_mean": [to_float(r.mean) for r in run.rows],
        "filtered_cov": [lower(r.cov) for r in run.rows],
    }
    if run.failed:
        return out | {"failed": run.failed}
    smoothed = fixed_interval(run)
    rowwise = moments([smoothed[r.node] for r in run.rows])
    start = moments([smoothed[0]])
    out |= {
        "smoothed_mean": rowwise["mean"],
        "smoothed_cov": rowwise["cov"],
        "start_mean": start["mean"][0],
        "start_cov": start["cov"][0],
    }
    if (transition := conditional_failure(run)) is not None:
        row = next(k for k, r in enumerate(run.rows) if r.node > transition)
        out["conditional_fails"] = {"row": row, "time": float(rows[row].time)}
    if lagged and name in LAGGED:
        out |= {f"lag{LAG}": moments(fixed_lag(run, LAG)), f"point{POINT}": moments(fixed_point(run, POINT - 1))}
    return out


def scenario(name, plan):
    model = Model(GOLDEN / name / "model.toml")
    rows = read_rows(model, GOLDEN / name / "data.csv")
    small = 5**model.n <= MOST_POINTS
    rules = plan.rules or [rule for rule in RULES if small or rule != "gauss_hermite5"]
    return {
        "states": model.names,
        "rows": [
            {"time": float(row.time)} | ({"sensor": row.sensor} if row.sensor else {}) | {"measures": row.measures}
            for row in rows
        ],
        "filters": {rule: one_filter(model, rows, rule, plan.lag) for rule in rules},
    }


def csv_text(records):
    header = list(records[0])
    return "\n".join(",".join(line) for line in [header] + [[r[h] for h in header] for r in records]) + "\n"


def json_text(value, depth=0):
    """One quantity of one row on a line."""
    if isinstance(value, dict) and (
        depth < 4
        and any(isinstance(v, (dict, list)) for v in value.values())
        and "measures" not in value
        and "rule" not in value
    ):
        pad = " " * (depth + 1)
        body = ",\n".join(f"{pad}{json.dumps(k)}: {json_text(v, depth + 1)}" for k, v in value.items())
        return "{\n" + body + "\n" + " " * depth + "}"
    if isinstance(value, list) and value and isinstance(value[0], (list, dict)):
        pad = " " * (depth + 1)
        return "[\n" + ",\n".join(pad + json.dumps(v, separators=(",", ":")) for v in value) + "]"
    return json.dumps(value, separators=(",", ":"))


def difference(a, b, where=""):
    """The largest relative difference of two results; anything but numbers must be equal."""
    if isinstance(a, float) and isinstance(b, float):
        return abs(a - b) / max(abs(a), abs(b), 1e-300) if a != b else 0.0, where
    if isinstance(a, dict) and isinstance(b, dict) and a.keys() == b.keys():
        return max((difference(a[k], b[k], f"{where}/{k}") for k in a), default=(0.0, where))
    if isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        return max((difference(x, y, f"{where}/{i}") for i, (x, y) in enumerate(zip(a, b))), default=(0.0, where))
    return (0.0 if a == b else float("inf")), where


def settle(path, text, value, check):
    """Writes the file, or compares: text exactly, numbers to the last few bits. Returns whether it stands."""
    if not check:
        path.write_text(text)
        return True
    if value is None:
        good = path.read_text() == text
        print(f"{path.parent.name}/{path.name}: {'same' if good else 'DIFFERENT'}")
        return good
    worst, where = difference(value, json.loads(path.read_text()))
    print(f"{path.parent.name}/{path.name}: {worst:.1e} {where if worst else ''}")
    return worst < 1e-14


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenarios", nargs="*", metavar="SCENARIO")
    parser.add_argument("--check", action="store_true", help="compare, write nothing")
    parser.add_argument("--self-test", action="store_true", help="test the oracle itself")
    options = parser.parse_args()
    if options.self_test:
        import checks

        return checks.main(GOLDEN)
    good = True
    for name in ("cv", "ct"):
        if not options.scenarios or name in options.scenarios:
            text = csv_text(published(name, GOLDEN, Model(GOLDEN / name / "model.toml")))
            good &= settle(GOLDEN / name / "data.csv", text, None, options.check)
    for name, plan in PLANS.items():
        if options.scenarios and name not in options.scenarios:
            continue
        text = csv_text(simulate(plan, Model(GOLDEN / name / "model.toml")))
        good &= settle(GOLDEN / name / "data.csv", text, None, options.check)
        expected = json.loads(json.dumps(scenario(name, plan)))
        good &= settle(GOLDEN / name / "expected.json", json_text(expected) + "\n", expected, options.check)
        if not options.check:
            conditional = {
                rule: f["conditional_fails"]["row"]
                for rule, f in expected["filters"].items()
                if "conditional_fails" in f
            }
            print(name, "conditional fails:", conditional)
            failed = {rule: f["failed"] for rule, f in expected["filters"].items() if "failed" in f}
            print(name, *(f"{rule}: {f['matrix']} at row {f['row']};" for rule, f in failed.items()))
    if not options.scenarios or "ill_conditioned" in options.scenarios:
        value = json.loads(json.dumps(ill_conditioned.cases()))
        good &= settle(GOLDEN / "ill_conditioned.json", json_text(value) + "\n", value, options.check)
    if not options.scenarios or "stress" in options.scenarios:
        value = json.loads(json.dumps(stress.cases()))
        good &= settle(GOLDEN / "stress.json", json_text(value) + "\n", value, options.check)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())

//! Wrong methods, options and parameters.

use super::{NONE, check, folder};

#[test]
fn wrong_methods_and_options() {
    check(
        "options",
        &[
            (
                "method",
                NONE,
                "filter model.toml data.csv -o out.csv --method ukff",
                &["--method ukff: there is no method `ukff`", "did you mean `ukf`?"],
            ),
            (
                "continuous",
                NONE,
                "filter model.toml data.csv -o out.csv --method cd-ckf",
                &[
                    "--method cd-ckf: `cd-ckf` is a continuous-time method",
                    "the model is discrete",
                    "is `ckf`",
                ],
            ),
            (
                "unread",
                NONE,
                "filter model.toml data.csv -o out.csv --method ckf --set eta=2",
                &["--set eta=2: `ckf` does not read `eta`", "central-difference"],
            ),
            (
                "update",
                NONE,
                "filter model.toml data.csv -o out.csv --method ckf --set update=joint",
                &["`ckf` does not read `update`", "square-root"],
            ),
            (
                "in_compare",
                NONE,
                "compare model.toml data.csv --methods ukf,ckf --set ckf.kappa=2",
                &["--set ckf.kappa=2: `ckf` does not read `kappa`"],
            ),
            (
                "for_all",
                NONE,
                "compare model.toml data.csv --methods ukf,ckf --set kappa=2",
                &["`ckf` does not read `kappa`", "--set METHOD.kappa=2"],
            ),
            (
                "other_method",
                NONE,
                "compare model.toml data.csv --methods ukf,ckf --set ekf.kappa=2",
                &["--set ekf.kappa=2: `ekf` is not among --methods"],
            ),
            (
                "precision",
                NONE,
                "filter model.toml data.csv -o out.csv --set precision=f16",
                &["--set precision=f16: no such choice", "one of: f64, f32"],
            ),
            (
                "no_value",
                NONE,
                "filter model.toml data.csv -o out.csv --set kappa",
                &["--set kappa: write it as name=value"],
            ),
            (
                "word",
                NONE,
                "filter model.toml data.csv -o out.csv --set rule=cubatur3",
                &["--set rule=cubatur3: no such choice", "did you mean `cubature3`?"],
            ),
            (
                "points",
                NONE,
                "filter model.toml data.csv -o out.csv --method qkf --set points=1",
                &["points", "from 2 to 64"],
            ),
            (
                "grid",
                NONE,
                "filter model.toml data.csv -o out.csv --method qkf --set points=64",
                &["--set points=64: ", "use fewer points", "the model has n = 4"],
            ),
            (
                "alpha",
                NONE,
                "filter model.toml data.csv -o out.csv --set alpha=0",
                &["--set alpha=0: must be above zero"],
            ),
            (
                "kappa",
                NONE,
                "filter model.toml data.csv -o out.csv --set kappa=-4.5",
                &["--set kappa=-4.5: n + kappa must be above zero", "the model has n = 4"],
            ),
            (
                "eta",
                NONE,
                "filter model.toml data.csv -o out.csv --method cdkf --set eta=0.9",
                &["--set eta=0.9: must be"],
            ),
        ],
    );
}

#[test]
fn numbers_out_of_reach() {
    check(
        "reach",
        &[
            (
                "eta_overflow",
                NONE,
                "filter model.toml data.csv -o out.csv --method cdkf --set eta=1e200",
                &["--set eta=1e200: must be at least 1, and at most 1e9"],
            ),
            (
                "alpha_underflow",
                NONE,
                "filter model.toml data.csv -o out.csv --set alpha=1e-170",
                &["--set alpha=1e-170: the points, ", "the model has n = 4"],
            ),
            (
                "lag_too_large",
                NONE,
                "smooth model.toml data.csv -o out.csv --lag 99999999999999999999999",
                &["for '--lag <ROWS>': is too large a number"],
            ),
            (
                "runs_too_large",
                NONE,
                "simulate model.toml --steps 3 --every 1 --seed 1 --runs 99999999999",
                &["for '--runs <N>': is too large a number of runs"],
            ),
        ],
    );
}

#[test]
fn wrong_parameters_and_lists() {
    check(
        "parameters",
        &[
            (
                "number",
                NONE,
                "filter model.toml data.csv -o out.csv --set kappa=two",
                &["--set kappa=two: must be a number"],
            ),
            (
                "paper",
                NONE,
                "reproduce arasaratnam2011smoother -o pages",
                &["there is no paper `arasaratnam2011smoother`", "did you mean `arasaratnam2011smoothers`?"],
            ),
            (
                "experiment",
                NONE,
                "reproduce arasaratnam2011smoothers --only table-5 -o pages",
                &["--only table-5: there is no such experiment", "did you mean `table-4`?"],
            ),
            (
                "no_runs",
                NONE,
                "reproduce arasaratnam2011smoothers --runs 0 -o pages",
                &["'0' for '--runs <RUNS>': must be a whole number above zero"],
            ),
            (
                "several",
                NONE,
                "filter model.toml data.csv -o out.csv --set kappa=2,update=joint",
                &["--set kappa=2,update=joint: one at a time", "write --set kappa=2 --set update=joint"],
            ),
            (
                "param",
                NONE,
                "filter model.toml data.csv -o out.csv --param p=1",
                &["model.toml: the parameter `p` was set, but the model has none of this name", "help: "],
            ),
            (
                "param_number",
                NONE,
                "filter model.toml data.csv -o out.csv --param q=much",
                &["--param q=much: `much` is not a finite number"],
            ),
            (
                "param_shape",
                NONE,
                "filter model.toml data.csv -o out.csv --param q",
                &["--param q: write it as name=value"],
            ),
            (
                "methods_unknown",
                NONE,
                "compare model.toml data.csv --methods ukf,ckff",
                &["--methods ckff: there is no method `ckff`", "did you mean"],
            ),
            (
                "methods_empty",
                NONE,
                "compare model.toml data.csv --methods ukf,,ckf",
                &["--methods ukf,,ckf: a name is empty", "commas between"],
            ),
            ("methods_missing", NONE, "compare model.toml data.csv", &["--methods <A,B,…>"]),
            (
                "at",
                NONE,
                "filter model.toml data.csv -o out.csv --at 1,b",
                &["--at: `b` is not a time", "every:DT"],
            ),
            (
                "at_early",
                NONE,
                "filter model.toml data.csv -o out.csv --at=-1",
                &["--at -1: before the initial belief"],
            ),
            ("at_every", NONE, "filter model.toml data.csv -o out.csv --at every:0", &["DT must be above 0"]),
            (
                "report",
                NONE,
                "filter model.toml data.csv -o out.csv --reprot r.html",
                &["unexpected argument '--reprot'", "--report"],
            ),
            (
                "arrow",
                NONE,
                "filter model.toml data.csv -o out.csv --format arrow",
                &["invalid value 'arrow'", "csv, jsonl, parquet"],
            ),
        ],
    );
}

#[test]
fn a_number_of_threads_is_a_whole_one_above_zero() {
    const MUST: &str = "must be a whole number above zero; left out, all cores";
    check(
        "threads",
        &[
            ("none", NONE, "filter model.toml data.csv -o out.csv --threads 0", &["'--threads <N>'", MUST]),
            ("fewer", NONE, "smooth model.toml data.csv -o out.csv --threads -1", &["'--threads <N>'", MUST]),
            (
                "broken",
                NONE,
                "filter model.toml data.csv -o out.csv --threads 1.5",
                &["'--threads <N>'", MUST],
            ),
            (
                "word",
                NONE,
                "compare model.toml data.csv --methods ckf --threads all",
                &["'--threads <N>'", MUST],
            ),
            (
                "large",
                NONE,
                "filter model.toml data.csv -o out.csv --threads 99999999999999999999999",
                &["'--threads <N>'", "is too large a number"],
            ),
            (
                "other_command",
                NONE,
                "simulate model.toml --steps 3 --every 1 --seed 1 --threads 2",
                &["unexpected argument '--threads'"],
            ),
        ],
    );
}

#[test]
fn an_empty_list_of_methods_is_told() {
    let found = folder("methods", &NONE).run_args(&["compare", "model.toml", "data.csv", "--methods", ""]);
    assert_eq!((found.code, found.stdout.as_str()), (2, ""));
    assert!(found.stderr.contains("--methods : a name is empty"), "{}", found.stderr);
}

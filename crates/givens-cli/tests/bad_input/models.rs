//! Wrong model files.

use super::{FILTER, NONE, check};

#[test]
fn wrong_models() {
    const M: &str = "model.toml";
    check(
        "models",
        &[
            (
                "state",
                (M, "x + dt*vx", "x + dt*vz"),
                FILTER,
                &["model.toml:11:28: ", "unknown name `vz`", "did you mean `vx`?"],
            ),
            (
                "function",
                (M, "hypot(x", "hypto(x"),
                FILTER,
                &["model.toml:21:23: ", "`hypto`", "did you mean `hypot`?"],
            ),
            (
                "key",
                (M, "angles", "angels"),
                FILTER,
                &["model.toml:23:1: ", "unknown key `angels` in [[sensor]]", "did you mean `angles`?"],
            ),
            ("section", (M, "[plot]", "[plt]"), FILTER, &["unknown key `plt`", "did you mean `plot`?"]),
            (
                "measures",
                (M, "{ range = 1, bearing = 0.02 }", "[1]"),
                FILTER,
                &["model.toml:22:7: ", "`std` has 1 value, but there are 2 measures", "`range`, `bearing`"],
            ),
            (
                "asymmetric",
                (M, "[[4, 1], [1, 4]]", "[[4, 1], [2, 4]]"),
                FILTER,
                &[
                    "model.toml:28:",
                    "`cov` is not symmetric: row 2, column 1 (`py`, `px`) is 2, but row 1, column 2 is 1",
                ],
            ),
            (
                "indefinite",
                (M, "[[4, 1], [1, 4]]", "[[4, 5], [5, 4]]"),
                FILTER,
                &["model.toml:28:", "not positive semidefinite: pivot 2 (`py`)", "no correlation above one"],
            ),
            (
                "negative_std",
                (M, "std = [5, 1, 5, 1]", "std = [5, 1, -5, 1]"),
                FILTER,
                &["model.toml:5:", "`std` of `y` is -5"],
            ),
            (
                "negative_noise",
                (M, "bearing = 0.02", "bearing = -0.02"),
                FILTER,
                &["model.toml:22:", "`bearing` is -0.02"],
            ),
        ],
    );
}

#[test]
fn models_that_are_none_and_filters_that_do_not_fit() {
    const M: &str = "model.toml";
    check(
        "filters",
        &[
            (
                "missing_model",
                NONE,
                "filter modell.toml data.csv -o out.csv",
                &["modell.toml: there is no such file"],
            ),
            ("empty_model", (M, "", "\n"), FILTER, &["model.toml: the model has no [state]", "help: "]),
            (
                "method_in_file",
                (M, "sr-ukf", "sr-ufk"),
                FILTER,
                &["model.toml:34:10: there is no method `sr-ufk`", "did you mean `sr-ukf`?"],
            ),
            (
                "option_in_file",
                (M, "sr-ukf", "sr-ckf"),
                FILTER,
                &["model.toml:35:1: `sr-ckf` does not read `kappa`", "unscented"],
            ),
            (
                "no_such_option",
                (M, "kappa = 0", "digits = 7"),
                FILTER,
                &["model.toml:35:1: there is no option `digits`", "help: one of: "],
            ),
            (
                "range_in_file",
                (M, "kappa = 0", "kappa = -4"),
                FILTER,
                &["model.toml:35:1: ", "n + kappa must be above zero", "the model has n = 4"],
            ),
            ("check", (M, "x + dt*vx", "x + dt*vz"), "check model.toml", &["model.toml:11:28: "]),
            (
                "swapped",
                NONE,
                "filter data.csv model.toml -o out.csv",
                &["data.csv:1:", "this is a table, not a model file", "the model comes first"],
            ),
            (
                "method_option",
                NONE,
                "check model.toml --set method=ekf",
                &["--set method=ekf: ", "--method ekf"],
            ),
        ],
    );
}

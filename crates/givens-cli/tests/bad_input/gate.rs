//! Gates that cannot serve.

use super::{NONE, check};

#[test]
fn gates_that_are_no_probability() {
    check(
        "gate",
        &[
            (
                "gate",
                NONE,
                "filter model.toml data.csv -o out.csv --set gate=1.5",
                &["--set gate=1.5: must be a probability above 0 and below 1, such as 0.9999"],
            ),
            (
                "gate_word",
                NONE,
                "filter model.toml data.csv -o out.csv --set gate=on",
                &["--set gate=on: must be a number"],
            ),
            (
                "gate_in_the_file",
                ("model.toml", "kappa = 0\n", "kappa = 0\ngate = 1\n"),
                "filter model.toml data.csv -o out.csv",
                &["model.toml:", "gate = 1: must be a probability above 0 and below 1"],
            ),
        ],
    );
}

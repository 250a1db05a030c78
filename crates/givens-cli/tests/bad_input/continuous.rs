//! Methods, parts and options that do not go with a continuous model, or with each other.

use super::{NONE, Slip, check};

/// A diffusion that depends on the state.
const BY_STATE: Slip = ("osc.toml", "v = \"0.2\"", "v = \"0.2*x\"");

#[test]
fn methods_of_the_other_kind() {
    check(
        "kinds",
        &[
            (
                "ckf",
                NONE,
                "filter osc.toml osc.csv -o out.csv --method ckf",
                &[
                    "--method ckf: `ckf` is a discrete-time method, and the model is continuous",
                    "is `cd-ckf`",
                ],
            ),
            (
                "sr_qkf",
                NONE,
                "filter osc.toml osc.csv -o out.csv --method sr-qkf",
                &["`sr-qkf` is a discrete-time method", "is `sr-cd-ghkf2`"],
            ),
            (
                "cdkf",
                NONE,
                "filter osc.toml osc.csv -o out.csv --method cdkf",
                &["`cdkf` is a discrete-time method", "set time_update = moment-ode or ito-taylor"],
            ),
            (
                "lskf",
                NONE,
                "filter model.toml data.csv -o out.csv --method lskf",
                &["`lskf` is a continuous-time method, and the model is discrete", "is `sr-ckf`"],
            ),
            (
                "update",
                NONE,
                "filter model.toml data.csv -o out.csv --set time_update=moment-ode",
                &["`sr-ukf` with time_update = moment-ode is a continuous-time method"],
            ),
            (
                "compare",
                NONE,
                "compare osc.toml osc.csv --methods cd-ckf,ckf",
                &["--methods ckf: `ckf` is a discrete-time method"],
            ),
        ],
    );
}

#[test]
fn parts_and_options_that_exclude_each_other() {
    check(
        "parts",
        &[
            (
                "level_set",
                NONE,
                "filter osc.toml osc.csv -o out.csv --method lskf --set form=covariance",
                &["--set form=covariance: the level set is a square root by nature", "moment-ode"],
            ),
            (
                "level_set_of_covariance",
                NONE,
                "filter osc.toml osc.csv -o out.csv --method cd-ckf --set time_update=level-set",
                &["--set time_update=level-set: `cd-ckf` is in covariance form", "lskf"],
            ),
            (
                "adaptive",
                NONE,
                "filter osc.toml osc.csv -o out.csv --method acd-ekf --set solver=rk4",
                &["--set solver=rk4: `acd-ekf` adapts its steps", "dp5 or rodas4"],
            ),
            (
                "both_steps",
                NONE,
                "filter osc.toml osc.csv -o out.csv --set substeps=4 --set max_step=0.1",
                &["--set max_step=0.1: `substeps` and `max_step` both", "set one of them"],
            ),
            (
                "substeps_of_dp5",
                NONE,
                "filter osc.toml osc.csv -o out.csv --method cd-ckf2 --set substeps=4",
                &["`cd-ckf2` does not read `substeps`", "rtol and atol", "solver = euler, rk2 or rk4"],
            ),
            (
                "tolerance_of_equal_steps",
                NONE,
                "filter osc.toml osc.csv -o out.csv --set rtol=1e-3",
                &["`sr-cd-ckf` does not read `rtol`", "dp5 and rodas4"],
            ),
            (
                "gauge",
                NONE,
                "filter osc.toml osc.csv -o out.csv --set gauge=free",
                &["`sr-cd-ckf` does not read `gauge`", "time_update = level-set"],
            ),
            (
                "solver_of_discrete",
                NONE,
                "filter model.toml data.csv -o out.csv --set solver=dp5",
                &["`sr-ukf` does not read `solver`", "moment-ode and level-set"],
            ),
            (
                "word",
                NONE,
                "filter osc.toml osc.csv -o out.csv --set variant=ful",
                &["--set variant=ful: no such choice", "did you mean `full`?"],
            ),
            (
                "half_a_step",
                NONE,
                "filter osc.toml osc.csv -o out.csv --set substeps=0.5",
                &["--set substeps=0.5: must be a whole number from 1 to 100000"],
            ),
            (
                "no_length",
                NONE,
                "filter osc.toml osc.csv -o out.csv --set max_step=0",
                &["--set max_step=0: must be a number above 0"],
            ),
            (
                "no_tolerance",
                NONE,
                "filter osc.toml osc.csv -o out.csv --method cd-ckf2 --set rtol=0",
                &["--set rtol=0: must be above 0, or atol must be"],
            ),
        ],
    );
}

#[test]
fn diffusions_that_a_method_cannot_serve() {
    check(
        "diffusions",
        &[
            (
                "by_state",
                BY_STATE,
                "filter osc.toml osc.csv -o out.csv",
                &[
                    "osc.toml: sr-cd-ckf: the diffusion depends on the state",
                    "moment-ode, euler-maruyama",
                    "--method sr-cd-ckf2",
                ],
            ),
            (
                "by_state_full_step",
                BY_STATE,
                "filter osc.toml osc.csv -o out.csv --method cd-ukf1",
                &["osc.toml: cd-ukf1: the diffusion depends on the state", "moment-ode, euler-maruyama"],
            ),
            (
                "by_state_level_set",
                BY_STATE,
                "smooth osc.toml osc.csv -o out.csv --method lskf",
                &["osc.toml: lskf: the diffusion depends on the state", "moment-ode, euler-maruyama"],
            ),
            (
                "shape_of_the_diffusion",
                ("osc.toml", "{ v = \"0.2\" }", "[[0.1], [0.2], [0.3]]"),
                "filter osc.toml osc.csv -o out.csv",
                &["osc.toml:12:13: `diffusion` has 3 rows, but there are 2 states", "a row for each state"],
            ),
        ],
    );
}

#[test]
fn simulations_that_cannot_be() {
    check(
        "simulate",
        &[
            (
                "discrete",
                NONE,
                "simulate model.toml --until 3 --every 1 --seed 1 --substeps 4",
                &["--substeps: the model is discrete", "leave it out"],
            ),
            (
                "by_state",
                BY_STATE,
                "simulate osc.toml --until 3 --every 1 --seed 1 --scheme ito-taylor",
                &["--scheme ito-taylor: the diffusion depends on the state", "euler-maruyama"],
            ),
            (
                "no_distance",
                NONE,
                "simulate osc.toml --until 3 --seed 1",
                &["the model has no step", "--every DT"],
            ),
            (
                "no_step",
                NONE,
                "simulate osc.toml --until 3 --every 1 --seed 1 --max-step 0",
                &["--max-step", "must be a number above 0"],
            ),
        ],
    );
}

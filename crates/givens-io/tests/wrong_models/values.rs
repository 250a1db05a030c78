//! Numbers, matrices, and what contradicts itself.

use givens_io::Model;

use super::{Case, RIGHT, check};

#[test]
fn numbers_that_cannot_be_are_told() {
    check(&[
        Case(
            "x = 1,",
            "x = -1,",
            (5, 13),
            "`std` of `x` is -1, but a standard deviation is not negative",
            "zero",
        ),
        Case("[10, 0.1]", "[\"-q\", 0.1]", (16, 8), "`std` of `range` is -0.1", "zero"),
        Case(
            "mean = [1, 2, 3]",
            "mean = [1, nan, 3]",
            (4, 12),
            "`mean` of `vx` is not a finite number",
            "finite",
        ),
        Case(
            "mean = [1, 2, 3]",
            "mean = [1, -inf, 3]",
            (4, 12),
            "`mean` of `vx` is not a finite number",
            "finite",
        ),
        Case(
            "mean = [1, 2, 3]",
            "mean = [1, \"1/0\", 3]",
            (4, 12),
            "`mean` of `vx` is inf",
            "division by zero",
        ),
        Case("mean = [1, 2, 3]", "mean = [1, 1e999, 3]", (4, 12), "", ""),
        Case(
            "q = 0.1",
            "q = \"sqrt(-1)\"",
            (7, 6),
            "`sqrt(-1)` is a constant that is not a number in the parameter `q`",
            "root",
        ),
        Case("time = 0.0", "time = \"2026-03-01T12:00:00\"", (3, 8), "`time` is not a time", "offset"),
        Case("time = 0.0", "time = \"2026-03-01\"", (3, 8), "`time` is not a time", "offset"),
        Case("time = 0.0", "time = 2026-03-01T12:00:00", (3, 8), "`time` is not a time", "offset"),
        Case("time = 0.0", "time = [1]", (3, 8), "`time` is a number or an expression; found a list", ""),
        Case("[dynamics]", "[dynamics]\nstep = 0", (11, 8), "`step` is 0", "length in seconds"),
        Case("[dynamics]", "[dynamics]\nstep = -0.5", (11, 8), "`step` is -0.5", ""),
        Case("[\"bearing\"]", "{ bearing = 0 }", (17, 22), "the period of `bearing` is 0", "360"),
        Case("[\"bearing\"]", "[\"baring\"]", (17, 11), "unknown measure `baring` in `angles`", "`bearing`"),
        Case("[\"bearing\"]", "[\"bearing\", \"bearing\"]", (17, 22), "`bearing` stands twice", "remove"),
        Case("[\"bearing\"]", "\"bearing\"", (17, 10), "`angles` is a list of names; found a string", ""),
        Case(
            "plane = [\"x\", \"y\"]",
            "plane = [\"x\", \"z\"]",
            (23, 15),
            "unknown state `z` in `plane`",
            "",
        ),
        Case("plane = [\"x\", \"y\"]", "plane = [\"x\", \"x\"]", (23, 15), "names `x` twice", "two states"),
    ]);
}

#[test]
fn matrices_that_are_no_covariances_are_told() {
    check(&[
        Case(
            "[0, 1, 0]",
            "[\"2*q\", 1, 0]",
            (12, 31),
            "row 2, column 1 (`vx`, `x`) is 0.2, but row 1, column 2 is 0",
            "same value",
        ),
        Case(
            "[0, 1, 0]",
            "[\"t\", 1, 0]",
            (12, 31),
            "(`vx`, `x`) is 0.37, but row 1, column 2 is 0 at t = 0.37",
            "same value",
        ),
        Case(
            "std = { x = 1, vx = 1, y = 2 }",
            "cov = [[1, 0, 0], [0, 1, 2], [0, 2, 1]]",
            (5, 37),
            "`cov` is not positive semidefinite: pivot 3 (`y`)",
            "no correlation above one",
        ),
        Case(
            "std = { x = 1, vx = 1, y = 2 }",
            "cov = [[1, 0, 0], [0, -1, 0], [0, 0, 1]]",
            (5, 23),
            "pivot 2 (`vx`)",
            "no negative variance",
        ),
        Case("[[4]]", "[[-4]]", (21, 9), "pivot 1 (`px`)", "no negative variance"),
        Case(
            "[[4]]",
            "[[\"0/0\"]]",
            (21, 10),
            "`0/0` is a constant that is not a number in row 1, column 1",
            "division",
        ),
        Case(
            "x + dt*vx",
            "x + dt*(vx + log(-1))",
            (11, 34),
            "`log(-1)` is a constant that is not a number",
            "logarithm",
        ),
        Case("\"x + dt*vx\"", "\"sqrt(-q)\"", (11, 20), "the transition of `x` is NaN", "root"),
        Case("= \"r\"", "= \"r + min(1, 0/0)\"", (15, 34), "`0/0` is a constant", "division"),
        Case("\"atan2(y, x)\"", "\"1/(q - q)\"", (15, 37), "the measure `bearing` is inf", "division"),
    ]);
}

#[test]
fn a_noise_in_dt_is_checked_where_the_step_is_fixed() {
    let text = RIGHT.replace("[0, 1, 0]", "[0, \"dt - 3\", 0]");
    assert!(Model::parse(&text, "m.toml").is_ok());
    let errors = Model::parse(&text.replace("[dynamics]", "[dynamics]\nstep = 2"), "m.toml").unwrap_err();
    assert!(errors.first().unwrap().message.contains("pivot 2 (`vx`)"), "{errors}");
}

#[test]
fn two_statements_of_one_thing_are_told() {
    check(&[
        Case("std = { x", "cov = [[1]]\nstd = { x", (5, 1), "[state] has both `std` and `cov`", "remove one"),
        Case(
            "cov = [[4]]",
            "cov = [[4]]\nstd = [2]",
            (21, 1),
            "the sensor has both `std` and `cov`",
            "remove one",
        ),
    ]);
}

/// [`RIGHT`] with `start` in place of time, mean and std.
pub(super) fn with_start(state: &str) -> Vec<(usize, usize, String)> {
    let text = RIGHT.replace("time = 0.0\nmean = [1, 2, 3]\nstd = { x = 1, vx = 1, y = 2 }", state);
    let errors = Model::parse(&text, "m.toml").map(|_| ()).expect_err(state).errors;
    errors.into_iter().map(|error| (error.position().0, error.position().1, error.message)).collect()
}

#[test]
fn slips_in_start_are_told() {
    let told = |state: &str, line: usize, column: usize, words: &str| {
        let errors = with_start(state);
        assert!(
            errors.len() == 1 && errors[0].0 == line && errors[0].1 == column && errors[0].2.contains(words),
            "{state}: {errors:?}"
        );
    };
    let start = "start = { x = \"range*cos(bearing)\", y = \"range*sin(bearing)\" }\n";
    told(&format!("{start}mean = [1]\nstd = [1]\ntime = 3"), 6, 1, "`time` stands beside `start`");
    told(
        &format!("{start}mean = {{ vx = 1, x = 2 }}\nstd = [1]"),
        4,
        18,
        "`x` stands in both `start` and `mean`",
    );
    told(
        &format!("{start}mean = [1, 2, 3]\nstd = [1]"),
        4,
        8,
        "`mean` of the states that `start` leaves out has 3 values",
    );
    told(&format!("{start}std = [1]"), 1, 2, "[state] has no `mean`");
    let one = "mean = { vx = 0, y = 0 }\nstd = { vx = 1, y = 1 }";
    told(&format!("start = {{ x = \"y\" }}\n{one}"), 3, 16, "`y` may not stand here");
    told(&format!("start = {{ x = \"rnge\" }}\n{one}"), 3, 16, "unknown name `rnge` in the start of `x`");
    told(&format!("start = {{ x = \"2*q\" }}\n{one}"), 3, 15, "names no measure");
    told(&format!("start = {{ x = \"r*px\" }}\n{one}"), 3, 16, "`r` may not stand here");
    told("start = {}\nmean = [1, 2, 3]\nstd = [1, 1, 1]", 3, 9, "finds no state");
    told(
        "start = [\"px\"]\nmean = [1, 2, 3]\nstd = [1, 1, 1]",
        3,
        9,
        "`start` has 1 value, but there are 3 states",
    );
    told(
        &format!("start = {{ xx = \"px\" }}\n{one}")
            .replace("vx = 0", "x = 1, vx = 0")
            .replace("vx = 1,", "x = 1, vx = 1,"),
        3,
        11,
        "unknown state `xx`",
    );
}

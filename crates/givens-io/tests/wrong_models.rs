//! Wrong model files: each is a small slip in a right one, and its error tells where, what, and the remedy.

use givens_io::Model;

/// A right model file; a case replaces a piece of it.
const RIGHT: &str = r#"[state]
names = ["x", "vx", "y"]
time = 0.0
mean = [1, 2, 3]
std = { x = 1, vx = 1, y = 2 }
[parameters]
q = 0.1
[let]
r = "hypot(x, y)"
[dynamics]
transition = { x = "x + dt*vx", vx = "vx", y = "y" }
noise_cov = [["q*dt", 0, 0], [0, 1, 0], [0, 0, 1]]
[[sensor]]
name = "radar"
measures = { range = "r", bearing = "atan2(y, x)" }
std = [10, 0.1]
angles = ["bearing"]
[[sensor]]
name = "gps"
measures = { px = "x" }
cov = [[4]]
[plot]
plane = ["x", "y"]
[filter]
method = "sr-ckf"
"#;

/// What is replaced, by what, and the first error then: line, column, words of the message, words of the help.
struct Case(&'static str, &'static str, (usize, usize), &'static str, &'static str);

fn check(cases: &[Case]) {
    let mut failures = String::new();
    for Case(from, to, position, message, help) in cases {
        assert!(RIGHT.contains(from), "the right file does not hold {from:?}");
        let text = RIGHT.replacen(from, to, 1);
        let told = match Model::parse(&text, "model.toml") {
            Ok(_) => {
                failures.push_str(&format!("{to:?}: was taken for right\n\n"));
                continue;
            }
            Err(errors) => errors,
        };
        let first = told.first().unwrap();
        let has_help = first.help.as_ref().is_some_and(|told| told.contains(help)) || help.is_empty();
        if first.position() != *position || !first.message.contains(message) || !has_help {
            failures.push_str(&format!("{to:?}: expected {position:?} {message:?} {help:?}\n{told}\n\n"));
        }
        // A slip is one error, unless a case says otherwise by its own test.
        if told.errors.len() != 1 {
            failures.push_str(&format!("{to:?}: {} errors\n{told}\n\n", told.errors.len()));
        }
    }
    assert!(failures.is_empty(), "\n{failures}");
}

#[test]
fn the_right_file_is_right() {
    assert!(Model::parse(RIGHT, "model.toml").is_ok());
}

#[test]
fn slips_in_the_syntax_are_told_in_place() {
    check(&[
        Case("time = 0.0", "time = ", (3, 8), "not valid TOML", ""),
        Case("mean = [1, 2, 3]", "mean = [1, 2, 3", (5, 1), "not valid TOML", "lists in [ ]"),
        Case("method = \"sr-ckf\"", "method = sr-ckf", (25, 10), "not valid TOML", "strings stand in quotes"),
        Case("method = \"sr-ckf\"", "method = \"sr-ckf", (25, 17), "not valid TOML", ""),
        Case("[parameters]", "[state]", (6, 2), "duplicate key", ""),
        Case("q = 0.1", "q = 0.1\nq = 0.2", (8, 1), "duplicate key", ""),
        Case("mean =", "[mean", (4, 6), "not valid TOML", ""),
    ]);
}

#[test]
fn unknown_keys_are_told_with_the_near_one() {
    check(&[
        Case("[plot]", "[plots]", (22, 2), "unknown key `plots` in a model file", "did you mean `plot`?"),
        Case("[filter]", "[zebra]", (24, 2), "unknown key `zebra` in a model file", "has the keys `state`"),
        Case("time = 0.0", "tiem = 0.0", (3, 1), "unknown key `tiem` in [state]", "did you mean `time`?"),
        Case(
            "noise_cov =",
            "noise_covariance =",
            (12, 1),
            "unknown key `noise_covariance` in [dynamics]",
            "",
        ),
        Case(
            "angles = [\"bearing\"]",
            "angle = [\"bearing\"]",
            (17, 1),
            "unknown key `angle` in [[sensor]]",
            "`angles`",
        ),
        Case("plane =", "plan =", (23, 1), "unknown key `plan` in [plot]", "did you mean `plane`?"),
    ]);
}

#[test]
fn missing_parts_are_told() {
    check(&[
        Case("names = [\"x\", \"vx\", \"y\"]\n", "", (1, 2), "[state] has no `names`", "name the states"),
        Case("mean = [1, 2, 3]\n", "", (1, 2), "[state] has no `mean`", "initial mean of `x`, `vx`, `y`"),
        Case(
            "std = { x = 1, vx = 1, y = 2 }\n",
            "",
            (1, 2),
            "neither `std` nor `cov`",
            "standard deviation of `x`",
        ),
        Case(
            "transition = { x = \"x + dt*vx\", vx = \"vx\", y = \"y\" }\n",
            "",
            (10, 2),
            "no `transition`",
            "next value",
        ),
        Case("name = \"radar\"\n", "", (13, 1), "[[sensor]] has no `name`", "name = \"radar\""),
        Case("measures = { px = \"x\" }\n", "", (18, 1), "[[sensor]] has no `measures`", "what it measures"),
        Case("cov = [[4]]\n", "", (18, 1), "neither `std` nor `cov`", "standard deviation of each measure"),
        Case("vx = \"vx\", ", "", (11, 14), "`transition` leaves out the state `vx`", ""),
        Case("vx = 1, y = 2 }", "}", (5, 7), "`std` leaves out the states `vx`, `y`", ""),
    ]);
}

#[test]
fn missing_sections_are_told() {
    let whole = |text: &str| Model::parse(text, "m.toml").unwrap_err().errors;
    assert_eq!(whole("").len(), 2);
    assert!(whole("")[0].message.contains("the model has no [state]"));
    assert!(whole("")[1].message.contains("the model has no [dynamics]"));
    let sensor = RIGHT.find("[[sensor]]").unwrap();
    assert!(whole(&RIGHT[..sensor])[0].message.contains("the model has no sensor"));
    let dynamics = RIGHT.replace("[dynamics]", "[zebra]");
    assert!(whole(&dynamics).iter().any(|error| error.message.contains("no [dynamics]")));
}

#[test]
fn lists_and_tables_of_the_wrong_shape_are_told() {
    check(&[
        Case(
            "mean = [1, 2, 3]",
            "mean = [1, 2]",
            (4, 8),
            "`mean` has 2 values, but there are 3 states",
            "`x`, `vx`, `y`",
        ),
        Case("mean = [1, 2, 3]", "mean = 1", (4, 8), "`mean` is a list or a table; found a number", "[ … ]"),
        Case("mean = [1, 2, 3]", "mean = [1, true, 3]", (4, 12), "found a truth value", "write a number"),
        Case("y = 2 }", "z = 2 }", (5, 24), "unknown state `z` in `std`", ""),
        Case(
            "y = \"y\" }",
            "y = \"y\", vz = \"0\" }",
            (11, 53),
            "unknown state `vz` in `transition`",
            "`vx`",
        ),
        Case(
            "[10, 0.1]",
            "[10]",
            (16, 7),
            "`std` has 1 value, but there are 2 measures",
            "`range`, `bearing`",
        ),
        Case(
            "[10, 0.1]",
            "{ range = 1, baring = 2 }",
            (16, 20),
            "unknown measure `baring` in `std`",
            "`bearing`",
        ),
        Case(
            "[[\"q*dt\", 0, 0], [0, 1, 0], [0, 0, 1]]",
            "[[1]]",
            (12, 13),
            "`noise_cov` has 1 row, but needs 3",
            "3 rows of 3",
        ),
        Case("[0, 1, 0]", "[0, 1]", (12, 30), "row 2 of `noise_cov` has 2 values, but needs 3", ""),
        Case("[0, 1, 0]", "7", (12, 30), "row 2 of `noise_cov` has a number", ""),
        Case("[[4]]", "4", (21, 7), "`cov` is a list of rows; found a number", "[[…], …]"),
        Case(
            "measures = { px = \"x\" }",
            "measures = [\"x\"]",
            (20, 12),
            "`measures` is a table",
            "what it measures",
        ),
        Case("measures = { px = \"x\" }", "measures = {}", (20, 12), "measures nothing", "what it measures"),
        Case(
            "names = [\"x\", \"vx\", \"y\"]",
            "names = \"x\"",
            (2, 9),
            "`names` is a list of names",
            "write [",
        ),
        Case(
            "names = [\"x\", \"vx\", \"y\"]",
            "names = []",
            (2, 9),
            "the model has no state",
            "at least one",
        ),
        Case(
            "names = [\"x\", \"vx\", \"y\"]",
            "names = [\"x\", 3]",
            (2, 15),
            "`names` is a text; found a number",
            "quotes",
        ),
        Case("name = \"radar\"", "name = 3", (14, 8), "`name` is a text; found a number", "quotes"),
        Case(
            "plane = [\"x\", \"y\"]",
            "plane = [\"x\"]",
            (23, 9),
            "`plane` names two states, not 1",
            "horizontal",
        ),
        Case("method = \"sr-ckf\"", "method = 3", (25, 10), "`method` is a text; found a number", "quotes"),
        Case("method = \"sr-ckf\"", "kappa = [1]", (25, 9), "`kappa` in [filter]", "single values"),
        Case("method = \"sr-ckf\"", "kappa = nan", (25, 9), "found no finite number", ""),
    ]);
}

#[test]
fn single_brackets_for_a_sensor_are_told() {
    let text = RIGHT.replacen("[[sensor]]", "[sensor]", 1).replacen(
        "[[sensor]]\nname = \"gps\"\nmeasures = { px = \"x\" }\ncov = [[4]]\n",
        "",
        1,
    );
    let errors = Model::parse(&text, "m.toml").unwrap_err();
    assert!(errors.first().unwrap().help.as_ref().unwrap().contains("[[sensor]]"), "{errors}");
}

#[test]
fn names_that_cannot_stand_are_told() {
    check(&[
        Case(
            "\"x\", \"vx\", \"y\"]\ntime",
            "\"x\", \"x\", \"vx\", \"y\"]\ntime",
            (2, 15),
            "the name `x` is given twice",
            "rename",
        ),
        Case("q = 0.1", "q = 0.1\nx = 3", (8, 1), "`x` is a state already (line 2)", "rename"),
        Case("[let]", "[let]\nq = 3", (9, 1), "`q` is a parameter already (line 7)", "rename"),
        Case("q = 0.1", "q = 0.1\nt = 1", (8, 1), "`t` is the time", "another name"),
        Case("q = 0.1", "q = 0.1\ndt = 1", (8, 1), "`dt` is the length of a step", "another name"),
        Case("q = 0.1", "q = 0.1\npi = 3", (8, 1), "`pi` is the number π", "another name"),
        Case("q = 0.1", "q = 0.1\natan2 = 3", (8, 1), "`atan2` is a function", "another name"),
        Case("q = 0.1", "q = 0.1\nnot = 3", (8, 1), "`not` is an operator", "another name"),
        Case("q = 0.1", "q = 0.1\nu_q = 3", (8, 1), "`u_` are controls", "another name"),
        Case("q = 0.1", "q = 0.1\n\"\" = 3", (8, 1), "empty name", "give it a name"),
        Case("q = 0.1", "q = 0.1\n\"2q\" = 3", (8, 1), "`2q` cannot be the name", "letters, digits and _"),
        Case(
            "\"y\"]\ntime",
            "\"y\", \"nis\"]\ntime",
            (2, 26),
            "`nis` is a column of every output",
            "another",
        ),
        Case("px = \"x\"", "time = \"x\"", (20, 14), "`time` is a column of every table", "another name"),
        Case("px = \"x\"", "u_x = \"x\"", (20, 14), "a measure cannot be called `u_x`", "another name"),
        Case("px = \"x\"", "\" px\" = \"x\"", (20, 14), "begins or ends with a space", "another name"),
        Case("name = \"gps\"", "name = \"radar\"", (19, 8), "two sensors are called `radar`", "rename"),
        Case("name = \"gps\"", "name = \"\"", (19, 8), "sensor's name is empty", "write a name"),
    ]);
}

#[test]
fn a_state_named_as_the_deviation_of_another_is_told() {
    let text = RIGHT.replace("\"y\"]\ntime", "\"x_std\"]\ntime");
    let errors = Model::parse(&text, "m.toml").unwrap_err();
    assert!(
        errors.first().unwrap().message.contains("`x_std` is the column of a standard deviation"),
        "{errors}"
    );
}

#[test]
fn slips_in_expressions_are_told_within_the_string() {
    check(&[
        Case(
            "x + dt*vx",
            "x + dt*vz",
            (11, 28),
            "unknown name `vz` in the transition of `x`",
            "did you mean `vx`?",
        ),
        Case("x + dt*vx", "x + dt*(vx", (11, 28), "in the transition of `x`", ""),
        Case("x + dt*vx", "", (11, 21), "the expression is empty in the transition of `x`", ""),
        Case("hypot(x, y)", "hypot(x)", (9, 6), "in `r`", "hypot(x, y)"),
        Case("hypot(x, y)", "range", (9, 6), "unknown name `range` in `r`", ""),
        Case("\"atan2(y, x)\"", "\"x > 0\"", (15, 38), "condition", "where"),
        Case("\"hypot(x, y)\"", "'''\nhypot(x, yy)'''", (10, 10), "unknown name `yy` in `r`", "known are"),
        Case("\"hypot(x, y)\"", "\"h\\u0079pot(x, yy)\"", (9, 5), "unknown name `yy` in `r`", "known are"),
    ]);
}

#[test]
fn names_where_they_may_not_stand_are_told() {
    check(&[
        Case(
            "\"q*dt\"",
            "\"q*vx\"",
            (12, 18),
            "`vx` may not stand here in row 1, column 1 of `noise_cov`",
            "may not depend on the state",
        ),
        Case("\"q*dt\"", "\"r\"", (12, 16), "`r` may not stand here", "may not depend on the state"),
        Case(
            "[10, 0.1]",
            "[\"x\", 0.1]",
            (16, 9),
            "`x` may not stand here in `std` of `range`",
            "depend on the state",
        ),
        Case("[10, 0.1]", "[\"dt\", 0.1]", (16, 9), "`dt` may not stand here", "a measurement has no step"),
        Case(
            "\"atan2(y, x)\"",
            "\"dt*x\"",
            (15, 38),
            "`dt` may not stand here in the measure `bearing`",
            "no step",
        ),
        Case(
            "mean = [1, 2, 3]",
            "mean = [1, \"t\", 3]",
            (4, 13),
            "`t` may not stand here in `mean` of `vx`",
            "only numbers and parameters",
        ),
        Case(
            "mean = [1, 2, 3]",
            "mean = [1, \"x\", 3]",
            (4, 13),
            "`x` may not stand here",
            "only numbers and parameters",
        ),
        Case(
            "mean = [1, 2, 3]",
            "mean = [1, \"u_a\", 3]",
            (4, 13),
            "`u_a` may not stand here",
            "only numbers and parameters",
        ),
        Case("q = 0.1", "q = \"p\"\np = 1", (7, 6), "unknown name `p` in the parameter `q`", ""),
        Case("hypot(x, y)", "hypot(px, y)", (9, 12), "unknown name `px` in `r`", ""),
    ]);
}

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
        Case("q = 0.1", "q = \"sqrt(-1)\"", (7, 5), "the parameter `q` is NaN", "root"),
        Case("time = 0.0", "time = \"2026-03-01T12:00:00\"", (3, 8), "`time` is not a time", "offset"),
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
        Case("[[4]]", "[[\"0/0\"]]", (21, 9), "row 1, column 1 of `cov` is NaN", "division"),
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

#[test]
fn definitions_in_a_circle_are_told() {
    check(&[
        Case(
            "r = \"hypot(x, y)\"",
            "r = \"r + 1\"",
            (9, 1),
            "[let] defines `r` by itself: r → r",
            "without the others",
        ),
        Case("r = \"hypot(x, y)\"", "r = \"b\"\nb = \"2*c\"\nc = \"r\"", (9, 1), "r → b → c → r", ""),
    ]);
}

#[test]
fn what_is_still_to_come_is_told_plainly() {
    check(&[
        Case("transition =", "drift =", (11, 1), "`drift` makes the model continuous", "`transition`"),
        Case(
            "[dynamics]",
            "[dynamics]\ndiffusion = [1, 1, 1]",
            (11, 1),
            "`diffusion` makes the model continuous",
            "",
        ),
    ]);
}

/// [`RIGHT`] with `start` in place of time, mean and std.
fn with_start(state: &str) -> Vec<(usize, usize, String)> {
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
    told(&format!("start = {{ x = \"rate(px)\" }}\n{one}"), 3, 16, "`rate`");
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

#[test]
fn all_slips_are_told_at_once_the_earliest_first() {
    let text = RIGHT
        .replace("vx = 1,", "vx = -1,")
        .replace("dt*vx", "dt*vz")
        .replace("\"q*dt\"", "\"q*dtt\"")
        .replace("plane = [\"x\"", "plane = [\"z\"")
        .replace("[10, 0.1]", "[10]");
    let errors = Model::parse(&text, "m.toml").unwrap_err();
    let lines: Vec<usize> = errors.errors.iter().map(|error| error.position().0).collect();
    assert_eq!(lines, [5, 11, 12, 16, 23], "{errors}");
}

#[test]
fn a_wrong_definition_is_told_once_and_not_at_each_use() {
    let text = RIGHT.replace("hypot(x, y)", "hypot(x, y").replace("q = 0.1", "q = \"1 +\"");
    let errors = Model::parse(&text, "m.toml").unwrap_err();
    let lines: Vec<usize> = errors.errors.iter().map(|error| error.position().0).collect();
    assert_eq!(lines, [7, 9], "{errors}");
}

#[test]
fn an_error_shows_its_line_with_carets_below() {
    let text = RIGHT.replace("dt*vx", "dt*vz");
    let errors = Model::parse(&text, "model.toml").unwrap_err();
    let shown = "model.toml:11:28: unknown name `vz` in the transition of `x`\n  \
                 11 | transition = { x = \"x + dt*vz\", vx = \"vx\", y = \"y\" }\n     \
                 |                            ^^\n  \
                 help: did you mean `vx`?";
    assert_eq!(errors.to_string(), shown);
}

#[test]
fn a_file_that_is_not_there_is_told() {
    let error = Model::read("no/such/model.toml").unwrap_err().to_string();
    assert_eq!(error, "no/such/model.toml: there is no such file");
}

//! Wrong model files: each is a small slip in a right one, and its error tells where, what, and the remedy.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod continuous;
mod names;
mod rates;
mod shape;
mod values;

use core::fmt::Write;

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
struct Case<'a>(&'a str, &'a str, (usize, usize), &'a str, &'a str);

fn check(cases: &[Case]) {
    check_in(RIGHT, cases);
}

/// Slips in a right file.
fn check_in(right: &str, cases: &[Case]) {
    let mut failures = String::new();
    for Case(from, to, position, message, help) in cases {
        assert!(right.contains(from), "the right file does not hold {from:?}");
        let text = right.replacen(from, to, 1);
        let Err(told) = Model::parse(&text, "model.toml") else {
            writeln!(failures, "{to:?}: was taken for right\n").unwrap();
            continue;
        };
        let first = told.first().unwrap();
        let has_help = first.help.as_ref().is_some_and(|told| told.contains(help)) || help.is_empty();
        if first.position() != *position || !first.message.contains(message) || !has_help {
            writeln!(failures, "{to:?}: expected {position:?} {message:?} {help:?}\n{told}\n").unwrap();
        }
        // A slip is one error, unless a case says otherwise by its own test.
        if told.errors.len() != 1 {
            writeln!(failures, "{to:?}: {} errors\n{told}\n", told.errors.len()).unwrap();
        }
    }
    assert!(failures.is_empty(), "\n{failures}");
}

#[test]
fn the_right_file_is_right() {
    assert!(Model::parse(RIGHT, "model.toml").is_ok());
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

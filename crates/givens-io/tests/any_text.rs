//! No text whatever makes a reader panic, and what is wrong with it lies within it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use core::fmt::Write;

use givens_io::{InputErrors, Model, parse_tracks};
use proptest::prelude::*;

const MODEL: &str = r#"[state]
names = ["x", "vx"]
mean = { x = "2*q", vx = 0 }
cov = [[1, 0.5], [0.5, 1]]
[parameters]
q = 0.1
[let]
a = "b + x"
b = "q*dt"
[dynamics]
transition = ["x + dt*vx + u_a", "where(x > 0, vx, a)"]
noise_cov = [["q*dt", 0], [0, "b"]]
step = 0.5
[[sensor]]
name = "radar"
measures = { range = "abs(x)", bearing = "atan2(1, x)" }
std = [10, "q*t"]
angles = { bearing = "2*pi" }
[[sensor]]
name = "gps"
measures = { px = "x" }
cov = [[4]]
[plot]
plane = ["x", "vx"]
[filter]
method = "sr-ckf"
kappa = 1
"#;

const STARTED: &str = r#"[state]
names = ["x", "y"]
start = { x = "range*cos(bearing)", y = "range*sin(bearing)" }
[dynamics]
transition = ["x", "y"]
[[sensor]]
name = "radar"
measures = { range = "hypot(x, y)", bearing = "atan2(y, x)" }
std = [10, 0.1]
"#;

const CONTINUOUS: &str = r#"[state]
names = ["x", "vx", "y"]
start = { x = "range*cos(bearing)", y = "range*sin(bearing)", vx = "rate(x) + 0*t" }
[parameters]
q = 0.1
[let]
a = "q*x^3"
[dynamics]
drift = { x = "vx", vx = "u_f - a", y = "where(x > 0, sin(t), 0)" }
diffusion = [["q", 0], [0, "sqrt(q)*t"], [1, 0]]
[[sensor]]
name = "radar"
measures = { range = "hypot(x, y)", bearing = "atan2(y, x)" }
std = [10, 0.1]
"#;

const TABLE: &str = "time,track_id,sensor,range,bearing,px,u_a,note\n\
    0.5,a,radar,1,2,,0,\"x, y\"\n0.5,a,gps,,,3,0,\n1.0,b,,1,,2,0,é\n1.5,a,,,,,1e-3,\n";

const CALENDAR: &str = "time,px,u_a\n2026-03-01T12:00:00Z,1,0\n2026-03-01T12:00:00.5Z,,0\n";

/// Errors lie on a line that is there, in a column that is there or one beyond.
fn well_placed(text: &str, errors: &InputErrors) {
    assert!(!errors.errors.is_empty());
    for place in errors.errors.iter().filter_map(|error| error.place.as_ref()) {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let line = text.split('\n').nth(place.line - 1).expect("the line is there");
        assert_eq!(line.trim_end_matches('\r'), place.source);
        assert!(place.column >= 1 && place.column <= line.chars().count() + 1, "{place:?}");
    }
    assert!(!errors.to_string().is_empty());
}

fn model_survives(text: &str) {
    match Model::parse(text, "m.toml") {
        Err(errors) => well_placed(text, &errors),
        Ok(model) => {
            let rows = "time,range,bearing,px,u_f,u_a\n1,2,0.5,1,0,0\n2,2,0.6,1,0,0\n";
            for track in parse_tracks(rows, "d.csv", &model).iter().flat_map(|tracks| &tracks.tracks) {
                let _ = model.begin(track);
            }
        }
    }
}

fn table_survives(text: &str) {
    let model = Model::parse(MODEL, "m.toml").unwrap();
    match parse_tracks(text, "d.csv", &model) {
        Err(errors) => well_placed(text, &errors),
        Ok(tracks) => {
            for row in tracks.tracks.iter().flat_map(|track| track.rows.iter()) {
                let row = row.unwrap();
                assert!(row.z.len() == model.measures() && row.u.len() == 1 && row.time.is_finite());
                let _ = model.place(&row);
            }
        }
    }
}

/// Pieces that may break a reader where they are put in.
const PIECES: &[&str] = &[
    "\"",
    "'",
    "[",
    "]",
    "{",
    "}",
    ",",
    "=",
    "\n",
    "\r",
    ".",
    "-",
    "1e999",
    "nan",
    "x",
    "dt",
    "u_a",
    "π",
    "\\",
    "\u{feff}",
    "\"\"\"",
    "((((",
    "[[",
    "]]",
    "# ",
    "0",
    "9999999999999999999999",
    "inf",
    "time",
    "^",
    "rate(x)",
    "\t",
    "\u{0}",
];

/// A text with some stretches replaced by pieces.
fn mutated(text: &'static str) -> impl Strategy<Value = String> {
    let edit = (0..text.len(), 0..12usize, prop::sample::select(PIECES));
    prop::collection::vec(edit, 1..4).prop_map(move |edits| {
        let mut text = text.to_string();
        for (at, length, piece) in edits {
            let floor = |mut at: usize| {
                at = at.min(text.len());
                while !text.is_char_boundary(at) {
                    at -= 1;
                }
                at
            };
            let (start, end) = (floor(at), floor(at + length));
            text.replace_range(start..end, piece);
        }
        text
    })
}

/// A text without one of its lines, or with one twice.
fn relined(text: &'static str) -> impl Strategy<Value = String> {
    (0..text.lines().count(), any::<bool>()).prop_map(move |(which, twice)| {
        let lines = text.lines().enumerate().flat_map(|(i, line)| {
            let times = if i != which {
                1
            } else if twice {
                2
            } else {
                0
            };
            core::iter::repeat_n(line, times)
        });
        lines.collect::<Vec<_>>().join("\n")
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text_may_be_read_as_a_model(text in "\\PC{0,200}") {
        model_survives(&text);
    }

    #[test]
    fn any_text_may_be_read_as_a_table(text in "(\\PC|\n|,|\"){0,200}") {
        table_survives(&text);
        table_survives(&format!("time,px,u_a\n{text}"));
    }

    #[test]
    fn a_mutated_model_is_read_or_refused(text in mutated(MODEL)) {
        model_survives(&text);
    }

    #[test]
    fn a_mutated_model_with_start_is_read_or_refused(text in mutated(STARTED)) {
        model_survives(&text);
    }

    #[test]
    fn a_mutated_continuous_model_is_read_or_refused(text in mutated(CONTINUOUS)) {
        model_survives(&text);
    }

    #[test]
    fn a_continuous_model_with_a_line_less_or_more_is_read_or_refused(text in relined(CONTINUOUS)) {
        model_survives(&text);
    }

    #[test]
    fn a_model_with_a_line_less_or_more_is_read_or_refused(text in relined(MODEL)) {
        model_survives(&text);
    }

    #[test]
    fn a_mutated_table_is_read_or_refused(text in mutated(TABLE)) {
        table_survives(&text);
    }

    #[test]
    fn a_mutated_table_of_the_calendar_is_read_or_refused(text in mutated(CALENDAR)) {
        table_survives(&text);
    }
}

#[test]
fn the_texts_before_mutation_are_right() {
    for text in [MODEL, STARTED, CONTINUOUS] {
        Model::parse(text, "m.toml").unwrap_or_else(|errors| panic!("{errors}"));
    }
    let model = Model::parse(MODEL, "m.toml").unwrap();
    for text in [TABLE, CALENDAR] {
        parse_tracks(text, "d.csv", &model).unwrap_or_else(|errors| panic!("{errors}"));
    }
}

#[test]
fn deep_and_large_inputs_are_refused_without_a_panic() {
    model_survives(&format!("a = {}", "[".repeat(100_000)));
    model_survives(&MODEL.replace("atan2(1, x)", &"(".repeat(100_000)));
    model_survives(&MODEL.replace("atan2(1, x)", &"-".repeat(100_000)));
    let names: Vec<String> = (0..2000).map(|i| format!("\"x{i}\"")).collect();
    model_survives(&MODEL.replace("[\"x\", \"vx\"]", &format!("[{}]", names.join(","))));
    // each definition doubles the one before
    let mut lets = String::from("c0 = \"x\"\n");
    for i in 1..200 {
        writeln!(lets, "c{i} = \"c{}*sin(c{})\"", i - 1, i - 1).unwrap();
    }
    model_survives(&MODEL.replace("[let]\n", &format!("[let]\n{lets}")));
    let doubled = CONTINUOUS.replace("[let]\n", &format!("[let]\n{lets}"));
    model_survives(&doubled.replace("u_f - a", "c199"));
    model_survives(&CONTINUOUS.replace("[\"q\", 0]", &format!("[{}]", "0,".repeat(2000))));
    table_survives(&"\"".repeat(100_000));
    table_survives(&",".repeat(100_000));
    table_survives("time,px,u_a\n9999-12-31T23:59:59Z,1,1\n-9999-01-01T00:00:00Z,1,1\n");
    table_survives("time,px,u_a\n1e308,1,1\n-1e308,1,1\n");
}

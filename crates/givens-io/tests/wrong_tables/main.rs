//! Wrong tables: their errors tell line, column and name, and the remedy.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod cells;
mod sensors;
mod times;

use core::fmt::Write;

use givens_io::{InputErrors, Model, Tracks, parse_tracks};

const MODEL: &str = r#"
[state]
names = ["x", "y"]
mean = [0, 0]
std = [1, 1]
[dynamics]
transition = ["x + u_a", "y"]
[[sensor]]
name = "radar"
measures = { range = "hypot(x, y)", bearing = "atan2(y, x)" }
std = [1, 1]
[[sensor]]
name = "gps"
measures = { px = "x" }
std = [1]
"#;

fn model() -> Model {
    Model::parse(MODEL, "model.toml").unwrap()
}

/// The model without its control, with a line more in a section.
fn changed(section: &str, line: &str) -> Model {
    let text = MODEL.replace(" + u_a", "").replace(section, &format!("{section}\n{line}"));
    Model::parse(&text, "model.toml").unwrap()
}

fn read(table: &str) -> Result<Tracks, InputErrors> {
    parse_tracks(table, "data.csv", &model())
}

/// A table, and its first error: line, column in characters, words of the message and of the help.
type Case = (&'static str, (usize, usize), &'static str, &'static str);

fn check(model: &Model, cases: &[Case]) {
    let mut failures = String::new();
    for (table, position, message, help) in cases {
        let Err(told) = parse_tracks(table, "data.csv", model) else {
            writeln!(failures, "{table:?}: was taken for right\n").unwrap();
            continue;
        };
        let first = told.first().unwrap();
        let has_help = help.is_empty() || first.help.as_ref().is_some_and(|told| told.contains(help));
        if first.position() != *position || !first.message.contains(message) || !has_help {
            writeln!(failures, "{table:?}: expected {position:?} {message:?} {help:?}\n{told}\n").unwrap();
        }
        if told.errors.len() != 1 {
            writeln!(failures, "{table:?}: {} errors\n{told}\n", told.errors.len()).unwrap();
        }
    }
    assert!(failures.is_empty(), "\n{failures}");
}

#[test]
fn many_wrong_cells_are_told_in_part_and_counted() {
    let mut table = "time,u_a,px\n".to_string();
    for k in 0..1000 {
        writeln!(table, "{k},0,x").unwrap();
    }
    let errors = read(&table).unwrap_err();
    assert_eq!((errors.errors.len(), errors.more), (20, 980));
    assert!(errors.to_string().ends_with("and 980 errors more"));
}

#[test]
fn a_table_that_is_not_text_is_told() {
    let folder = std::env::temp_dir().join(format!("givens-io-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let told = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).unwrap();
        let errors = givens_io::read_tracks(path.to_str().unwrap(), &model()).unwrap_err();
        errors.errors[0].clone()
    };
    let latin = told("latin.csv", b"time,u_a,px\n1,2,\xe9\n");
    assert_eq!((latin.position(), latin.message.as_str()), ((2, 5), "this is not UTF-8 text"));
    assert!(told("a.parquet", b"PAR1\x00\xff\x00").message.contains("Parquet"));
    std::fs::remove_dir_all(&folder).unwrap();
}

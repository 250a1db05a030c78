//! Wrong tables: their errors tell line, column and name, and the remedy.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

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
fn a_wrong_header_is_told() {
    check(
        &model(),
        &[
            ("", (0, 0), "the table is empty", "the first line names the columns"),
            (" \n\n", (0, 0), "the table is empty", ""),
            ("time,u_a,px\n", (0, 0), "a header but no rows", "one measurement"),
            ("Time,u_a,px\n1,2,3\n", (1, 1), "the table has no column `time`", "rename `Time` to `time`"),
            ("t,u_a,px\n1,2,3\n", (1, 1), "the table has no column `time`", "the table has `t`, `u_a`, `px`"),
            (
                "time,u_a\n1,2\n",
                (1, 1),
                "none of the model's 3 measures: `range`, `bearing`, `px`",
                "names of the measures",
            ),
            (
                "time,u_a,rnage\n1,2,3\n",
                (1, 1),
                "none of the model's 3 measures",
                "rename `rnage` to `range`",
            ),
            (
                "time,u_a,range\n1,2,3\n",
                (1, 1),
                "no column `bearing`, a measure of the sensor `radar`",
                "not in part",
            ),
            (
                "time,u_a,range,baering\n1,2,3,4\n",
                (1, 1),
                "no column `bearing`",
                "rename `baering` to `bearing`",
            ),
            ("time,px\n1,3\n", (1, 1), "no column `u_a`, a control that the model uses", "the table has"),
            (
                "time,u_a,px,px\n1,2,3,4\n",
                (1, 13),
                "the column `px` stands twice: columns 3 and 4",
                "rename or remove",
            ),
            ("time,u_a,px,c,\"c\"\n1,2,3,4,5\n", (1, 15), "the column `c` stands twice", ""),
        ],
    );
    let (table, model) = ("time;px\n1;2\n", changed("[dynamics]", ""));
    let errors = parse_tracks(table, "data.csv", &model).unwrap_err();
    assert!(
        errors.errors.iter().all(|error| error.help.as_ref().unwrap().contains("semicolons")),
        "{errors}"
    );
}

#[test]
fn a_wrong_cell_is_told() {
    check(
        &model(),
        &[
            (
                "time,u_a,px\n1,2,abc\n",
                (2, 5),
                "`abc` in `px` (column 3) is not a number",
                "leave the cell empty",
            ),
            (
                "time,u_a,px\n1,2,nan\n",
                (2, 5),
                "`nan` in `px` (column 3) is not a finite number",
                "leave the cell empty",
            ),
            ("time,u_a,px\n1,2,NaN\n", (2, 5), "`NaN` in `px` (column 3) is not a finite number", ""),
            ("time,u_a,px\n1,2,-inf\n", (2, 5), "`-inf` in `px` (column 3) is not a finite number", ""),
            ("time,u_a,px\n1,2,1e999\n", (2, 5), "1e999 in `px` (column 3) is too large", "units"),
            (
                "time,u_a,px\n1,,3\n",
                (2, 3),
                "the control `u_a` (column 2) is missing",
                "every row states its controls",
            ),
            ("time,u_a,px\n1,x,3\n", (2, 3), "`x` in `u_a` (column 2) is not a number", ""),
            ("time,u_a,px\n,2,3\n", (2, 1), "a row has no time", "every row"),
            ("time,u_a,px\nnan,2,3\n", (2, 1), "`nan` in `time` (column 1) is not a finite number", ""),
            ("time,u_a,px\nnoon,2,3\n", (2, 1), "`noon` in `time` (column 1) is not a number", ""),
            ("a,b,time,u_a,px\n\"one, two\",\"ü\",1,2,x\n", (2, 20), "`x` in `px` (column 5)", ""),
            ("time,u_a,px\n1,2,3\n\n\n2,2,x\n", (5, 5), "`x` in `px` (column 3)", ""),
            ("time,u_a,px\r\n1,2,3\r\n2,2,x\r\n", (3, 5), "`x` in `px` (column 3)", ""),
        ],
    );
}

#[test]
fn a_row_of_the_wrong_length_is_told() {
    check(
        &model(),
        &[
            ("time,u_a,px\n1,2\n", (2, 3), "the row has 2 fields, the header 3 columns", "keep its comma"),
            ("time,u_a,px\n1,2,3,4\n", (2, 7), "the row has 4 fields, the header 3 columns", "with a point"),
            ("time,u_a,px\n1,2,3\n7\n", (3, 1), "the row has 1 field, the header 3 columns", ""),
            ("time,u_a,px\n1,\"2,3\n4,5,6\n", (2, 3), "the row has 2 fields", "quotation mark"),
        ],
    );
}

#[test]
fn times_out_of_order_are_told() {
    check(
        &model(),
        &[
            (
                "time,u_a,px\n2,0,1\n1,0,1\n",
                (3, 1),
                "the row at 1 stands after the row at 2 (line 2)",
                "sort",
            ),
            (
                "time,u_a,px\n2,0,1\n2,0,1\n",
                (3, 1),
                "two rows at 2: this one and line 2",
                "different `sensor`",
            ),
            (
                "time,u_a,px,range,bearing,sensor\n1,0,1,,,gps\n1,0,,1,1,radar\n1,0,2,,,gps\n",
                (4, 1),
                "two rows at 1: this one and line 2",
                "",
            ),
            (
                "time,track_id,u_a,px\n2,a,0,1\n1,b,0,1\n1,a,0,1\n",
                (4, 1),
                "the row at 1 stands after the row at 2 (line 2)",
                "",
            ),
            ("time,track_id,u_a,px\n2,,0,1\n", (2, 3), "a row has no `track_id`", "name its track"),
            (
                "time,u_a,px\n1,0,1\n2026-03-01T12:00:00Z,0,1\n",
                (3, 1),
                "is in RFC 3339, but the rows before give seconds",
                "alike",
            ),
            (
                "time,u_a,px\n2026-03-01T12:00:00Z,0,1\n1,0,1\n",
                (3, 1),
                "is in seconds, but the rows before give RFC 3339",
                "alike",
            ),
            ("time,u_a,px\n2026-03-01T12:00:00,0,1\n", (2, 1), "is not a time", "with its offset"),
            ("time,u_a,px\n2026-03-41T12:00:00Z,0,1\n", (2, 1), "is not a time", "RFC 3339"),
            (
                "time,u_a,px\n2026-03-01T12:00:01Z,0,1\n2026-03-01T12:00:00Z,0,1\n",
                (3, 1),
                "stands after",
                "sort",
            ),
        ],
    );
}

#[test]
fn a_row_before_the_initial_belief_is_told() {
    check(
        &changed("[state]", "time = 5"),
        &[
            (
                "time,px\n4,1\n",
                (2, 1),
                "the row at 4 lies before the initial belief, which holds at 5",
                "`time` in [state]",
            ),
            (
                "time,px\n2026-03-01T12:00:00Z,1\n",
                (2, 1),
                "the first row lies before the initial belief, which holds 5 s after it",
                "",
            ),
        ],
    );
    check(
        &changed("[state]", "time = 2026-03-01T12:00:00Z"),
        &[
            ("time,px\n4,1\n", (2, 1), "seconds, but the model's `time` is 2026-03-01T12:00:00Z", "both as"),
            ("time,px\n2026-03-01T11:00:00Z,1\n", (2, 1), "lies before the initial belief", ""),
        ],
    );
}

#[test]
fn a_gap_of_no_whole_number_of_steps_is_told() {
    check(
        &changed("[dynamics]", "step = 0.5"),
        &[
            (
                "time,px\n1,1\n1.7,1\n",
                (3, 1),
                "from the row at 1 (line 2) to 1.7 (line 3) are 1.4 steps of 0.5",
                "leave `step` out",
            ),
            ("time,px\n1,1\n1.500001,1\n", (3, 1), "not a whole number", ""),
            ("time,px\n1,1\n1e12,1\n", (3, 1), "steps of 0.5", "same unit"),
        ],
    );
    let model = changed("[dynamics]", "step = 0.5");
    assert!(parse_tracks("time,px\n1,1\n1.5000001,1\n", "d.csv", &model).is_ok());
    assert!(parse_tracks("time,px\n1700000000.1,1\n1700000000.6,1\n", "d.csv", &model).is_ok());
    let text = MODEL
        .replace(" + u_a", "")
        .replace("[dynamics]", "[dynamics]\nstep = 0.5")
        .replace("[state]", "[state]\ntime = 0");
    check(
        &Model::parse(&text, "m.toml").unwrap(),
        &[(
            "time,px\n0.7,1\n",
            (2, 1),
            "from the initial belief at 0 to 0.7 (line 2) are 1.4 steps of 0.5",
            "",
        )],
    );
}

#[test]
fn wrong_sensors_are_told() {
    check(
        &model(),
        &[
            ("time,u_a,px,sensor\n1,0,1,gsp\n", (2, 7), "unknown sensor `gsp`", "did you mean `gps`?"),
            ("time,u_a,px,sensor\n1,0,1,lidar\n", (2, 7), "unknown sensor `lidar`", "`radar`, `gps`"),
            (
                "time,u_a,px,sensor\n1,0,,radar\n",
                (2, 6),
                "no columns of the sensor `radar`",
                "`range`, `bearing`",
            ),
            (
                "time,u_a,range,bearing,px,sensor\n1,0,1,1,5,radar\n",
                (2, 9),
                "`px` (column 5) is no measure of the sensor `radar`",
                "a row of its own",
            ),
        ],
    );
}

/// Two sensors with one column.
fn sharing() -> Model {
    let text = MODEL.replace(" + u_a", "").replace("px = \"x\"", "range = \"x\"");
    Model::parse(&text, "model.toml").unwrap()
}

#[test]
fn a_shared_column_needs_a_sensor() {
    check(
        &sharing(),
        &[
            (
                "time,range,bearing\n1,2,3\n",
                (1, 6),
                "the column `range` belongs to the sensors `radar`, `gps`",
                "`sensor`",
            ),
            (
                "time,range,bearing,sensor\n1,2,3,\n",
                (2, 3),
                "`range` (column 2) belongs to several sensors",
                "fill in",
            ),
            (
                "time,range,bearing,sensor\n1,2,3,gps\n",
                (2, 5),
                "`bearing` (column 3) is no measure of the sensor `gps`",
                "",
            ),
        ],
    );
    let tracks =
        parse_tracks("time,range,bearing,sensor\n1,2,3,radar\n1,2,,gps\n", "d.csv", &sharing()).unwrap();
    let z = |k: usize| tracks.tracks[0].rows[k].z.clone();
    assert_eq!(z(0)[..2], [2.0, 3.0]);
    assert!(z(0)[2].is_nan() && z(1)[0].is_nan() && z(1)[1].is_nan());
    assert_eq!(z(1)[2], 2.0);
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

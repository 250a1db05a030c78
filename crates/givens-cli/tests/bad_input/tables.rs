//! Wrong tables.

use super::{FILTER, NONE, check};

#[test]
fn wrong_tables() {
    const D: &str = "data.csv";
    const T: &str = "truth.csv";
    const TRUE: &str = "filter model.toml data.csv --truth truth.csv -o out.csv";
    check(
        "tables",
        &[
            (
                "nan",
                (D, "49.5", "NaN"),
                FILTER,
                &["data.csv:2:3: `NaN` in `range` (column 2) is not a finite number", "leave the cell empty"],
            ),
            ("inf", (D, "0.79", "-inf"), FILTER, &["data.csv:4:4: `-inf` in `bearing`"]),
            (
                "word",
                (D, "36.5", "36,5"),
                FILTER,
                &["data.csv:3:", "the row has 6 fields, the header 5 columns", "written with a point"],
            ),
            (
                "unsorted",
                (D, "\n3,", "\n1.5,"),
                FILTER,
                &["data.csv:4:1: the row at 1.5 stands after the row at 2 (line 3)", "sort the rows"],
            ),
            (
                "duplicate",
                (D, "\n3,", "\n2,"),
                FILTER,
                &["data.csv:4:1: two rows at 2: this one and line 3", "`sensor`"],
            ),
            (
                "before_start",
                (D, "\n1,", "\n-1,"),
                FILTER,
                &[
                    "data.csv:2:1: the row at -1 lies before the initial belief, which holds at 0",
                    "set `time` in [state]",
                ],
            ),
            (
                "not_whole_steps",
                (D, "", "time,z\n1,0\n2.5,1\n"),
                "filter walk.toml data.csv -o out.csv",
                &["data.csv:3:1: ", "1.5 steps of 1, not a whole number", "leave `step` out"],
            ),
            (
                "missing_column",
                (D, "bearing", "angle"),
                FILTER,
                &[
                    "data.csv:1:1: the table has no column `bearing`, a measure of the sensor `radar`",
                    "not in part",
                ],
            ),
            (
                "no_time",
                (D, "time", "Time"),
                FILTER,
                &["data.csv:1:1: the table has no column `time`", "rename `Time` to `time`"],
            ),
            (
                "empty",
                (D, "", " \n"),
                FILTER,
                &["data.csv: the table is empty", "the first line names the columns"],
            ),
            ("no_rows", (D, "", "time,px,py\n"), FILTER, &["data.csv: the table has a header but no rows"]),
            (
                "missing_data",
                NONE,
                "filter model.toml dat.csv -o out.csv",
                &["dat.csv: there is no such file"],
            ),
            (
                "missing_truth",
                NONE,
                "filter model.toml data.csv --truth no.csv -o out.csv",
                &["no.csv: there is no such file"],
            ),
            (
                "wrong_truth",
                (T, "x,y", "a,b"),
                TRUE,
                &["truth.csv:1:1: the table has no column of a state", "`x`, `vx`, `y`, `vy`"],
            ),
            (
                "near_truth",
                (T, "x,y", "x1,b"),
                TRUE,
                &["truth.csv:1:1: the table has no column of a state", "rename `x1` to `x`"],
            ),
            (
                "model_for_data",
                NONE,
                "filter model.toml walk.toml -o out.csv",
                &["walk.toml:1:1: this is a model file, not a table", "the model comes first"],
            ),
            (
                "control_without_its_prefix",
                ("model.toml", "x + dt*vx", "x + dt*vx + u_gas"),
                "filter model.toml data.csv -o out.csv",
                &["the table has no column `u_gas`, a control that the model uses"],
            ),
            ("nan_truth", (T, "31", "nan"), TRUE, &["truth.csv:2:3: `nan` in `x`"]),
            ("empty_stdin", NONE, "filter model.toml - -o out.csv", &["standard input: the table is empty"]),
            ("two_stdins", NONE, "filter - - -o out.csv", &["MODEL and DATA are both `-`", "help: "]),
            (
                "missing_times",
                NONE,
                "simulate model.toml --times no.csv --seed 1 -o out.csv",
                &["no.csv: there is no such file"],
            ),
        ],
    );
}

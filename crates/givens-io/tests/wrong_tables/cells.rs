//! Headers, cells and rows.

use super::*;

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
            ("time,u_a,px,c,\"px\"\n1,2,3,4,5\n", (1, 15), "the column `px` stands twice", ""),
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
            (
                "time,u_a,px\nnan,2,3\n",
                (2, 1),
                "`nan` in `time` (column 1) is not a finite number",
                "states its `time`",
            ),
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

//! Times: order, beginning, steps.

use super::*;

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
                "the row at 2026-03-01T12:00:00Z lies before the initial belief, which holds at 2026-03-01T12:00:05Z",
                "",
            ),
        ],
    );
    check(
        &changed("[state]", "time = 2026-03-01T12:00:00Z"),
        &[
            ("time,px\n4,1\n", (2, 1), "seconds, but the model's `time` is 2026-03-01T12:00:00Z", "both as"),
            (
                "time,px\n2026-03-01T11:00:00Z,1\n",
                (2, 1),
                "lies before the initial belief, which holds at 2026-03-01T12:00:00Z",
                "",
            ),
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
            ("time,px\n1,1\n1.54,1\n", (3, 1), "are 1.08 steps of 0.5, not a whole number", ""),
            ("time,px\n1,1\n1.500001,1\n", (3, 1), "are 1 + 2.0e-6 steps of 0.5, not a whole number", ""),
            ("time,px\n1,1\n1e7,1\n", (3, 1), "are 2.000e7 steps of 0.5", "same unit"),
        ],
    );
    let model = changed("[dynamics]", "step = 0.5");
    assert!(parse_tracks("time,px\n1,1\n1.5000001,1\n", "d.csv", &model).is_ok());
    assert!(parse_tracks("time,px\n1700000000.1,1\n1700000000.6,1\n", "d.csv", &model).is_ok());
    // a hundredth of a second, between times that are known to a quarter of a microsecond
    let model = changed("[dynamics]", "step = 0.01");
    let table = "time,px\n1700000000.01,1\n1700000000.02,1\n1700000000.03,1\n1700000000.07,1\n";
    assert!(parse_tracks(table, "d.csv", &model).is_ok());
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
fn times_that_cannot_be_told_apart_are_told() {
    let apart = |a: &str, b: &str| format!("time,sensor,px,range,bearing\n{a},gps,1,,\n{b},radar,,1,1\n");
    let model = changed("[state]", "");
    for (a, b) in [
        ("1000000000000000000", "1000000000000000001"),
        ("-1e16", "-10000000000000000.5"),
        ("0.1", "0.10000000000000000001"),
    ] {
        let errors = parse_tracks(&apart(a, b), "d.csv", &model).unwrap_err();
        assert!(errors.to_string().contains("cannot be told from that of line 2"), "{errors}");
    }
    let table = "time,px\n2020-01-01T00:00:00Z,1\n2026-03-01T12:00:00.000000001Z,1\n2026-03-01T12:00:00.000000002Z,1\n";
    check(&model, &[(table, (4, 1), "cannot be told from that of line 3", "near the data")]);
    for (a, b) in [("0.1", "0.10"), ("1e2", "100"), ("0", "-0.0"), ("120", "12e1"), ("0.5e-3", ".0005")] {
        assert!(parse_tracks(&apart(a, b), "d.csv", &model).is_ok(), "{a} {b}");
    }
}

#[test]
fn times_of_another_shape_than_rfc_3339_are_told() {
    let model = changed("[state]", "");
    for (time, words) in [
        ("2016-12-31T23:59:60Z", "a leap second"),
        ("9999-12-31T23:59:59Z", "the last instant that can be counted is 9999-12-30"),
        ("2026-03-01T12:00:00.1234567891Z", "more than nine digits"),
        ("2026-03-01T12:00:00", "its offset from UTC is missing"),
        ("2026-03-01", "its time of day is missing"),
        ("2026-03-01T12:00:00+25:30", "`+25:30` is no offset from UTC"),
        ("2026-03-01T12:00:00-0100", "`-0100` is no offset from UTC"),
        ("2026-03-01T12:00Z", "is not of the form"),
        ("2026-02-30T12:00:00Z", "must be in range `1..=28`"),
    ] {
        let errors = parse_tracks(&format!("time,px\n{time},1\n"), "d.csv", &model).unwrap_err();
        assert!(errors.to_string().contains(words), "{time}: {errors}");
    }
    let table = "time,px\n2026-03-01t12:00:00.123456789z,1\n2026-03-01 13:00:01-23:59,1\n";
    assert!(parse_tracks(table, "d.csv", &model).is_ok());
}

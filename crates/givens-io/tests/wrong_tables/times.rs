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

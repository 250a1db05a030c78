//! Sensors and what they share.

use super::*;

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
    let z = |k: usize| tracks.tracks[0].rows.row(k).unwrap().unwrap().z;
    assert_eq!(z(0)[..2], [2.0, 3.0]);
    assert!(z(0)[2].is_nan() && z(1)[0].is_nan() && z(1)[1].is_nan());
    assert_eq!(z(1)[2], 2.0);
}

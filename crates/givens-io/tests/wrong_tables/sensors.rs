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

#[test]
fn an_empty_cell_of_a_shared_column_needs_no_sensor() {
    let tracks = parse_tracks("time,range,bearing,sensor\n1,,3,\n", "d.csv", &sharing()).unwrap();
    let z = tracks.tracks[0].rows.row(0).unwrap().unwrap().z;
    assert!(z[0].is_nan() && z[2].is_nan());
    assert_eq!(z[1], 3.0);
}

#[test]
fn a_row_of_times_names_its_sensor_where_columns_are_shared() {
    let path = std::env::temp_dir().join(format!("givens-io-shared-{}.csv", std::process::id()));
    std::fs::write(&path, "time,sensor\n1,gps\n2,\n").unwrap();
    let told = givens_io::read_times(path.to_str().unwrap(), &sharing()).unwrap_err();
    std::fs::remove_file(&path).unwrap();
    let first = told.first().unwrap();
    assert_eq!((first.position().0, told.errors.len()), (3, 1), "{told}");
    assert!(first.message.contains("the sensors share the column `range`"), "{told}");
    assert!(first.help.as_ref().is_some_and(|help| help.contains("name a `sensor`")), "{told}");
}

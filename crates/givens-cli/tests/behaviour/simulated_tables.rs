//! `simulate --times`: the rows of a table.

use super::common::cells;
use super::{WALK, column, folder};

/// Which cells are filled.
fn filled(text: &str) -> Vec<Vec<bool>> {
    cells(text).iter().map(|row| row.iter().map(|cell| !cell.is_empty()).collect()).collect()
}

#[test]
fn of_a_table_with_measures_the_filled_cells_are_drawn() {
    let folder = folder("cells");
    let drawn = folder.run("simulate model.toml --times data.csv --seed 1").good().stdout;
    let data = folder.read("data.csv");
    assert_eq!(filled(&drawn), filled(&data));
    assert_eq!(drawn.lines().next(), data.lines().next());
    assert_ne!(cells(&drawn)[1][1], cells(&data)[1][1]);
    folder.write("drawn.csv", &drawn);
    let of = |data: &str| folder.run(&format!("filter model.toml {data}")).good().cells();
    assert_eq!(column(&of("drawn.csv"), "nis_dof"), column(&of("data.csv"), "nis_dof"));
}

#[test]
fn gaps_sensors_and_tracks_are_kept_in_the_tables_order() {
    let folder = folder("kept");
    let data = "time,track_id,sensor,range,bearing,px,py\n\
                0.5,b,radar,1,,,\n0.5,a,gps,,,1,1\n0.5,b,gps,,,1,\n3.25,a,,1,1,1,1\n7,b,,,,,\n";
    folder.write("data.csv", data);
    folder.run("simulate model.toml --times data.csv --seed 1 -o drawn.csv --states truth.csv").good();
    let drawn = folder.read("drawn.csv");
    assert_eq!(filled(&drawn), filled(data));
    for (a, b) in cells(&drawn).iter().zip(cells(data)) {
        assert_eq!(a[..3], b[..3]);
    }
    let truth = cells(&folder.read("truth.csv"));
    let keys: Vec<String> = truth[1..].iter().map(|row| row[..2].join("")).collect();
    assert_eq!(keys, ["0.5b", "0.5a", "3.25a", "7b"]);
}

#[test]
fn a_table_of_times_alone_draws_all_measures() {
    let folder = folder("alone");
    folder.write("times.csv", "time\n1\n2.5\n9\n");
    let drawn = folder.run("simulate model.toml --times times.csv --runs 2 --seed 1").good().cells();
    assert_eq!(drawn[0].join(","), "time,track_id,range,bearing,px,py");
    let keys: Vec<String> = drawn[1..].iter().map(|row| row[..2].join(" ")).collect();
    assert_eq!(keys, ["1 0", "2.5 0", "9 0", "1 1", "2.5 1", "9 1"]);
    assert!(drawn.iter().flatten().all(|cell| !cell.is_empty()));
    folder.write("times.csv", "time,sensor\n1,gps\n2.5,radar\n9,\n");
    let drawn = folder.run("simulate model.toml --times times.csv --seed 1").good();
    let (f, t) = (false, true);
    let expected = [[t, t, f, f, t, t], [t, t, t, t, f, f], [t, f, t, t, t, t]];
    assert_eq!(filled(&drawn.stdout)[1..], expected);
}

#[test]
fn controls_and_calendar_times_are_kept() {
    let folder = folder("controls");
    let model = WALK
        .replace("transition = [\"x\"]", "transition = [\"x + u_a\"]")
        .replace("time = 0", "time = \"2026-03-01T12:00:00Z\"");
    let model = model.replace("std = [2]", "std = [0]").replace("\"dt\"", "0");
    folder.write("walk.toml", &model);
    let times = "time,u_a\n2026-03-01T12:00:01Z,10\n2026-03-01T13:00:03+01:00,100\n";
    folder.write("times.csv", times);
    folder.run("simulate walk.toml --times times.csv --seed 1 -o drawn.csv --states truth.csv").good();
    let drawn = cells(&folder.read("drawn.csv"));
    assert_eq!(drawn[0].join(","), "time,z,u_a");
    assert_eq!(
        (drawn[2][0].as_str(), column(&drawn, "u_a")),
        ("2026-03-01T13:00:03+01:00", vec![10.0, 100.0])
    );
    // nothing is uncertain: one step of 10, then two more of the first row's control
    let truth = folder.read("truth.csv");
    assert_eq!(column(&cells(&truth), "x"), [10.0, 30.0]);
    folder.run("filter walk.toml drawn.csv --truth truth.csv").good();
}

#[test]
fn sensors_that_share_a_column_must_be_named() {
    let folder = folder("shared");
    let far = "[[sensor]]\nname = \"far\"\nmeasures = { z = \"x - 100\" }\nstd = [1]\n";
    folder.write("shared.toml", &format!("{WALK}{far}")).write("times.csv", "time\n1\n");
    let found = folder.run("simulate shared.toml --times times.csv --seed 1 -o out.csv");
    assert_eq!(found.code, 2);
    let words = "times.csv:2:1: the sensors share the column `z`, and this row names none";
    assert!(found.stderr.contains(words), "{}", found.stderr);
    folder.write("times.csv", "time,sensor\n1,far\n1,level\n");
    let drawn = folder.run("simulate shared.toml --times times.csv --seed 1").good().cells();
    assert!(column(&drawn, "z")[0] < -80.0 && column(&drawn, "z")[1] > -20.0);
    // a sensor in part is refused as by the filter
    folder.write("times.csv", "time,range\n1,1\n");
    let found = folder.run("simulate model.toml --times times.csv --seed 1");
    assert!(
        found.stderr.contains("no column `bearing`, a measure of the sensor `radar`"),
        "{}",
        found.stderr
    );
}

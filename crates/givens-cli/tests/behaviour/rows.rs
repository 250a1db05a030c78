//! Rows: sensors, tracks, times, controls, predictions.

use super::common::numbers;
use super::{DATA, MODEL, WALK, column, folder, near};

#[test]
fn a_row_is_one_update_of_all_its_measures() {
    let folder = folder("stacked");
    // two rows of independent sensors at one time are, in a linear model, one stacked row
    let linear =
        MODEL.replace("hypot(x, y)", "x + y").replace("atan2(y, x)", "x - vy").replace("sr-ukf", "ukf");
    folder.write("model.toml", &linear);
    folder.write("one.csv", "time,range,bearing,px,py\n1,70,0.1,31,38\n");
    folder.write("two.csv", "time,sensor,range,bearing,px,py\n1,radar,70,0.1,,\n1,gps,,,31,38\n");
    let one = folder.run("filter model.toml one.csv").good().cells();
    let two = folder.run("filter model.toml two.csv").good().cells();
    for name in ["x", "vx", "y_std"] {
        assert!(near(column(&two, name)[1], column(&one, name)[0]), "{name}");
    }
    let sum: f64 = column(&two, "log_likelihood").iter().sum();
    assert!(near(sum, column(&one, "log_likelihood")[0]));
}

#[test]
fn two_sensors_may_share_a_column() {
    let folder = folder("shared");
    let far = "[[sensor]]\nname = \"far\"\nmeasures = { z = \"x - 100\" }\nstd = [1]\n";
    let model = format!("{WALK}{far}");
    folder.write("walk.toml", &model).write("data.csv", "time,sensor,z\n1,level,6\n1,far,-94\n");
    let rows = folder.run("filter walk.toml data.csv --format jsonl").good().objects();
    assert_eq!((&rows[0]["sensor"], &rows[1]["sensor"]), (&"level".into(), &"far".into()));
    // P⁻ = 5, R = 1 twice: both say 6
    assert!(near(numbers(&rows[0]["mean"])[0], 5.0) && near(numbers(&rows[1]["mean"])[0], 60.0 / 11.0));
    assert_eq!(rows[1]["measures"], serde_json::json!(["z"]));
}

#[test]
fn tracks_may_be_interleaved_and_come_out_in_the_inputs_order() {
    let folder = folder("tracks");
    let twice = DATA.lines().skip(1).map(|row| {
        let (time, rest) = row.split_once(',').unwrap();
        format!("{time},b,{rest}\n{time},a,{rest}\n")
    });
    let data = format!("time,track_id,range,bearing,px,py\n{}", twice.collect::<String>());
    folder.write("tracks.csv", &data);
    for command in ["filter", "smooth", "smooth --lag 2", "smooth --point 2"] {
        let alone = folder.run(&format!("{command} model.toml data.csv")).good().cells();
        let found = folder.run(&format!("{command} model.toml tracks.csv")).good();
        assert!(found.stderr.contains(" rows of 2 tracks, "), "{}", found.stderr);
        let both = found.cells();
        for (k, row) in both[1..].iter().enumerate() {
            let same = &alone[1 + k / 2];
            assert_eq!((&row[0], row[1].as_str()), (&same[0], ["b", "a"][k % 2]), "{command}");
            // side by side, the last digit may be another one
            for (cell, same) in row[2..].iter().zip(&same[1..]) {
                let number = |cell: &str| cell.parse::<f64>();
                let alike = match (number(cell), number(same)) {
                    (Ok(cell), Ok(same)) => near(cell, same),
                    _ => cell == same,
                };
                assert!(alike, "{command}: {cell} for {same}");
            }
        }
        assert_eq!(both.len() - 1, 2 * (alone.len() - 1));
    }
}

#[test]
fn a_blank_row_asks_for_the_prediction_and_changes_nothing_else() {
    let folder = folder("blank");
    folder.write("less.csv", &DATA.replace("4,,,,\n", ""));
    let all = folder.run("filter model.toml data.csv").good().cells();
    let less = folder.run("filter model.toml less.csv").good().cells();
    assert_eq!(all[1..4], less[1..4]);
    // a linear transition with this noise composes
    for name in ["x", "vx", "y", "vy", "x_std", "nis"] {
        assert!((column(&all, name)[4] / column(&less, name)[3] - 1.0).abs() < 1e-12, "{name}");
    }
}

#[test]
fn times_in_rfc_3339_count_from_the_models_time() {
    let folder = folder("calendar");
    let mut data = DATA.to_owned();
    for k in 1..=5 {
        data = data.replace(&format!("\n{k},"), &format!("\n2026-03-01T13:00:0{k}+01:00,"));
    }
    folder.write("calendar.csv", &data);
    folder.write("calendar.toml", &MODEL.replace("time = 0.0", "time = \"2026-03-01T12:00:00Z\""));
    let seconds = folder.run("smooth model.toml data.csv").good().cells();
    // the number of the model's `time` places the belief before the first row, so that one says an instant
    let calendar = folder.run("smooth calendar.toml calendar.csv").good().cells();
    assert_eq!(calendar[1][0], "2026-03-01T13:00:01+01:00");
    for (a, b) in seconds.iter().zip(&calendar) {
        assert_eq!(a[1..], b[1..]);
    }
    let rows = folder.run("smooth calendar.toml calendar.csv --format jsonl").good().objects();
    assert_eq!(rows[0]["time"], "2026-03-01T13:00:01+01:00");
    let a = folder.run("smooth model.toml data.csv --point 2").good().cells();
    let b = folder.run("smooth calendar.toml calendar.csv --point 2026-03-01T12:00:02Z").good().cells();
    assert_eq!(a[1][1..], b[1][1..]);
}

#[test]
fn a_control_holds_from_its_row_to_the_next_the_first_one_also_before() {
    let folder = folder("controls");
    folder.write("walk.toml", &WALK.replace("transition = [\"x\"]", "transition = [\"x + u_a\"]"));
    folder.write("data.csv", "time,u_a,z\n1,10,\n2,100,\n3,1000,\n");
    let cells = folder.run("filter walk.toml data.csv").good().cells();
    assert_eq!(column(&cells, "x"), [10.0, 20.0, 120.0]);
}

#[test]
fn without_a_time_the_belief_holds_at_the_first_row() {
    let folder = folder("no_time");
    folder.write("walk.toml", &WALK.replace("time = 0\n", "")).write("data.csv", "time,z\n7,\n8,\n");
    let cells = folder.run("filter walk.toml data.csv").good().cells();
    assert_eq!(column(&cells, "x_std"), [2.0, 5_f64.sqrt()]);
}

#[test]
fn columns_that_the_model_does_not_use_are_named() {
    let folder = folder("ignored");
    folder.write("data.csv", "time,z,quality,u_b\n1,2,3,4\n").write("truth.csv", "time,x,weight\n1,2,3\n");
    let found = folder.run("filter walk.toml data.csv --truth truth.csv").good();
    assert!(
        found.stderr.contains("data.csv: columns not used by the model: quality, u_b\n"),
        "{}",
        found.stderr
    );
    assert!(found.stderr.contains("truth.csv: column not used by the model: weight\n"), "{}", found.stderr);
}

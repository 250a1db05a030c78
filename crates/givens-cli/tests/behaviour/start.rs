//! States found from a track's first measurement.

use super::common::models::MODEL;
use super::common::numbers;
use super::{folder, near};

fn model() -> String {
    let prior = "time = 0.0\nmean = [30, 1, 40, -2]\nstd = [5, 1, 5, 1]";
    let start =
        "start = { x = \"2*px + py\", y = \"py\" }\nmean = { vx = 1, vy = -2 }\nstd = { vx = 3, vy = 4 }";
    MODEL.replace(prior, start)
}

const DATA: &str = "time,range,bearing,px,py\n1,50,0.9,,\n2,,,,\n3,51,0.8,10,20\n4,52,0.7,11,21\n";

#[test]
fn start_finds_states_and_their_covariance() {
    let folder = folder("start");
    folder.write("model.toml", &model()).write("data.csv", DATA);
    let rows = folder.run("filter model.toml data.csv --format jsonl").good().objects();
    assert_eq!(rows.len(), 4);
    for row in &rows[..2] {
        assert!(row["mean"].is_null() && row["cov"].is_null() && row["nis_dof"].is_null());
    }
    let first = &rows[2];
    assert_eq!(numbers(&first["mean"]), [40.0, 1.0, 20.0, -2.0]);
    // J R Jᵀ of J = [2 1; 0 1], R = [4 1; 1 4]
    let cov = numbers(&first["cov"]);
    let expected = [24.0, 0.0, 6.0, 0.0, 0.0, 9.0, 0.0, 0.0, 6.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.0, 16.0];
    assert!(cov.iter().zip(expected).all(|(found, expected)| near(*found, expected)), "{cov:?}");
    // the row is not used again, not even the measures that `start` does not read
    for key in ["predicted_mean", "measures", "innovation", "nis", "nis_dof", "log_likelihood"] {
        assert!(first[key].is_null(), "{key}");
    }
    assert_eq!(rows[3]["nis_dof"], 4);
    let predicted = numbers(&rows[3]["predicted_mean"]);
    assert!(predicted.iter().zip([41.0, 1.0, 18.0, -2.0]).all(|(a, b)| near(*a, b)), "{predicted:?}");
}

#[test]
fn rows_before_the_start_are_empty_in_csv() {
    let folder = folder("start_csv");
    folder.write("model.toml", &model()).write("data.csv", DATA);
    for command in ["filter", "smooth", "smooth --lag 1"] {
        let cells = folder.run(&format!("{command} model.toml data.csv")).good().cells();
        assert_eq!(cells[1].join(","), "1,,,,,,,,,,,", "{command}");
        assert_eq!(cells[2].join(","), "2,,,,,,,,,,,");
        assert_eq!(cells[3][9..], ["", "", ""]);
        assert_eq!(cells[4][10], "4");
    }
    let keys = |line: &str| line.matches("\":").count();
    let json = folder.run("smooth model.toml data.csv --format jsonl").good().stdout;
    assert!(json.lines().all(|line| keys(line) == 15), "{json}");
}

#[test]
fn each_track_has_its_own_start() {
    let folder = folder("start_tracks");
    let data = "time,track_id,px,py\n1,a,10,20\n2,b,,\n2,a,11,21\n3,b,1,2\n";
    folder.write("model.toml", &model()).write("data.csv", data);
    let cells = folder.run("filter model.toml data.csv").good().cells();
    let x: Vec<&str> = cells[1..].iter().map(|row| row[2].as_str()).collect();
    assert_eq!((x[0], x[1], x[3]), ("40", "", "4"));
}

#[test]
fn tracks_that_cannot_begin_leave_the_others() {
    let folder = folder("start_none");
    let words =
        ["b", "d"].map(|id| format!("data.csv: track {id}: no row has all that `start` reads: px, py"));
    let (a, b, c) = ("1,a,10,20\n2,a,11,21\n", "2,b,,\n", "1,c,1,2\n2,c,,2\n");
    let of = |tracks: &[&str]| "time,track_id,px,py\n".to_owned() + &tracks.concat();
    folder.write("model.toml", &model()).write("data.csv", &of(&[a, c]));
    // streamed, held for a figure, resumable, at other times, of one time
    let ways = ["", " --plot out.svg", " --resume", " --at every:0.5", " --at 1,2"]
        .map(|how| format!("filter{how}"));
    for how in ways.into_iter().chain(["smooth --point 2".to_owned()]) {
        let command = format!("{how} model.toml data.csv -o out.csv");
        folder.write("data.csv", &of(&[a, c])).run(&command).good();
        let without = folder.read("out.csv");
        let found = folder.write("data.csv", &of(&[a, b, c, "3,d,1,\n"])).run(&command);
        assert_eq!((found.code, folder.read("out.csv")), (1, without), "{how}");
        assert!(words.iter().all(|words| found.stderr.contains(words)), "{}", found.stderr);
    }
    // of none that begins nothing is written
    let found = folder.write("data.csv", &of(&[b, "3,d,1,\n"])).run("filter model.toml data.csv -o none.csv");
    assert_eq!((found.code, folder.files().contains(&"none.csv".to_owned())), (2, false));
    assert!(found.stderr.contains(&words[0]), "{}", found.stderr);
}

#[test]
fn a_point_at_the_start_is_smoothed_from_there() {
    let folder = folder("start_point");
    folder.write("model.toml", &model()).write("data.csv", DATA);
    let rows = folder.run("smooth model.toml data.csv --point 3 --format jsonl").good().objects();
    assert_eq!(rows.iter().map(|row| row["time"].as_f64().unwrap()).collect::<Vec<_>>(), [3.0, 4.0]);
    assert_eq!(numbers(&rows[0]["mean"]), [40.0, 1.0, 20.0, -2.0]);
    let interval = folder.run("smooth model.toml data.csv --format jsonl").good().objects();
    let (a, b) = (numbers(&rows[1]["mean"]), numbers(&interval[2]["mean"]));
    assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-9), "{a:?} {b:?}");
}

#[test]
fn a_start_that_finds_no_number_is_told_with_its_row() {
    let folder = folder("start_domain");
    folder.write("model.toml", &model().replace("2*px + py", "sqrt(px)"));
    folder.write("data.csv", "time,track_id,px,py\n1,a,4,20\n1,b,-4,20\n");
    let found = folder.run("filter model.toml data.csv -o out.csv");
    assert_eq!(found.code, 1);
    assert!(
        found.stderr.contains("data.csv:3: track b: `start` finds no finite `x` from this row"),
        "{}",
        found.stderr
    );
}

/// Positions from a row, velocities from two.
fn two_rows() -> String {
    let start = "start = { x = \"px\", y = \"py\", vx = \"rate(x)\", vy = \"rate(y)\" }";
    MODEL.replace("time = 0.0\nmean = [30, 1, 40, -2]\nstd = [5, 1, 5, 1]", start)
}

#[test]
fn velocities_start_from_the_first_two_rows() {
    let folder = folder("start_two");
    let data = "time,range,bearing,px,py\n0,50,0.9,,\n1,,,10,20\n2,51,,,\n3,51,0.8,14,19\n4,52,0.7,16,18\n";
    folder.write("model.toml", &two_rows()).write("data.csv", data);
    let rows = folder.run("filter model.toml data.csv --format jsonl").good().objects();
    for row in &rows[..3] {
        assert!(row["mean"].is_null() && row["cov"].is_null() && row["nis_dof"].is_null());
    }
    assert_eq!(numbers(&rows[3]["mean"]), [14.0, 2.0, 19.0, -0.5]);
    // R₁, R₁/T and 2 R/T² of R = [4 1; 1 4], T = 2
    let cov = numbers(&rows[3]["cov"]);
    let expected = [4.0, 2.0, 1.0, 0.5, 2.0, 2.0, 0.5, 0.5, 1.0, 0.5, 4.0, 2.0, 0.5, 0.5, 2.0, 2.0];
    assert!(cov.iter().zip(expected).all(|(found, expected)| near(*found, expected)), "{cov:?}");
    // neither row is used again
    for key in ["predicted_mean", "measures", "innovation", "nis", "nis_dof", "log_likelihood"] {
        assert!(rows[3][key].is_null(), "{key}");
    }
    assert_eq!(rows[4]["nis_dof"], 4);
    let smoothed = folder.run("smooth model.toml data.csv --format jsonl").good().objects();
    assert!(smoothed[2]["mean"].is_null() && numbers(&smoothed[3]["mean"]).len() == 4);
    let told = folder.run("check model.toml").good().stdout;
    assert!(told.contains("at the second row that `start` can read"), "{told}");
}

#[test]
fn two_rows_at_one_time_have_no_rate() {
    let folder = folder("start_at_once");
    let data = "time,sensor,px,py\n1,,10,20\n1,gps,14,19\n2,gps,16,18\n";
    folder.write("model.toml", &two_rows()).write("data.csv", data);
    let found = folder.run("filter model.toml data.csv -o out.csv");
    assert_eq!((found.code, folder.files().contains(&"out.csv".to_owned())), (2, false));
    assert!(
        found
            .stderr
            .contains("data.csv:3: `rate` needs two times, but this row and that of line 2 are at one"),
        "{}",
        found.stderr
    );
}

#[test]
fn a_track_of_one_row_has_no_rate() {
    let folder = folder("start_one");
    let data = "time,track_id,px,py\n1,a,10,20\n2,a,14,19\n2,b,16,18\n";
    folder.write("model.toml", &two_rows()).write("data.csv", data);
    let found = folder.run("filter model.toml data.csv -o out.csv");
    assert_eq!(found.code, 1);
    let words = "data.csv: track b: only one row has, where `rate` needs two, all that `start` reads: px, py";
    assert!(found.stderr.contains(words), "{}", found.stderr);
}

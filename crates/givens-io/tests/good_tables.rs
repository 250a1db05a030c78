//! Right tables of every form.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use givens_io::{Model, Tracks, parse_tracks};

const MODEL: &str = r#"
[state]
names = ["x", "y"]
mean = [0, 0]
std = [1, 1]
[dynamics]
transition = ["x", "y"]
[[sensor]]
name = "radar"
measures = { range = "hypot(x, y)", bearing = "atan2(y, x)" }
std = [1, 1]
[[sensor]]
name = "gps"
measures = { px = "x" }
std = [1]
"#;

fn model(with: &str) -> Model {
    Model::parse(&MODEL.replace("[state]", &format!("[state]\n{with}")), "model.toml").unwrap()
}

fn read(table: &str, model: &Model) -> Tracks {
    parse_tracks(table, "data.csv", model).unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn cells_become_measures_and_empty_ones_are_missing() {
    let tracks = read("\u{feff} time , px ,range,bearing,note\n0.5, 7 ,1,,hello\n1.5,,,,\n", &model(""));
    assert_eq!(tracks.ignored, ["note"]);
    assert!(!tracks.has_track_id && !tracks.has_sensor);
    let track = &tracks.tracks[0];
    assert_eq!((track.id.as_deref(), track.start, track.rows.len()), (None, 0.5, 2));
    let row = track.rows.first().unwrap();
    assert_eq!((row.line, row.index, row.time, row.time_text.as_str()), (2, 0, 0.5, "0.5"));
    assert_eq!((row.z[0], row.z[2]), (1.0, 7.0));
    assert!(row.z[1].is_nan() && row.measured() && !track.rows.last().unwrap().measured());
}

#[test]
fn a_sensor_may_be_absent_as_a_whole() {
    let tracks = read("time,px\n1,7\n", &model(""));
    let z = &tracks.tracks[0].rows.first().unwrap().z;
    assert!(z[0].is_nan() && z[1].is_nan());
    assert_eq!(z[2], 7.0);
}

#[test]
fn tracks_may_interleave_and_keep_their_order_and_names() {
    let tracks = read("time,track_id,px\n5,b,1\n1,007,2\n6,b,3\n1.5,007,4\n", &model(""));
    let ids: Vec<_> = tracks.tracks.iter().map(|track| track.id.as_deref().unwrap()).collect();
    assert_eq!(ids, ["b", "007"]);
    let indices: Vec<Vec<usize>> =
        tracks.tracks.iter().map(|track| track.rows.iter().map(|row| row.unwrap().index).collect()).collect();
    assert_eq!(indices, [vec![0, 2], vec![1, 3]]);
    assert_eq!((tracks.tracks[0].start, tracks.tracks[1].start), (5.0, 1.0));
}

#[test]
fn the_belief_holds_at_the_time_of_the_model_or_at_the_first_row() {
    assert_eq!(read("time,px\n3,1\n", &model("")).tracks[0].start, 3.0);
    assert_eq!(read("time,px\n3,1\n", &model("time = -1")).tracks[0].start, -1.0);
}

#[test]
fn times_of_the_calendar_count_from_the_first_row_of_each_track() {
    let table = "time,track_id,px\n2026-03-01T12:00:00Z,a,1\n2026-03-01T14:00:00+01:00,b,1\n2026-03-01T12:00:02.25Z,a,1\n";
    let tracks = read(table, &model(""));
    let times = |k: usize| tracks.tracks[k].rows.iter().map(|row| row.unwrap().time).collect::<Vec<_>>();
    assert_eq!((times(0), times(1)), (vec![0.0, 2.25], vec![0.0]));
    assert_eq!(tracks.tracks[0].rows.row(1).unwrap().unwrap().time_text, "2026-03-01T12:00:02.25Z");
    assert_eq!(tracks.tracks[0].time_text(1.5), "2026-03-01T12:00:01.5Z");
    assert_eq!(tracks.tracks[0].parse_time("2026-03-01T12:00:10Z"), Ok(10.0));
    assert_eq!(tracks.tracks[0].start, 0.0);
    // a number as `time` is seconds after the first row
    assert_eq!(read(table, &model("time = -10")).tracks[1].start, -10.0);
}

#[test]
fn times_of_the_calendar_count_from_a_calendar_time_of_the_model() {
    let model = model("time = 2026-03-01T11:59:50Z");
    let tracks = read("time,px\n2026-03-01T12:00:00Z,1\n", &model);
    assert_eq!((tracks.tracks[0].start, tracks.tracks[0].rows.first().unwrap().time), (0.0, 10.0));
}

#[test]
fn rows_at_one_time_differ_in_their_sensor() {
    let tracks =
        read("time,sensor,px,range,bearing\n1,gps,5,,\n1,radar,,2,3\n2,,5,2,3\n3,gps,,,\n", &model(""));
    let rows = tracks.tracks[0].rows.read(0..usize::MAX).unwrap();
    assert_eq!(rows.iter().map(|row| row.sensor).collect::<Vec<_>>(), [Some(1), Some(0), None, Some(1)]);
    assert!(rows[0].z[0].is_nan() && rows[1].z[2].is_nan() && !rows[3].measured());
    assert_eq!(rows[2].z, [2.0, 3.0, 5.0]);
    assert!(tracks.has_sensor);
}

#[test]
fn controls_stand_in_the_order_of_the_model() {
    let text = MODEL.replace("[\"x\", \"y\"]\n[[", "[\"x + u_b\", \"y + u_a + u_b\"]\n[[");
    let model = Model::parse(&text, "m.toml").unwrap();
    assert_eq!(model.controls, ["u_b", "u_a"]);
    let tracks = read("time,u_a,u_b,px,u_c\n1,2,3,4,5\n", &model);
    assert_eq!(tracks.tracks[0].rows.first().unwrap().u, [3.0, 2.0]);
    assert_eq!(tracks.ignored, ["u_c"]);
}

#[test]
fn a_table_of_times_needs_no_measures_and_truth_stands_beside_tracks() {
    let folder = std::env::temp_dir().join(format!("givens-io-good-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_string()
    };
    let model = model("");
    let times = givens_io::read_times(&write("times.csv", "time\n1\n2\n"), &model).unwrap();
    let asked = |tracks: &Tracks, row: usize| -> Vec<bool> {
        tracks.tracks[0].rows.row(row).unwrap().unwrap().z.iter().map(|value| !value.is_nan()).collect()
    };
    assert_eq!((asked(&times, 0), asked(&times, 1)), (vec![true; 3], vec![true; 3]));
    let times = givens_io::read_times(&write("times.csv", "time,sensor\n1,gps\n2,\n"), &model).unwrap();
    assert_eq!((asked(&times, 0), asked(&times, 1)), (vec![false, false, true], vec![true; 3]));
    let times = write("times.csv", "time,range,bearing\n1,9,\n2,,\n");
    let times = givens_io::read_times(&times, &model).unwrap();
    assert_eq!((asked(&times, 0), asked(&times, 1)), (vec![true, false, false], vec![false; 3]));

    let tracks = read("time,track_id,px\n2026-03-01T12:00:00Z,a,1\n2026-03-01T13:00:00Z,b,1\n", &model);
    let truth = "time,track_id,y,z\n2026-03-01T13:00:01Z,b,4,0\n2026-03-01T12:00:02Z,a,,0\n";
    let path = write("truth.csv", truth);
    let truth = givens_io::read_truth(&path, &model, &tracks).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!((truth.times, truth.tracks, truth.lines), (vec![1.0, 2.0], vec![1, 0], vec![2, 3]));
    assert!(truth.states[0].is_none());
    let y = truth.states[1].as_ref().unwrap();
    assert!(y[0] == 4.0 && y[1].is_nan());
    assert_eq!(truth.ignored, ["z"]);

    let wrong = |text: &str, tracks: &Tracks| {
        let errors = givens_io::read_truth(&write("wrong.csv", text), &model, tracks).unwrap_err();
        let first = errors.errors[0].clone();
        assert_eq!(errors.errors.len(), 1, "{errors}");
        (first.position(), first.message)
    };
    let one = read("time,px\n1,1\n2,1\n", &model);
    assert_eq!(wrong("time,vx\n1,2\n", &one).1, "the table has no column of a state");
    assert_eq!(wrong("tim,x\n1,2\n", &one).1, "the table has no column `time`");
    assert_eq!(wrong("time,x\n2,2\n1,2\n", &one).0, (3, 1));
    assert!(wrong("time,x\n1,2\n1,2\n", &one).1.contains("is there twice (line 2)"));
    assert!(wrong("time,x\n1,abc\n", &one).1.contains("`abc` in `x` (column 2)"));
    assert!(wrong("time,x\n2026-03-01T13:00:01Z,1\n", &one).1.contains("RFC 3339"));
    assert!(wrong("time,x\n2026-03-01T13:00:01Z,1\n", &tracks).1.contains("several tracks"));
    assert!(wrong("time,x,track_id\n1,1,a\n", &one).1.contains("no column `track_id`"));
    assert!(wrong("time,x,track_id\n2026-03-01T13:00:01Z,1,c\n", &tracks).1.contains("no track `c`"));
    assert!(wrong("time,x\n", &one).1.contains("no rows"));
    std::fs::remove_dir_all(&folder).unwrap();
}

//! Tracks side by side: the same numbers as one at a time, whatever the number of threads.

use super::common::models::{OSCILLATOR, WALK};
use super::common::{Folder, objects};
use super::folder;
use core::fmt::Write;
use serde_json::Value;

/// Rows of each of seven tracks, so that packs are full, ragged and left over.
const LENGTHS: [usize; 7] = [9, 1, 6, 9, 3, 8, 2];

/// Seven tracks of the radar and the position sensor, each at times of its own, with missing components and rows without
/// any; the rows of all in order of time.
fn radar() -> Vec<(f64, usize, String)> {
    let mut rows = Vec::new();
    for (track, &len) in LENGTHS.iter().enumerate() {
        for k in 0..len {
            let (i, a) = ((7 * k + 3 * track) as f64, track as f64);
            let time = 0.25 * (1.0 + a) + (0.5 + 0.125 * a) * k as f64;
            let [x, y] = [30.0 + time + (2.1 * i).sin() + a, 40.0 - 2.0 * time + (1.3 * i).cos()];
            let all = [x.hypot(y) + (0.7 * i).sin(), y.atan2(x), x + 1.0, y - 1.0];
            let there = |m: usize| k % 4 != 3 && !(k + m + track).is_multiple_of(3);
            let cells =
                all.iter().enumerate().map(|(m, z)| if there(m) { z.to_string() } else { String::new() });
            rows.push((time, track, cells.collect::<Vec<_>>().join(",")));
        }
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    rows
}

fn table(measures: &str, rows: &[(f64, usize, String)]) -> String {
    rows.iter().fold(format!("time,track_id,{measures}\n"), |mut table, (time, track, cells)| {
        writeln!(table, "{time},t{track},{cells}").unwrap();
        table
    })
}

/// The same positions for the oscillator.
fn oscillators() -> Vec<(f64, usize, String)> {
    let one = |(time, track, cells): (f64, usize, String)| {
        let z = if cells.starts_with(',') { String::new() } else { (1.1 * time).cos().to_string() };
        (time, track, z)
    };
    radar().into_iter().map(one).collect()
}

/// A folder with the tracks of both models.
fn tracks(name: &str) -> Folder {
    let folder = folder(name);
    folder.write("osc.toml", OSCILLATOR);
    folder.write("radar.csv", &table("range,bearing,px,py", &radar()));
    folder.write("osc.csv", &table("z", &oscillators()));
    folder
}

/// The largest difference of the numbers, in parts of the larger one or of 1; all else is equal.
fn apart(a: &Value, b: &Value) -> f64 {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (a, b) = (a.as_f64().unwrap(), b.as_f64().unwrap());
            (a - b).abs() / a.abs().max(b.abs()).max(1.0)
        }
        (Value::Array(a), Value::Array(b)) => {
            assert_eq!(a.len(), b.len());
            a.iter().zip(b).map(|(a, b)| apart(a, b)).fold(0.0, f64::max)
        }
        (Value::Object(a), Value::Object(b)) => {
            assert!(a.keys().eq(b.keys()));
            a.values().zip(b.values()).map(|(a, b)| apart(a, b)).fold(0.0, f64::max)
        }
        _ => {
            assert_eq!(a, b);
            0.0
        }
    }
}

/// Those that go in packs, and those that do not.
const RUNS: [&str; 12] = [
    "filter model.toml radar.csv",
    "smooth model.toml radar.csv",
    "smooth model.toml radar.csv --lag 2",
    "filter model.toml radar.csv --at every:0.5",
    "smooth model.toml radar.csv --method sr-ckf5",
    "filter model.toml radar.csv --method ckf",
    "smooth model.toml radar.csv --method sr-ekf",
    "smooth model.toml radar.csv --method sr-cdkf",
    "filter osc.toml osc.csv",
    "smooth osc.toml osc.csv",
    "smooth osc.toml osc.csv --method sr-cd-ckf2",
    "filter osc.toml osc.csv --method lskf",
];

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let folder = tracks("threads");
    for run in RUNS {
        let all = folder.run(&format!("{run} --format jsonl")).good();
        for threads in [1, 2, 3, 100] {
            let some = folder.run(&format!("{run} --format jsonl --threads {threads}")).good();
            assert!(some.stdout == all.stdout && some.stderr == all.stderr, "{run} on {threads}");
        }
    }
    let untimed = |threads: &str| -> Vec<String> {
        let found =
            folder.run(&format!("compare model.toml radar.csv --methods sr-ukf,ckf {threads}")).good();
        assert!(
            found.stderr.contains("without reading and writing, tracks side by side"),
            "{}",
            found.stderr
        );
        found.stdout.lines().map(|line| line.rsplit_once("  ").unwrap().0.trim_end().to_owned()).collect()
    };
    assert_eq!(untimed("--threads 1"), untimed("--threads 3"));
}

#[test]
fn each_track_comes_out_as_alone_and_its_rows_stand_where_they_stood() {
    let folder = tracks("alone");
    for run in RUNS.iter().filter(|run| !run.contains("--at")) {
        let (measures, rows) =
            if run.contains("osc") { ("z", oscillators()) } else { ("range,bearing,px,py", radar()) };
        let together = folder.run(&format!("{run} --format jsonl")).good().objects();
        let order: Vec<(f64, String)> =
            rows.iter().map(|(time, track, _)| (*time, format!("t{track}"))).collect();
        let found = together
            .iter()
            .map(|row| (row["time"].as_f64().unwrap(), row["track_id"].as_str().unwrap().to_owned()));
        assert_eq!(found.collect::<Vec<_>>(), order, "{run}");
        for track in 0..LENGTHS.len() {
            let own: Vec<_> = rows.iter().filter(|row| row.1 == track).cloned().collect();
            folder.write("one.csv", &table(measures, &own));
            let one = run.replace("radar.csv", "one.csv").replace("osc.csv", "one.csv");
            let alone = folder.run(&format!("{one} --format jsonl")).good().objects();
            let name = format!("t{track}");
            let same: Vec<&Value> = together.iter().filter(|row| row["track_id"] == name.as_str()).collect();
            assert_eq!(same.len(), alone.len());
            for (a, b) in same.into_iter().zip(&alone) {
                let apart = apart(a, b);
                assert!(apart < 1e-12, "{run}: track {track} is {apart:e} off:\n{a}\n{b}");
            }
        }
    }
}

#[test]
fn tracks_may_stand_one_below_the_other_or_mixed() {
    let folder = tracks("order");
    let mut rows = radar();
    rows.sort_by_key(|row| core::cmp::Reverse(row.1));
    folder.write("blocks.csv", &table("range,bearing,px,py", &rows));
    let sorted = |data: &str| {
        let mut rows = folder.run(&format!("filter model.toml {data} --format jsonl")).good().objects();
        rows.sort_by_key(|row| row["track_id"].as_str().unwrap().to_owned());
        rows
    };
    let (mixed, blocks) = (sorted("radar.csv"), sorted("blocks.csv"));
    assert!(mixed.iter().zip(&blocks).all(|(a, b)| apart(a, b) < 1e-12));
    let found = folder.run("filter model.toml blocks.csv").good().cells();
    let order: Vec<String> = rows.iter().map(|row| format!("{} t{}", row.0, row.1)).collect();
    assert_eq!(found[1..].iter().map(|row| row[..2].join(" ")).collect::<Vec<_>>(), order);
}

/// More rows than the lines of one block.
#[test]
fn a_large_table_is_written_in_its_order_whatever_the_number_of_threads() {
    let folder = folder("large");
    folder.run("simulate model.toml --steps 100 --every 1 --runs 200 --seed 1 -o runs.csv").good();
    let keys = |text: &str| -> Vec<String> {
        text.lines().skip(1).map(|line| line.split(',').take(2).collect::<Vec<_>>().join(" ")).collect()
    };
    for format in ["csv", "jsonl"] {
        let line = format!("filter model.toml runs.csv --format {format} --threads");
        let one = folder.run(&format!("{line} 1")).good().stdout;
        assert_eq!(one.lines().count(), 20_000 + usize::from(format == "csv"));
        assert!(format == "jsonl" || keys(&one) == keys(&folder.read("runs.csv")));
        for threads in [2, 5] {
            assert!(folder.run(&format!("{line} {threads}")).good().stdout == one, "{format} {threads}");
        }
    }
}

/// A walk above 20 has no transition: two tracks of six end there.
#[test]
fn tracks_that_fail_in_a_pack_are_named_and_their_neighbours_go_on() {
    let folder = folder("failing");
    folder.write("walk.toml", &WALK.replace("transition = [\"x\"]", "transition = [\"x + 0*sqrt(20 - x)\"]"));
    let mut data = "time,track_id,z\n".to_owned();
    for k in 1..=5 {
        for track in ["a", "b", "c", "d", "e", "f"] {
            let z = if (track, k) == ("b", 2) || (track, k) == ("e", 4) { 100.0 } else { f64::from(k) / 2.0 };
            writeln!(data, "{k},{track},{z}").unwrap();
        }
    }
    folder.write("data.csv", &data);
    for command in ["filter", "smooth"] {
        let line = |threads: usize| {
            format!(
                "{command} walk.toml data.csv --method sr-ckf --format jsonl -o out.jsonl --threads {threads}"
            )
        };
        let found = folder.run(&line(2));
        let all = folder.read("out.jsonl");
        assert_eq!((found.code, found.stdout.as_str()), (1, ""));
        let failed: Vec<&str> = found.stderr.lines().filter(|line| line.starts_with("error: ")).collect();
        assert_eq!(failed.len(), 2, "{}", found.stderr);
        assert!(failed[0].starts_with("error: data.csv:15: track b, t = 3, step "), "{}", failed[0]);
        assert!(failed[1].starts_with("error: data.csv:30: track e, t = 5, step "), "{}", failed[1]);
        assert!(
            failed[0].contains("the transition of `x` is not a finite number; look for"),
            "{}",
            failed[0]
        );
        for finished in ["  2 rows of track b finished before", "  4 rows of track e finished before"] {
            assert!(found.stderr.contains(finished), "{}", found.stderr);
        }
        assert!(found.stderr.contains("sr-ckf: 26 rows of 6 tracks, "), "{}", found.stderr);
        assert_eq!((folder.run(&line(1)).stderr, folder.read("out.jsonl")), (found.stderr, all.clone()));
        // the others, and what was finished of these, are as they are alone
        for track in ["a", "b", "c", "d", "e", "f"] {
            let own = data.lines().filter(|line| line.starts_with("time") || line.contains(track));
            folder.write("one.csv", &own.map(|line| format!("{line}\n")).collect::<String>());
            let alone = folder.run(&format!("{command} walk.toml one.csv --method sr-ckf --format jsonl"));
            assert_eq!(alone.code, i32::from(track == "b" || track == "e"));
            let same: Vec<Value> = objects(&all).into_iter().filter(|row| row["track_id"] == track).collect();
            let alone = alone.objects();
            assert_eq!(same.len(), alone.len(), "{command} {track}");
            assert!(same.iter().zip(&alone).all(|(a, b)| apart(a, b) < 1e-12), "{command} {track}");
        }
    }
}

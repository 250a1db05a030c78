//! Rows beyond the gate: not taken in, marked, counted and named.

use super::{column, folder};
use core::fmt::Write;

/// The walk of the models, and a detection of something else in the fourth row.
const DATA: &str = "time,z\n1,0.4\n2,2.1\n3,-0.8\n4,60\n5,1.9\n6,\n7,-1.3\n";

#[test]
fn a_row_beyond_is_that_of_a_table_without_it() {
    let folder = folder("outlier");
    folder.write("data.csv", DATA).write("without.csv", &DATA.replace("60", ""));
    for run in ["filter walk.toml", "smooth walk.toml", "smooth walk.toml --lag 2"] {
        let found = folder.run(&format!("{run} data.csv --set gate=0.9999")).good();
        let without = folder.run(&format!("{run} without.csv")).good();
        let (cells, expected) = (found.cells(), without.cells());
        assert_eq!(cells[0].join(","), "time,x,x_std,nis,nis_dof,log_likelihood,gated", "{run}");
        assert_eq!(column(&cells, "gated"), [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0], "{run}");
        for (k, (found, expected)) in cells.iter().zip(&expected).enumerate().skip(1) {
            assert_eq!((&found[..3], &found[5]), (&expected[..3], &expected[5]), "{run}, row {k}");
            assert!(k == 4 || found[3..5] == expected[3..5], "{run}, row {k}");
        }
        // the walk has come from 2² to about 1.6 by the fourth row, and its measure has 1 more
        let nis = column(&cells, "nis")[3];
        assert!((1000.0..2000.0).contains(&nis) && column(&cells, "nis_dof")[3] == 1.0, "{nis}");
        let told = "1 of 7 rows beyond the gate (0.9999), not taken in: data.csv:5 (t = 4)\n";
        assert!(found.stderr.ends_with(told), "{run}: {}", found.stderr);
        // the band is that of what a gate lets in
        let verdict = |stderr: &str| {
            let (_, rest) = stderr.split_once(": 7 rows").unwrap();
            rest.split_once(", 95 % band").unwrap().0.to_owned()
        };
        assert_eq!(verdict(&found.stderr), verdict(&without.stderr), "{run}");
        let objects =
            folder.run(&format!("{run} data.csv --set gate=0.9999 --format jsonl")).good().objects();
        let gated: Vec<bool> = objects.iter().map(|row| row["gated"].as_bool().unwrap()).collect();
        assert_eq!(gated, [false, false, false, true, false, false, false], "{run}");
    }
}

#[test]
fn the_model_file_has_it_too_and_without_it_nothing_is_said() {
    let folder = folder("file");
    folder.write("data.csv", DATA);
    folder.write("gated.toml", &format!("{}[filter]\ngate = 0.99\n", super::WALK));
    let found = folder.run("filter gated.toml data.csv").good();
    assert!(found.stderr.contains("rows beyond the gate (0.99)"), "{}", found.stderr);
    assert!(folder.run("check gated.toml").good().stdout.contains("gate 0.99"));
    let none = folder.run("filter walk.toml data.csv").good();
    assert!(!none.stderr.contains("gate") && !none.stdout.contains("gated"), "{}", none.stderr);
    let clean = DATA.replace("60", "0.1");
    folder.write("data.csv", &clean);
    let found = folder.run("filter gated.toml data.csv").good();
    assert!(found.stderr.ends_with("\n0 of 7 rows beyond the gate (0.99)\n"), "{}", found.stderr);
}

#[test]
fn those_of_many_tracks_are_named_with_theirs_and_no_more_than_a_few() {
    let folder = folder("tracks");
    let mut table = "time,track_id,z\n".to_owned();
    for k in 0..20 {
        for track in ["a", "b"] {
            let z = if track == "b" && k % 2 == 1 { "70" } else { "0.1" };
            writeln!(table, "{},{track},{z}", k + 1).unwrap();
        }
    }
    folder.write("data.csv", &table);
    let found = folder.run("filter walk.toml data.csv --set gate=0.9999 --plot track.svg").good();
    let told = "10 of 40 rows beyond the gate (0.9999), not taken in: data.csv:5 (track b, t = 2), data.csv:9 (track b, \
                t = 4), ";
    assert!(found.stderr.contains(told) && found.stderr.contains(" and 2 more\n"), "{}", found.stderr);
    let one = table.replace("a,0.1", "a,90");
    folder.write("data.csv", &one);
    folder.run("filter walk.toml data.csv --set gate=0.9999 --plot track.svg").good();
    assert!(folder.read("track.svg").contains("20 beyond the gate (rings)"));
}

#[test]
fn compare_counts_them() {
    let folder = folder("compare");
    folder.write("data.csv", DATA);
    let run = |settings: &str| {
        folder.run(&format!("compare walk.toml data.csv --methods ckf,sr-ckf {settings}")).good()
    };
    let found = run("--set sr-ckf.gate=0.9999").stdout;
    let lines: Vec<Vec<&str>> = found.lines().map(|line| line.split_whitespace().collect()).collect();
    let column: Vec<&str> = lines.iter().map(|line| line[3]).collect();
    assert_eq!(column, ["gated", "0", "1"]);
    assert_eq!((lines[1][6], lines[2][6]), ("overconfident", "consistent"));
    assert!(!run("").stdout.contains("gated"));
}

//! Long tables.

use super::folder;

#[test]
fn a_hundred_thousand_rows_run_in_seconds() {
    let folder = folder("large");
    let begun = std::time::Instant::now();
    folder.run("simulate walk.toml --steps 100000 --seed 1 -o data.csv --states truth.csv").good();
    let found = folder.run("filter walk.toml data.csv --truth truth.csv -o out.csv").good();
    assert!(found.stderr.contains("sr-ckf: 100000 rows, "), "{}", found.stderr);
    assert!(found.stderr.contains(", consistent: "), "{}", found.stderr);
    folder.run("smooth walk.toml data.csv -o out.jsonl").good();
    assert_eq!(folder.read("out.csv").lines().count(), 100_001);
    assert_eq!(folder.read("out.jsonl").lines().count(), 100_000);
    // a few seconds of an idle machine, in a build without optimisation
    assert!(begun.elapsed().as_secs() < 120, "{:?}", begun.elapsed());
}

#[test]
fn a_thousand_tracks_with_a_truth_run_in_seconds() {
    let folder = folder("tracks");
    let begun = std::time::Instant::now();
    let line = "simulate walk.toml --steps 20 --runs 2000 --seed 1 -o data.csv --states truth.csv";
    folder.run(line).good();
    let found = folder.run("smooth walk.toml data.csv --truth truth.csv -o out.csv").good();
    assert!(found.stderr.contains("40000 rows of 2000 tracks"), "{}", found.stderr);
    assert!(begun.elapsed().as_secs() < 120, "{:?}", begun.elapsed());
}

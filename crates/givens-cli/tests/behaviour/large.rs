//! Long tables.

use super::common::Folder;
use super::folder;
use core::fmt::Write;

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

/// A chain of thirty states, whose records of some three thousand rows are more than a smoother holds at once.
const STATES: usize = 30;
const ROWS: usize = 3000;

fn chain() -> String {
    let names: Vec<String> = (0..STATES).map(|i| format!("\"x{i}\"")).collect();
    let moves: Vec<String> =
        (0..STATES).map(|i| format!("x{i} = \"0.9*x{i} + 0.05*x{}\"", (i + 1) % STATES)).collect();
    let noise: Vec<String> = (0..STATES)
        .map(|i| {
            format!(
                "[{}]",
                (0..STATES).map(|j| if i == j { "0.1" } else { "0" }).collect::<Vec<_>>().join(",")
            )
        })
        .collect();
    format!(
        "[state]\nnames = [{}]\ntime = 0.0\nmean = {:?}\nstd = {:?}\n[dynamics]\ntransition = {{ {} }}\n\
         noise_cov = [{}]\nstep = 1.0\n[[sensor]]\nname = \"ends\"\nmeasures = {{ a = \"x0\", b = \"x{}\" }}\n\
         std = {{ a = 0.5, b = 0.5 }}\n[plot]\nplane = [\"x0\", \"x1\"]\n",
        names.join(","),
        [0.0; STATES],
        [1.0; STATES],
        moves.join(", "),
        noise.join(","),
        STATES / 2
    )
}

/// A folder with the rows of one track, and the same beside a row of another track.
fn chains(name: &str, rows: usize) -> Folder {
    let folder = folder(name);
    folder.write("chain.toml", &chain());
    let (mut one, mut two) = (String::from("time,a,b\n"), String::from("time,track_id,a,b\n"));
    for k in 1..=rows {
        let a = if k % 5 == 0 { String::new() } else { format!("{}", (0.7 * k as f64).sin()) };
        let b = (0.3 * k as f64).cos();
        writeln!(one, "{k},{a},{b}").unwrap();
        writeln!(two, "{k},one,{a},{b}").unwrap();
    }
    two.push_str("1,two,0.5,0.5\n");
    folder.write("one.csv", &one).write("two.csv", &two);
    folder
}

// two tracks in one table are held whole: ckf goes in no pack, and gives the numbers of a track alone
fn alike(folder: &Folder, command: &str, ending: &str) {
    let alone = folder.run(&format!("{command} one.csv --method ckf --format {ending}")).good().stdout;
    let beside = folder.run(&format!("{command} two.csv --method ckf --format {ending}")).good().stdout;
    let (named, none) =
        if ending == "csv" { (",one,", ",") } else { ("\"track_id\":\"one\"", "\"track_id\":null") };
    let beside: Vec<String> =
        beside.lines().map(|line| line.replacen(named, none, 1).replacen(",track_id,", ",", 1)).collect();
    let alone: Vec<&str> = alone.lines().collect();
    assert!(alone.len() >= 10 && beside.len() > alone.len(), "{command}");
    let other = beside.iter().filter(|line| !line.contains("two"));
    let rows = alone.iter().zip(other).enumerate();
    rows.for_each(|(k, (alone, beside))| assert_eq!(alone, beside, "{command} {ending}, line {k}"));
}

#[test]
fn a_track_alone_has_the_numbers_that_it_has_beside_others() {
    let folder = chains("few", 40);
    for command in ["filter chain.toml", "smooth chain.toml", "smooth chain.toml --lag 3"] {
        alike(&folder, command, "csv");
        alike(&folder, command, "jsonl");
    }
    alike(&folder, "smooth chain.toml --at every:1", "jsonl");
    alike(&folder, "smooth chain.toml --at every:3", "csv");
}

#[test]
fn a_smoother_in_segments_has_the_numbers_of_one_that_holds_all_rows() {
    let folder = chains("many", ROWS);
    let found = folder.run("smooth chain.toml one.csv -o out.csv --plot out.svg").good();
    let told =
        format!("{ROWS} rows are smoothed in segments, three times over the data: at once they would take");
    assert!(found.stderr.contains(&told), "{}", found.stderr);
    alike(&folder, "smooth chain.toml", "csv");
}

/// More rows than are held in memory: the others lie in a temporary file.
const LONG: usize = 530_000;

#[test]
fn rows_on_the_disk_have_the_numbers_of_rows_in_memory() {
    let folder = folder("long");
    folder.run(&format!("simulate walk.toml --steps {LONG} --seed 1 -o data.csv")).good();
    let table = folder.read("data.csv");
    let short: Vec<&str> = table.lines().take(200_001).collect();
    folder.write("short.csv", &(short.join("\n") + "\n"));
    for (command, last) in [("filter", 0), ("smooth --lag 2", 2)] {
        let long = folder.run(&format!("{command} walk.toml data.csv --report page.html -o long.csv")).good();
        assert!(long.stderr.contains(&format!("{LONG} rows, ")), "{}", long.stderr);
        folder.run(&format!("{command} walk.toml short.csv -o short-out.csv")).good();
        let (long, short) = (folder.read("long.csv"), folder.read("short-out.csv"));
        assert_eq!(long.lines().count(), LONG + 1);
        let rows = long.lines().zip(short.lines()).take(200_001 - last).enumerate();
        rows.for_each(|(k, (long, short))| assert_eq!(long, short, "{command}, line {k}"));
        assert!(folder.read("page.html").contains("The usual gap between measured rows is"));
        // what comes from a pipe has a place on the disk too
        if command == "filter" {
            folder.run_with("filter walk.toml - -o piped.csv", &table).good();
            assert!(folder.read("piped.csv") == long, "from a pipe");
        }
    }
    // times beyond the rows that are held are named as fast as others
    let at = folder.run("filter walk.toml data.csv --at every:100 -o at.csv").good();
    assert!(at.stderr.contains(&format!("{LONG} rows, ")), "{}", at.stderr);
    let of_row = |text: &str| {
        text.lines()
            .find(|line| line.starts_with("529900,"))
            .map(|line| line.split(',').nth(1).unwrap().to_owned())
    };
    assert_eq!(of_row(&folder.read("at.csv")).unwrap(), of_row(&folder.read("piped.csv")).unwrap());
    let mut named = String::from("track_id,") + table.lines().next().unwrap() + "\n";
    table.lines().skip(1).for_each(|row| writeln!(named, "one,{row}").unwrap());
    writeln!(named, "two,{}", table.lines().nth(1).unwrap()).unwrap();
    folder.write("one.csv", &table).write("two.csv", &named);
    alike(&folder, "smooth walk.toml", "csv");
}

#[test]
fn what_is_wrong_far_down_is_told_before_anything_is_written() {
    let folder = folder("far-down");
    let mut table = String::from("time,z\n");
    (0..LONG).for_each(|k| writeln!(table, "{k},0").unwrap());
    let wrong = format!("{},0\n{},none\n", LONG - 5, LONG);
    folder.write("data.csv", &(table.clone() + &wrong));
    let told = folder.run("filter walk.toml data.csv -o out.csv");
    assert_eq!(told.code, 2);
    let (first, second) = (format!("data.csv:{}:1: ", LONG + 2), format!("data.csv:{}:", LONG + 3));
    assert!(told.stderr.contains(&first) && told.stderr.contains(&second), "{}", told.stderr);
    assert!(!folder.path("out.csv").exists());
    folder.write("data.csv", &table);
    let mut command = folder.command(&["filter", "walk.toml", "data.csv", "-o", "out.csv"]);
    let told = command.env("TMPDIR", folder.path("nowhere")).output().unwrap();
    let told = String::from_utf8(told.stderr).unwrap();
    assert!(told.contains("the rows of a long table lie in the folder for temporary files"), "{told}");
    assert!(told.contains("TMPDIR"), "{told}");
}

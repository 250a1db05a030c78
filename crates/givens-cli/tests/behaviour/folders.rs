//! Many files: cut by tracks, run one by one, gone on with.

use super::common::models::WALK;
use super::common::{Folder, Run};
use super::folder;
use core::fmt::Write;
use core::time::Duration;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;

/// Rows of so many tracks, mixed, of different lengths, some without a measure.
fn table(tracks: usize, longest: usize) -> String {
    let mut text = String::from("time,track_id,z,remark\n");
    for k in 0..longest {
        for track in (0..tracks).filter(|track| k < 3 + track * 7 % longest) {
            let z =
                if (k + track) % 5 == 3 { String::new() } else { ((k * 37 + track * 11) % 101).to_string() };
            writeln!(text, "{},ship {track},{z},\"a, b\"", k + track % 2).unwrap();
        }
    }
    text
}

/// The lines of every track, by the second cell.
fn by_track(texts: &[String]) -> BTreeMap<String, Vec<String>> {
    let mut found = BTreeMap::<String, Vec<String>>::new();
    for text in texts {
        for line in text.lines().skip(1) {
            let track = line.split(',').nth(1).unwrap();
            found.entry(track.to_owned()).or_default().push(line.to_owned());
        }
    }
    found
}

fn texts(folder: &Folder, name: &str) -> Vec<String> {
    let mut files: Vec<_> =
        fs::read_dir(folder.path(name)).unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    files.iter().map(|file| fs::read_to_string(file).unwrap()).collect()
}

#[test]
fn each_track_has_the_bytes_that_it_has_in_one_table_however_they_are_cut() {
    let folder = folder("cut");
    folder.write("ships.csv", &table(23, 40));
    for command in ["filter", "smooth"] {
        let whole = folder.run(&format!("{command} walk.toml ships.csv")).good().stdout;
        let expected = by_track(&[whole]);
        assert_eq!(expected.len(), 23);
        for rows in [1, 90, 100_000] {
            let _ = fs::remove_dir_all(folder.path("parts"));
            let _ = fs::remove_dir_all(folder.path("out"));
            folder.run(&format!("partition ships.csv --by track_id -o parts --rows {rows}")).good();
            for threads in [1, 3] {
                let line = format!("{command} walk.toml parts -o out --format csv --threads {threads}");
                let done = folder.run(&line).good();
                let files = fs::read_dir(folder.path("parts")).unwrap().count();
                assert!(files == texts(&folder, "out").len() && (rows != 1 || files == 23), "{files}");
                assert!(done.stderr.contains(" of 23 tracks in "), "{}", done.stderr);
                assert!(
                    by_track(&texts(&folder, "out")) == expected,
                    "{command}, {rows} rows, {threads} threads"
                );
            }
        }
    }
}

#[test]
fn tables_of_either_kind_are_cut_together_and_sorted_by_time() {
    let folder = folder("together");
    folder
        .write("a.csv", "time,track_id,z\n2,a,1\n1,b,2\n0,a,3\n")
        .write("b.csv", "time,track_id,z\n1,a,\n0,b,4\n");
    let done = folder.run("partition a.csv b.csv --by track_id -o parts").good();
    assert_eq!(done.stderr, "5 rows of 2 tracks in 1 file\n");
    // the cut tables are tables again
    folder.run("partition parts --by track_id -o again").good();
    let filtered = folder.run("filter walk.toml again/part-00000.parquet").good().cells();
    let keys: Vec<String> = filtered[1..].iter().map(|row| row[..2].join("")).collect();
    assert_eq!(keys, ["0a", "1a", "2a", "0b", "1b"]);
}

#[test]
fn what_is_cut_is_what_it_was() {
    let folder = folder("lossless");
    let tables = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/behaviour/tables");
    fs::copy(tables.join("blanks.parquet"), folder.path("blanks.parquet")).unwrap();
    folder.write("any.toml", &WALK.replace("time = 0\n", ""));
    // blanks around a name do not count
    folder.run("partition blanks.parquet --by track_id --rows 1 -o blanks").good();
    folder.run("filter any.toml blanks -o blanks-out --format csv").good();
    let whole = by_track(&[folder.run("filter any.toml blanks.parquet").good().stdout]);
    assert!(by_track(&texts(&folder, "blanks-out")) == whole && whole.len() == 2, "{whole:?}");
    // a column of tracks with another name is called track_id
    folder.write("ships.csv", "time,ship,z\n1,a,1\n2,b,5\n3,a,2\n");
    folder.run("partition ships.csv --by ship -o ships").good();
    let run = folder.run("filter any.toml ships -o ships-out --format csv").good();
    assert!(run.stderr.contains("3 rows of 2 tracks in 1 file"), "{}", run.stderr);
    let both = folder
        .write("both.csv", "time,ship,track_id,z\n1,a,b,1\n")
        .run("partition both.csv --by ship -o both");
    assert!(
        both.code == 2 && both.stderr.contains("would be called `track_id`, and there is one"),
        "{}",
        both.stderr
    );
    // NaN stays wrong, and what is of two kinds, padded or long stays as it is written
    folder.write(
        "odd.csv",
        "time,track_id,z,a,b,c\n1,x,NaN,5,007,9007199254740993\n2,x,2,2026-03-01T12:00:00Z,1,2\n",
    );
    folder.run("partition odd.csv --by track_id -o odd").good();
    let odd = folder.run("filter any.toml odd/part-00000.parquet");
    assert!(odd.code == 2 && odd.stderr.contains("row 1: `NaN` in `z` is not a number"), "{}", odd.stderr);
    let file = fs::File::open(folder.path("odd/part-00000.parquet")).unwrap();
    let rows = parquet::file::reader::SerializedFileReader::new(file).unwrap();
    let first = rows.into_iter().next().unwrap().unwrap().to_string();
    assert!(first.ends_with("a: \"5\", b: \"007\", c: \"9007199254740993\"}"), "{first}");
}

#[test]
fn a_folder_that_was_not_cut_to_its_end_is_refused() {
    let folder = folder("unfinished");
    folder.write("ships.csv", &table(9, 9));
    folder.run("partition ships.csv --by track_id --rows 20 -o parts").good();
    fs::rename(folder.path("parts/part-00001.parquet"), folder.path("parts/part-00001.parquet.unfinished"))
        .unwrap();
    let found = folder.run("filter walk.toml parts -o out");
    assert!(
        found.code == 2 && found.stderr.contains("`givens partition` was broken off"),
        "{}",
        found.stderr
    );
    assert!(!folder.path("out").exists());
}

#[test]
fn what_cannot_be_cut_is_told_by_table_row_and_column() {
    let folder = folder("uncut");
    folder.write("good.csv", "time,track_id,z\n1,a,1\n").write("less.csv", "time,track_id\n1,a\n");
    folder
        .write("hole.csv", "time,track_id,z\n1,a,1\n2,,1\n")
        .write("late.csv", "time,track_id,z\n1,a,1\n,a,1\n");
    for (line, words) in [
        (
            "good.csv --by ship -o p1",
            "good.csv: the table has no column `ship`: it has `time`, `track_id`, `z`",
        ),
        ("good.csv less.csv --by track_id -o p2", "less.csv: it has 2 columns, and good.csv has 3"),
        ("hole.csv --by track_id -o p3", "hole.csv: row 2: a row has no `track_id`"),
        ("late.csv --by track_id -o p4", "late.csv: row 2: a row has no time"),
        ("none*.csv --by track_id -o p6", "none*.csv: no file has such a name"),
    ] {
        let found = folder.run(&format!("partition {line}"));
        assert!(found.code == 2 && found.stderr.contains(words), "{line}: {}", found.stderr);
    }
    folder.run("partition good.csv --by track_id -o parts").good();
    let again = folder.run("partition good.csv --by track_id -o parts");
    assert!(again.code == 2 && again.stderr.contains("there is a part-00000.parquet"), "{}", again.stderr);
}

#[test]
fn a_file_that_cannot_be_read_and_a_track_that_fails_leave_the_others() {
    let folder = folder("some_fail");
    fs::create_dir(folder.path("in")).unwrap();
    folder.write("in/a.csv", "time,z\n1,2\n").write("in/b.csv", "time,z\n1,x\n");
    folder
        .write("in/c.csv", "time,track_id,z\n1,a,1\n1,b,1e200\n2,b,-1e200\n")
        .write("in/notes.txt", "no table");
    let found = folder.run("filter walk.toml in -o out");
    assert_eq!(found.code, 1, "{}", found.stderr);
    assert!(found.stderr.contains("in/b.csv:2:3: `x` in `z` (column 2) is not a number"), "{}", found.stderr);
    assert!(
        found.stderr.contains("in/c.csv:3: track b, t = 1, step 1: the filter failed"),
        "{}",
        found.stderr
    );
    assert!(found.stderr.contains("of 3 tracks in 2 files"), "{}", found.stderr);
    assert!(folder.read("out/a.csv").lines().count() == 2 && !folder.path("out/b.csv").exists());
    assert_eq!(folder.read("out/c.csv").lines().count(), 2);
}

#[test]
fn what_is_for_one_table_is_refused_and_nothing_is_written() {
    let folder = folder("refused");
    fs::create_dir(folder.path("in")).unwrap();
    folder.write("in/a.csv", "time,z\n1,2\n");
    for (line, words) in [
        ("in", "in is of several tables, and there is no -o"),
        ("in -o -", "-o -: of several tables the answers are several files"),
        ("in -o walk.toml", "-o walk.toml: of several tables the answers are several files"),
        ("in -o in", "-o in/a.csv: that is the file of the data"),
        ("in -o out --truth truth.csv", "--truth is for one table"),
        ("in -o out --plot a.svg", "--plot is for one table"),
        ("in -o out --method xyz", "xyz"),
    ] {
        let found = folder.run(&format!("filter walk.toml {line}"));
        assert!(found.code == 2 && found.stderr.contains(words), "{line}: {}", found.stderr);
    }
    assert!(!folder.path("out").exists());
}

#[test]
fn a_run_over_files_that_is_killed_is_gone_on_with() {
    let folder = folder("killed");
    // so many that it is at work for a while after the first ones are done
    folder.write("ships.csv", &table(200, 3000));
    folder.run("partition ships.csv --by track_id -o parts --rows 600").good();
    folder.run("smooth walk.toml parts -o unbroken").good();
    let line = "smooth walk.toml parts -o out --resume --threads 1";
    let words: Vec<&str> = line.split_whitespace().collect();
    let mut child = folder.command(&words).spawn().unwrap();
    let done = || fs::read_dir(folder.path("out")).map_or(0, Iterator::count);
    // three files, the checkpoint and what is being written
    while done() < 5 && child.try_wait().unwrap().is_none() {
        sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let plain = folder.run("smooth walk.toml parts -o out");
    assert!(plain.code == 2 && plain.stderr.contains("add --resume"), "{}", plain.stderr);
    let other = folder.run("smooth walk.toml parts -o out --resume --method ckf");
    assert!(other.code == 2 && other.stderr.contains("of another"), "{}", other.stderr);
    // an answer that is not what the run has written is written again
    let mut files: Vec<_> =
        fs::read_dir(folder.path("out")).unwrap().map(|file| file.unwrap().path()).collect();
    files.sort();
    fs::write(&files[0], "junk").unwrap();
    let last = folder.run(line).good();
    assert!(last.stderr.starts_with("goes on: "), "{}", last.stderr);
    assert!(last.stderr.contains(" of 200 tracks in "), "{}", last.stderr);
    for file in fs::read_dir(folder.path("unbroken")).unwrap() {
        let file = file.unwrap();
        let own = folder.path("out").join(file.file_name());
        assert!(fs::read(own).unwrap() == fs::read(file.path()).unwrap(), "{}", file.path().display());
    }
    assert!(!folder.path("out/run.checkpoint").exists());
}

#[test]
fn a_table_that_cannot_be_cut_leaves_nothing_behind_and_tells_which_folder_is_full() {
    let folder = folder("full");
    folder.write("ships.csv", &table(9, 9));
    let args = ["partition", "ships.csv", "--by", "track_id", "--rows", "20", "-o", "parts"];
    let told: Run = folder.command(&args).env("TMPDIR", folder.path("gone")).output().unwrap().into();
    assert!(told.code == 2 && told.stderr.contains("gone: rows cannot be held in this folder meanwhile"));
    assert!(told.stderr.contains("set TMPDIR"), "{}", told.stderr);
    // what stands in the way of the second file
    let block = folder.path("parts/part-00001.parquet.unfinished");
    fs::create_dir_all(&block).unwrap();
    let told = folder.run_args(&args);
    assert!(told.code == 2 && told.stderr.contains("parts: cannot be written"), "{}", told.stderr);
    assert_eq!(fs::read_dir(folder.path("parts")).unwrap().count(), 1);
    fs::remove_dir(&block).unwrap();
    folder.run_args(&args).good();
}

#[cfg(target_os = "linux")]
#[test]
fn a_file_whose_name_is_no_text_is_told() {
    use std::os::unix::ffi::OsStrExt;
    let folder = folder("names");
    fs::create_dir(folder.path("data")).unwrap();
    folder.write("data/a.csv", &table(2, 4));
    let odd = folder.path("data").join(std::ffi::OsStr::from_bytes(b"b\xff.csv"));
    fs::copy(folder.path("data/a.csv"), odd).unwrap();
    let told = folder.run("filter walk.toml data -o out");
    assert!(told.code == 2 && told.stderr.contains("the name of this file is not UTF-8\n  help: rename it"));
    assert!(!folder.path("out").exists());
}

#[test]
fn runs_over_the_same_files_at_once_all_end_well() {
    let folder = folder("at_once");
    folder.write("ships.csv", &table(23, 40));
    folder.run("partition ships.csv --by track_id --rows 20 -o parts").good();
    folder.run("filter walk.toml parts -o alone --format csv").good();
    let args = ["filter", "walk.toml", "parts", "-o", "out", "--format", "csv"];
    for _ in 0..5 {
        let started: Vec<_> = (0..4).map(|_| folder.command(&args).stderr(Stdio::piped()).spawn()).collect();
        for run in started {
            Run::from(run.unwrap().wait_with_output().unwrap()).good();
        }
        assert_eq!(texts(&folder, "out"), texts(&folder, "alone"));
    }
}

//! Runs that are killed and gone on with: `--resume`.

use super::common::Folder;
use super::common::models::WALK;
use super::folder;
use core::fmt::Write;
use core::time::Duration;
use std::fs;
use std::thread::sleep;

/// So many rows of each of some tracks; a single one has no name.
fn table(rows: usize, tracks: usize) -> String {
    let mut text = String::from(if tracks == 1 { "time,z\n" } else { "time,track_id,z\n" });
    for k in 1..=rows {
        for track in 0..tracks {
            let name = if tracks == 1 { String::new() } else { format!(",{track}") };
            writeln!(text, "{k}{name},{}", (k * 37 + track * 11) % 101).unwrap();
        }
    }
    text
}

/// Kills runs of a command at moments that move on, until `times` of them had been at work or one was done before, then lets one
/// end. What it has written is what an unbroken one writes.
fn survives(folder: &Folder, line: &str, output: &str, times: usize) {
    let unbroken = folder.run(&format!("{line} --resume=0 -o unbroken-{output}")).good();
    let resumed = format!("{line} --resume=0 -o {output}");
    let words: Vec<&str> = resumed.split_whitespace().collect();
    let checkpoint = folder.path(&format!("{output}.checkpoint"));
    let (mut killed, mut wait) = (0, Duration::from_millis(2));
    while killed < times {
        let before = fs::read(&checkpoint).ok();
        let mut child = folder.command(&words).spawn().unwrap();
        // until it has come further than the one before
        while child.try_wait().unwrap().is_none() && fs::read(&checkpoint).ok() == before {
            sleep(Duration::from_millis(1));
        }
        sleep(wait);
        wait = wait * 5 / 4;
        let ended = child.try_wait().unwrap().is_some();
        child.kill().unwrap();
        child.wait().unwrap();
        if ended {
            break;
        }
        killed += 1;
        let partial = folder.path(&format!("{output}.partial"));
        assert!(!folder.path(output).exists() || !partial.exists(), "nothing lies there before it is whole");
    }
    assert!(killed > 0, "{line}: it was done too soon");
    let last = folder.run(&resumed).good();
    let goes_on = "goes on from the checkpoint of a run that was broken off\n";
    // killed before its first checkpoint, it begins anew, and does not say so
    let words = last.stderr.strip_prefix(goes_on).unwrap_or(&last.stderr);
    assert_eq!(words, unbroken.stderr, "{line}: the closing words");
    let whole = folder.read(&format!("unbroken-{output}"));
    assert!(folder.read(output) == whole, "{line}: other bytes");
    let plain = format!("{line} -o plain-{output}");
    folder.run(&plain).good();
    assert!(folder.read(&format!("plain-{output}")) == whole, "{line}: other bytes without a checkpoint");
    let left: Vec<String> = folder
        .files()
        .into_iter()
        .filter(|name| name.contains(".checkpoint") || name.contains(".partial"))
        .collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn a_filter_that_is_killed_goes_on_to_the_same_bytes() {
    let folder = folder("filter");
    folder.write("long.csv", &table(40_000, 1)).write("free.toml", &WALK.replace("step = 1\n", ""));
    survives(&folder, "filter walk.toml long.csv", "out.csv", 2);
    survives(&folder, "filter free.toml long.csv --at every:0.5", "at.csv", 1);
    survives(&folder, "filter walk.toml long.csv --set gate=0.9 --plot a.svg", "out.jsonl", 1);
}

#[test]
fn a_smoother_that_is_killed_goes_on_to_the_same_bytes() {
    let folder = folder("smoother");
    folder.write("long.csv", &table(40_000, 1)).write("free.toml", &WALK.replace("step = 1\n", ""));
    survives(&folder, "smooth walk.toml long.csv", "out.csv", 2);
    survives(&folder, "smooth free.toml long.csv --at every:0.5", "at.csv", 2);
    survives(&folder, "smooth walk.toml long.csv --lag 7", "lag.csv", 1);
}

#[test]
fn tracks_that_are_killed_go_on_to_the_same_bytes() {
    let folder = folder("tracks");
    folder.write("tracks.csv", &table(300, 1100));
    survives(&folder, "smooth walk.toml tracks.csv", "out.csv", 1);
}

#[cfg(unix)]
#[test]
fn a_disk_that_is_full_leaves_what_can_be_gone_on_with() {
    let folder = folder("full");
    folder.write("long.csv", &table(40_000, 1));
    let expected = folder.run("filter walk.toml long.csv").good().stdout;
    // files of up to 400 blocks, and no signal where one would become longer
    let shell = |resume: &str| {
        let script = "trap '' XFSZ; ulimit -f 400; exec \"$0\" filter walk.toml long.csv -o out.csv $1";
        let mut shell = std::process::Command::new("sh");
        shell.args(["-c", script, env!("CARGO_BIN_EXE_givens"), resume]).current_dir(&folder.0);
        let found = super::common::Run::from(shell.output().unwrap());
        assert!(found.code == 1 && found.stderr.contains("cannot write out.csv: "), "{}", found.stderr);
        folder.files().into_iter().filter(|name| name.starts_with("out.csv")).collect::<Vec<_>>()
    };
    assert_eq!(shell(""), [""; 0]);
    assert_eq!(shell("--resume=0"), ["out.csv.checkpoint", "out.csv.partial"]);
    folder.run("filter walk.toml long.csv --resume -o out.csv").good();
    assert!(folder.read("out.csv") == expected);
}

#[test]
fn a_run_that_was_killed_behind_its_last_word_is_gone_on_with() {
    let folder = folder("named");
    let bytes = killed(&folder);
    let line = "filter walk.toml long.csv --resume -o out.csv --plot a.svg";
    let found = folder.run("filter walk.toml long.csv --resume -o out.csv").good();
    assert!(found.stderr.starts_with("goes on from the checkpoint"), "{}", found.stderr);
    let whole = folder.read("out.csv");
    // the output has its name, and the checkpoint is still there
    fs::write(folder.path("out.csv.checkpoint"), bytes).unwrap();
    folder.run("filter walk.toml long.csv --resume -o out.csv").good();
    assert!(folder.read("out.csv") == whole);
    // a figure that cannot be written is no reason to lose the run
    fs::create_dir(folder.path("a.svg.partial")).unwrap();
    assert_eq!(folder.run(line).code, 2);
    fs::remove_dir(folder.path("a.svg.partial")).unwrap();
    folder.run(line).good();
    assert!(folder.read("out.csv") == whole && folder.path("a.svg").exists());
}

#[test]
fn a_track_that_fails_is_gone_on_with_too() {
    let folder = folder("fails");
    let model = WALK.replace("transition = [\"x\"]", "transition = [\"x + 0*sqrt(1e6 - x)\"]");
    let mut rows: Vec<String> = table(9000, 1).lines().map(str::to_owned).collect();
    rows[8000] = "8000,1e9".to_owned();
    folder.write("fails.toml", &model).write("bad.csv", &(rows.join("\n") + "\n"));
    for line in [
        "filter fails.toml bad.csv",
        "smooth fails.toml bad.csv --threads 1",
        "smooth fails.toml bad.csv --lag 3",
    ] {
        let whole = folder.run(&format!("{line} -o whole.csv --resume=0"));
        assert!(whole.code == 1 && whole.stderr.contains("8000 rows finished before"), "{}", whole.stderr);
        let words = format!("{line} -o out.csv --resume=0");
        let mut killed = 0;
        for wait in 1..60 {
            let mut child = folder.command(&words.split_whitespace().collect::<Vec<_>>()).spawn().unwrap();
            sleep(Duration::from_millis(wait));
            let ended = child.try_wait().unwrap().is_some();
            child.kill().unwrap();
            child.wait().unwrap();
            if ended {
                break;
            }
            killed += usize::from(folder.path("out.csv.checkpoint").exists());
        }
        assert!(killed > 0, "{line}");
        folder.run(&words);
        assert!(folder.read("out.csv") == folder.read("whole.csv"), "{line}");
        fs::remove_file(folder.path("out.csv")).unwrap();
    }
}

/// A run that was killed, and what it has left.
fn killed(folder: &Folder) -> Vec<u8> {
    folder.write("long.csv", &table(40_000, 1));
    let checkpoint = folder.path("out.csv.checkpoint");
    let mut child =
        folder.command(&["filter", "walk.toml", "long.csv", "--resume=0", "-o", "out.csv"]).spawn().unwrap();
    let begun = fs::read(&checkpoint).ok().map_or(0, |bytes| bytes.len());
    while child.try_wait().unwrap().is_none()
        && fs::read(&checkpoint).map_or(0, |bytes| bytes.len()) < begun + 600
    {
        sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!folder.path("out.csv").exists());
    fs::read(&checkpoint).unwrap()
}

#[test]
fn a_checkpoint_that_is_damaged_or_of_another_run_is_refused() {
    let folder = folder("refused");
    let bytes = killed(&folder);
    let path = folder.path("out.csv.checkpoint");
    let refused = |line: &str, words: &str| {
        let found = folder.run(&format!("{line} --resume -o out.csv"));
        assert!(found.code == 2 && found.stderr.contains(words), "{line}: {}", found.stderr);
    };
    for at in [3, 30, bytes.len() / 2, bytes.len() - 1] {
        let mut wrong = bytes.clone();
        wrong[at] ^= 1;
        fs::write(&path, wrong).unwrap();
        refused("filter walk.toml long.csv", "out.csv.checkpoint: ");
    }
    fs::write(&path, &bytes).unwrap();
    let other = |what: &str| {
        format!("out.csv.checkpoint: this is the checkpoint of another run: its {what} differs\n  help: ")
    };
    refused("filter walk.toml long.csv --method ekf", &other("method"));
    refused("smooth walk.toml long.csv", &other("task"));
    refused("filter walk.toml long.csv --format jsonl", &other("format"));
    folder.write("walk.toml", &WALK.replace("std = [2]", "std = [3]"));
    refused("filter walk.toml long.csv", &other("model file"));
    folder.write("walk.toml", WALK).write("long.csv", &table(39_999, 1));
    refused("filter walk.toml long.csv", &other("table of measurements"));
    // an output that another run has left in the place of its own
    folder.write("long.csv", &table(40_000, 1)).write("out.csv.partial", "time,x\n");
    refused(
        "filter walk.toml long.csv",
        "out.csv.partial is not what its checkpoint was made beside\n  help: remove",
    );
    // a run that would leave the checkpoint behind, and one of several tracks
    let plain = folder.run("filter walk.toml long.csv -o out.csv");
    assert!(plain.code == 2 && plain.stderr.contains("add --resume, or remove the file"), "{}", plain.stderr);
    folder.write("tracks.csv", &table(5, 3));
    refused("filter walk.toml tracks.csv", &other("table of measurements"));
    assert_eq!(folder.read("out.csv.partial"), "time,x\n");
    fs::remove_file(&path).unwrap();
    folder.run("filter walk.toml long.csv --resume -o out.csv").good();
}

#[test]
fn wrong_uses_are_told() {
    let folder = folder("wrong");
    folder.write("out.csv.checkpoint.new", "time,z\n");
    for (line, words) in [
        ("filter model.toml data.csv --resume", "--output"),
        ("filter model.toml data.csv --resume=-1 -o out.csv", "must be a number of seconds, zero or above"),
        ("filter model.toml data.csv --resume -o /dev/null", "-o /dev/null: it is no file"),
        ("smooth model.toml data.csv --resume -o out.csv --point 0", "cannot be used with"),
        ("filter model.toml data.csv --resume -o -", "-o -: standard output cannot be gone on with"),
        ("filter model.toml out.csv.checkpoint.new --resume -o out.csv", "this is the file of DATA too"),
        ("filter model.toml data.csv --resume -o out.csv --plot out.csv.checkpoint.svg", ""),
    ] {
        let found = folder.run(line);
        let good = words.is_empty();
        assert!((found.code == 2) != good && found.stderr.contains(words), "{line}: {}", found.stderr);
    }
    assert!(folder.files().iter().all(|name| !name.ends_with(".checkpoint") && name != "-"));
}

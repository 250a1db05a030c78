//! Where data come from and go to: files that appear whole, standard input, pipes, figures.

use super::common::{Folder, Run};
use super::{DATA, folder};
use std::io::{BufRead, BufReader, Read};
use std::process::Stdio;

#[test]
fn an_output_appears_whole_under_its_name() {
    let folder = folder("whole");
    let expected = folder.run("filter model.toml data.csv").good().stdout;
    folder.write("out.csv", "what was there before\n");
    std::fs::hard_link(folder.path("out.csv"), folder.path("old.csv")).unwrap();
    let found = folder.run("filter model.toml data.csv -o out.csv").good();
    assert_eq!((found.stdout.as_str(), folder.read("out.csv")), ("", expected));
    // the new file took the name; what had it before was not written over
    assert_eq!(folder.read("old.csv"), "what was there before\n");
    assert!(!folder.files().contains(&"out.csv.partial".to_owned()));
    // until then it is OUT.partial, which a folder of this name prevents
    std::fs::create_dir(folder.path("new.csv.partial")).unwrap();
    let found = folder.run("filter model.toml data.csv -o new.csv");
    assert!(found.code == 2 && found.stderr.contains("cannot write new.csv: "), "{}", found.stderr);
}

#[cfg(unix)]
#[test]
fn what_another_run_writes_is_left_alone() {
    let folder = folder("at-once");
    folder.write("few.csv", "time,z\n1,0.5\n2,0.1\n").write("out.csv.partial", "theirs");
    let theirs = std::fs::OpenOptions::new().write(true).open(folder.path("out.csv.partial")).unwrap();
    theirs.try_lock().unwrap();
    let refused = folder.run("filter walk.toml few.csv -o out.csv");
    assert_eq!(refused.code, 2, "{}", refused.stderr);
    assert!(refused.stderr.contains("cannot write out.csv: another run is writing it"), "{}", refused.stderr);
    assert!(folder.read("out.csv.partial") == "theirs" && !folder.path("out.csv").exists());
    // what a run that was killed has left is nobody's
    drop(theirs);
    folder.run("filter walk.toml few.csv -o out.csv").good();
    assert!(folder.read("out.csv").lines().count() == 3 && !folder.path("out.csv.partial").exists());
}

#[test]
fn links_are_followed_and_devices_stay_devices() {
    let folder = folder("links");
    let expected = folder.run("filter model.toml data.csv").good().stdout;
    folder.write("target.csv", "");
    std::os::unix::fs::symlink("target.csv", folder.path("link.csv")).unwrap();
    folder.run("filter model.toml data.csv -o link.csv").good();
    assert!(folder.path("link.csv").is_symlink());
    assert_eq!(folder.read("target.csv"), expected);
    folder.run("filter model.toml data.csv -o /dev/null").good();
    assert!(!std::path::Path::new("/dev/null").is_file());
    assert_eq!(folder.run("filter model.toml data.csv -o /dev/stdout").good().stdout, expected);
}

#[test]
fn a_dash_is_standard_input_and_standard_output() {
    let folder = folder("dash");
    let expected = folder.run("filter model.toml data.csv").good().stdout;
    assert_eq!(folder.run_with("filter model.toml - -o -", DATA).good().stdout, expected);
    assert_eq!(folder.run_with("filter - data.csv", super::MODEL).good().stdout, expected);
    let found = folder.run_with("filter model.toml -", &DATA.replace("49.5", "x"));
    assert!(found.stderr.contains("standard input:2:3: `x` in `range`"), "{}", found.stderr);
    assert!(!folder.files().contains(&"-".to_owned()));
}

/// Starts a run, reads a line of its output, and closes the pipe.
fn head(folder: &Folder, line: &str) -> Run {
    let args: Vec<&str> = line.split_whitespace().collect();
    let mut command = folder.command(&args);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut stdout = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut stdout).unwrap();
    let mut stderr = String::new();
    child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
    Run { code: child.wait().unwrap().code().unwrap_or(-1), stdout, stderr }
}

#[test]
fn a_reader_that_has_enough_is_no_error() {
    let folder = folder("head");
    // more than a pipe holds
    let rows: String = (0..5000).map(|k| format!("{k},{}\n", k % 7)).collect();
    folder.write("data.csv", &format!("time,z\n{rows}"));
    for line in [
        "filter walk.toml data.csv",
        "smooth walk.toml data.csv --format jsonl",
        "simulate walk.toml --steps 20000 --seed 1",
    ] {
        let found = head(&folder, line);
        assert_eq!(found.code, 0, "{line}: {}", found.stderr);
        assert!(!found.stderr.contains("error"), "{line}: {}", found.stderr);
        assert!(
            found.stdout.starts_with("time,") || found.stdout.starts_with("{\"time\":0.0,"),
            "{}",
            found.stdout
        );
    }
}

#[test]
fn an_unread_stderr_is_no_reason_to_stop() {
    let folder = folder("stderr");
    let mut command = folder.command(&["filter", "model.toml", "data.csv", "-o", "out.csv"]);
    let mut child = command.stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert_eq!(folder.read("out.csv").lines().count(), 6);
}

#[test]
fn figures_are_valid_svg_and_png() {
    let folder = folder("figures");
    for command in ["filter", "smooth"] {
        for (name, more) in
            [("a.svg", ""), ("b.png", ""), ("c.SVG", " --truth truth.csv"), ("d.png", " -o out.csv")]
        {
            folder.run(&format!("{command} model.toml data.csv --plot {name}{more}")).good();
            let path = folder.path(name);
            if name.ends_with("png") {
                let picture = tiny_skia::Pixmap::load_png(&path).unwrap();
                assert!(picture.width() > 300 && picture.height() > 300);
                assert!(picture.pixels().iter().any(|pixel| *pixel != picture.pixels()[0]));
            } else {
                let text = folder.read(name);
                let document = roxmltree::Document::parse(&text).unwrap();
                assert_eq!(document.root_element().tag_name().name(), "svg");
                assert!(text.contains("model"), "{name}");
            }
        }
    }
    assert!(folder.files().iter().all(|name| !name.ends_with(".partial")), "{:?}", folder.files());
}

#[test]
fn several_figures_are_drawn_each_in_its_file() {
    let folder = folder("figures");
    folder.run("filter model.toml data.csv --plot a.svg --plot b.png").good();
    assert!(folder.path("a.svg").is_file() && folder.path("b.png").is_file());
    let found = folder.run("filter model.toml data.csv --plot c.svg --plot ./c.svg");
    assert!(found.code == 2 && found.stderr.contains("this is the file of --plot too"), "{}", found.stderr);
}

#[test]
fn figures_of_odd_runs_are_drawn_too() {
    let folder = folder("odd_figures");
    folder.write("one.csv", "time,z\n1,2\n").write("blank.csv", "time,z\n1,\n");
    folder.write("tracks.csv", "time,track_id,z\n1,a,2\n1,b,\n2,a,\n");
    for data in ["one.csv", "blank.csv", "tracks.csv"] {
        let found = folder.run(&format!("smooth walk.toml {data} --plot a.svg --point 1")).good();
        assert!(found.stderr.contains("sr-ckf: "), "{}", found.stderr);
        roxmltree::Document::parse(&folder.read("a.svg")).unwrap();
    }
}

/// A row without measures asks for the same as `--at` does, and a linear model gives the same in one step or two.
#[test]
fn a_figure_goes_through_the_times_asked_for_as_through_rows() {
    let folder = folder("figure_at");
    folder.write("few.csv", "time,z\n1,2\n2,1\n4,3\n").write("more.csv", "time,z\n1,2\n2,1\n3,\n4,3\n");
    let drawn = |command: &str| {
        folder.run(&format!("{command} --plot a.svg")).good();
        folder.read("a.svg")
    };
    for command in ["filter", "smooth"] {
        let at = drawn(&format!("{command} walk.toml few.csv --at 2,3 -o out.csv"));
        assert_eq!(at, drawn(&format!("{command} walk.toml more.csv")), "{command}");
        assert_ne!(at, drawn(&format!("{command} walk.toml few.csv")), "{command}");
    }
}

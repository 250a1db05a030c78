//! What the command tells about itself and about models.

use super::common::Folder;
use super::common::models::OSCILLATOR;
use super::{WALK, folder};
use givens::registry::{ENTRIES, OPTIONS};

const COMMANDS: [&str; 8] =
    ["filter", "smooth", "simulate", "compare", "reproduce", "methods", "check", "completions"];

#[test]
fn methods_lists_every_row_of_the_registry() {
    let found = Folder::new("methods").run("methods").good();
    for entry in ENTRIES {
        let line =
            found.stdout.lines().find(|line| line.split_whitespace().next() == Some(entry.name)).unwrap();
        for words in [entry.rule.word(), entry.form.word(), entry.about] {
            assert!(line.contains(words), "{line}");
        }
        assert!(entry.aliases.iter().all(|alias| line.contains(alias)), "{line}");
        assert!(entry.sources.iter().all(|source| found.stdout.contains(source)));
    }
    for option in OPTIONS {
        assert!(found.stdout.contains(&format!("\n{} ", option.key)) && found.stdout.contains(option.about));
    }
    assert_eq!(found.stderr, "");
}

#[test]
fn check_tells_what_was_understood() {
    let folder = folder("check");
    let found = folder.run("check model.toml").good();
    let lines: Vec<String> =
        found.stdout.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    assert_eq!(
        lines,
        [
            "model.toml: a discrete-time model, 4 states, 4 measures",
            "time one transition per gap",
            "begins at 0",
            "state x: 30 ± 5",
            "state vx: 1 ± 1",
            "state y: 40 ± 5",
            "state vy: -2 ± 1",
            "parameter q = 0.1",
            "sensor radar: range, bearing (angle, period 6.283185307179586)",
            "sensor gps: px, py",
            "plane x across, y upwards",
            "method sr-ukf: rule unscented, alpha 1, beta 0, kappa 0, form square-root, update joint",
        ]
    );
}

#[test]
fn check_tells_steps_starts_controls_and_settings() {
    let folder = folder("check_more");
    let text = folder.run("check walk.toml --set update=separate").good().stdout;
    assert!(text.starts_with("walk.toml: a discrete-time model, 1 state, 1 measure\n"), "{text}");
    assert!(text.contains("steps of 1\n") && text.contains("form square-root, update separate\n"), "{text}");
    let text = folder.run("check model.toml --param q=7 --method qkf --set points=4").good().stdout;
    assert!(
        text.contains("q = 7\n") && text.contains("qkf: rule gauss-hermite, points 4, form covariance\n"),
        "{text}"
    );
    let start = super::WALK
        .replace("time = 0\nmean = [0]\nstd = [2]", "start = { x = \"z + u_a\" }")
        .replace("[[\"dt\"]]", "[[0]]");
    folder.write("walk.toml", &start);
    let text = folder.run("check walk.toml").good().stdout;
    for words in ["at the first row that `start` can read", "x: from `start`", "controls    u_a"] {
        assert!(text.contains(words), "{text}");
    }
    folder.write("walk.toml", &super::WALK.replace("time = 0", "time = 2026-03-01T12:00:00Z"));
    let text = folder.run("check walk.toml").good().stdout;
    assert!(text.contains("begins      at 2026-03-01T12:00:00Z\n"), "{text}");
}

#[test]
fn every_command_has_help_with_an_example() {
    let folder = Folder::new("help");
    let main = folder.run("--help").good().stdout;
    for command in COMMANDS {
        assert!(main.contains(&format!("\n  {command} ")), "{command}");
        let help = folder.run(&format!("{command} --help")).good().stdout;
        let example = help.lines().skip_while(|line| !line.starts_with("Example")).nth(1);
        assert!(example.is_some_and(|line| line.contains(&format!("givens {command}"))), "{help}");
    }
    assert!(main.contains("Exit codes: 0 done; 1 a filter failed"), "{main}");
    assert!(folder.run("--version").good().stdout.starts_with("givens 0."));
}

#[test]
fn nothing_at_all_shows_the_help_and_is_bad_input() {
    let found = Folder::new("nothing").run("");
    assert_eq!((found.code, found.stdout.as_str()), (2, ""));
    assert!(found.stderr.contains("Usage: givens <COMMAND>"), "{}", found.stderr);
}

#[test]
fn completions_are_written_for_each_shell() {
    let folder = Folder::new("completions");
    for shell in ["bash", "zsh", "fish"] {
        let script = folder.run(&format!("completions {shell}")).good().stdout;
        for word in COMMANDS.into_iter().chain(["method", "plot", "truth", "seed"]) {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    assert_eq!(folder.run("completions perl").code, 2);
}

#[test]
fn the_examples_of_the_help_run() {
    let folder = Folder::new("examples");
    folder.write("turn.toml", super::MODEL).write("swing.toml", OSCILLATOR);
    for command in ["simulate", "filter", "smooth", "compare", "check"] {
        let help = folder.run(&format!("{command} --help")).good().stdout;
        let examples = help.lines().skip_while(|line| !line.starts_with("Example")).skip(1);
        let mut count = 0;
        for example in examples {
            // no terminal breaks the line
            assert!(example.chars().count() <= 80, "{example}");
            // words after a gap explain, and the shell does the rest
            let line = example.trim().strip_prefix("givens ").unwrap().split("   ").next().unwrap();
            let (line, input) = match line.split_once(" < ") {
                Some((line, files)) => (line, folder.read(files.split(' ').next().unwrap())),
                None => (line, String::new()),
            };
            // this model has no step, which the example takes for granted
            let every = if line.contains("--steps") { " --every 1" } else { "" };
            folder.run_with(&format!("{line}{every}"), &input).good();
            count += 1;
        }
        assert!(count > 0, "{help}");
    }
}

#[test]
fn a_column_that_is_not_used_is_told_with_the_one_it_may_have_been_meant_for() {
    let folder = folder("near");
    folder.write("data.csv", "time,snesor,z,weight\n1,level,1,70\n").write("truth.csv", "time,x,xx\n1,1,2\n");
    let found = folder.run("filter walk.toml data.csv --truth truth.csv").good();
    assert!(found.stderr.contains("snesor (did you mean `sensor`?), weight\n"), "{}", found.stderr);
    // what the table has already is not suggested again
    assert!(found.stderr.contains("truth.csv: column not used by the model: xx\n"), "{}", found.stderr);
}

#[test]
fn an_angle_beyond_its_period_is_noted() {
    let folder = folder("degrees");
    folder.write("walk.toml", &WALK.replace("std = [1]\n", "std = [1]\nangles = [\"z\"]\n"));
    folder.write("data.csv", "time,z\n1,0.5\n2,300\n");
    let found = folder.run("filter walk.toml data.csv").good();
    let words = "data.csv: `z` has values such as 300, beyond 2π\n  help: if it is in degrees, write angles = { z = 360 }";
    assert!(found.stderr.contains(words), "{}", found.stderr);
    folder.write("data.csv", "time,z\n1,0.5\n2,-6.2\n");
    assert!(!folder.run("filter walk.toml data.csv").good().stderr.contains("degrees"));
}

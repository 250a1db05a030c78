//! Continuous models from end to end: simulated, filtered, smoothed, compared, checked, and their failures in words.

use super::common::Folder;
use super::common::models::OSCILLATOR;
use super::{column, folder, near};

/// A folder with the oscillator, data that it draws, and their truth.
fn drawn(name: &str) -> Folder {
    let folder = folder(name);
    folder.write("model.toml", OSCILLATOR);
    folder.run("simulate model.toml --until 6 --every 0.3 --seed 4 -o data.csv --states truth.csv").good();
    folder
}

#[test]
fn every_question_of_a_continuous_model_is_answered() {
    let folder = drawn("all");
    let filtered = folder.run("filter model.toml data.csv --truth truth.csv").good();
    assert!(filtered.stderr.starts_with("sr-cd-ckf: 20 rows, log-likelihood"), "{}", filtered.stderr);
    let cells = filtered.cells();
    let std = column(&cells, "x_std");
    let smoothed = folder.run("smooth model.toml data.csv").good().cells();
    for (row, (filtered, smoothed)) in std.iter().zip(column(&smoothed, "x_std")).enumerate() {
        assert!(smoothed <= filtered * (1.0 + 1e-12), "row {row}");
    }
    // no lag is the filter; the longest is the whole interval
    assert_eq!(folder.run("smooth model.toml data.csv --lag 0").good().cells(), cells);
    let longest = folder.run("smooth model.toml data.csv --lag 99").good().cells();
    for name in ["x", "v", "x_std", "v_std"] {
        assert!(
            column(&longest, name).iter().zip(column(&smoothed, name)).all(|(a, b)| near(*a, b)),
            "{name}"
        );
    }
    let point = folder.run("smooth model.toml data.csv --point 3").good().cells();
    assert_eq!(column(&point, "x").len(), 11);
    let methods = "cd-ekf,acd-ekf,cd-ukf,cd-ckf,cd-ckf2,cd-ghkf2,sr-cd-ukf1,lskf";
    let table =
        folder.run(&format!("compare model.toml data.csv --methods {methods} --truth truth.csv")).good();
    for name in methods.split(',') {
        let line = table.stdout.lines().find(|line| line.split_whitespace().next() == Some(name)).unwrap();
        assert!(line.contains(" 20 ") && line.contains(" 0 "), "{line}");
    }
}

#[test]
fn options_of_the_time_update_change_the_numbers_and_their_limits_agree() {
    let folder = drawn("options");
    let likelihood = |more: &str| {
        let cells = folder.run(&format!("filter model.toml data.csv {more}")).good().cells();
        column(&cells, "log_likelihood").iter().sum::<f64>()
    };
    let exact = likelihood("--method sr-cd-ckf2 --set rtol=1e-10");
    for other in [
        "--method cd-ckf2",
        "--method sr-cd-ckf2 --set solver=rodas4",
        "--method sr-cd-ckf2 --set solver=rk4 --set substeps=64",
        "--method sr-cd-ckf2 --set solver=rk4 --set max_step=0.01",
        "--method sr-cd-ckf2 --set max_step=0.05",
        "--method lskf --set gauge=triangular",
        "--method sr-ckf --set time_update=moment-ode",
    ] {
        assert!((likelihood(other) - exact).abs() < 1e-4, "{other}");
    }
    for coarse in
        ["--set substeps=4", "--set time_update=euler-maruyama --set substeps=4", "--set variant=noise-once"]
    {
        assert!((likelihood(coarse) - exact).abs() > 1e-4, "{coarse}");
    }
    let text = folder.run("check model.toml --method lskf --set velocity=averaged").good().stdout;
    assert!(text.starts_with("model.toml: a continuous-time model, 2 states, 1 measure\n"), "{text}");
    let parts = "lskf: rule cubature3, form square-root, update joint, time update level-set, velocity averaged, gauge \
                 free, root lower, solver dp5, rtol 1e-6, atol 0\n";
    assert!(text.contains(parts), "{text}");
    let text = folder.run("check model.toml --set max_step=0.1").good().stdout;
    assert!(text.contains("time update ito-taylor, variant simplified, max step 0.1\n"), "{text}");
}

#[test]
fn a_method_of_the_command_line_drops_what_the_file_set_for_another() {
    let folder = drawn("dropped");
    let filter =
        "[filter]\nmethod = \"cd-ckf2\"\ntime_update = \"moment-ode\"\nsolver = \"rk4\"\nsubsteps = 32\n";
    folder.write("model.toml", &format!("{OSCILLATOR}{filter}"));
    folder.run("filter model.toml data.csv -o out.csv").good();
    let found = folder.run("filter model.toml data.csv -o out.csv --method sr-cd-ckf").good();
    for key in ["time_update", "solver"] {
        let words = format!("`{key}` of [filter] does not go with sr-cd-ckf: left out");
        assert!(found.stderr.contains(&words), "{}", found.stderr);
    }
    let found = folder.run("filter model.toml data.csv -o out.csv --method acd-ekf").good();
    for key in ["solver", "substeps"] {
        let words = format!("`{key}` of [filter] does not go with acd-ekf: left out");
        assert!(found.stderr.contains(&words), "{}", found.stderr);
    }
}

#[test]
fn failures_on_the_way_say_where_why_and_the_way_out() {
    let folder = drawn("failures");
    let stiff = OSCILLATOR.replace("mu = 2", "mu = 1e5").replace("mean = [1, 0]", "mean = [0.3, -0.7]");
    let known = OSCILLATOR.replace("std = [0.3, 0.3]", "std = [0.3, 0]");
    let root = OSCILLATOR.replace("mu*(1 - x^2)*v - x", "sqrt(x) - 2");
    folder.write("stiff.toml", &stiff).write("known.toml", &known).write("root.toml", &root);
    folder.write("late.csv", "time,z\n1,0.2\n");
    for (line, words) in [
        (
            "filter stiff.toml late.csv --method sr-cd-ckf2",
            &[
                "late.csv:2: t = 0.",
                "the solver came no further than this time in its 100000 steps, the smallest of ",
                "likely stiff: --set solver=rodas4",
                "set out from x = ",
            ][..],
        ),
        (
            "filter known.toml data.csv --method sr-cd-ckf2",
            &["factor of the covariance is singular at pivot 2 (state `v`)", "--set time_update=ito-taylor"],
        ),
        (
            "filter known.toml data.csv --method lskf",
            &["factor of the covariance is singular at pivot 2 (state `v`)", "--set time_update=ito-taylor"],
        ),
        (
            "filter root.toml data.csv --method sr-cd-ckf2",
            &[
                "data.csv:",
                ": t = ",
                "the drift of `v` is not a finite number; look for",
                "the root of a negative number",
                "the step set out from x = ",
                "v = ",
            ],
        ),
        (
            "filter root.toml data.csv",
            &["the drift of ", "derivative of it in the expansion", "set out from x = "],
        ),
        (
            "simulate root.toml --until 9 --every 1 --seed 1",
            &["the simulation failed: the drift of `v` is not a finite number"],
        ),
    ] {
        let found = folder.run(line);
        assert_eq!(found.code, 1, "{line}: {}", found.stderr);
        for words in words {
            assert!(found.stderr.contains(words), "{line}: {}", found.stderr);
        }
    }
    folder.run("filter known.toml data.csv --method sr-cd-ckf").good();
    folder.run("filter stiff.toml late.csv --method sr-cd-ckf2 --set solver=rodas4").good();
    for method in ["sr-cd-ckf2", "lskf"] {
        folder
            .run(&format!("filter known.toml data.csv --method {method} --set time_update=ito-taylor"))
            .good();
    }
}

#[test]
fn simulated_paths_depend_on_seed_and_steps_and_a_diffusion_of_the_state_is_followed_by_euler_maruyama() {
    let folder = drawn("paths");
    let draw = |more: &str| folder.run(&format!("simulate model.toml --until 3 --every 1 {more}")).good();
    let first = draw("--seed 1");
    assert_eq!(first.stdout, draw("--seed 1").stdout);
    assert_eq!(first.stdout, draw("--seed 1 --scheme ito-taylor --substeps 16").stdout);
    for other in
        ["--seed 2", "--seed 1 --substeps 8", "--seed 1 --max-step 0.1", "--seed 1 --scheme euler-maruyama"]
    {
        assert_ne!(first.stdout, draw(other).stdout, "{other}");
    }
    assert_eq!(first.stderr, "");
    folder.write("model.toml", &OSCILLATOR.replace("\"0.2\"", "\"0.2*x\""));
    let found = draw("--seed 1");
    assert_eq!(found.stderr, "the diffusion depends on the state: the path is followed by euler-maruyama\n");
    folder.run("filter model.toml data.csv --method sr-cd-ckf2 -o out.csv").good();
}

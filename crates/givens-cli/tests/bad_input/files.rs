//! Outputs that cannot be written, wrong times, and simulations that cannot be drawn.

use super::common::Folder;
use super::{DATA, MODEL, NONE, check, folder};

#[test]
fn wrong_outputs() {
    check(
        "outputs",
        &[
            (
                "missing_folder",
                NONE,
                "filter model.toml data.csv -o no/out.csv",
                &["cannot write no/out.csv: ", "make its folder first"],
            ),
            (
                "plot_missing_folder",
                NONE,
                "filter model.toml data.csv -o out.csv --plot no/a.svg",
                &["cannot write no/a.svg: ", "make its folder first"],
            ),
            ("folder", NONE, "filter model.toml data.csv -o ..", &["cannot write ..: it is a folder"]),
            (
                "under_a_file",
                NONE,
                "filter model.toml data.csv -o data.csv/out.csv",
                &["cannot write data.csv/out.csv: "],
            ),
            (
                "input",
                NONE,
                "filter model.toml data.csv -o ./data.csv",
                &["-o ./data.csv: this is the file of DATA too", "choose another name"],
            ),
            (
                "twice",
                NONE,
                "simulate model.toml --every 1 --steps 3 --seed 1 -o a.csv --states ./a.csv",
                &["--states ./a.csv: this is the file of -o too"],
            ),
            (
                "arrow",
                NONE,
                "filter model.toml data.csv -o out.arrow",
                &["-o out.arrow: this version does not write .arrow", "--format csv"],
            ),
            (
                "plot",
                NONE,
                "filter model.toml data.csv -o out.csv --plot a.pdf",
                &["--plot a.pdf: the name must end in .svg or .png"],
            ),
            (
                "plot_bare",
                NONE,
                "filter model.toml data.csv -o out.csv --plot svg",
                &["--plot svg: the name must end in .svg or .png"],
            ),
        ],
    );
}

#[test]
fn wrong_times_of_smoothers() {
    check(
        "smoothers",
        &[
            (
                "both",
                NONE,
                "smooth model.toml data.csv -o out.csv --lag 2 --point 2",
                &["'--lag <ROWS>' cannot be used with '--point <T>'"],
            ),
            (
                "between",
                NONE,
                "smooth model.toml data.csv -o out.csv --point 2.4",
                &[
                    "--point 2.4: neither a row nor the initial belief stands at this time",
                    "the nearest row is at 2",
                ],
            ),
            (
                "negative_lag",
                NONE,
                "smooth model.toml data.csv -o out.csv --lag -1",
                &["invalid value '-1' for '--lag <ROWS>'", "zero or above"],
            ),
            (
                "lag_word",
                NONE,
                "smooth model.toml data.csv -o out.csv --lag 1.5",
                &["invalid value '1.5' for '--lag <ROWS>'", "whole number"],
            ),
            (
                "point_word",
                NONE,
                "smooth model.toml data.csv -o out.csv --point noon",
                &["--point: `noon` is not a time in seconds"],
            ),
            (
                "lag_of_filter",
                NONE,
                "filter model.toml data.csv -o out.csv --lag 1",
                &["--lag is an option of `smooth`", "givens smooth MODEL DATA --lag ROWS"],
            ),
        ],
    );
}

#[test]
fn wrong_simulations() {
    const M: &str = "model.toml";
    const STEPS: &str = "simulate model.toml --every 1 --steps 3 --seed 1 -o out.csv";
    check(
        "simulations",
        &[
            (
                "no_length",
                NONE,
                "simulate walk.toml --seed 1 -o out.csv",
                &["how long to simulate is not said", "--until T, --steps N or --times DATA"],
            ),
            ("no_seed", NONE, "simulate walk.toml --steps 3", &["--seed <S>"]),
            (
                "no_distance",
                NONE,
                "simulate model.toml --steps 3 --seed 1",
                &["the model has no step", "--every DT"],
            ),
            (
                "part_of_a_step",
                NONE,
                "simulate walk.toml --steps 3 --every 0.5 --seed 1",
                &["--every 0.5: this is not a whole number of the model's steps", "one step is 1"],
            ),
            (
                "no_step",
                NONE,
                "simulate walk.toml --steps 3 --every 1e-9 --seed 1",
                &["not a whole number of the model's steps"],
            ),
            (
                "negative",
                NONE,
                "simulate walk.toml --steps 3 --every -1 --seed 1",
                &["--every -1: the time between rows must be above zero"],
            ),
            (
                "negative_steps",
                NONE,
                "simulate walk.toml --steps -3 --seed 1",
                &["invalid value '-3' for '--steps <N>'", "zero or above"],
            ),
            (
                "zero_steps",
                NONE,
                "simulate walk.toml --steps 0 --seed 1",
                &["--steps 0: draw at least one row"],
            ),
            (
                "zero_runs",
                NONE,
                "simulate walk.toml --steps 3 --runs 0 --seed 1",
                &["invalid value '0' for '--runs <N>'", "above zero"],
            ),
            (
                "negative_seed",
                NONE,
                "simulate walk.toml --steps 3 --seed -1",
                &["invalid value '-1' for '--seed <S>'"],
            ),
            (
                "early",
                NONE,
                "simulate walk.toml --until -2 --seed 1",
                &["--until -2: no row lies so early", "the first row stands at 1"],
            ),
            (
                "endless",
                NONE,
                "simulate walk.toml --steps 99999999999 --seed 1",
                &["99999999999 rows, more than 10000000"],
            ),
            (
                "two_lengths",
                NONE,
                "simulate walk.toml --steps 3 --until 3 --seed 1",
                &["cannot be used with"],
            ),
            (
                "controls",
                (M, "vx = \"vx\"", "vx = \"vx + u_a\""),
                STEPS,
                &["model.toml: the model has controls: u_a", "--times DATA"],
            ),
            (
                "start",
                (
                    M,
                    "time = 0.0\nmean = [30, 1, 40, -2]\nstd = [5, 1, 5, 1]",
                    "start = { x = \"px\", y = \"py\" }\nmean = { vx = 0, vy = 0 }\nstd = { vx = 1, vy = 1 }",
                ),
                STEPS,
                &["`start` finds states from measurements, of which there are none yet"],
            ),
        ],
    );
}

#[test]
fn a_folder_that_may_not_be_written_is_told() {
    let folder = Folder::new("read_only");
    folder.write("model.toml", MODEL).write("data.csv", DATA);
    let locked = folder.path("locked");
    std::fs::create_dir(&locked).unwrap();
    let may_write = std::fs::metadata(&locked).unwrap().permissions();
    let mut may_not = may_write.clone();
    may_not.set_readonly(true);
    std::fs::set_permissions(&locked, may_not).unwrap();
    // the superuser may write anywhere
    let superuser = std::fs::write(locked.join("probe"), "").is_ok();
    let found = folder.run("filter model.toml data.csv -o locked/out.csv");
    std::fs::set_permissions(&locked, may_write).unwrap();
    if !superuser {
        assert_eq!(found.code, 2);
        assert!(found.stderr.contains("choose a folder that you may write to"), "{}", found.stderr);
    }
}

#[test]
fn a_table_that_times_a_simulation_with_tracks_has_no_runs() {
    let folder = folder("runs", &NONE);
    folder.write("times.csv", "time,track_id\n1,a\n1,b\n");
    let found = folder.run("simulate model.toml --times times.csv --runs 2 --seed 1 -o out.csv");
    assert_eq!((found.code, found.stdout.as_str()), (2, ""));
    assert!(
        found.stderr.contains("--runs 2: the table of --times has tracks of its own"),
        "{}",
        found.stderr
    );
}

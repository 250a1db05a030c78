//! `givens reproduce` on a small experiment.

use super::common::Folder;
use std::fs;

const TABLE: &str = "arasaratnam2011smoothers/table-4-armse.csv";

#[test]
fn the_same_numbers_for_any_number_of_threads() {
    let folder = Folder::new("threads");
    let csv = |threads: &str| {
        let args =
            ["reproduce", "arasaratnam2011smoothers", "--only", "table-4", "--runs", "7", "-o", threads];
        let run = folder.command(&args).env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        folder.read(&format!("{threads}/{TABLE}"))
    };
    let one = csv("1");
    assert_eq!(one, csv("3"));
    assert_eq!(one.lines().count(), 16, "five estimators of three states");
}

#[test]
fn a_page_has_its_tables_and_figures_and_an_index() {
    let folder = Folder::new("pages");
    let line = "reproduce arasaratnam2011smoothers --runs 3 --seed 5 -o pages";
    let run = folder.run(line).good();
    assert_eq!(run.stdout, "");
    assert!(run.stderr.contains("arasaratnam2011smoothers table-4: 17 claims, "), "{}", run.stderr);
    let page = folder.read("pages/arasaratnam2011smoothers/figures-1-3.md");
    assert!(page.contains("`givens reproduce arasaratnam2011smoothers --runs 3 --seed 5`"), "{page}");
    // what the page points to is there
    let links: Vec<&str> = page.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    assert!(links.len() > 1, "{page}");
    for link in links {
        assert!(folder.path(&format!("pages/arasaratnam2011smoothers/{link}")).is_file(), "{link}");
    }
    let png = fs::read(folder.path("pages/arasaratnam2011smoothers/figures-1-3-rmse.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG"));
    assert!(folder.read("pages/index.md").contains("(arasaratnam2011smoothers/table-4.md)"));
}

#[test]
fn without_a_folder_the_claims_go_to_standard_output() {
    let folder = Folder::new("stdout");
    let run = folder.run("reproduce arasaratnam2011smoothers --only table-4 --runs 3").good();
    assert!(run.stdout.contains("| CKF position, m | 23.15 | "), "{}", run.stdout);
    assert!(folder.files().is_empty());
}

#[test]
fn runs_of_what_draws_nothing_are_said_to_make_no_difference() {
    let folder = Folder::new("nothing_drawn");
    let run = folder.run("reproduce arasaratnam2010continuous --only table-5 --runs 3").good();
    assert!(run.stderr.contains("table-5: nothing is drawn, --runs makes no difference\n"), "{}", run.stderr);
}

#[test]
fn a_folder_that_cannot_be_written_is_known_before_the_work() {
    let folder = Folder::new("unwritable");
    fs::create_dir_all(folder.path("pages/index.md")).unwrap();
    let run = folder.run("reproduce arasaratnam2011smoothers --only table-4 -o pages");
    assert_eq!((run.code, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("cannot write pages/index.md: it is a folder"), "{}", run.stderr);
    assert!(!run.stderr.contains("claims"), "{}", run.stderr);
}

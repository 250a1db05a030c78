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
    assert!(
        page.contains("`givens reproduce arasaratnam2011smoothers --only figures-1-3 --runs 3 --seed 5`"),
        "{page}"
    );
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

/// The cells of a line of CSV.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut quoted) = (vec![String::new()], false);
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            _ => cells.last_mut().unwrap().push(c),
        }
    }
    cells
}

#[test]
fn every_table_has_as_many_names_as_columns() {
    let folder = Folder::new("headers");
    for line in [
        "reproduce arasaratnam2011smoothers --runs 2 -o pages",
        "reproduce arasaratnam2009cubature --only figure-8 --runs 2 -o pages",
        "reproduce arasaratnam2009cubature --only halts --runs 2 -o pages",
        "reproduce wang2021levelset --only figure-5 --runs 2 -o pages",
    ] {
        folder.run(line).good();
    }
    let mut tables = 0;
    for key in ["arasaratnam2011smoothers", "arasaratnam2009cubature", "wang2021levelset"] {
        for entry in fs::read_dir(folder.path(&format!("pages/{key}"))).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|ending| ending == "csv") {
                let text = fs::read_to_string(&path).unwrap();
                let names = cells(text.lines().next().unwrap());
                for name in &names {
                    assert_eq!(names.iter().filter(|other| *other == name).count(), 1, "{names:?}");
                }
                let widths: Vec<usize> = text.lines().map(|line| cells(line).len()).collect();
                assert!(widths.iter().all(|&width| width == names.len()), "{}: {widths:?}", path.display());
                tables += 1;
            }
        }
    }
    assert_eq!(tables, 6);
}

#[test]
fn of_one_run_or_two_nothing_is_concluded_and_no_page_says_nan() {
    let folder = Folder::new("few");
    for runs in ["1", "2"] {
        for only in ["arasaratnam2011smoothers", "arasaratnam2009cubature --only figure-10"] {
            let run = folder.run(&format!("reproduce {only} --runs {runs} --seed 5")).good();
            assert!(!run.stdout.contains("NaN") && !run.stdout.contains("inf"), "{}", run.stdout);
            let judged =
                ["differs", "does not hold", "within ("].map(|word| run.stdout.matches(word).count());
            // the legend has the first two once
            assert_eq!(judged, [1, 1, 0], "{}", run.stdout);
            assert!(
                run.stdout.contains("undecided: fewer than 10 runs to tell a spread from"),
                "{}",
                run.stdout
            );
        }
    }
}

#[test]
fn more_runs_than_memory_holds_are_refused_before_the_work() {
    let folder = Folder::new("huge");
    for only in ["arasaratnam2010continuous --only table-4", "arasaratnam2011smoothers", "all"] {
        let run = folder.run(&format!("reproduce {only} --runs 4294967295 -o pages"));
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{}", run.stderr);
        assert!(run.stderr.contains("--runs 4294967295: "), "{}", run.stderr);
        assert!(run.stderr.contains(" at most\n"), "{}", run.stderr);
        assert!(folder.files().is_empty());
    }
}

#[test]
fn several_processes_share_a_folder_and_none_loses_its_work() {
    let folder = Folder::new("shared");
    let start = |seed: &str| {
        let args = ["reproduce", "arasaratnam2011smoothers", "--runs", "20", "--seed", seed, "-o", "both"];
        folder.command(&args).stderr(std::process::Stdio::piped()).spawn().unwrap()
    };
    let children: Vec<_> = ["1", "2", "3", "4"].map(start).into();
    for child in children {
        let done = child.wait_with_output().unwrap();
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    }
    let index = folder.read("both/index.md");
    assert!(index.contains("arasaratnam2011smoothers/table-4.md") && index.contains("| CKF position, m |"));
    let left = fs::read_dir(folder.path("both/arasaratnam2011smoothers")).unwrap();
    let left: Vec<_> = left.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    assert!(!left.iter().any(|name| name.contains("partial")), "{left:?}");
}

#[test]
fn the_index_keeps_the_pages_of_earlier_calls_each_with_its_own_command() {
    let folder = Folder::new("turns");
    folder.run("reproduce arasaratnam2011smoothers --only table-4 --runs 3 -o turn").good();
    folder.run("reproduce wang2021levelset --only figure-1 --seed 2 -o turn").good();
    let index = folder.read("turn/index.md");
    for wanted in [
        "Made by `givens reproduce arasaratnam2011smoothers --only table-4 --runs 3 --seed 1`.",
        "Made by `givens reproduce wang2021levelset --only figure-1 --seed 2`.",
        "(arasaratnam2011smoothers/table-4.md)",
        "(wang2021levelset/figure-1.md)",
        "| CKF position, m | 23.15 |",
    ] {
        assert!(index.contains(wanted), "{wanted}: {index}");
    }
}

#[test]
fn a_folder_that_is_none_is_known_before_the_work() {
    let folder = Folder::new("no_folder");
    let run = folder.run("reproduce arasaratnam2011smoothers --only table-4 -o -");
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("pages go to a folder"), "{}", run.stderr);
    fs::create_dir(folder.path("pages")).unwrap();
    folder.write("pages/arasaratnam2011smoothers", "a file");
    let run = folder.run("reproduce arasaratnam2011smoothers --only table-4 -o pages");
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("cannot write pages/arasaratnam2011smoothers"), "{}", run.stderr);
    assert!(!run.stderr.contains("claims"), "{}", run.stderr);
}

#[test]
fn an_unknown_experiment_lists_each_name_once() {
    let run = Folder::new("unknown").run("reproduce all --only zzz");
    assert_eq!(run.code, 2);
    assert_eq!(run.stderr.matches("table-1,").count(), 1, "{}", run.stderr);
}

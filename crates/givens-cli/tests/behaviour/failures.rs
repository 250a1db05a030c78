//! Tracks that fail leave the others alone, and what was finished is written.

use super::common::models::WALK;
use super::folder;

/// A walk that ends above 20, where its transition is no number.
fn model() -> String {
    WALK.replace("transition = [\"x\"]", "transition = [\"x + 0*sqrt(20 - x)\"]")
        + "[filter]\nmethod = \"ekf\"\n"
}

const DATA: &str = "time,track_id,z
1,a,1
1,b,2
2,a,2
2,b,100
3,b,3
3,a,3
4,b,4
4,a,4
";

#[test]
fn one_track_that_fails_leaves_the_others() {
    let folder = folder("one_fails");
    folder.write("walk.toml", &model()).write("data.csv", DATA);
    let found = folder.run("filter walk.toml data.csv -o out.csv");
    assert_eq!((found.code, found.stdout.as_str()), (1, ""));
    let words = "data.csv:6: track b, t = 3, step 3: the filter failed: the transition of `x` is not a finite number; \
                 look for a division by zero, the root of a negative number, or an estimate that runs away\n  the step set out from x = 65.294\n  2 rows of track b finished before";
    assert!(found.stderr.contains(words), "{}", found.stderr);
    let cells = super::common::cells(&folder.read("out.csv"));
    let keys: Vec<String> = cells[1..].iter().map(|row| row[..2].join("")).collect();
    assert_eq!(keys, ["1a", "1b", "2a", "2b", "3a", "4a"]);
    // track a is as it is alone
    let of_a: String =
        DATA.lines().filter(|line| !line.contains(",b,")).map(|line| format!("{line}\n")).collect();
    folder.write("a.csv", &of_a);
    let alone = folder.run("filter walk.toml a.csv").good().cells();
    let of_a: Vec<&Vec<String>> = cells[1..].iter().filter(|row| row[1] == "a").collect();
    assert_eq!(of_a, alone[1..].iter().collect::<Vec<_>>());
}

#[test]
fn a_smoother_that_fails_smooths_the_rows_before_among_themselves() {
    smoothed_before_a_failure("interval", "");
    smoothed_before_a_failure("point", "--point 1");
}

#[test]
fn a_lag_that_fails_smooths_the_rows_before_among_themselves() {
    smoothed_before_a_failure("lag", "--lag 1");
}

fn smoothed_before_a_failure(name: &str, how: &str) {
    let folder = folder(name);
    let data = "time,z\n1,1\n2,5\n3,100\n4,1\n";
    folder.write("walk.toml", &model()).write("data.csv", data).write("less.csv", &data.replace("4,1\n", ""));
    let found = folder.run(&format!("smooth walk.toml data.csv {how}"));
    assert_eq!(found.code, 1);
    assert!(found.stderr.contains("data.csv:5: t = 4, step 4: the smoother failed: "), "{}", found.stderr);
    assert!(found.stderr.contains("\n  3 rows finished before"), "{}", found.stderr);
    let less = folder.run(&format!("smooth walk.toml less.csv {how}")).good();
    assert_eq!(found.stdout, less.stdout, "{how}");
}

#[test]
fn a_failure_in_the_first_row_writes_the_header_alone() {
    let folder = folder("first_row");
    folder
        .write("walk.toml", &model().replace("mean = [0]", "mean = [30]"))
        .write("data.csv", "time,z\n1,1\n");
    let found = folder.run("filter walk.toml data.csv");
    assert_eq!((found.code, found.stdout.as_str()), (1, "time,x,x_std,nis,nis_dof,log_likelihood\n"));
    assert!(found.stderr.contains("ekf: no row was finished\n"), "{}", found.stderr);
    assert!(found.stderr.contains("\n  no row finished before"), "{}", found.stderr);
}

#[test]
fn a_missing_measure_does_not_shift_the_name_of_a_failing_one() {
    let folder = folder("names");
    let model = WALK.replace(
        "measures = { z = \"x\" }\nstd = [1]",
        "measures = { a = \"x\", b = \"x\", c = \"x\" }\nstd = [1, 0, 0]",
    );
    folder.write("walk.toml", &model).write("data.csv", "time,a,b,c\n1,,2,2\n");
    let found = folder.run("filter walk.toml data.csv --method ckf");
    assert_eq!(found.code, 1);
    assert!(
        found.stderr.contains("(measure `c`)") && found.stderr.contains("std above zero"),
        "{}",
        found.stderr
    );
    assert!(found.stderr.contains("the innovation covariance is singular at pivot 3"), "{}", found.stderr);
}

#[test]
fn compare_names_the_failures_of_each_method() {
    let folder = folder("earlier");
    folder.write("walk.toml", &model()).write("data.csv", DATA);
    let found = folder.run("compare walk.toml data.csv --methods ekf,ckf");
    assert_eq!(found.code, 1);
    let failed: Vec<&str> = found.stderr.lines().filter(|line| line.contains("the filter failed")).collect();
    assert_eq!(failed.len(), 2, "{}", found.stderr);
    assert!(failed[0].starts_with("error: ekf: data.csv:6: track b, t = 3"), "{}", failed[0]);
    let table = found.stdout.lines().nth(1).unwrap();
    assert_eq!(table.split_whitespace().take(3).collect::<Vec<_>>(), ["ekf", "6", "1"]);
}

#[test]
fn a_derivative_that_does_not_exist_is_told_with_a_method_that_needs_none() {
    let folder = folder("derivative");
    folder.write("walk.toml", &WALK.replace("z = \"x\"", "z = \"hypot(x, 0)\""));
    folder.write("data.csv", "time,z\n0,1\n");
    let found = folder.run("filter walk.toml data.csv --method ekf");
    assert_eq!(found.code, 1);
    let words = "the derivative of the predicted measure `z`, with respect to the state at the mean, is not a finite number; use \
                 a method without derivatives (--method sr-ckf)";
    assert!(found.stderr.contains(words), "{}", found.stderr);
}

#[test]
fn a_huge_number_is_written_with_an_exponent() {
    let folder = folder("huge");
    folder.write("data.csv", "time,z\n1,1e12\n");
    let found = folder.run("filter walk.toml data.csv").good();
    assert!(found.stderr.contains("mean NIS 1.667e23 per") && found.stderr.len() < 300, "{}", found.stderr);
}

#[test]
fn an_innovation_too_large_to_be_squared_names_its_measure() {
    let folder = folder("squared");
    folder.write("walk.toml", WALK).write("data.csv", "time,z\n1,1\n2,1e200\n");
    let found = folder.run("filter walk.toml data.csv");
    assert_eq!(found.code, 1);
    let words = "data.csv:3: t = 2, step 2: the filter failed: the innovation of `z`, in its standard deviations, is too \
                 large to be squared; look for a wrong unit";
    assert!(found.stderr.contains(words), "{}", found.stderr);
}

#[test]
fn points_of_a_small_alpha_that_coincide_are_to_be_set_further() {
    let folder = folder("alpha");
    folder.write("walk.toml", WALK).write("data.csv", "time,z\n1,1e6\n2,1e6\n3,1e6\n");
    let found = folder.run("filter walk.toml data.csv --method sr-ukf --set alpha=1e-7");
    assert_eq!(found.code, 1);
    assert!(
        found.stderr.contains("set the points further from the mean (--set alpha=1), or measure"),
        "{}",
        found.stderr
    );
}

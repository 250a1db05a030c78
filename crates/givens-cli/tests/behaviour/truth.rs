//! Estimates against a truth, with numbers worked out by hand.

use super::folder;

// P⁻ = 4 + 1 = 5, S = 6, K = 5/6: x = 5, P = 5/6; then P⁻ = 11/6, S = 17/6, K = 11/17: x = 5 + 11 = 16, P = 11/17.
const DATA: &str = "time,z\n1,6\n2,22\n";

#[test]
fn errors_and_coverage_are_those_of_the_hand() {
    let folder = folder("hand");
    folder.write("data.csv", DATA).write("truth.csv", "time,x\n0,1\n1,4\n1.5,9\n2,13\n");
    let found = folder.run("filter walk.toml data.csv --truth truth.csv").good();
    // errors 1 and 3 with 2σ of 1.83 and 1.61; NEES 6/5 and 9·17/11
    let words: Vec<Vec<&str>> = found.stderr.lines().map(|line| line.split_whitespace().collect()).collect();
    assert!(words.contains(&vec!["state", "RMSE", "within", "2σ", "rows"]), "{}", found.stderr);
    assert!(words.contains(&vec!["x", "2.2361", "50.0", "%", "2"]), "{}", found.stderr);
    assert!(
        found.stderr.contains("mean NEES 7.555 of 1.0 states known, 7.555 per state"),
        "{}",
        found.stderr
    );
}

#[test]
fn a_truth_at_no_row_is_refused_with_both_spans() {
    let folder = folder("elsewhere");
    folder.write("data.csv", DATA).write("truth.csv", "time,x\n1.5,9\n7,9\n");
    for command in ["filter walk.toml data.csv -o out.csv", "compare walk.toml data.csv --methods ckf"] {
        let found = folder.run(&format!("{command} --truth truth.csv"));
        assert_eq!((found.code, found.stdout.as_str()), (2, ""));
        let words = "truth.csv: no time of the truth is that of a row of the data\n  help: the truth goes from 1.5 to 7, the \
                     data from 1 to 2\n";
        assert!(found.stderr.contains(words), "{}", found.stderr);
    }
    assert!(!folder.files().contains(&"out.csv".to_owned()));
    // times of the calendar are told as such
    folder
        .write("data.csv", "time,z\n2026-03-01T00:00:00Z,1\n")
        .write("truth.csv", "time,x\n2026-03-02T00:00:00Z,9\n");
    let found = folder.run("filter walk.toml data.csv --truth truth.csv");
    assert!(found.stderr.contains("to 2026-03-02T00:00:00Z, the data from 2026-03-0"), "{}", found.stderr);
    // a fixed point needs the truth at its own time
    folder.write("data.csv", DATA).write("truth.csv", "time,x\n2,9\n");
    let found = folder.run("smooth walk.toml data.csv --point 1 --truth truth.csv");
    assert!(found.code == 2 && found.stderr.contains("--point 1: the truth has no row"), "{}", found.stderr);
}

#[test]
fn a_truth_may_know_some_states_at_some_rows() {
    let folder = folder("some");
    let found = folder.run("filter model.toml data.csv --truth truth.csv").good();
    let compared: Vec<&str> = found.stderr.lines().filter(|line| line.ends_with(" 3")).collect();
    assert_eq!(compared.len(), 2, "{}", found.stderr);
    assert!(found.stderr.contains("of 2.0 states known"), "{}", found.stderr);
}

#[test]
fn tracks_are_compared_each_with_its_own_truth() {
    let folder = folder("tracks");
    folder.write("data.csv", "time,track_id,z\n1,a,6\n1,b,6\n2,a,22\n2,b,22\n");
    folder.write("truth.csv", "time,track_id,x\n1,b,6\n2,b,17\n1,a,4\n2,a,13\n");
    let found = folder.run("filter walk.toml data.csv --truth truth.csv").good();
    // errors 1, 3 and −1, −1
    assert!(found.stderr.contains(&format!("{:.4}", 3_f64.sqrt())), "{}", found.stderr);
}

#[test]
fn a_fixed_point_is_compared_with_the_truth_at_its_time() {
    let folder = folder("point");
    folder.write("data.csv", DATA).write("truth.csv", "time,x\n1,4\n2,1000\n");
    let found = folder.run("smooth walk.toml data.csv --point 1 --truth truth.csv").good();
    // G = (5/6)/(11/6) = 5/11: x₁ = 5, then 5 + 5/11 · 11 = 10; errors 1 and 6
    assert!(found.stderr.contains(&format!("{:.4}", 18.5_f64.sqrt())), "{}", found.stderr);
}

//! Fixed interval, fixed lag, fixed point.

use super::common::{Folder, numbers};
use super::{DATA, folder};
use serde_json::Value;

/// The largest difference of the named numbers of two rows.
fn difference(a: &Value, b: &Value, keys: [&str; 2]) -> f64 {
    let pairs = numbers(&a[keys[0]]).into_iter().zip(numbers(&b[keys[1]]));
    pairs.map(|(a, b)| (a - b).abs() / b.abs().max(1.0)).fold(0.0, f64::max)
}

fn objects(folder: &Folder, line: &str) -> Vec<Value> {
    folder.run(&format!("{line} --format jsonl")).good().objects()
}

/// The first rows of the data as a file of their own.
fn first(folder: &Folder, rows: usize) -> String {
    let name = format!("first{rows}.csv");
    folder.write(&name, &DATA.lines().take(rows + 1).map(|line| format!("{line}\n")).collect::<String>());
    name
}

#[test]
fn filtered_values_do_not_change_when_smoothing() {
    let folder = folder("unchanged");
    let method = |form: &str| format!("model.toml data.csv --set form={form}");
    for form in ["covariance", "square-root"] {
        let filter = objects(&folder, &format!("filter {}", method(form)));
        for how in ["", "--lag 2", "--point 0"] {
            let smooth = objects(&folder, &format!("smooth {} {how}", method(form)));
            for (a, b) in smooth.iter().zip(&filter) {
                for (smoothed, own) in [("filtered_mean", "mean"), ("filtered_cov", "cov")] {
                    assert!(difference(a, b, [smoothed, own]) < 1e-13, "{form} {how} {smoothed}");
                }
                for key in
                    ["predicted_mean", "predicted_cov", "innovation", "innovation_cov", "log_likelihood"]
                {
                    assert!(difference(a, b, [key, key]) < 1e-13, "{form} {how} {key}");
                }
            }
        }
    }
}

#[test]
fn a_lag_smooths_each_row_with_the_next_ones() {
    let folder = folder("lag");
    let filter = objects(&folder, "filter model.toml data.csv");
    for (row, same) in objects(&folder, "smooth model.toml data.csv --lag 0").iter().zip(&filter) {
        assert_eq!((&row["mean"], &row["cov"]), (&same["mean"], &same["cov"]));
    }
    let interval = objects(&folder, "smooth model.toml data.csv");
    for (row, same) in objects(&folder, "smooth model.toml data.csv --lag 100").iter().zip(&interval) {
        assert!(
            difference(row, same, ["mean", "mean"]) < 1e-12 && difference(row, same, ["cov", "cov"]) < 1e-12
        );
    }
    let lag = objects(&folder, "smooth model.toml data.csv --lag 2");
    for (k, row) in lag.iter().enumerate() {
        let given = objects(&folder, &format!("smooth model.toml {}", first(&folder, (k + 3).min(5))));
        assert!(difference(row, &given[k], ["mean", "mean"]) < 1e-12, "row {k}");
    }
}

#[test]
fn a_point_is_one_state_better_known_with_every_row() {
    let folder = folder("point");
    let point = objects(&folder, "smooth model.toml data.csv --point 2");
    let times: Vec<f64> = point.iter().map(|row| row["time"].as_f64().unwrap()).collect();
    assert_eq!(times, [2.0, 3.0, 4.0, 5.0]);
    for (k, row) in point.iter().enumerate() {
        let given = objects(&folder, &format!("smooth model.toml {}", first(&folder, k + 2)));
        assert!(difference(row, &given[1], ["mean", "mean"]) < 1e-12, "row {k}");
        assert!(difference(row, &given[1], ["cov", "cov"]) < 1e-12, "row {k}");
    }
    // the filtered belief is the row's own
    let filter = objects(&folder, "filter model.toml data.csv");
    assert!(difference(&point[3], &filter[4], ["filtered_mean", "mean"]) < 1e-13);
}

#[test]
fn a_point_may_be_the_initial_belief() {
    let folder = folder("initial");
    let point = objects(&folder, "smooth model.toml data.csv --point 0");
    assert_eq!(point.len(), 5);
    folder.write("blank.csv", &DATA.replace("\n1,", "\n0,,,,\n1,"));
    let interval = objects(&folder, "smooth model.toml blank.csv");
    assert!(difference(&point[4], &interval[0], ["mean", "mean"]) < 1e-12);
    assert!(difference(&point[4], &interval[0], ["cov", "cov"]) < 1e-12);
}

//! The scenarios `cv` and `ct` of discrete.json: with a blank row at time 0, which gives the state at k = 0.

use super::common::{Folder, golden, golden_json, numbers};
use super::compare::Expected;
use super::{FORMS, arguments, run, set};
use serde_json::Value;

/// The filters of the file, by their registry names and settings.
const FILTERS: [(&str, &str, &[&str]); 7] = [
    ("EKF", "ekf", &[]),
    ("UKF", "ukf", &[]),
    ("CDKF", "cdkf", &[]),
    ("QKF", "qkf", &[]),
    ("CKF", "ckf", &[]),
    ("CKF5", "ckf5", &[]),
    ("UKF_a05_b2_k0", "ukf", &["alpha=0.5", "beta=2", "kappa=0"]),
];

struct Scenario {
    name: &'static str,
    golden: Value,
    folder: Folder,
    tolerance: f64,
}

impl Scenario {
    fn read(name: &'static str, tolerance: f64) -> Self {
        let golden = golden_json("discrete.json")["scenarios"][name].take();
        let data = std::fs::read_to_string(golden_data(name)).unwrap();
        let (header, rows) = data.split_once('\n').unwrap();
        let commas = ",".repeat(header.matches(',').count());
        let folder = Folder::new(name);
        folder.write("data.csv", &format!("{header}\n0,{}\n{rows}", &commas[1..]));
        Self { name, golden, folder, tolerance }
    }

    fn run(&self, command: &str, more: &[String]) -> Vec<Value> {
        run(&self.folder, &arguments(command, self.name, "data.csv", more)).good().objects()
    }

    /// Rows `at`, `at` + 1, … against one series of the file.
    fn compare(&self, what: &str, series: &Value, at: usize, found: &[Value], keys: [&str; 2]) {
        let means = series["mean"].as_array().unwrap();
        assert_eq!(found.len(), means.len() + at, "{what}");
        for (k, mean) in means.iter().enumerate() {
            let row = &found[k + at];
            let diagonal = Expected::diagonal(&numbers(mean), &numbers(&series["var"][k]));
            let error = diagonal.error(&row[keys[0]], &row[keys[1]]);
            assert!(error < self.tolerance, "{what} {k}: {error:e}");
        }
        for (k, cov) in series["cov"].as_object().unwrap() {
            let k: usize = k.parse().unwrap();
            let row = &found[k + at];
            let error = Expected::full(&means[k], cov).error(&row[keys[0]], &row[keys[1]]);
            assert!(error < self.tolerance, "{what} covariance {k}: {error:e}");
        }
    }

    fn check(&self) {
        for (golden, method, options) in FILTERS {
            let golden_filter = &self.golden["filters"][golden];
            for (prefix, form) in ["", "sr-", "sr-"].into_iter().zip(FORMS) {
                if golden_filter.is_null() {
                    continue;
                }
                // the form is the name's; only the update is set
                let settings = options.iter().chain(form.iter().skip(1)).map(|setting| (*setting).to_owned());
                let mut more = vec!["--method".to_owned(), format!("{prefix}{method}")];
                more.extend(set(settings));
                let what = |part: &str| format!("{} {more:?} {part}", self.name);
                let with = |extra: [&str; 2]| -> Vec<String> {
                    more.iter().cloned().chain(extra.map(str::to_owned)).collect()
                };
                let smooth = self.run("smooth", &more);
                let filter = self.run("filter", &more);
                let series = |name: &str| &golden_filter[name];
                self.compare(&what("filtered"), series("filt"), 0, &filter, ["mean", "cov"]);
                self.compare(
                    &what("filtered"),
                    series("filt"),
                    0,
                    &smooth,
                    ["filtered_mean", "filtered_cov"],
                );
                self.compare(
                    &what("predicted"),
                    series("pred"),
                    1,
                    &smooth,
                    ["predicted_mean", "predicted_cov"],
                );
                self.compare(&what("smoothed"), series("smooth"), 0, &smooth, ["mean", "cov"]);
                let lag = self.run("smooth", &with(["--lag", "5"]));
                self.compare(&what("lag 5"), series("lag5"), 0, &lag, ["mean", "cov"]);
                let point = self.run("smooth", &with(["--point", "5"]));
                self.compare(&what("point 5"), series("point5"), 0, &point, ["mean", "cov"]);
                let total: f64 = filter.iter().map(|row| row["log_likelihood"].as_f64().unwrap()).sum();
                let error = (total - golden_filter["loglik"].as_f64().unwrap()).abs();
                assert!(error < 1e-9, "{}: {error:e}", what("log-likelihood"));
            }
        }
    }
}

fn golden_data(name: &str) -> std::path::PathBuf {
    golden().join(name).join("data.csv")
}

#[test]
fn cv() {
    Scenario::read("cv", 1e-11).check();
}

#[test]
fn ct() {
    Scenario::read("ct", 1e-10).check();
}

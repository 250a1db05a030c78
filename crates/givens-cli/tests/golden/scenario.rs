//! A folder of tests/golden: model, data, and what the oracle expects.

use super::common::{Folder, Run, golden, golden_json};
use super::compare::{Expected, number_error};
use super::{FORMS, arguments, run, set};
use core::fmt::Write;
use serde_json::Value;

/// A scenario, and what was found wrong with it.
pub struct Scenario {
    name: &'static str,
    expected: Value,
    folder: Folder,
    wrong: String,
}

/// One filter of a scenario in one form.
struct Case<'a> {
    golden: &'a Value,
    title: String,
    settings: Vec<String>,
    tolerance: f64,
    /// That of the smoothers.
    smoothed: f64,
    square_root: bool,
}

impl Scenario {
    pub fn read(name: &'static str) -> Self {
        let expected = golden_json(&format!("{name}/expected.json"));
        Self { name, expected, folder: Folder::new(name), wrong: String::new() }
    }

    pub fn check(mut self) {
        let filters = self.expected["filters"].take();
        for (name, golden) in filters.as_object().unwrap() {
            for form in FORMS {
                let options = golden["options"].as_object().unwrap().iter();
                let options =
                    options.map(|(key, value)| format!("{key}={}", value.to_string().trim_matches('"')));
                let settings = set(form.iter().map(|part| (*part).to_owned()).chain(options));
                let title = format!("{name} {form:?}");
                // its weights are of the order of 1e6
                let tolerance = if name == "unscented_small" { 1e-6 } else { 1e-10 };
                let square_root = form[0] == "form=square-root";
                // P⁻ is nearly singular at the end, and the covariance form subtracts from it
                let smoothed = match self.name {
                    "reentry" if !square_root => 1e-7,
                    "contracting" if !square_root => 2e-2,
                    _ => tolerance,
                };
                self.case(&Case { golden, title, settings, tolerance, smoothed, square_root });
            }
        }
        assert!(self.wrong.is_empty(), "\n{}", self.wrong);
    }

    fn case(&mut self, case: &Case) {
        let fails_back = case.square_root && !case.golden["conditional_fails"].is_null();
        let filter = self.run(case, "filter", &[]);
        self.rows(case, &filter, ["mean", "cov"]);
        if !case.golden["failed"].is_null() {
            self.failure(case, &filter);
            let smooth = self.run(case, "smooth", &[]);
            self.failure(case, &smooth);
            self.rows(case, &smooth, ["filtered_mean", "filtered_cov"]);
        } else if fails_back {
            let smooth = self.run(case, "smooth", &[]);
            self.require(smooth.code == 1, &case.title, &format!("smooth: exit {}", smooth.code));
        } else {
            self.smoothers(case);
        }
    }

    fn smoothers(&mut self, case: &Case) {
        let interval = self.run(case, "smooth", &[]);
        self.rows(case, &interval, ["filtered_mean", "filtered_cov"]);
        self.series(case, &interval, "smoothed", &case.golden["smoothed_mean"], &case.golden["smoothed_cov"]);
        let start = self.start_time();
        let point = self.run(case, "smooth", &["--point", &start]);
        let last: Vec<Value> = point.objects().pop().into_iter().collect();
        let (mean, cov) = (&case.golden["start_mean"], &case.golden["start_cov"]);
        self.compare(case, "start", &last, core::slice::from_ref(mean), core::slice::from_ref(cov));
        if !case.golden["lag5"].is_null() {
            let lag = self.run(case, "smooth", &["--lag", "5"]);
            self.series(case, &lag, "lag 5", &case.golden["lag5"]["mean"], &case.golden["lag5"]["cov"]);
            let fifth = self.expected["rows"][4]["time"].to_string();
            let point = self.run(case, "smooth", &["--point", &fifth]);
            let series = &case.golden["point5"];
            self.series(case, &point, "point 5", &series["mean"], &series["cov"]);
        }
    }

    fn run(&self, case: &Case, command: &str, more: &[&str]) -> Run {
        let data = golden().join(self.name).join("data.csv");
        let mut more: Vec<String> = more.iter().map(|arg| (*arg).to_owned()).collect();
        more.extend_from_slice(&case.settings);
        run(&self.folder, &arguments(command, self.name, data.to_str().unwrap(), &more))
    }

    /// `[state] time` of the model file.
    fn start_time(&self) -> String {
        let text = std::fs::read_to_string(golden().join(self.name).join("model.toml")).unwrap();
        let line = text.lines().find(|line| line.starts_with("time")).unwrap();
        line.split('=').nth(1).unwrap().trim().to_owned()
    }

    fn require(&mut self, good: bool, title: &str, what: &str) {
        if !good {
            writeln!(self.wrong, "{title}: {what}").unwrap();
        }
    }

    /// What filter and smoother tell alike; `filtered` names the keys of the filtered belief.
    fn rows(&mut self, case: &Case, found: &Run, filtered: [&str; 2]) {
        let golden = case.golden;
        let objects = found.objects();
        let count = golden["filtered_mean"].as_array().unwrap().len();
        self.require(objects.len() == count, &case.title, &format!("{} rows of {count}", objects.len()));
        if golden["failed"].is_null() {
            self.require(found.code == 0, &case.title, &format!("exit {}: {}", found.code, found.stderr));
        }
        for (k, row) in objects.iter().enumerate().take(count) {
            let expected = self.expected["rows"][k].clone();
            let belief = |name: &str| {
                Expected::of(&golden[format!("{name}_mean")][k], &golden[format!("{name}_cov")][k])
            };
            let innovation = Expected::of(&golden["innovation"][k], &golden["innovation_cov"][k]);
            for (what, error) in [
                ("predicted", belief("predicted").error(&row["predicted_mean"], &row["predicted_cov"])),
                ("filtered", belief("filtered").error(&row[filtered[0]], &row[filtered[1]])),
                ("innovation", innovation.error(&row["innovation"], &row["innovation_cov"])),
                ("nis", number_error(&row["nis"], &golden["nis"][k])),
                ("log-likelihood", number_error(&row["log_likelihood"], &golden["log_likelihood"][k])),
            ] {
                self.require(error < case.tolerance, &case.title, &format!("row {k} {what}: {error:e}"));
            }
            for key in ["time", "sensor", "measures"] {
                self.require(row[key] == expected[key], &case.title, &format!("row {k} {key}: {}", row[key]));
            }
            let dof = expected["measures"].as_array().unwrap().len();
            self.require(row["nis_dof"] == dof, &case.title, &format!("row {k} dof: {}", row["nis_dof"]));
        }
    }

    fn series(&mut self, case: &Case, found: &Run, what: &str, mean: &Value, cov: &Value) {
        self.require(found.code == 0, &case.title, &format!("{what}: exit {}: {}", found.code, found.stderr));
        self.compare(case, what, &found.objects(), mean.as_array().unwrap(), cov.as_array().unwrap());
    }

    fn compare(&mut self, case: &Case, what: &str, found: &[Value], mean: &[Value], cov: &[Value]) {
        self.require(
            found.len() == mean.len(),
            &case.title,
            &format!("{what}: {} rows of {}", found.len(), mean.len()),
        );
        for (k, row) in found.iter().enumerate().take(mean.len()) {
            let error = Expected::of(&mean[k], &cov[k]).error(&row["mean"], &row["cov"]);
            self.require(error < case.smoothed, &case.title, &format!("{what} {k}: {error:e}"));
        }
    }

    /// A run that stops: exit code, and the words that name the place.
    fn failure(&mut self, case: &Case, found: &Run) {
        let failed = &case.golden["failed"];
        let matrix = failed["matrix"].as_str().unwrap();
        let line = failed["row"].as_u64().unwrap() + 2;
        self.require(found.code == 1, &case.title, &format!("exit {}", found.code));
        let matrix = format!("the {matrix} is not positive definite at pivot ");
        for words in [
            format!("data.csv:{line}: "),
            format!("t = {}", failed["time"].as_f64().unwrap()),
            "step ".into(),
            matrix,
        ] {
            let told = found.stderr.contains(&words);
            self.require(told, &case.title, &format!("stderr does not say `{words}`:\n{}", found.stderr));
        }
    }
}

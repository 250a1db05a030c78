//! A scenario of `golden`: a model, its data, and what the oracle makes of them.

use crate::{cov_error, golden, lower, mean_error, numbers};
use givens::filter::{Fault, Gaussian, Matrix, StepError};
use givens::registry::{Choice, FormName, Setting, Value as Word, resolve};
use givens::{Estimates, Failure, Goal, Outcome, Row};
use givens_io::{Model, read_tracks};
use serde_json::Value;
use std::path::PathBuf;

/// Model and data as the command reads them, and the expected answers.
pub struct Scenario {
    /// The folder.
    pub name: String,
    /// `model.toml`.
    pub model: Model,
    /// `data.csv`.
    pub rows: Vec<givens_io::Row>,
    /// When the prior holds.
    pub start: f64,
    /// The initial belief.
    pub prior: Gaussian,
    /// `expected.json`.
    pub expected: Value,
}

/// How a rule is computed: in covariance form, or in square-root form with one of its measurement updates.
pub const ROADS: [(&str, &[(&str, &str)]); 3] = [
    ("covariance", &[("form", "covariance")]),
    ("joint", &[("form", "square-root"), ("update", "joint")]),
    ("separate", &[("form", "square-root"), ("update", "separate")]),
];

/// The rule of `expected.json` with α = 0.001.
pub const SMALL: &str = "unscented_small";

/// The largest errors of a run, in standard deviations; see `golden/README.md`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reached {
    /// Predicted means and covariances.
    pub predicted: f64,
    /// Innovations and their covariances.
    pub innovation: f64,
    /// NIS and log-likelihoods, |Δ| / max(1, |value|).
    pub scores: f64,
    /// Filtered means and covariances.
    pub filtered: f64,
    /// Fixed interval, fixed lag and fixed point.
    pub smoothed: f64,
}

impl Reached {
    /// The largest of all but the smoothers'.
    #[must_use]
    pub fn filter(&self) -> f64 {
        self.predicted.max(self.innovation).max(self.scores).max(self.filtered)
    }

    /// The larger of both in every column.
    #[must_use]
    pub fn worse(self, other: Self) -> Self {
        Self {
            predicted: self.predicted.max(other.predicted),
            innovation: self.innovation.max(other.innovation),
            scores: self.scores.max(other.scores),
            filtered: self.filtered.max(other.filtered),
            smoothed: self.smoothed.max(other.smoothed),
        }
    }
}

impl Scenario {
    /// Reads the folder of this name.
    #[must_use]
    pub fn read(name: &str) -> Self {
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("golden").join(name);
        let path = |file: &str| folder.join(file).to_str().unwrap().to_owned();
        let model = Model::read(&path("model.toml")).unwrap();
        let mut tracks = read_tracks(&path("data.csv"), &model).unwrap().tracks;
        assert_eq!(tracks.len(), 1, "{name}: one track");
        let track = tracks.remove(0);
        let mean: Vec<f64> = model.prior.mean.iter().map(|m| m.unwrap()).collect();
        let prior = Gaussian::from_cov(&mean, &model.prior.cov).unwrap();
        let expected = golden(&format!("{name}/expected.json"));
        Self {
            name: name.to_owned(),
            model,
            rows: track.rows.read(0..usize::MAX).unwrap().into_owned(),
            start: track.start,
            prior,
            expected,
        }
    }

    /// The rules with expected values.
    pub fn rules(&self) -> impl Iterator<Item = &String> {
        self.expected["filters"].as_object().unwrap().keys()
    }

    /// The method for a rule of the scenario, as the registry resolves it.
    #[must_use]
    pub fn choose(&self, rule: &str, road: &[(&str, &str)]) -> Choice {
        let options = self.expected["filters"][rule]["options"].as_object().unwrap();
        let parts = road.iter().map(|&(key, word)| Setting { key: key.into(), value: word.into() });
        let options = options.iter().map(|(key, value)| {
            let value = value.as_str().map_or_else(|| Word::Number(value.as_f64().unwrap()), Word::from);
            Setting { key: key.clone(), value }
        });
        resolve("ckf", &parts.chain(options).collect::<Vec<_>>()).unwrap()
    }

    /// Runs over `rows`.
    pub fn run<'a>(
        &self,
        choice: &Choice,
        rows: impl Iterator<Item = Row<'a>> + Clone,
        goal: Goal,
    ) -> Outcome {
        let transition = self.model.dynamics.discrete().expect("the scenarios are discrete");
        choice.run(transition, &self.model.observation, rows, self.start, &self.prior, goal, &[])
    }

    /// The rows of the data.
    pub fn data(&self) -> impl Iterator<Item = Row<'_>> + Clone {
        self.rows.iter().map(|row| Row { time: row.time, z: &row.z, u: &row.u })
    }

    /// The errors of one rule on one road, over all goals.
    ///
    /// # Errors
    /// In words, if a run fails where it should not, or does not where it should.
    pub fn reached(&self, rule: &str, road: &[(&str, &str)]) -> Result<Reached, String> {
        let golden = &self.expected["filters"][rule];
        let choice = self.choose(rule, road);
        let what = format!("{} {rule} {road:?}", self.name);
        let mut reached = Reached::default();
        let failed = golden["failed"].as_object();
        let failure = failed.map(|of| words(&of["row"], &of["time"], of["matrix"].as_str().unwrap()));
        let outcome = self.run(&choice, self.data(), Goal::Filter);
        agree(&what, failure.as_ref(), outcome.failure)?;
        self.forward(golden, &outcome.estimates, &mut reached);
        // a smoother in square-root form needs the root of one more matrix
        let conditional = golden["conditional_fails"].as_object();
        match conditional.filter(|_| choice.form == FormName::SquareRoot) {
            Some(of) => {
                let failure = words(&of["row"], &of["time"], Matrix::Conditional.name());
                agree(&what, Some(&failure), self.run(&choice, self.data(), Goal::Interval).failure)?;
            }
            None if failure.is_none() => {
                let done = self.backward(golden, &choice, &mut reached);
                done.map_err(|error| format!("{what}: {error}"))?;
            }
            None => {}
        }
        Ok(reached)
    }

    /// What the filter learns, row by row.
    fn forward(&self, golden: &Value, est: &Estimates, reached: &mut Reached) {
        let rows = golden["filtered_mean"].as_array().unwrap().len();
        assert_eq!(est.len(), rows, "{}: rows", self.name);
        for k in 0..rows {
            let of = |part: &str| &golden[part][k];
            let compare = |mean: &str, cov: &str, m: &[f64], p: &[f64]| {
                let (mean, cov) = (numbers(of(mean)), lower(&numbers(of(cov))));
                mean_error(m, &mean, &cov).max(cov_error(p, &cov, mean.len()))
            };
            let predicted =
                compare("predicted_mean", "predicted_cov", est.predicted_mean(k), est.predicted_cov(k));
            reached.predicted = reached.predicted.max(predicted);
            let filtered =
                compare("filtered_mean", "filtered_cov", est.filtered_mean(k), est.filtered_cov(k));
            reached.filtered = reached.filtered.max(filtered);
            let there = |x: &&f64| !x.is_nan();
            let nu: Vec<f64> = est.innovation(k).iter().filter(there).copied().collect();
            let s: Vec<f64> = est.innovation_cov(k).iter().filter(there).copied().collect();
            assert_eq!(nu.len(), numbers(of("innovation")).len(), "{}: measures of row {k}", self.name);
            reached.innovation = reached.innovation.max(compare("innovation", "innovation_cov", &nu, &s));
            let (nis, log_likelihood) = (of("nis").as_f64(), of("log_likelihood").as_f64().unwrap());
            let score = |x: f64, y: f64| (x - y).abs() / y.abs().max(1.0);
            reached.scores = reached.scores.max(score(est.log_likelihood[k], log_likelihood));
            match nis {
                Some(nis) => reached.scores = reached.scores.max(score(est.nis[k], nis)),
                None => assert!(est.nis[k].is_nan() && est.log_likelihood[k] == 0.0),
            }
        }
    }

    /// What the smoothers learn. A row without measures at the time of the prior shows the smoothed prior.
    fn backward(&self, golden: &Value, choice: &Choice, reached: &mut Reached) -> Result<(), Failure> {
        let done = |rows: Vec<Row>, goal| self.run(choice, rows.iter().copied(), goal).into_result();
        let nothing = vec![f64::NAN; self.model.measures()];
        let first = Row { time: self.start, z: &nothing, u: &self.rows[0].u };
        let from_start = done([first].into_iter().chain(self.data()).collect(), Goal::Interval)?;
        let mut compare = |mean: &Value, cov: &Value, est: &Estimates, row: usize| {
            let (mean, cov) = (numbers(mean), lower(&numbers(cov)));
            let error = mean_error(est.mean(row), &mean, &cov).max(cov_error(est.cov(row), &cov, mean.len()));
            reached.smoothed = reached.smoothed.max(error);
        };
        compare(&golden["start_mean"], &golden["start_cov"], &from_start, 0);
        let all = done(self.data().collect(), Goal::Interval)?;
        for row in 0..all.len() {
            compare(&golden["smoothed_mean"][row], &golden["smoothed_cov"][row], &all, row);
        }
        let goals = [("lag5", Goal::Lag(5)), ("point5", Goal::Point(self.rows[4.min(all.len() - 1)].time))];
        for (part, goal) in goals {
            let golden = &golden[part];
            let Some(means) = golden["mean"].as_array() else { continue };
            let est = done(self.data().collect(), goal)?;
            assert_eq!(est.len(), means.len(), "{} {part}", self.name);
            for row in 0..est.len() {
                compare(&golden["mean"][row], &golden["cov"][row], &est, row);
            }
        }
        Ok(())
    }
}

fn words(row: &Value, time: &Value, matrix: &str) -> String {
    format!("row {row}, t = {time}: {matrix}")
}

/// The run must have failed as expected, or not at all.
fn agree(what: &str, expected: Option<&String>, failure: Option<(usize, StepError)>) -> Result<(), String> {
    let found = failure.map(|(row, error)| match error.fault {
        Fault::NotPositive { matrix, .. } => words(&row.into(), &error.time.into(), matrix.name()),
        other => other.to_string(),
    });
    if expected == found.as_ref() {
        return Ok(());
    }
    Err(format!("{what}: expected {expected:?}, found {found:?}"))
}

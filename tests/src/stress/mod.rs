//! The ladders of `golden/stress.json`: linear problems that grow harder rung by rung, with their answers in sixty digits.

mod doubts;
mod judge;
mod methods;
mod model;
mod peers;
mod table;

pub use judge::{Answered, Asks, Verdict, judge};
pub use methods::{Tried, asks, every_method, named_methods};
pub use model::{Sight, Stage};
pub use peers::{Peer, read_peers};
pub use table::{Column, cell, table};

use crate::{golden, lower, numbers};
use givens::registry::Precision;
use nalgebra::DMatrix;
use serde_json::Value;

/// A mean and a covariance, row by row.
pub type Moments = (Vec<f64>, Vec<f64>);

/// What a filter should find, and what the rounding of its numbers alone may cost.
pub struct Answer {
    /// The largest change of the answer, in standard deviations, when every number moves by half a spacing.
    pub cost: f64,
    /// The same when the points of a rule, and what the model says at them, move too.
    pub points: f64,
    /// After each row; of a long run after the last.
    pub rows: Vec<Moments>,
}

/// dx = A x dt + G dβ.
pub struct Flow {
    /// A.
    pub a: DMatrix<f64>,
    /// G.
    pub g: DMatrix<f64>,
}

/// One problem of a ladder.
pub struct Rung {
    /// How hard it is.
    pub d: f64,
    /// The belief at time 0.
    pub prior: Moments,
    /// When the rows are measured.
    pub times: Vec<f64>,
    /// F and Q before each row; one for all, or one a row.
    pub steps: Vec<(DMatrix<f64>, DMatrix<f64>)>,
    /// H.
    pub h: DMatrix<f64>,
    /// R.
    pub r: DMatrix<f64>,
    /// The measurements, row by row.
    pub z: Vec<Vec<f64>>,
    /// How often the one row is run.
    pub repeat: Option<usize>,
    /// The period of the measures, if they are angles.
    pub period: Option<f64>,
    /// The continuous model of which the steps are the exact solution.
    pub flow: Option<Flow>,
    /// Whether it is a problem of continuous methods alone.
    pub continuous: bool,
    /// In `f64`, in `f32`; none where the numbers do not determine it.
    answers: [Option<Answer>; 2],
}

impl Rung {
    /// The answer for the numbers as this precision holds them.
    #[must_use]
    pub fn answer(&self, precision: Precision) -> Option<&Answer> {
        self.answers[usize::from(precision == Precision::F32)].as_ref()
    }
}

/// A family of problems.
pub struct Case {
    /// Its name in the file.
    pub name: String,
    /// What d is.
    pub about: String,
    /// From easy to hard.
    pub rungs: Vec<Rung>,
}

/// All cases.
#[must_use]
pub fn cases() -> Vec<Case> {
    let file = golden("stress.json");
    let case = |(name, of): (&String, &Value)| Case {
        name: name.clone(),
        about: of["about"].as_str().unwrap().to_owned(),
        rungs: of["rungs"].as_array().unwrap().iter().map(rung).collect(),
    };
    file.as_object().unwrap().iter().map(case).collect()
}

/// The case of this name.
#[must_use]
pub fn case(name: &str) -> Case {
    cases().into_iter().find(|case| case.name == name).unwrap_or_else(|| panic!("no case {name}"))
}

fn matrix(rows: &Value) -> DMatrix<f64> {
    let rows = rows.as_array().unwrap();
    DMatrix::from_row_iterator(rows.len(), rows[0].as_array().unwrap().len(), rows.iter().flat_map(numbers))
}

fn rung(of: &Value) -> Rung {
    let answer = |precision: &str| {
        let of = of.get(precision)?;
        let row = |row: &Value| (numbers(&row["mean"]), lower(&numbers(&row["cov"])));
        let rows = of["rows"].as_array().unwrap().iter().map(row).collect();
        Some(Answer { cost: of["cost"].as_f64().unwrap(), points: of["points"].as_f64().unwrap(), rows })
    };
    let steps = of["steps"].as_array().unwrap().iter();
    Rung {
        d: of["d"].as_f64().unwrap(),
        prior: (numbers(&of["mean"]), numbers(&of["cov"])),
        times: numbers(&of["times"]),
        steps: steps.map(|step| (matrix(&step["f"]), matrix(&step["q"]))).collect(),
        h: matrix(&of["h"]),
        r: matrix(&of["r"]),
        z: of["z"].as_array().unwrap().iter().map(numbers).collect(),
        repeat: of.get("repeat").map(|count| count.as_u64().unwrap() as usize),
        period: of.get("period").and_then(Value::as_f64),
        flow: of.get("a").map(|a| Flow { a: matrix(a), g: matrix(&of["g"]) }),
        continuous: of.get("only").is_some(),
        answers: [answer("f64"), answer("f32")],
    }
}

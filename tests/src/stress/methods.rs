//! givens' methods on a rung.

use super::{Answered, Asks, Rung, Sight, Stage};
use crate::choices::{choices, continuous_choices};
use givens::filter::{Gaussian, StepError};
use givens::registry::{AnyFilter, Choice, ENTRIES, FormName, Kind, Precision, RuleName, Setting, resolve};

/// A method by a name that tells its options.
pub type Tried = (String, Choice);

/// How a method asks the model.
#[must_use]
pub fn asks(choice: &Choice) -> Asks {
    if choice.rule == RuleName::Taylor { Asks::Slopes } else { Asks::Points }
}

/// Every method that serves the rung, with every option that makes a difference.
#[must_use]
pub fn every_method(rung: &Rung, precision: Precision) -> Vec<Tried> {
    let n = rung.prior.0.len();
    let mut all = if rung.continuous { Vec::new() } else { choices(n) };
    if rung.flow.is_some() {
        all.extend(continuous_choices(n));
        all.extend(stiff_solvers());
    }
    in_precision(all, precision)
}

/// Every name of the registry that serves the rung, as it is used without options; of the square-root forms with both updates.
#[must_use]
pub fn named_methods(rung: &Rung, precision: Precision) -> Vec<Tried> {
    let mut all = Vec::new();
    for entry in ENTRIES {
        let serves = match entry.kind() {
            Kind::Discrete => !rung.continuous,
            Kind::Continuous => rung.flow.is_some(),
        };
        let updates: &[&str] =
            if entry.form == FormName::SquareRoot { &["joint", "separate"] } else { &[""] };
        for &update in updates.iter().filter(|_| serves) {
            let setting = Setting { key: "update".into(), value: update.into() };
            let settings = if update.is_empty() { vec![] } else { vec![setting] };
            all.push((label(entry.name, update), resolve(entry.name, &settings).unwrap()));
        }
    }
    if rung.flow.is_some() {
        all.extend(stiff_solvers());
    }
    in_precision(all, precision)
}

fn label(name: &str, update: &str) -> String {
    if update.is_empty() { name.to_owned() } else { format!("{name}, {update}") }
}

/// The continuous methods that can be told to use the solver for stiff drifts.
fn stiff_solvers() -> Vec<Tried> {
    let stiff = [Setting { key: "solver".into(), value: "rodas4".into() }];
    let of = |name: &'static str| Some((format!("{name}, rodas4"), resolve(name, &stiff).ok()?));
    ENTRIES
        .iter()
        .filter(|entry| entry.kind() == Kind::Continuous)
        .filter_map(|entry| of(entry.name))
        .collect()
}

/// A covariance has no f32.
fn in_precision(all: Vec<Tried>, precision: Precision) -> Vec<Tried> {
    let served = |(_, choice): &Tried| precision == Precision::F64 || choice.form == FormName::SquareRoot;
    let with = |(name, choice)| (name, Choice { precision, ..choice });
    all.into_iter().filter(served).map(with).collect()
}

impl Rung {
    /// Runs a method over the rung; with `repeat`, so many rows of a long run in place of its own.
    #[must_use]
    pub fn run(&self, choice: &Choice, repeat: Option<usize>) -> Answered {
        let mut answered = Answered::default();
        let stopped = self.step_through(choice, repeat, &mut answered);
        answered.refused = stopped.err().map(|error| error.fault.to_string());
        answered
    }

    fn step_through(
        &self,
        choice: &Choice,
        repeat: Option<usize>,
        out: &mut Answered,
    ) -> Result<(), StepError> {
        let (stage, sight) = (Stage(self), Sight(self));
        let prior = Gaussian::from_cov(&self.prior.0, &self.prior.1).unwrap();
        let mut filter = match choice.kind() {
            Kind::Discrete => choice.start(&stage, &sight, 0.0, &prior)?,
            Kind::Continuous => choice.start_continuous(&stage, &sight, 0.0, &prior)?,
        };
        let mut keep = |filter: &AnyFilter| out.rows.push((filter.mean().to_vec(), filter.cov()));
        if let Some(own) = self.repeat {
            for k in 1..=repeat.unwrap_or(own) {
                filter.predict(k as f64)?;
                filter.update(&self.z[0])?;
            }
            keep(&filter);
            return Ok(());
        }
        for (k, (&time, z)) in self.times.iter().zip(&self.z).enumerate() {
            if choice.kind() == Kind::Discrete && self.steps.len() > 1 {
                filter.set_controls(&[k as f64])?;
            }
            filter.predict(time)?;
            filter.update(z)?;
            keep(&filter);
        }
        Ok(())
    }
}

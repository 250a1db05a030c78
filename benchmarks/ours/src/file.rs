//! A model that is known when the program runs: read from a file, its method by name, as the command has it.

use crate::VERSION;
use crate::workloads::unknown;
use core::num::NonZeroUsize;
use givens::Data;
use givens::batch::{Batch, Track};
use givens::filter::{Gaussian, StepError};
use givens::registry::{AnyFilter, Choice, Setting, Value, resolve};
use givens_contest::{Entry, Failure, Inputs, Rows, Table};
use givens_io::{Dynamics, Model, SettingValue};

/// A model file with its rows.
struct File {
    model: Model,
    choice: Choice,
    prior: Gaussian,
    rows: Table,
    dt: f64,
}

impl File {
    fn read(inputs: &Inputs, name: &str, rows: Table, dt: f64) -> Result<Self, Failure> {
        let model = Model::read(&inputs.path(&format!("{name}.toml")).to_string_lossy())?;
        let method = model.filter.method.as_ref().ok_or("the model file names no method")?;
        let mut options = Vec::new();
        for own in &model.filter.options {
            let value = match &own.value {
                SettingValue::Number(x) => Value::Number(*x),
                SettingValue::Text(word) => Value::Word(word.clone()),
                SettingValue::Truth(truth) => Value::Word(truth.to_string()),
            };
            options.push(Setting { key: own.key.clone(), value });
        }
        let choice = resolve(&method.0, &options)?;
        let mean: Option<Vec<f64>> = model.prior.mean.iter().copied().collect();
        let prior =
            Gaussian::from_cov(&mean.ok_or("the model file leaves states to `start`")?, &model.prior.cov)?;
        Ok(Self { model, choice, prior, rows, dt })
    }

    fn start(&self) -> Result<AnyFilter<'_>, StepError> {
        let (sensors, prior) = (&self.model.observation, &self.prior);
        match &self.model.dynamics {
            Dynamics::Discrete(model) => self.choice.start(model, sensors, 0.0, prior),
            Dynamics::Continuous(model) => self.choice.start_continuous(model, sensors, 0.0, prior),
        }
    }

    /// One trajectory, stepped by hand.
    fn alone(&self, mut told: Option<&mut Rows>) -> Result<f64, Failure> {
        let n = self.prior.mean().len();
        let mut f = self.start()?;
        for k in 0..self.rows.rows() {
            f.predict(self.dt * (k + 1) as f64)?;
            f.update(self.rows.row(k))?;
            if let Some(told) = told.as_deref_mut() {
                let cov = f.cov();
                told.next(f.mean().iter().copied(), |i| cov[i * (n + 1)]);
            }
        }
        Ok(f.mean()[0])
    }

    /// Many, in one thread.
    fn batch(&self, data: &[Data], mut told: Option<&mut Rows>) -> f64 {
        let batch = Batch { threads: Some(NonZeroUsize::MIN), ..Batch::default() };
        let (sensors, prior) = (&self.model.observation, &self.prior);
        let outcomes = match &self.model.dynamics {
            Dynamics::Discrete(model) => {
                let tracks: Vec<_> =
                    data.iter().map(|data| Track::new(model, sensors, data, prior)).collect();
                self.choice.run_batch(&tracks, &batch)
            }
            Dynamics::Continuous(model) => {
                let tracks: Vec<_> =
                    data.iter().map(|data| Track::new(model, sensors, data, prior)).collect();
                self.choice.run_batch_continuous(&tracks, &batch)
            }
        };
        crate::batch::ends(&outcomes, &mut told)
    }
}

/// What there is for a workload.
pub fn offer(contestant: &str, workload: &str, inputs: &Inputs) -> Result<Entry<'static>, Failure> {
    match (workload, contestant) {
        ("W1", "file") => one(inputs, "plane", inputs.csv("plane")?, 1.0, 10),
        ("W2", "file batch") => many(inputs, "plane", inputs.f32("plane_tracks", 2)?, 1.0, 100),
        ("P1", "file") => one(inputs, "space", inputs.csv("space_fast")?, 1.0, 10),
        _ => unknown(contestant),
    }
}

/// One trajectory after the model file NAME, a row every `dt`; every so many rows are reported.
fn one(inputs: &Inputs, name: &str, rows: Table, dt: f64, every: usize) -> Result<Entry<'static>, Failure> {
    let file = File::read(inputs, name, rows, dt)?;
    let mut told = Rows::every(every);
    file.alone(Some(&mut told))?;
    Ok(Entry {
        version: VERSION.to_owned(),
        steps: file.rows.rows(),
        result: told.numbers,
        go: Box::new(move || file.alone(None)),
    })
}

/// Trajectories of `steps` rows each, after the model file NAME.
fn many(inputs: &Inputs, name: &str, rows: Table, dt: f64, steps: usize) -> Result<Entry<'static>, Failure> {
    let data = crate::batch::split(&rows, dt, steps)?;
    let file = File::read(inputs, name, rows, dt)?;
    let mut told = Rows::every(1);
    file.batch(&data, Some(&mut told));
    Ok(Entry {
        version: VERSION.to_owned(),
        steps: file.rows.rows(),
        result: told.numbers,
        go: Box::new(move || Ok(file.batch(&data, None))),
    })
}

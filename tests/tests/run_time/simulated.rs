//! Many runs drawn from one model: truths and measurements, and a method over all of them.

use givens::batch::{Batch, Track};
use givens::filter::Gaussian;
use givens::registry::Choice;
use givens::simulate::{Paths, Simulation, Stream, simulate, simulate_continuous};
use givens::{Data, Draws, Estimates, Goal, Samples};
use givens_tests::models::{Problem, Sensor};
use givens_tests::sde::Continuous;

const ROWS: usize = 9;

pub enum Model {
    Discrete(Problem),
    Continuous(Continuous),
}

/// The runs of a model with two states.
pub struct Drawn {
    model: Model,
    truths: Vec<Simulation>,
    data: Vec<Data>,
}

/// So many runs of a discrete model with two measures.
pub fn discrete(seed: u64, runs: usize, bend: f64) -> Drawn {
    let problem = Problem::random(seed, 2, 2, ROWS, bend);
    let (times, prior) = (times(problem.rows().map(|row| row.time), 2), problem.prior());
    let draw = |run: usize| {
        let stream = &mut Stream::new(seed, 7, run as u32);
        simulate(&problem.model, &problem.sensor, times.rows(), 0.0, &prior, stream).unwrap()
    };
    let truths = (0..runs).map(draw).collect();
    Drawn::new(truths, 2, Model::Discrete(problem.clone()))
}

/// So many runs of a continuous model with one measure.
pub fn continuous(seed: u64, runs: usize, bend: f64) -> Drawn {
    let problem = Continuous::random(seed, [2, 2, 1], ROWS, bend);
    let (times, prior) = (times(problem.times.iter().copied(), 1), problem.prior());
    let draw = |run: usize| {
        let (stream, paths) = (&mut Stream::new(seed, 7, run as u32), &Paths::default());
        simulate_continuous(&problem.model, &problem.sensor, times.rows(), 0.0, &prior, paths, stream)
            .unwrap()
    };
    let truths = (0..runs).map(draw).collect();
    Drawn::new(truths, 1, Model::Continuous(problem.clone()))
}

/// Rows that ask for every measure but those of every fourth row.
fn times(times: impl Iterator<Item = f64>, measures: usize) -> Data {
    let mut data = Data::new(measures).starting_at(0.0);
    for (k, time) in times.enumerate() {
        let z = if k % 4 == 2 { f64::NAN } else { 0.0 };
        data.push(time, &vec![z; measures]).unwrap();
    }
    data
}

impl Drawn {
    fn new(truths: Vec<Simulation>, measures: usize, model: Model) -> Self {
        let data = truths.iter().map(|drawn| {
            let mut data = Data::new(measures).starting_at(0.0);
            let rows = drawn.time.iter().zip(drawn.z.chunks_exact(measures));
            rows.for_each(|(&time, z)| data.push(time, z).unwrap());
            data
        });
        Self { data: data.collect(), truths, model }
    }

    pub fn rows(&self) -> usize {
        ROWS
    }

    pub fn runs(&self) -> usize {
        self.data.len()
    }

    /// The true state of a run at a row.
    pub fn truth(&self, run: usize, row: usize) -> &[f64] {
        &self.truths[run].states[2 * row..2 * row + 2]
    }

    /// Tells the methods that the measurements have this part of their standard deviations.
    pub fn shrink_noise(&mut self, part: f64) {
        self.sensor_mut().r *= part * part;
    }

    fn sensor_mut(&mut self) -> &mut Sensor {
        match &mut self.model {
            Model::Discrete(problem) => &mut problem.sensor,
            Model::Continuous(problem) => &mut problem.sensor,
        }
    }

    fn prior(&self) -> Gaussian {
        match &self.model {
            Model::Discrete(problem) => problem.prior(),
            Model::Continuous(problem) => problem.prior(),
        }
    }

    /// A method over all runs.
    pub fn run(&self, choice: &Choice, goal: Goal) -> Vec<Estimates> {
        let (prior, batch) = (self.prior(), Batch { goal, ..Batch::default() });
        let outcomes = match &self.model {
            Model::Discrete(Problem { model, sensor, .. }) => {
                let tracks: Vec<_> =
                    self.data.iter().map(|data| Track::new(model, sensor, data, &prior)).collect();
                choice.run_batch(&tracks, &batch)
            }
            Model::Continuous(Continuous { model, sensor, .. }) => {
                let tracks: Vec<_> =
                    self.data.iter().map(|data| Track::new(model, sensor, data, &prior)).collect();
                choice.run_batch_continuous(&tracks, &batch)
            }
        };
        let whole = outcomes.into_iter().flatten().map(|outcome| {
            assert!(outcome.failure.is_none(), "{:?}", outcome.failure);
            outcome.estimates
        });
        whole.collect()
    }

    /// Trajectories drawn from the posterior of a run.
    pub fn sample(&self, choice: &Choice, run: usize, count: u32) -> Samples {
        let (prior, data) = (self.prior(), &self.data[run]);
        let draws = Draws { count, seed: 9, track: run as u32 };
        let drawn = match &self.model {
            Model::Discrete(Problem { model, sensor, .. }) => {
                choice.sample(model, sensor, data.rows(), 0.0, &prior, draws)
            }
            Model::Continuous(Continuous { model, sensor, .. }) => {
                choice.sample_continuous(model, sensor, data.rows(), 0.0, &prior, draws)
            }
        };
        drawn.unwrap()
    }
}

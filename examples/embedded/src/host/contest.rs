//! A tracker against the answers.

use crate::stack::depth_of;
use givens_core::filter::StepError;
use tracker::{LagMemory, PlaneFilter, PlaneMemory, PlaneSmoother, SpaceFilter, SpaceMemory};

/// What rounding may do: a mean may be off by so much of its standard deviation, and a standard deviation by so much of
/// itself. A position of 30 km has a grain of 2 mm in single precision, and one of 1e-4 of its standard deviation of 15 m;
/// a step rounds some dozen times and forgets what was before ten steps, which makes some 1e-3. Measured: 7e-4 and 1.2e-4.
/// An error of the mathematics (a wrong weight, a lost noise) shows in the first digits.
const MEAN_WITHIN: f64 = 0.003;
const DEVIATION_WITHIN: f64 = 0.0005;

/// A tracker of measurements of length D.
pub trait Tracked<'m, const D: usize>: Sized {
    type Memory;
    fn start(memory: &'m mut Self::Memory) -> Result<Self, StepError>;
    fn step(&mut self, time: f64, z: [f32; D]) -> Result<(), StepError>;
    /// Mean and factor, once there are any.
    fn told(&self) -> Option<(&[f32], &[f32])>;
}

macro_rules! tracked {
    ($tracker:ident in $memory:ident, $d:literal, |$own:ident| $told:expr) => {
        impl<'m> Tracked<'m, $d> for $tracker<'m> {
            type Memory = $memory;
            fn start(memory: &'m mut $memory) -> Result<Self, StepError> {
                Self::start(memory)
            }
            fn step(&mut self, time: f64, z: [f32; $d]) -> Result<(), StepError> {
                self.step(time, z)
            }
            fn told(&self) -> Option<(&[f32], &[f32])> {
                let $own = self;
                $told
            }
        }
    };
}
tracked!(PlaneFilter in PlaneMemory, 2, |own| Some((own.mean(), own.factor())));
tracked!(PlaneSmoother in LagMemory, 2, |own| own.lagged());
tracked!(SpaceFilter in SpaceMemory, 3, |own| Some((own.mean(), own.factor())));

/// What a run has found.
#[derive(Default)]
pub struct Found {
    /// Answers that there are, and those of them that were compared.
    answers: usize,
    pub compared: usize,
    /// The largest difference of a mean, in standard deviations of the answer; infinite if it is no number.
    pub mean: f64,
    /// The largest difference of a standard deviation, relative to the answer's.
    pub deviation: f64,
    /// Bytes of stack.
    pub stack_start: usize,
    pub stack_step: usize,
}

impl Found {
    /// Whether every answer was compared, and none was too far off.
    pub fn agrees(&self) -> bool {
        self.compared == self.answers && self.mean <= MEAN_WITHIN && self.deviation <= DEVIATION_WITHIN
    }

    /// Compares a belief with an answer: its means, then its standard deviations.
    fn compare(&mut self, (mean, factor): (&[f32], &[f32]), answer: &[f64]) {
        let (means, deviations) = answer.split_at(mean.len());
        for ((&x, row), (&m, &s)) in
            mean.iter().zip(factor.chunks_exact(mean.len())).zip(means.iter().zip(deviations))
        {
            let variance = row.iter().fold(0.0, |sum, &x| sum + f64::from(x) * f64::from(x));
            // without roots, which core lacks: v/s² − 1 is twice s'/s − 1
            self.mean = larger(self.mean, (f64::from(x) - m).abs() / s);
            self.deviation = larger(self.deviation, (0.5 * (variance / (s * s) - 1.0)).abs());
        }
        self.compared += 1;
    }
}

fn larger(a: f64, b: f64) -> f64 {
    if b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// What one call works on.
struct Start<'m, T, M> {
    memory: Option<&'m mut M>,
    tracker: Option<T>,
}

struct Step<T, const D: usize> {
    tracker: T,
    time: f64,
    z: [f32; D],
    done: bool,
}

/// Runs a tracker over rows that are a second apart. The answers begin with the row `late`.
pub fn run<'m, T: Tracked<'m, D>, const D: usize, const W: usize>(
    memory: &'m mut T::Memory,
    rows: &[[f32; D]],
    answers: &[[f64; W]],
    late: usize,
    falsified: bool,
) -> Found {
    let mut found = Found { answers: answers.len(), ..Found::default() };
    let mut start = Start { memory: Some(memory), tracker: None };
    found.stack_start =
        depth_of(|s| s.tracker = s.memory.take().and_then(|memory| T::start(memory).ok()), &mut start);
    let Some(tracker) = start.tracker else { return found };
    let mut step = Step { tracker, time: 0.0, z: [0.0; D], done: true };
    for (k, row) in rows.iter().enumerate() {
        step.time += 1.0;
        step.z = *row;
        if falsified && k == rows.len() / 2 {
            step.z[0] *= 1.01;
        }
        let depth = depth_of(|step| step.done = step.tracker.step(step.time, step.z).is_ok(), &mut step);
        found.stack_step = found.stack_step.max(depth);
        if !step.done {
            return found;
        }
        let answer = k.checked_sub(late).and_then(|k| answers.get(k));
        if let (Some(told), Some(answer)) = (step.tracker.told(), answer) {
            found.compare(told, answer);
        }
    }
    found
}

//! The loop over the rows: predict, update, write down.

use super::between::Between;
use super::goal::{Goal, Outcome};
use super::own::{OwnFilter, Start, scatter, start_own};
use super::task::{Rows, Task};
use crate::filter::{Belief, Form, Method, Over, StepError};
use crate::gate::teach;
use crate::model::Observation;
use crate::scalar::Real;
use crate::smoother::{FixedPoint, History};
use crate::{Estimates, Row};
use core::ops::Range;

/// A filter, what it has recorded, and what it is to find out.
pub(crate) struct Recorder<'t, 'm, X: Method, M, H, T> {
    pub(crate) filter: OwnFilter<'m, X, M, T>,
    pub(super) task: Task<'t, 'm, X, M, H>,
    pub(super) history: History<T, Vec<T>>,
    point: Option<FixedPoint<T, Vec<T>>>,
    present: Vec<bool>,
    /// The belief after the last finished row: where the way back begins if the next one fails.
    pub(super) last: (Vec<f64>, Vec<f64>, Vec<f64>),
    /// A root of a covariance on its way to the estimates.
    spare: Vec<f64>,
    pub(super) reached: Reached,
    /// Rows of the data up to the last one that was finished.
    pub(crate) finished: usize,
    /// States at other times.
    pub(super) between: Between<'t, T>,
}

/// How far the row at work has come.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Reached {
    /// No further than the one before: the filter stands there.
    Nothing,
    /// Its prediction was begun.
    Leaving,
    /// It was predicted, and so recorded.
    Itself,
}

impl<'t, 'm, X: Over<M>, M, H: Observation, T: Real> Recorder<'t, 'm, X, M, H, T> {
    /// A filter with memory of its own, and room for what it records of `rows` rows.
    pub fn start(
        task: Task<'t, 'm, X, M, H>,
        start: Start,
        rows: usize,
        between: Between<'t, T>,
    ) -> Result<Self, StepError> {
        let Task { method, model, sensors, parameters, goal, .. } = task;
        let mut filter = start_own(method, model, sensors, start, goal != Goal::Filter)?;
        if !parameters.is_empty() {
            filter.set_parameters(parameters)?;
        }
        let n = filter.mean().len();
        let capacity = match goal {
            Goal::Filter | Goal::Point(_) => 0,
            Goal::Interval => rows,
            Goal::Lag(lag) => lag.min(rows),
        };
        let square_root = X::Form::SQUARE_ROOT;
        let memory = vec![T::zero(); History::<T, Vec<T>>::memory_len(n, capacity)];
        let t0 = filter.time();
        let mut recorder = Self {
            filter,
            task,
            history: History::new(n, square_root, memory),
            point: None,
            present: vec![false; sensors.measures()],
            last: (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * n]),
            spare: vec![0.0; n * n],
            reached: Reached::Nothing,
            finished: 0,
            between,
        };
        recorder.begin_point(t0)?;
        Ok(recorder)
    }

    /// Begins the fixed point if its time has come.
    fn begin_point(&mut self, t: f64) -> Result<(), StepError> {
        if self.point.is_none() && self.task.goal == Goal::Point(t) {
            let memory = vec![T::zero(); FixedPoint::<T, Vec<T>>::memory_len(self.filter.mean().len())];
            self.point = Some(FixedPoint::begin(&mut self.filter, memory)?);
        }
        Ok(())
    }

    /// Takes in these rows, up to one that fails.
    pub fn forward(&mut self, rows: &dyn Rows, range: Range<usize>, outcome: &mut Outcome) {
        let watch = self.task.watch;
        let mut before = range.start.checked_sub(1).and_then(|k| rows.at(k));
        outcome.estimates.reserve(range.len());
        for k in range {
            let Some(row) = rows.at(k).filter(|_| !watch.stopped()) else { break };
            if let Err(error) = self.row(before, row, &mut outcome.estimates) {
                outcome.failure = Some((k, error));
                outcome.failed_at = told(self.filter.mean()).collect();
                break;
            }
            self.reached = Reached::Nothing;
            self.finished = k + 1;
            outcome.log_likelihood += self.filter.innovation().log_likelihood.first();
            watch.count(1);
            before = Some(row);
        }
        let out = &mut outcome.estimates;
        out.truncate(out.len());
    }

    /// The row of the data that the first of the estimates is of.
    pub fn first(&self, outcome: &Outcome) -> usize {
        self.finished.saturating_sub(outcome.estimates.len())
    }

    /// Takes off the estimates but for the last `keep`, and the states at the wanted times so far.
    pub fn cut(&mut self, outcome: &mut Outcome, keep: usize) -> (Estimates, Estimates) {
        let at = self.between.cut(&outcome.estimates, false);
        let done = outcome.estimates.len().saturating_sub(keep);
        let kept = outcome.estimates.split_off(done);
        (core::mem::replace(&mut outcome.estimates, kept), at)
    }

    /// Goes on to the times that are wanted behind the last row.
    pub fn beyond(&mut self, outcome: &mut Outcome) {
        if outcome.failure.is_none() {
            let Task { sensors, limits, watch, .. } = self.task;
            let beyond = self.between.ahead(&self.filter, sensors, None, &outcome.estimates, limits, watch);
            outcome.failure = beyond.err().map(|error| (self.finished.saturating_sub(1), error));
        }
    }

    /// Takes in one row and writes it to `out`; `before` is the row above it.
    fn row(&mut self, before: Option<Row>, row: Row, out: &mut Estimates) -> Result<(), StepError> {
        let Task { sensors, goal, limits, watch, .. } = self.task;
        // a control holds from its row to the next, the first one also before
        self.filter.set_controls(before.unwrap_or(row).u)?;
        for (there, z) in self.present.iter_mut().zip(row.z) {
            *there = !z.is_nan();
        }
        self.between.ahead(&self.filter, sensors, Some((row, &self.present)), out, limits, watch)?;
        self.reached = Reached::Leaving;
        match &mut self.point {
            Some(point) => point.predict(&mut self.filter, row.time)?,
            None => self.history.predict(&mut self.filter, row.time)?,
        }
        self.reached = Reached::Itself;
        push(&self.filter, &mut out.predicted_mean, &mut out.predicted_cov, &mut self.spare);
        self.filter.set_controls(row.u)?;
        let taken = teach(&mut self.filter, sensors, row.z, &self.present, limits)?;
        let waiting = matches!(goal, Goal::Point(_)) && self.point.is_none();
        match &mut self.point {
            Some(point) => point.update(&self.filter)?,
            None => self.begin_point(row.time)?,
        }
        if waiting && self.point.is_none() {
            out.truncate(out.len());
            return Ok(());
        }
        self.write(row.time, out);
        out.gated.push(!taken);
        if let Goal::Lag(lag) = goal {
            let at = out.len() - 1;
            let filter = &self.filter;
            let done = self.history.smooth(filter, lag.min(at), |age, smoothed| {
                if age == lag {
                    put::<X::Form, T>(out, at - age, &smoothed.belief);
                }
            });
            if done.is_err() {
                out.truncate(at);
            }
            done?;
        }
        if goal != Goal::Filter {
            self.keep();
        }
        Ok(())
    }

    /// Notes the belief that the row has ended with.
    fn keep(&mut self) {
        let (mean, factor, cov) = &mut self.last;
        mean.clear();
        mean.extend(told(self.filter.mean()));
        factor.clear();
        factor.extend(told(self.filter.factor()));
        // a square root is read without
        if !X::Form::SQUARE_ROOT {
            write_cov(&self.filter, factor, cov);
        }
    }

    fn write(&mut self, time: f64, out: &mut Estimates) {
        out.time.push(time);
        if let Some(point) = &self.point {
            out.mean.extend(told(point.mean()));
            out.cov.extend(told(point.cov()));
            out.factor.extend(told(point.factor()));
        } else {
            push(&self.filter, &mut out.mean, &mut out.cov, &mut self.spare);
            out.factor.extend(told(self.filter.factor()));
        }
        if out.smoothed {
            push(&self.filter, &mut out.filtered_mean, &mut out.filtered_cov, &mut self.spare);
        }
        let d = self.present.len();
        let innovation = self.filter.innovation();
        let (nu_at, cov_at) = (out.innovation.len(), out.innovation_cov.len());
        out.innovation.resize(nu_at + d, f64::NAN);
        out.innovation_cov.resize(cov_at + d * d, f64::NAN);
        scatter(&innovation, &self.present, &mut out.innovation[nu_at..], &mut out.innovation_cov[cov_at..]);
        let dof = innovation.nu.len();
        out.nis_dof.push(dof);
        out.nis.push(if dof == 0 { f64::NAN } else { innovation.nis.first() });
        out.log_likelihood.push(innovation.log_likelihood.first());
    }
}

/// The numbers of a filter, as estimates have them.
pub(crate) fn told<T: Real>(numbers: &[T]) -> impl Iterator<Item = f64> {
    numbers.iter().map(|x| x.first())
}

/// Appends a filter's mean and covariance; `spare` has the length of the covariance.
pub(super) fn push<X: Over<M>, M, T: Real>(
    filter: &OwnFilter<X, M, T>,
    mean: &mut Vec<f64>,
    cov: &mut Vec<f64>,
    spare: &mut [f64],
) {
    let (n, at) = (filter.mean().len(), cov.len());
    mean.extend(told(filter.mean()));
    cov.resize(at + n * n, 0.0);
    spare.iter_mut().zip(told(filter.factor())).for_each(|(to, x)| *to = x);
    write_cov(filter, spare, &mut cov[at..]);
}

/// Writes a filter's covariance, n × n, of which `factor` is the root.
pub(crate) fn write_cov<X: Over<M>, M, T: Real>(
    filter: &OwnFilter<X, M, T>,
    factor: &[f64],
    cov: &mut [f64],
) {
    let n = filter.mean().len();
    if X::Form::SQUARE_ROOT {
        crate::kernels::square_lower(cov, n, factor);
    } else {
        cov.iter_mut().zip(told(filter.carried().cov)).for_each(|(to, x)| *to = x);
    }
}

/// Replaces the estimate of a row by a smoothed one.
pub(super) fn put<F: Form, T: Real>(out: &mut Estimates, row: usize, belief: &Belief<T>) {
    let n = belief.mean.len();
    let write = |to: &mut [f64], from: &[T]| to.iter_mut().zip(told(from)).for_each(|(to, x)| *to = x);
    let square = row * n * n..(row + 1) * n * n;
    write(&mut out.mean[row * n..(row + 1) * n], belief.mean);
    write(&mut out.factor[square.clone()], belief.factor);
    let cov = &mut out.cov[square.clone()];
    if F::SQUARE_ROOT {
        crate::kernels::square_lower(cov, n, &out.factor[square]);
    } else {
        write(cov, belief.cov);
    }
}

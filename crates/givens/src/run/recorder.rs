//! The loop over the rows: predict, update, write down; then back again for the smoothers.

use super::between::Between;
use super::goal::{Goal, Outcome};
use super::own::{OwnFilter, Start, scatter, start_own};
use crate::filter::{Belief, Form, Gaussian, Method, Over, Prior, StepError};
use crate::model::Observation;
use crate::scalar::Real;
use crate::smoother::{FixedPoint, History, Smoothed};
use crate::{Estimates, Row};
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// A filter, what it has recorded, and what it is to find out.
pub(super) struct Recorder<'t, 'm, X: Method, M, H, T> {
    pub(super) filter: OwnFilter<'m, X, M, T>,
    sensors: &'m H,
    goal: Goal,
    pub(super) history: History<T, Vec<T>>,
    point: Option<FixedPoint<T, Vec<T>>>,
    present: Vec<bool>,
    /// The belief after the last finished row: where the way back begins if the next one fails.
    last: (Vec<f64>, Vec<f64>, Vec<f64>),
    /// A root of a covariance on its way to the estimates.
    spare: Vec<f64>,
    /// Whether the row at work has been predicted, and so recorded.
    predicted: bool,
    /// States at other times.
    between: Between<'t, T>,
    /// Once it says stop, no further row is begun, on neither way.
    watch: Watch<'t>,
}

/// What others see of a run at work, and have to say to it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Watch<'t> {
    /// Cancels the run when it is set.
    pub cancel: Option<&'t AtomicBool>,
    /// Counts the rows that are taken in.
    pub rows: Option<&'t AtomicUsize>,
}

impl Watch<'_> {
    pub fn stopped(&self) -> bool {
        self.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed))
    }

    pub fn count(&self, rows: usize) {
        if let Some(count) = self.rows {
            count.fetch_add(rows, Ordering::Relaxed);
        }
    }
}

impl<'t, 'm, X: Over<M>, M, H: Observation, T: Real> Recorder<'t, 'm, X, M, H, T> {
    /// A filter with memory of its own for this model, these sensors and `rows` rows.
    pub fn start(
        method: X,
        model: &'m M,
        sensors: &'m H,
        t0: f64,
        prior: &Gaussian,
        parameters: &[f64],
        goal: Goal,
        rows: usize,
        between: Between<'t, T>,
        watch: Watch<'t>,
    ) -> Result<Self, StepError> {
        let mut filter = start_own(method, model, sensors, Start::Prior(t0, prior), goal != Goal::Filter)?;
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
        let mut recorder = Self {
            filter,
            sensors,
            goal,
            history: History::new(n, square_root, memory),
            point: None,
            present: vec![false; sensors.measures()],
            last: (prior.mean().to_vec(), prior.factor().to_vec(), prior.cov().to_vec()),
            spare: prior.factor().to_vec(),
            predicted: false,
            between,
            watch,
        };
        recorder.begin_point(t0)?;
        Ok(recorder)
    }

    /// Begins the fixed point if its time has come.
    fn begin_point(&mut self, t: f64) -> Result<(), StepError> {
        if self.point.is_none() && self.goal == Goal::Point(t) {
            let memory = vec![T::zero(); FixedPoint::<T, Vec<T>>::memory_len(self.filter.mean().len())];
            self.point = Some(FixedPoint::begin(&mut self.filter, memory)?);
        }
        Ok(())
    }

    /// Takes in all rows, up to one that fails, and goes on to the times that are wanted behind the last.
    pub fn forward(&mut self, rows: &[Row], outcome: &mut Outcome) {
        let (mut before, watch) = (None, self.watch);
        outcome.estimates.reserve(rows.len());
        for (k, &row) in rows.iter().take_while(|_| !watch.stopped()).enumerate() {
            if let Err(error) = self.row(before, row, &mut outcome.estimates) {
                outcome.failure = Some((k, error));
                outcome.failed_at = told(self.filter.mean()).collect();
                break;
            }
            outcome.log_likelihood += self.filter.innovation().log_likelihood.first();
            watch.count(1);
            before = Some(row);
        }
        let out = &mut outcome.estimates;
        out.truncate(out.len());
        if outcome.failure.is_none() {
            let beyond = self.between.ahead(&self.filter, self.sensors, None, out, watch);
            outcome.failure = beyond.err().map(|error| (out.len().saturating_sub(1), error));
        }
    }

    /// Takes in one row and writes it to `out`; `before` is the row above it.
    fn row(&mut self, before: Option<Row>, row: Row, out: &mut Estimates) -> Result<(), StepError> {
        self.predicted = false;
        // a control holds from its row to the next, the first one also before
        self.filter.set_controls(before.unwrap_or(row).u)?;
        for (there, z) in self.present.iter_mut().zip(row.z) {
            *there = !z.is_nan();
        }
        self.between.ahead(&self.filter, self.sensors, Some((row, &self.present)), out, self.watch)?;
        match &mut self.point {
            Some(point) => point.predict(&mut self.filter, row.time)?,
            None => self.history.predict(&mut self.filter, row.time)?,
        }
        self.predicted = true;
        push(&self.filter, &mut out.predicted_mean, &mut out.predicted_cov, &mut self.spare);
        self.filter.set_controls(row.u)?;
        self.filter.update_present(self.sensors, row.z, &self.present)?;
        let waiting = matches!(self.goal, Goal::Point(_)) && self.point.is_none();
        match &mut self.point {
            Some(point) => point.update(&self.filter)?,
            None => self.begin_point(row.time)?,
        }
        if waiting && self.point.is_none() {
            out.truncate(out.len());
            return Ok(());
        }
        self.write(row.time, out);
        if let Goal::Lag(lag) = self.goal {
            let at = out.len() - 1;
            let filter = &self.filter;
            self.history.smooth(filter, lag.min(at), |age, smoothed| {
                if age == lag {
                    put::<X::Form, T>(out, at - age, &smoothed.belief);
                }
            })?;
        }
        self.keep();
        Ok(())
    }

    /// Notes the belief that the row has ended with.
    fn keep(&mut self) {
        let (mean, factor, cov) = &mut self.last;
        mean.clear();
        mean.extend(told(self.filter.mean()));
        factor.clear();
        factor.extend(told(self.filter.factor()));
        write_cov(&self.filter, factor, cov);
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

    /// Goes back over the finished rows.
    fn back(&mut self, out: &mut Estimates, failed: bool) -> Result<(), StepError> {
        let Some(last) = out.len().checked_sub(1) else { return Ok(()) };
        let steps = match self.goal {
            Goal::Interval => last,
            Goal::Lag(lag) => lag.min(last),
            Goal::Filter | Goal::Point(_) => return Ok(()),
        };
        let time = out.time[last];
        let (mut wrong, between, watch) = (None, &mut self.between, self.watch);
        let put = |age: usize, smoothed: &Smoothed<T>| {
            let row = last - age;
            put::<X::Form, T>(out, row, &smoothed.belief);
            let filtered = (out.filtered_mean(row), out.filtered_cov(row));
            wrong = wrong.or(between.back::<X::Form>(row, out.time[row], smoothed, filtered).err());
            if watch.stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let start = Prior { time, mean: &self.last.0, factor: &self.last.1, cov: &self.last.2 };
        if failed {
            self.history.smooth_from::<X::Form, _>(start, usize::from(self.predicted), steps, put)?;
        } else {
            self.history.smooth(&self.filter, steps, put)?;
        }
        wrong.map_or(Ok(()), Err)
    }

    /// Goes back, and gives the states at the wanted times.
    pub fn finish(mut self, outcome: &mut Outcome) -> Estimates {
        let out = &mut outcome.estimates;
        if let Err(error) = self.back(out, outcome.failure.is_some()) {
            // a smoothed covariance that does not exist: the filtered rows are no answer to the question. The record that
            // failed leads from its row, counted from one less, to the next
            let row = error.step.saturating_sub(1).min(out.len().saturating_sub(1));
            let time = out.time.get(row).copied().unwrap_or(error.time);
            outcome.failure.get_or_insert((row, StepError { time, ..error }));
            out.truncate(0);
        }
        self.between.finish(out, outcome.failure.is_some())
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
        crate::kernels::square(cov, n, factor, n, n);
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
        crate::kernels::square(cov, n, &out.factor[square], n, n);
    } else {
        write(cov, belief.cov);
    }
}

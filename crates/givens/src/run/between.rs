//! States at any time, beside the recursion over the rows: no other number changes by asking.

use super::own::OwnFilter;
use super::recorder::{push, put, told};
use super::watch::Watch;
use crate::filter::{Belief, Form, Over, StepError};
use crate::gate::teach;
use crate::model::Observation;
use crate::scalar::Real;
use crate::smoother::{History, Smoothed};
use crate::{Estimates, Row};

/// The states at `times`, in increasing order.
pub(crate) struct Between<'t, T> {
    times: &'t [f64],
    smoothing: bool,
    sides: Vec<Side<T>>,
    /// Of every time that is a row's, the row.
    rows: Vec<Option<usize>>,
    /// One estimate for each time so far.
    out: Estimates,
}

/// The way over one wanted time, from the row before it to the one behind: each has its own, so that no answer depends on
/// what else is asked.
struct Side<T> {
    history: History<T, Vec<T>>,
    /// Which of the times.
    index: usize,
    /// The row at its end.
    row: usize,
    /// What its filter believes there, which is not to the bit what the filter of the rows does.
    mean: Vec<T>,
    factor: Vec<T>,
    cov: Vec<T>,
}

impl<'t, T: Real> Between<'t, T> {
    pub fn new(times: &'t [f64], out: Estimates) -> Self {
        Self { times, smoothing: out.is_smoothed(), sides: Vec::new(), rows: Vec::new(), out }
    }

    /// Predicts to all wanted times before that of `next`, from a filter that stands behind its last finished row, and
    /// for a smoother goes on to that row and its update. Without a next row, to all that are left.
    pub fn ahead<X: Over<M>, M, H: Observation>(
        &mut self,
        filter: &OwnFilter<X, M, T>,
        sensors: &H,
        next: Option<(Row, &[bool])>,
        finished: &Estimates,
        limits: &[f64],
        watch: Watch,
    ) -> Result<(), StepError> {
        let n = filter.mean().len();
        let until = next.map_or(f64::INFINITY, |(row, _)| row.time);
        while let Some(&t) = self.times.get(self.out.len()).filter(|&&t| t < until && !watch.stopped()) {
            let last = finished.time.last() == Some(&t);
            self.rows.push(if last { finished.len().checked_sub(1) } else { None });
            let mut filter = filter.clone();
            let memory = if self.smoothing { History::<T, Vec<T>>::memory_len(n, 2) } else { 0 };
            let mut history = History::new(n, X::Form::SQUARE_ROOT, vec![T::zero(); memory]);
            history.predict(&mut filter, t)?;
            self.write(&filter, t);
            if let (Some((row, present)), true, false) = (next, self.smoothing, last) {
                history.predict(&mut filter, row.time)?;
                filter.set_controls(row.u)?;
                teach(&mut filter, sensors, row.z, present, limits)?;
                history.close(&mut filter)?;
                self.sides.push(Side {
                    history,
                    index: self.out.len() - 1,
                    row: finished.len(),
                    mean: filter.mean().to_vec(),
                    factor: filter.factor().to_vec(),
                    cov: filter.cov(),
                });
            }
        }
        Ok(())
    }

    /// One more estimate: a prediction.
    fn write<X: Over<M>, M>(&mut self, filter: &OwnFilter<X, M, T>, t: f64) {
        let d = self.out.measures();
        let out = &mut self.out;
        let mut spare: Vec<f64> = told(filter.factor()).collect();
        push(filter, &mut out.predicted_mean, &mut out.predicted_cov, &mut spare);
        push(filter, &mut out.mean, &mut out.cov, &mut spare);
        out.factor.extend_from_slice(&spare);
        if self.smoothing {
            push(filter, &mut out.filtered_mean, &mut out.filtered_cov, &mut spare);
        }
        out.time.push(t);
        out.innovation.extend(core::iter::repeat_n(f64::NAN, d));
        out.innovation_cov.extend(core::iter::repeat_n(f64::NAN, d * d));
        out.nis.push(f64::NAN);
        out.nis_dof.push(0);
        out.gated.push(false);
        out.log_likelihood.push(0.0);
    }

    /// The way back has reached a row; rows come from the last to the first, as the sides do from the end.
    pub fn back<F: Form>(
        &mut self,
        row: usize,
        time: f64,
        smoothed: &Smoothed<T>,
        filtered: (&[f64], &[f64]),
    ) -> Result<(), StepError> {
        while let Some(mut side) = self.sides.pop_if(|side| side.row >= row) {
            if side.row == row {
                let (out, index) = (&mut self.out, side.index);
                let put = |age: usize, smoothed: &Smoothed<T>| {
                    if age == 1 {
                        put::<F, T>(out, index, &smoothed.belief);
                    }
                };
                if !F::SQUARE_ROOT || alike((&side.mean, &side.cov), filtered) {
                    side.history.smooth_on(time, smoothed, put)?;
                    continue;
                }
                let Belief { mean, factor, cov, .. } = &smoothed.belief;
                let (mut mean, mut factor, mut cov) = (mean.to_vec(), factor.to_vec(), cov.to_vec());
                let (mut shift, mut root) = (side.mean.clone(), side.factor.clone());
                smoothed.seen_from(&side.mean, &side.factor, &mut shift, &mut root);
                let belief = Belief { mean: &mut mean, factor: &mut factor, cov: &mut cov, moved: &mut [] };
                let seen = Smoothed { belief, shift: &mut shift, root: &mut root };
                side.history.smooth_on(time, &seen, put)?;
            }
        }
        Ok(())
    }

    /// The estimates at the times so far, those of the rows themselves taken from `rows`; what comes then begins behind them. Of a
    /// run that has failed, up to the row at fault; smoothed ones, which need the row behind them, up to the last finished row.
    pub fn cut(&mut self, rows: &Estimates, failed: bool) -> Estimates {
        let end = rows.time.last().copied();
        let blank = Estimates::new(self.out.states(), self.out.measures(), self.smoothing);
        let mut out = core::mem::replace(&mut self.out, blank);
        for (k, row) in self.rows.drain(..).enumerate() {
            if let Some(row) = row.filter(|row| *row < rows.len()) {
                out.copy_row(k, rows, row);
            }
        }
        self.sides.clear();
        self.times = &self.times[out.len()..];
        if failed && self.smoothing {
            let kept = out.time.iter().take_while(|&&t| end.is_some_and(|end| t <= end)).count();
            out.truncate(kept);
        }
        out
    }
}

/// Whether two beliefs are the same but for rounding: what is nearly known is then spared a division by its root.
fn alike<T: Real>((mean, cov): (&[T], &[T]), (other, others): (&[f64], &[f64])) -> bool {
    let n = mean.len();
    let (mean, cov): (Vec<f64>, Vec<f64>) = (told(mean).collect(), told(cov).collect());
    let alike = ALIKE * T::EPSILON;
    let deviation = |i: usize| cov[i * n + i].sqrt();
    let near = |i: usize| (mean[i] - other[i]).abs() <= alike * (deviation(i) + mean[i].abs());
    let close = |i: usize, j: usize| {
        (cov[i * n + j] - others[i * n + j]).abs() <= alike * deviation(i) * deviation(j)
    };
    (0..n).all(near) && (0..n * n).all(|k| close(k / n, k % n))
}

const ALIKE: f64 = 450.0;

//! States at any time, beside the recursion over the rows: no other number changes by asking.

use super::recorder::{OwnFilter, push, put};
use crate::filter::{Form, Over, StepError};
use crate::model::Observation;
use crate::smoother::{History, Smoothed};
use crate::{Estimates, Row};

/// The states at `times`, in increasing order.
pub(super) struct Between<'t, 'm, X, M> {
    times: &'t [f64],
    smoothing: bool,
    sides: Vec<Side<'m, X, M>>,
    /// Of every time that is a row's, the row.
    rows: Vec<Option<usize>>,
    /// One estimate for each time so far.
    pub out: Estimates,
}

/// A way beside one gap between two rows: over the wanted times, to the later row and its update.
pub(super) struct Side<'m, X, M> {
    filter: OwnFilter<'m, X, M>,
    history: History<f64, Vec<f64>>,
    /// The row at its end.
    row: usize,
    /// The first of its times, and how many.
    first: usize,
    count: usize,
}

impl<'t, 'm, X: Over<M>, M> Between<'t, 'm, X, M> {
    pub fn new(times: &'t [f64], out: Estimates) -> Self {
        Self { times, smoothing: out.is_smoothed(), sides: Vec::new(), rows: Vec::new(), out }
    }

    /// Predicts to all wanted times before `until`, from a filter that stands at its last finished row, `row` rows after
    /// the first. Returns the way beside, if it is to go on.
    pub fn ahead(
        &mut self,
        filter: &OwnFilter<'m, X, M>,
        until: f64,
        row: usize,
        last: Option<f64>,
    ) -> Result<Option<Side<'m, X, M>>, StepError> {
        let first = self.out.len();
        let count = self.times[first..].iter().take_while(|&&t| t < until).count();
        if count == 0 {
            return Ok(None);
        }
        let n = filter.mean().len();
        let mut filter = filter.clone();
        let memory = if self.smoothing { History::<f64, Vec<f64>>::memory_len(n, count + 1) } else { 0 };
        let mut history = History::new(n, X::Form::SQUARE_ROOT, vec![0.0; memory]);
        for &t in &self.times[first..first + count] {
            let at_row = if last == Some(t) { row.checked_sub(1) } else { None };
            history.predict(&mut filter, t)?;
            self.rows.push(at_row);
            push(&filter, &mut self.out.predicted_mean, &mut self.out.predicted_cov);
            push(&filter, &mut self.out.mean, &mut self.out.cov);
            if self.smoothing {
                push(&filter, &mut self.out.filtered_mean, &mut self.out.filtered_cov);
            }
            self.out.time.push(t);
            let d = self.out.measures();
            self.out.innovation.extend(core::iter::repeat_n(f64::NAN, d));
            self.out.innovation_cov.extend(core::iter::repeat_n(f64::NAN, d * d));
            self.out.nis.push(f64::NAN);
            self.out.nis_dof.push(0);
            self.out.log_likelihood.push(0.0);
        }
        Ok(self.smoothing.then_some(Side { filter, history, row, first, count }))
    }

    /// Takes the way beside to the row at its end.
    pub fn arrive<H: Observation>(
        &mut self,
        mut side: Side<'m, X, M>,
        sensors: &H,
        row: Row,
        present: &[bool],
    ) -> Result<(), StepError> {
        side.history.predict(&mut side.filter, row.time)?;
        side.filter.set_controls(row.u)?;
        side.filter.update_present(sensors, row.z, present)?;
        self.sides.push(side);
        Ok(())
    }

    /// The way back has reached a row.
    pub fn back(&mut self, row: usize, smoothed: &Smoothed<f64>) -> Result<(), StepError> {
        let out = &mut self.out;
        for side in self.sides.iter_mut().filter(|side| side.row == row) {
            let (first, count) = (side.first, side.count);
            side.history.smooth_on(&mut side.filter, smoothed, |age, smoothed| {
                // the last record leads from the last wanted time to the row; the first, from the row before
                if (1..=count).contains(&age) {
                    put::<X::Form>(out, first + count - age, &smoothed.belief);
                }
            })?;
        }
        Ok(())
    }

    /// The estimates at all times up to the last finished row, those of the rows themselves taken from `rows`.
    pub fn finish(mut self, rows: &Estimates, failed: bool) -> Estimates {
        let end = rows.time.last().copied();
        for (k, row) in self.rows.iter().enumerate() {
            if let Some(row) = row.filter(|row| *row < rows.len()) {
                self.out.copy_row(k, rows, row);
            }
        }
        if failed {
            let kept = self.out.time.iter().take_while(|&&t| end.is_some_and(|end| t <= end)).count();
            self.out.truncate(kept);
        }
        self.out
    }
}

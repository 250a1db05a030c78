//! The way back over the rows that a recorder has finished.

use super::crossing::Crossing;
use super::goal::{Goal, Outcome};
use super::recorder::{Reached, Recorder, put};
use crate::Estimates;
use crate::filter::{Over, Prior, StepError};
use crate::model::Observation;
use crate::scalar::Real;
use crate::smoother::Smoothed;
use core::ops::ControlFlow;

impl<X: Over<M>, M, H: Observation, T: Real> Recorder<'_, '_, X, M, H, T> {
    /// Goes back, gives the smoothed belief at the first of the rows, and hands over the states at the wanted times.
    ///
    /// `from` is the smoothed belief at the last of the rows, if later ones that another recorder has finished have been gone
    /// back over: that row is theirs to answer, and dropped.
    pub fn finish(&mut self, outcome: &mut Outcome, from: Option<Crossing<T>>) -> Option<Crossing<T>> {
        let (first, failed) = (self.first(outcome), outcome.failure.is_some());
        let out = &mut outcome.estimates;
        let is_answered = from.is_some();
        let back = self.back(out, from);
        match &back {
            Ok(_) if is_answered => out.truncate(out.len().saturating_sub(1)),
            Ok(_) => {}
            Err((row, error)) => {
                // a smoothed covariance that does not exist: filtered rows are no answer to the question
                let time = out.time.get(*row).copied().unwrap_or(error.time);
                let step = first + row + 1;
                outcome.failure.get_or_insert((first + row, StepError { time, step, ..*error }));
                out.truncate(match self.task.goal {
                    Goal::Lag(lag) => out.len().saturating_sub(lag),
                    _ => 0,
                });
            }
        }
        let failed = failed || back.is_err();
        outcome.at = self.between.cut(&outcome.estimates, failed);
        back.ok().flatten()
    }

    /// The same; what fails, with its row among those of `out`.
    fn back(
        &mut self,
        out: &mut Estimates,
        mut from: Option<Crossing<T>>,
    ) -> Result<Option<Crossing<T>>, (usize, StepError)> {
        let Some(last) = out.len().checked_sub(1) else { return Ok(None) };
        let steps = match self.task.goal {
            Goal::Interval => last,
            Goal::Lag(lag) => lag.min(last),
            Goal::Filter | Goal::Point(_) => return Ok(None),
        };
        let (time, answered) = (out.time[last], from.is_some());
        let (between, watch) = (&mut self.between, self.task.watch);
        if let Some(from) = &mut from {
            let filtered = (out.filtered_mean(last), out.filtered_cov(last));
            let closed = self.history.close(&mut self.filter);
            let done = closed.and_then(|()| between.back::<X::Form>(last, time, &from.lend(), filtered));
            done.map_err(|error| (last, error))?;
        }
        let (mut row, mut wrong, mut first) = (last, None, None);
        let visit = |age: usize, smoothed: &Smoothed<T>| {
            row = last - age;
            if !(answered && age == 0) {
                put::<X::Form, T>(out, row, &smoothed.belief);
                let filtered = (out.filtered_mean(row), out.filtered_cov(row));
                wrong = between.back::<X::Form>(row, out.time[row], smoothed, filtered).err();
            }
            if row == 0 {
                first = Some(Crossing::of(smoothed));
            }
            // another recorder's record may lie behind the first row
            let ends = watch.stopped() || wrong.is_some() || row == 0;
            if ends { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let start = Prior { time, mean: &self.last.0, factor: &self.last.1, cov: &self.last.2 };
        let done = match (from, self.reached) {
            (Some(mut from), _) => self.history.smooth_on(time, &from.lend(), visit),
            (None, Reached::Nothing) => self.history.smooth(&self.filter, steps, visit),
            (None, Reached::Leaving) => self.history.smooth_from::<X::Form, _>(start, 0, steps, visit),
            (None, Reached::Itself) => self.history.smooth_from::<X::Form, _>(start, 1, steps, visit),
        };
        match (done, wrong) {
            (Err(error), _) => Err((row.saturating_sub(1), error)),
            (Ok(()), Some(error)) => Err((row, error)),
            (Ok(()), None) => Ok(first),
        }
    }
}

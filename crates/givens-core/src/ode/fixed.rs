//! Steps of equal length.

use super::field::{Field, Method, finite};
use super::segment::{Segment, Visit};
use super::{Steps, Stop, System, Why, Work};
use crate::model::At;
use crate::scalar::{Inside, Real};

/// How many steps a gap takes, if not more than `limit`. The count is that of the first lane.
#[inline(always)]
fn count<T: Real>(steps: Steps, gap: f64, limit: usize) -> Option<usize> {
    let count = match steps {
        Steps::Count(count) => count,
        Steps::Longest(longest) => {
            // a gap that is a whole number of steps but for its rounding is so many
            let ratio = gap.abs() / longest * (1.0 - 8.0 * T::EPSILON);
            let up = -Real::floor(-ratio);
            if up <= limit as f64 { (up as usize).max(1) } else { 0 }
        }
    };
    (1..=limit).contains(&count).then_some(count)
}

/// An integration over a gap; `end` has the length of the state, `curve` three times that.
pub(super) struct Fixed<'s, 'f, 'v, T, S, M> {
    pub method: &'s mut M,
    pub field: &'s mut Field<'f, S, T>,
    pub at: &'s At<'s, T>,
    pub steps: (Steps, usize),
    pub y: &'s mut [T],
    pub visit: Visit<'v, T>,
    pub work: &'s mut Work,
    pub end: &'s mut [T],
    pub curve: &'s mut [T],
}

impl<T: Real, S: System, M: Method<T, S>> Inside for Fixed<'_, '_, '_, T, S, M> {
    type Output = Result<(), Stop<S::Fault>>;
    #[inline(always)]
    fn go(self) -> Self::Output {
        let Self { method, field, at, steps: (steps, limit), y, mut visit, work, end, curve } = self;
        let gap = at.dt.first();
        let Some(count) = count::<T>(steps, gap, limit) else {
            return Err(Stop { time: at.t.first(), smallest: gap.abs(), why: Why::StepLimit { limit } });
        };
        let h = at.dt / T::of(count as f64);
        let time = |k: usize| T::of(k as f64).mul_add(h, at.t);
        let stop = |k: usize, why| Stop { time: time(k).first(), smallest: h.first().abs(), why };
        method.start(field, at.t, y).map_err(|failed| stop(0, failed.into()))?;
        for k in 0..count {
            let step = method.step(field, time(k), h, y, end).and_then(|()| finite(end));
            step.map_err(|failed| stop(k, failed.into()))?;
            let last = k + 1 == count;
            // the slope at the end of the gap serves dense output alone
            let slope = (!last || visit.is_some()).then(|| method.finish(field, time(k + 1), end));
            if let Some(visit) = visit.as_deref_mut() {
                method.curve(h, y, end, matches!(slope, Some(Ok(()))), curve);
                visit(&Segment { t: time(k).first(), h: h.first(), start: y, end, curve });
            }
            y.copy_from_slice(end);
            work.accepted = work.accepted.saturating_add(1);
            if let (Some(Err(failed)), false) = (slope, last) {
                return Err(stop(k + 1, failed.into()));
            }
            method.accept();
        }
        Ok(())
    }
}

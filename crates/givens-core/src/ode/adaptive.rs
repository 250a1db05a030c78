//! Steps as long as the tolerance allows.

use super::control::Control;
use super::field::{Failed, Field, Method, finite};
use super::segment::{Segment, Visit};
use super::{Stop, System, Tolerance, Why, Work};
use crate::model::At;
use crate::scalar::Real;

/// What an adaptive integration keeps to.
pub(super) struct Bounds {
    pub tolerance: Tolerance,
    pub longest: f64,
    pub limit: usize,
    /// The length of the first step, if it is not to be found.
    pub first: Option<f64>,
}

/// Integrates over the gap; `end` and `error` have the length of the state, `curve` three times that.
pub(super) fn adaptive<T: Real, S: System, M: Method<T, S>>(
    method: &mut M,
    field: &mut Field<S, T>,
    at: &At<T>,
    bounds: &Bounds,
    y: &mut [T],
    mut visit: Visit<T>,
    work: &mut Work,
    (end, error, curve): (&mut [T], &mut [T], &mut [T]),
) -> Result<(), Stop<S::Fault>> {
    let (time, gap) = (at.t.first(), at.dt.first());
    let (length, sign) = (gap.abs(), 1.0_f64.copysign(gap));
    let mut stop = Stop { time, smallest: length, why: Why::StepTooSmall };

    let start = finite(y).and_then(|()| method.start(field, at.t, y));
    start.map_err(|failed: Failed<S::Fault>| Stop { why: failed.into(), ..stop })?;
    // elapsed time is carried in f64, whatever the scalar
    let shortest = 16.0 * (T::EPSILON * length).max(f64::EPSILON * time.abs().max((time + gap).abs()));
    let mut h = match bounds.first {
        Some(first) => first,
        None => first_step(method, field, at, bounds, sign, y, (&mut *end, &mut *error)).max(shortest),
    };

    let mut control = Control::new(M::ERROR_ORDER);
    let mut elapsed = 0.0;
    for _ in 0..bounds.limit {
        h = h.min(bounds.longest);
        let rest = length - elapsed;
        // no tiny step is left over at the end of the gap
        let last = rest <= bounds.longest * (1.0 + 1e-12) && rest <= 1.01 * h;
        if last {
            h = rest;
        } else if h.is_nan() || h < shortest {
            return Err(stop);
        }
        stop.smallest = stop.smallest.min(h);
        let (from, to) = (at.t + T::of(sign * elapsed), at.t + T::of(sign * (elapsed + h)));
        let step = T::of(sign * h);
        match attempt(method, field, bounds.tolerance, (from, to, step), y, (&mut *end, &mut *error)) {
            Ok(size) if size <= 1.0 => {
                if let Some(visit) = visit.as_deref_mut() {
                    method.curve(step, y, end, true, curve);
                    visit(&Segment { t: stop.time, h: sign * h, start: y, end, curve });
                }
                y.copy_from_slice(end);
                work.accepted = work.accepted.saturating_add(1);
                if last {
                    return Ok(());
                }
                method.accept();
                elapsed += h;
                (stop.time, stop.why) = (time + sign * elapsed, Why::StepTooSmall);
                h = control.accepted(h, size);
                continue;
            }
            Ok(size) => {
                stop.why = Why::StepTooSmall;
                h = control.too_large(h, size);
            }
            Err(failed) => {
                stop.why = failed.into();
                h = control.failed(h);
            }
        }
        work.rejected = work.rejected.saturating_add(1);
    }
    Err(Stop { why: Why::StepLimit { limit: bounds.limit }, ..stop })
}

/// One step, and the size of its error in tolerances.
fn attempt<T: Real, S: System, M: Method<T, S>>(
    method: &mut M,
    field: &mut Field<S, T>,
    tolerance: Tolerance,
    (from, to, h): (T, T, T),
    y: &[T],
    (end, error): (&mut [T], &mut [T]),
) -> Result<f64, Failed<S::Fault>> {
    method.step(field, from, h, y, end)?;
    finite(end)?;
    method.finish(field, to, end)?;
    method.error(h, error);
    finite(error)?;
    Ok(field.system.error(tolerance, y, end, error))
}

/// A first step, from the sizes of y, f and the change of f over a short Euler step (after Hairer, Nørsett & Wanner 1993,
/// §II.4), in the system's own norm; a change of the units of time or state changes nothing.
fn first_step<T: Real, S: System, M: Method<T, S>>(
    method: &mut M,
    field: &mut Field<S, T>,
    at: &At<T>,
    bounds: &Bounds,
    sign: f64,
    y: &[T],
    (end, bend): (&mut [T], &mut [T]),
) -> f64 {
    let longest = at.dt.first().abs().min(bounds.longest);
    let system = field.system;
    let size = |error: &[T]| system.error(bounds.tolerance, y, y, error);
    let slope = size(method.slopes().0);
    let short = 0.01 * size(y) / slope;
    // a state or a slope of zero says nothing
    let short = if short > 0.0 && short.is_finite() { short.min(longest) } else { 1e-3 * longest };
    let h = T::of(sign * short);
    for (i, end) in end.iter_mut().enumerate() {
        *end = method.slopes().0[i].mul_add(h, y[i]);
    }
    if method.finish(field, at.t + h, end).is_err() {
        return 0.25 * short;
    }
    let (start, later) = method.slopes();
    for (i, bend) in bend.iter_mut().enumerate() {
        *bend = later[i] - start[i];
    }
    let bend = size(bend) / short;
    if !bend.is_finite() {
        return 0.25 * short;
    }
    // an error of slope/rate (h rate)^order, rate = bend/slope, that is a hundredth of the tolerance
    let rate = bend / slope;
    let found = if rate > 0.0 && rate.is_finite() {
        Real::pow(0.01 * rate / slope, 1.0 / f64::from(M::ERROR_ORDER)) / rate
    } else if bend > 0.0 {
        Real::sqrt(0.01 / bend)
    } else {
        f64::INFINITY
    };
    found.min(100.0 * short).min(longest)
}

#[cfg(test)]
mod tests {
    use super::{Bounds, Field, adaptive};
    use crate::model::At;
    use crate::ode::explicit::{Explicit, explicit_scratch};
    use crate::ode::tableau::DP5;
    use crate::ode::{System, Tolerance, Work};
    use crate::scalar::Real;

    /// y'' = −y.
    struct Oscillator;

    impl System for Oscillator {
        type Fault = ();
        fn len(&self) -> usize {
            2
        }
        fn scratch(&self) -> usize {
            0
        }
        fn derivative<T: Real>(
            &self,
            _: &At<T>,
            _: &[T],
            y: &[T],
            dy: &mut [T],
            _: &mut [T],
        ) -> Result<(), ()> {
            (dy[0], dy[1]) = (y[1], -y[0]);
            Ok(())
        }
        fn error<T: Real>(&self, tolerance: Tolerance, before: &[T], _: &[T], error: &[T]) -> f64 {
            error[0].hypot(error[1]).first() / tolerance.of(before[0].hypot(before[1]).first())
        }
    }

    #[test]
    fn the_result_does_not_depend_on_the_first_step_to_ten_tolerances() {
        let length = 7.0;
        for rtol in [1e-4, 1e-7, 1e-10] {
            for first in [None, Some(1e-12), Some(1e-6), Some(1e-2), Some(1.0), Some(7.0), Some(1e6)] {
                let tolerance = Tolerance { rtol, atol: 0.0 };
                let bounds = Bounds { tolerance, longest: f64::INFINITY, limit: 100_000, first };
                let (mut slopes, mut memory) = ([0.0; explicit_scratch(&DP5, 2)], [[0.0; 6]; 3]);
                let mut method = Explicit { tableau: &DP5, k: &mut slopes, len: 2 };
                let mut field =
                    Field { system: &Oscillator, u: &[], p: &[], table: &[], scratch: &mut [], calls: 0 };
                let at = At { t: 0.0, dt: length, u: &[], p: &[] };
                let (mut y, mut work) = ([1.0, 0.0], Work::default());
                let [end, error, curve] = &mut memory;
                let memory = (&mut end[..2], &mut error[..2], &mut curve[..]);
                adaptive(&mut method, &mut field, &at, &bounds, &mut y, None, &mut work, memory).unwrap();
                let error = (y[0] - length.cos()).hypot(y[1] + length.sin()) / rtol;
                assert!(error < 10.0, "first step {first:?}: {error} times {rtol:e}");
            }
        }
    }
}

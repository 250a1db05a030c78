//! Steps as long as the tolerance allows.

use super::control::Control;
use super::field::{Failed, Field, Method};
use super::integrator::Integrator;
use super::segment::{Segment, Visit};
use super::{Steps, Stop, System, Tolerance, Why, Work, not_finite};
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

impl Bounds {
    pub fn new(integrator: &Integrator) -> Self {
        let longest = match integrator.steps {
            Steps::Count(_) => f64::INFINITY,
            Steps::Longest(longest) => longest,
        };
        Self { tolerance: integrator.tolerance, longest, limit: integrator.limit, first: None }
    }
}

/// Integrates over the gap; `end` and `error` have the length of the state, `curve` three times that.
#[inline(always)]
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

    method.start(field, at.t, y).map_err(|fault| Stop { why: Why::System(fault), ..stop })?;
    if let Some(component) = not_finite(y).or(not_finite(method.slopes().0)) {
        return Err(Stop { why: Why::NotFinite { component }, ..stop });
    }
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
        let last = rest <= bounds.longest && rest <= 1.01 * h;
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
                work.accepted += 1;
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
                stop.why = match failed {
                    Failed::System(fault) => Why::System(fault),
                    Failed::NotFinite(component) => Why::NotFinite { component },
                    Failed::Singular => Why::StepTooSmall,
                };
                h = control.failed(h);
            }
        }
        work.rejected += 1;
    }
    Err(Stop { why: Why::StepLimit { limit: bounds.limit }, ..stop })
}

/// One step, and the size of its error in tolerances.
#[inline(always)]
fn attempt<T: Real, S: System, M: Method<T, S>>(
    method: &mut M,
    field: &mut Field<S, T>,
    tolerance: Tolerance,
    (from, to, h): (T, T, T),
    y: &[T],
    (end, error): (&mut [T], &mut [T]),
) -> Result<f64, Failed<S::Fault>> {
    let finite =
        |values: &[T]| not_finite(values).map_or(Ok(()), |component| Err(Failed::NotFinite(component)));
    method.step(field, from, h, y, end)?;
    finite(end)?;
    method.finish(field, to, end)?;
    finite(method.slopes().1)?;
    method.error(h, error);
    finite(error)?;
    Ok(field.system.error(tolerance, y, end, error))
}

/// A first step, from the sizes of y, f and the change of f over a short Euler step (after Hairer, Nørsett & Wanner 1993
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

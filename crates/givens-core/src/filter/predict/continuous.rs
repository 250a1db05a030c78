//! What the time updates of continuous models share: sizes, steps, and what they ask of the diffusion.

use super::Plan;
use crate::filter::error::Fault;
use crate::filter::sizes::Sizes;
use crate::model::{At, Sde, Varies, scratch_for};
use crate::ode::{Integrator, Steps};
use crate::rule::RuleError;
use crate::scalar::{Dual2, Mask, Real, as_duals};

/// The steps of a fixed division, in their range.
pub(super) fn check_steps(steps: Steps) -> Result<(), Fault> {
    Integrator { steps, ..Integrator::default() }.check().map_err(Fault::Option)
}

/// A solver's options, for moments: in standard deviations, an error of one is no answer.
pub(super) fn check_integrator(integrator: &Integrator) -> Result<(), Fault> {
    integrator.check().map_err(Fault::Option)?;
    let rtol = integrator.tolerance.rtol;
    if integrator.solver.adaptive() && rtol >= 1.0 {
        let must = "must be below 1: it is in standard deviations";
        return Err(Fault::Option(RuleError { option: "rtol", value: rtol, must }));
    }
    Ok(())
}

/// A continuous model, as its time updates see it.
pub(super) struct Continuous<'m, M>(pub &'m M);

impl<M: Sde> Continuous<'_, M> {
    /// Its sizes, with `model` scalars of scratch of its own.
    pub fn sizes(&self, model: usize) -> Sizes {
        Sizes {
            states: self.0.states(),
            process_noise: self.0.noises(),
            measures: 0,
            measurement_noise: 0,
            controls: self.0.controls(),
            parameters: self.0.parameters().len(),
            model,
        }
    }

    /// Its sizes, with the scratch of a map of it for so many points, that may go side by side, and at least `least`.
    pub fn sizes_for(&self, map: impl Fn(usize) -> usize, points: usize, least: usize) -> Sizes {
        let sizes = self.sizes(0);
        Sizes { model: scratch_for(map, points, sizes.beside()).max(least), ..sizes }
    }

    /// Whether the diffusion, at one state, depends on no more than it says.
    pub fn probe<T: Real>(&self, at: &At<T>, x: &[T], scratch: &mut [T]) -> Result<(), Fault> {
        let (n, q, varies) = (x.len(), self.0.noises(), self.0.diffusion_varies());
        let (point, rest) = as_duals(scratch).split_at_mut(n);
        let (g, rest) = rest.split_at_mut(n * q);
        let (u, rest) = rest.split_at_mut(at.u.len());
        let p = &mut rest[..at.p.len()];
        let constants = point.iter_mut().zip(x).chain(u.iter_mut().zip(at.u)).chain(p.iter_mut().zip(at.p));
        constants.for_each(|(dual, &x)| *dual = Dual2::constant(x));
        let still = Dual2::constant(at.t);
        let mut moves = |t: Dual2<T>, point: &[Dual2<T>], u: &[Dual2<T>], p: &[Dual2<T>]| {
            self.0.diffusion(&At { t, dt: Dual2::constant(at.dt), u, p }, point, g);
            // what overflows has a derivative that is no number, and is told when it is used
            let moved = |d: T| d.lt(T::zero()) | T::zero().lt(d);
            g.iter().any(|g| (moved(g.d) | moved(g.dd)).any())
        };
        if varies == Varies::Never && moves(Dual2::variable(at.t), point, u, p) {
            return Err(Fault::Mismatch {
                why: "the diffusion depends on the time; diffusion_varies must say so",
            });
        }
        for i in 0..if varies == Varies::WithState { 0 } else { n } {
            point[i] = Dual2::variable(x[i]);
            if moves(still, point, u, p) {
                return Err(Fault::Mismatch {
                    why: "the diffusion depends on the state; diffusion_varies must say so",
                });
            }
            point[i] = Dual2::constant(x[i]);
        }
        Ok(())
    }

    /// A diffusion that does not depend on the state.
    pub fn additive(&self) -> Result<(), Fault> {
        match self.0.diffusion_varies() {
            Varies::WithState => Err(Fault::StateDependentDiffusion),
            _ => Ok(()),
        }
    }
}

impl Plan {
    /// A gap in one piece.
    pub(super) fn whole(gap: f64) -> Self {
        Self { count: usize::from(gap > 0.0), dt: gap }
    }

    /// A gap divided as the user says.
    ///
    /// # Errors
    /// More steps than a gap may have.
    pub fn of(steps: Steps, gap: f64) -> Result<Self, Fault> {
        let count = match steps {
            _ if gap == 0.0 => 0,
            Steps::Count(count) => count,
            // a gap that is a whole number of longest steps, but for rounding, takes no more than these
            Steps::Longest(longest) => (Real::floor(gap / longest * (1.0 - 1e-12)) + 1.0) as usize,
        };
        if count > Integrator::default().limit {
            let (option, must) = ("max_step", "must not divide a gap into more than 100000 steps");
            return Err(Fault::Option(RuleError { option, value: gap / count as f64, must }));
        }
        Ok(Self { count, dt: if count == 0 { 0.0 } else { gap / count as f64 } })
    }
}

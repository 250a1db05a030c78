//! A belief carried over a gap by a solver, and what a smoother needs to come back.

use super::columns::gather;
use super::gain::gain_of_covariance;
use super::image::Image;
use super::{Given, Stopped};
use crate::filter::backward::Backward;
use crate::filter::error::{Fault, Halt, Matrix};
use crate::filter::form::{Belief, Form};
use crate::filter::lanes::{endless, lanes};
use crate::filter::memory::{put_columns, take};
use crate::filter::quantity::Quantity;
use crate::filter::sizes::{ENDLESS, Sizes, fits};
use crate::kernels::{Health, copy_lower, dot, downdate, solve_lower, tria};
use crate::model::At;
use crate::ode::{Integrator, Segment, Solver, Stop, System, Why, Work};
use crate::rule::RuleError;
use crate::scalar::{Mask, Real};

/// A system whose state is a belief: the mean first, then its spread, then the matrix X of C13.
pub(super) trait Carrier: System<Fault = Fault> {
    /// What moves it.
    type Image: Image;
    /// It.
    fn image(&self) -> Self::Image;
    /// The same without X.
    fn alone(&self) -> Self;
    /// The state of the solver at a belief.
    fn begin<T: Real>(&self, belief: &Belief<T>, y: &mut [T]);
    /// The lower triangular root of the covariance.
    fn factor<T: Real>(&self, y: &[T], factor: &mut [T]) -> Result<(), Fault>;
    /// The root that the solver has carried, of which `factor` is the lower triangular one.
    #[inline(always)]
    fn root<T: Real>(&self, _: &[T], factor: &[T], root: &mut [T]) {
        root.copy_from_slice(factor);
    }
    /// The covariance, n × n, of which `factor` is the root.
    fn covariance<T: Real>(&self, y: &[T], factor: &[T], cov: &mut [T]);
    /// X, n × n; empty if it is not carried.
    fn carried<'y, T>(&self, y: &'y [T]) -> &'y [T];
}

/// Nodes and weights of Gauss's quadrature over [0, 1], exact to degree 5.
const NODES: [(f64, f64); 3] =
    [(0.112_701_665_379_258_31, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// Scalars of scratch of [`integrate`], for a table of length `table`.
pub(super) const fn integrate_scratch(
    integrator: &Integrator,
    lengths: Lengths,
    sizes: Sizes,
    table: usize,
) -> usize {
    let Sizes { states: n, process_noise: columns, controls, parameters, .. } = sizes;
    // a Rosenbrock method has a matrix over the whole state
    let width = if matches!(integrator.solver, Solver::Rodas4) { lengths.state } else { 1 };
    if !fits(lengths.state, width, 8) {
        return ENDLESS;
    }
    let solver = integrator.scratch(lengths.state, lengths.system, controls + parameters, table);
    lengths.state + n * n + solver + conditional_scratch(n, columns, lengths)
}

/// The lengths of a [`Carrier`].
#[derive(Clone, Copy)]
pub(super) struct Lengths {
    /// Of its state.
    pub state: usize,
    /// Of the scratch of its derivative.
    pub system: usize,
    /// Of the scratch of its image.
    pub image: usize,
}

/// Moves `belief` over the gap of `given.at`.
///
/// With `back`, X goes along. Steps of equal length are those of the belief alone; a solver that chooses its steps goes over
/// the gap twice, once with X in mind and once without: what is believed does not depend on whether it is smoothed, and X
/// may move where the belief stands still.
#[inline(always)]
pub(super) fn integrate<T: Real, C: Carrier, F: Form, M, R>(
    integrator: &Integrator,
    carrier: &C,
    given: &Given<T, M, R>,
    belief: &mut Belief<T>,
    back: Option<&mut Backward<T>>,
    work: &mut Work,
    mut scratch: &mut [T],
) -> Result<T::Mask, Stopped> {
    let n = belief.mean.len();
    let y = take(&mut scratch, carrier.len());
    let next = take(&mut scratch, n * n);
    let stopped =
        |stop: Stop<Fault>| Stopped { reached: Some(stop.time), fault: fault(&stop, n, integrator) };
    let mut sick = T::Mask::splat(false);
    let again = back.is_none() || integrator.solver.adaptive();
    if let Some(back) = back {
        carrier.begin(belief, y);
        sick = way_back::<T, C, F, M, R>(integrator, carrier, given, belief, y, next, back, work, scratch)?;
    }
    let carrier = carrier.alone();
    let y = &mut y[..carrier.len()];
    if again {
        carrier.begin(belief, y);
        integrator.advance(&carrier, &given.at, given.table, y, work, scratch).map_err(stopped)?;
        carrier.factor(y, next)?;
    }
    sick = sick | endless(&y[..n], next, n)?;
    belief.mean.copy_from_slice(&y[..n]);
    if !F::SQUARE_ROOT {
        carrier.covariance(y, next, belief.cov);
    }
    belief.factor.copy_from_slice(next);
    if !belief.moved.is_empty() {
        carrier.root(y, next, belief.moved);
    }
    Ok(sick)
}

/// Moves `y` over the gap, its factor to `next`, and finds what a smoother needs to come back.
#[inline(always)]
fn way_back<T: Real, C: Carrier, F: Form, M, R>(
    integrator: &Integrator,
    carrier: &C,
    given: &Given<T, M, R>,
    belief: &Belief<T>,
    y: &mut [T],
    next: &mut [T],
    back: &mut Backward<T>,
    work: &mut Work,
    scratch: &mut [T],
) -> Result<T::Mask, Stopped> {
    let n = belief.mean.len();
    let (at, table) = (&given.at, given.table);
    let stopped =
        |stop: Stop<Fault>| Stopped { reached: Some(stop.time), fault: fault(&stop, n, integrator) };
    let mut sick = T::Mask::splat(false);
    if F::SQUARE_ROOT {
        back.conditional.fill(T::zero());
        let (plus, minus) = carrier.image().noises();
        let lengths =
            Lengths { state: carrier.len(), system: carrier.scratch(), image: carrier.image().scratch() };
        let (own, rest) = scratch.split_at_mut(conditional_scratch(n, plus + minus, lengths));
        let mut failed = None;
        let gather =
            |segment: &Segment<T>| match conditional(carrier, at, table, segment, back.conditional, own) {
                Ok(mask) => sick = sick | mask,
                Err(fault) => failed = failed.or(Some(Stopped { reached: Some(segment.t), fault })),
            };
        integrator.solve(carrier, at, table, y, work, gather, rest).map_err(stopped)?;
        failed.map_or(Ok(()), Err)?;
    } else {
        integrator.advance(carrier, at, table, y, work, scratch).map_err(stopped)?;
    }
    carrier.factor(y, next)?;
    // Ω = (S⁻¹ X)ᵀ
    for (j, row) in back.gain.chunks_exact_mut(n).enumerate() {
        gather(carrier.carried(y), n, j, row);
        solve_lower(next, n, row);
    }
    resolved(back, n)?;
    if !F::SQUARE_ROOT {
        // G = S₀ Xᵀ (P⁻)⁻¹
        gain_of_covariance(carrier.carried(y), n, belief.factor, next, back);
    }
    Ok(sick)
}

/// Ω Ωᵀ + Γ Γᵀ = I whatever the model, and Ω Ωᵀ ≤ I where Γ is not computed. Equal steps that are too long for X break it.
const ROUGH: f64 = 0.25;

#[inline(always)]
fn resolved<T: Real>(back: &Backward<T>, n: usize) -> Result<(), Fault> {
    for (i, omega) in back.gain.chunks_exact(n).enumerate() {
        let rest = back.conditional.chunks_exact(n).nth(i).map(|gamma| dot(gamma, gamma));
        let whole = dot(omega, omega) + rest.unwrap_or(T::zero());
        let under = rest.is_some() && (whole.lt(T::of(1.0 - ROUGH))).all();
        if under || (T::of(1.0 + ROUGH).lt(whole)).all() {
            return Err(Fault::Unresolved { component: i });
        }
    }
    Ok(())
}

/// A solver's end in the words of a step.
fn fault(stop: &Stop<Fault>, states: usize, integrator: &Integrator) -> Fault {
    let halt = |why| Fault::Solver { why, smallest: stop.smallest };
    match stop.why {
        Why::System(fault) => fault,
        Why::NotFinite { component } if component < states => {
            Fault::NotFinite { quantity: Quantity::Drift, component }
        }
        Why::NotFinite { .. } => Fault::NotPositive { matrix: Matrix::Predicted, pivot: 0 },
        Why::StepLimit { .. } if !integrator.solver.adaptive() => {
            let (value, must) = (stop.smallest, "must not divide a gap into more than 100000 steps");
            Fault::Option(RuleError { option: "max_step", value, must })
        }
        Why::StepLimit { limit } => halt(Halt::StepLimit { limit }),
        Why::StepTooSmall => halt(Halt::StepTooSmall),
    }
}

const fn conditional_scratch(n: usize, columns: usize, lengths: Lengths) -> usize {
    lengths.state + 2 * n * n + n * columns + n * (n + columns) + n + lengths.image
}

/// Adds to Γ what a step leaves unknown of the state at the start of the gap, in the coordinates of the roots: Γ Γᵀ =
/// ∫ Kᵀ H J Hᵀ K dt along the way, K = S⁻¹ X and H = S⁻¹ N (docs/algorithms.md C14). No difference is taken.
#[inline(always)]
fn conditional<T: Real, C: Carrier>(
    carrier: &C,
    at: &At<T>,
    table: &[T],
    segment: &Segment<T>,
    root: &mut [T],
    mut scratch: &mut [T],
) -> Result<T::Mask, Fault> {
    let image = carrier.image();
    let n = image.states();
    let (plus, minus) = image.noises();
    let columns = plus + minus;
    let y = take(&mut scratch, carrier.len());
    let s = take(&mut scratch, n * n);
    let k = take(&mut scratch, n * n);
    let noise = take(&mut scratch, n * columns);
    let stride = n + plus;
    let wide = take(&mut scratch, n * stride);
    let column = take(&mut scratch, n);
    let mut health = Health::good();
    for (theta, weight) in NODES {
        segment.at(theta, y);
        carrier.factor(y, s)?;
        let at = At { t: T::of(segment.t + theta * segment.h), dt: T::zero(), ..*at };
        image.noise(&at, table, &y[..n], s, noise, scratch)?;
        // K = S⁻¹ X, stored column by column
        for j in 0..n {
            let row = &mut k[j * n..(j + 1) * n];
            gather(carrier.carried(y), n, j, row);
            solve_lower(s, n, row);
        }
        put_columns(wide, stride, 0, root, n);
        let length = T::of(weight * segment.h).sqrt();
        for j in 0..columns {
            gather(noise, columns, j, column);
            solve_lower(s, n, column);
            for (i, k) in k.chunks_exact(n).enumerate() {
                let x = length * dot(k, column);
                if j < plus {
                    wide[i * stride + n + j] = x;
                } else {
                    noise[i * columns + j] = x;
                }
            }
        }
        health = health.and(tria(wide, n, stride, stride));
        for j in plus..columns {
            gather(noise, columns, j, column);
            health = health.and(downdate(wide, n, stride, column));
        }
        copy_lower(root, n, wide, stride);
    }
    lanes(health, Matrix::Conditional)
}

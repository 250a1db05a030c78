//! Measurement updates: what a measurement teaches about the state.

mod covariance;
mod innovation;
mod joint;
mod learnt;
mod sensed;
mod separate;

pub use innovation::Innovation;
pub(crate) use innovation::InnovationMut;
pub use learnt::Learnt;
use learnt::{turned, turned_scratch};

use super::error::{Fault, Quantity};
use super::form::{Belief, Form};
use crate::model::{At, Observation};
use crate::rule::{Rule, Shape, spread_scratch};
use crate::scalar::{Mask, Real};
use sensed::{Sensed, sense, sense_scratch};

/// The block that a square-root measurement update triangularises.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Block {
    /// Innovation, gain and posterior by one triangularisation (2010 eq 36; 2011 eq 27).
    #[default]
    Joint,
    /// Innovation and posterior one after the other (2009 Appendix B).
    Separate,
}

/// A measurement, and which of its components are there (`None`: all).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measurement<'a, T> {
    pub z: &'a [T],
    pub present: Option<&'a [bool]>,
}

/// Scalars of scratch of [`update`]: d measures, r noise columns, `map` of the model's own.
pub(crate) const fn update_scratch(
    n: usize,
    d: usize,
    r: usize,
    shape: Shape,
    map: usize,
    smoothing: bool,
) -> usize {
    let joint = joint::joint_scratch(n, d, shape.plus + r);
    let separate = separate::separate_scratch(n, d, n + shape.plus + r);
    let covariance = covariance::covariance_scratch(n, d, n + shape.plus + r, shape.minus);
    let mut block = if joint > separate { joint } else { separate };
    block = if covariance > block { covariance } else { block };
    let spread = spread_scratch(shape, n, d, map);
    let rotation = if smoothing { turned_scratch(n, d, shape.plus + r) } else { 0 };
    sense_scratch(n, d, r, shape) + rotation + if block > spread { block } else { spread }
}

/// What an update did.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Updated<T: Real> {
    /// Components that were there.
    pub present: usize,
    /// The lanes in which one of them had no more noise than rounding.
    pub exact: T::Mask,
    /// The lanes that a kernel could not serve.
    #[allow(dead_code, reason = "for packs")]
    pub sick: T::Mask,
}

/// Updates `belief` by a measurement, and writes the innovation. With no component there,
/// or after a fault, the belief is as before (but for a mean that has overflowed).
#[inline(always)]
pub(crate) fn update<T: Real, H: Observation, R: Rule, F: Form>(
    rule: &R,
    block: Block,
    table: &[T],
    h: &H,
    at: &At<T>,
    measurement: Measurement<T>,
    belief: &mut Belief<T>,
    innovation: &mut InnovationMut<T>,
    learnt: Option<&mut Learnt<T>>,
    mut scratch: &mut [T],
) -> Result<Updated<T>, Fault> {
    let (sensed, mut sick) = sense(rule, table, h, at, &measurement, belief, innovation, &mut scratch)?;
    if sensed.d == 0 {
        (*innovation.nis, *innovation.log_likelihood) = (T::zero(), T::zero());
        return Ok(Updated { present: 0, exact: T::Mask::splat(false), sick });
    }
    let (n, in_whole) = (belief.mean.len(), |fault| measurement.in_whole(fault));
    let rotation = match &learnt {
        Some(_) => {
            let (rotation, more) = turned(&sensed, n, belief.factor, &mut scratch).map_err(in_whole)?;
            sick = sick | more;
            Some(rotation)
        }
        None => None,
    };
    let more = match (F::SQUARE_ROOT, block) {
        (false, _) => covariance::update(&sensed, belief, innovation, scratch),
        (true, Block::Joint) => joint::update(&sensed, belief, innovation, scratch),
        (true, Block::Separate) => separate::update(&sensed, belief, innovation, scratch),
    };
    sick = sick | more.map_err(in_whole)?;
    if let (Some(learnt), Some(rotation)) = (learnt, rotation) {
        rotation.settle(belief.factor);
        learnt.add(rotation.block, sensed.d, &innovation.white[..sensed.d], scratch);
    }
    if let Some(component) = belief.mean.iter().position(|m| (!m.finite()).all()) {
        return Err(Fault::NotFinite { quantity: Quantity::Estimate, component });
    }
    innovation.score(sensed.d);
    Ok(Updated { present: sensed.d, exact: sensed.exact, sick })
}

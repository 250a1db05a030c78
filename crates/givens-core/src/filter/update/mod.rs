//! Measurement updates: what a measurement teaches about the state.

mod covariance;
mod innovation;
mod joint;
mod learnt;
mod posterior;
mod sensed;
mod separate;
mod square_root;

pub use innovation::Innovation;
pub(crate) use innovation::InnovationMut;
pub use learnt::Learnt;
pub(crate) use posterior::Posterior;

use super::error::Fault;
use super::form::{Belief, Form};
use crate::filter::memory::larger;
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

/// Which components of a measurement are there.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Present<'a, T: Real> {
    All,
    /// In every lane the same.
    Some(&'a [bool]),
    /// In each lane its own. All are counted, also those that no lane has.
    Lanes(&'a [T::Mask]),
}

impl<T: Real> Present<'_, T> {
    /// The lanes in which component `i` is there.
    #[inline(always)]
    pub fn lanes(&self, i: usize) -> T::Mask {
        match self {
            Self::All => T::Mask::splat(true),
            Self::Some(present) => T::Mask::splat(present[i]),
            Self::Lanes(masks) => masks[i],
        }
    }

    /// Whether component `i` has a row of its own.
    #[inline(always)]
    pub fn counts(&self, i: usize) -> bool {
        match self {
            Self::All | Self::Lanes(_) => true,
            Self::Some(present) => present[i],
        }
    }
}

/// A measurement, and which of its components are there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measurement<'a, T: Real> {
    pub z: &'a [T],
    pub present: Present<'a, T>,
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
    let columns = n + shape.plus + r;
    let square_root = square_root::square_root_scratch(n, d, shape.plus + r, smoothing);
    let covariance = covariance::covariance_scratch(n, d, columns, shape.minus);
    let spread = spread_scratch(shape, n, d, map);
    let of_block = larger(square_root, covariance);
    sense_scratch(n, d, r, shape) + larger(of_block, spread)
}

/// What an update found. Nothing is changed yet but the innovation.
pub(crate) struct Updated<'a, T: Real> {
    /// Components that were counted.
    pub present: usize,
    /// The lanes in which one of them had no more noise than rounding.
    pub exact: T::Mask,
    /// The lanes that a kernel could not serve.
    pub sick: T::Mask,
    /// What is believed now; none without any component.
    pub posterior: Option<Posterior<'a, T>>,
}

/// What `belief` becomes by a measurement; writes the innovation. With `learning`, also what a smoother needs.
#[inline(always)]
pub(crate) fn update<'a, T: Real, H: Observation, R: Rule, F: Form>(
    rule: &R,
    block: Block,
    table: &[T],
    h: &H,
    at: &At<T>,
    measurement: Measurement<T>,
    belief: &Belief<T>,
    innovation: &mut InnovationMut<T>,
    learning: bool,
    mut scratch: &'a mut [T],
) -> Result<Updated<'a, T>, Fault> {
    let (sensed, sick) = sense(rule, table, h, at, &measurement, belief, innovation, &mut scratch)?;
    let Sensed { d: present, exact, dof, .. } = sensed;
    if present == 0 {
        (*innovation.nis, *innovation.log_likelihood) = (T::zero(), T::zero());
        return Ok(Updated { present, exact: T::Mask::splat(false), sick, posterior: None });
    }
    let done = if F::SQUARE_ROOT {
        square_root::update(block, &sensed, belief, innovation, learning, scratch)
    } else {
        covariance::update(&sensed, belief, innovation, scratch)
    };
    let (posterior, more) = done.map_err(|fault| measurement.in_whole(fault))?;
    innovation.score(present, dof);
    Ok(Updated { present, exact, sick: sick | more, posterior: Some(posterior) })
}

//! Trajectories drawn from a model: of a [`Transition`] by [`simulate`], of an [`Sde`] by [`simulate_continuous`].

mod discrete;
mod path;
mod rows;
mod stream;

pub use path::{Path, Paths, Scheme};
pub use rows::Simulation;
pub use stream::Stream;

use crate::Row;
use crate::filter::{Gaussian, StepError};
use crate::model::{Observation, Sde, Transition};

/// Draws the initial state from `prior`, which holds at `t0`, and carries it through the rows: their times and controls
/// are used, and where a measurement is NaN the drawn one is too.
///
/// # Errors
/// A model that is not finite or whose noise is no covariance, a time that goes backwards, a gap that is not whole
/// steps.
pub fn simulate<'a, M: Transition, H: Observation>(
    model: &M,
    sensors: &H,
    rows: impl Iterator<Item = Row<'a>>,
    t0: f64,
    prior: &Gaussian,
    stream: &mut Stream,
) -> Result<Simulation, StepError> {
    rows::draw(discrete::Discrete::new(model), sensors, rows, t0, prior, stream)
}

/// Draws the initial state from `prior`, which holds at `t0`, and a path of the stochastic differential equation through
/// the rows, in the steps of `paths`; measurements as in [`simulate`].
///
/// ```
/// use givens::filter::Gaussian;
/// use givens::model::zoo::{Radar3d, Turn3d};
/// use givens::simulate::{Paths, Stream, simulate_continuous};
/// use givens::Data;
///
/// let mut times = Data::new(3);
/// for time in [1.0, 1.5, 4.0] {
///     times.push(time, &[0.0; 3])?; // which measures to draw: all
/// }
/// let prior = Gaussian::from_std(&[1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 0.1], &[0.0; 7])?;
/// let stream = &mut Stream::new(1, 0, 0);
/// let drawn = simulate_continuous(
///     &Turn3d::default(), &Radar3d::published(), times.rows(), 0.0, &prior, &Paths::default(), stream,
/// )?;
/// assert_eq!((drawn.states.len(), drawn.z.len()), (21, 9));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Options out of their range, a diffusion that depends on the state by the Itô–Taylor scheme, a model that is not
/// finite, measurement noise that is no covariance, a time that goes backwards.
pub fn simulate_continuous<'a, M: Sde, H: Observation>(
    model: &M,
    sensors: &H,
    rows: impl Iterator<Item = Row<'a>>,
    t0: f64,
    prior: &Gaussian,
    paths: &Paths,
    stream: &mut Stream,
) -> Result<Simulation, StepError> {
    let fail = |fault| StepError { fault, time: t0, step: 0 };
    let path = Path::new(model, *paths).map_err(fail)?;
    rows::draw(path, sensors, rows, t0, prior, stream)
}

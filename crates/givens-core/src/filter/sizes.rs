//! What the length of a filter's memory depends on.

use super::memory::larger;
use crate::model::{Observation, linear_scratch, points_scratch, scratch_for, side_by_side_scratch};
use crate::rule::Shape;

/// The sizes of a model and its sensors, as far as a filter's memory depends on them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// Length n of the state.
    pub states: usize,
    /// Columns of the root of Q; of G for continuous models, as the rule spreads them if G depends on the state.
    pub process_noise: usize,
    /// Length d of the longest measurement.
    pub measures: usize,
    /// Columns of the root of R of that measurement.
    pub measurement_noise: usize,
    /// Controls.
    pub controls: usize,
    /// Parameters.
    pub parameters: usize,
    /// Scratch of the model's own, for all points of the rule.
    pub model: usize,
}

impl Sizes {
    /// The sizes of a model whose noises have as many columns as rows and which overrides no provided method. A method for
    /// continuous models makes of these its own, by `sizes_for` of its type.
    #[must_use]
    pub const fn new(states: usize, measures: usize) -> Self {
        let longer = larger(states, measures);
        let (one, linear) = (points_scratch(states, longer), linear_scratch(states, longer, 0));
        let map = larger(one, linear);
        Self {
            states,
            process_noise: states,
            measures,
            measurement_noise: measures,
            controls: 0,
            parameters: 0,
            model: side_by_side_scratch(map, map, 0),
        }
    }

    /// Controls and parameters together.
    pub(crate) const fn beside(&self) -> usize {
        self.controls.saturating_add(self.parameters)
    }

    /// Room for so much scratch of a continuous model, and for a sensor that overrides no provided method.
    pub(super) const fn with_model_scratch(self, model: usize) -> Self {
        let (n, d) = (self.states, self.measures);
        let map = larger(points_scratch(n, d), linear_scratch(n, d, self.beside()));
        let sensor = side_by_side_scratch(map, map, self.beside());
        Self { model: larger(self.model, larger(model, sensor)), ..self }
    }

    /// Room for this sensor too.
    #[must_use]
    pub fn with_sensor<H: Observation>(self, sensor: &H, shape: Shape) -> Self {
        let d = sensor.measures();
        let model = scratch_for(|points| sensor.observe_scratch(points), shape.points, self.beside());
        Self {
            measures: self.measures.max(d),
            measurement_noise: self.measurement_noise.max(sensor.noise().columns(d)),
            model: self.model.max(model),
            ..self
        }
    }

    /// Room for this sensor in a filter over packs, some of whose lanes may lack a component that others have.
    #[must_use]
    pub fn with_sensor_in_lanes<H: Observation>(self, sensor: &H, shape: Shape) -> Self {
        let d = sensor.measures();
        let columns = sensor.noise().columns(d) + d;
        let sizes = self.with_sensor(sensor, shape);
        Self { measurement_noise: sizes.measurement_noise.max(columns), ..sizes }
    }

    /// Whether all of `other` fits into these.
    #[must_use]
    pub fn hold(&self, other: &Sizes) -> bool {
        self.states == other.states
            && self.measures >= other.measures
            && self.measurement_noise >= other.measurement_noise
            && self.model >= other.model
            && self.process_noise >= other.process_noise
            && self.controls >= other.controls
            && self.parameters >= other.parameters
    }
}

/// Whether the length of a filter's memory is a number that a `usize` holds; no memory is longer anyway.
pub(super) const fn countable(sizes: Sizes, shape: Shape) -> bool {
    let rows = sizes.states.saturating_add(sizes.measures);
    let noises = sizes.process_noise.saturating_add(sizes.measurement_noise);
    let images = shape.points.saturating_add(shape.plus).saturating_add(shape.minus);
    let alone = shape
        .table
        .saturating_add(sizes.model)
        .saturating_add(sizes.controls)
        .saturating_add(sizes.parameters);
    // every array of a filter is a fraction of this
    rows.saturating_mul(rows.saturating_add(noises).saturating_add(images)).saturating_add(alone)
        < usize::MAX / 128
}

/// A length that no memory has, and that may still be added to.
pub(super) const ENDLESS: usize = usize::MAX / 4;

/// Whether arrays of so many scalars, and a few times that, are a number that a `usize` holds.
pub(super) const fn fits(rows: usize, columns: usize, layers: usize) -> bool {
    rows.saturating_mul(columns).saturating_mul(layers) < usize::MAX / 128
}

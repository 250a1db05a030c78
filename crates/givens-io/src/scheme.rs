//! What a table has to do with a model: names, and when its belief holds.

use crate::model_file::{Model, Sensor};
use crate::table::Calendar;

/// What tables of measurements and of answers know of a model.
#[derive(Clone, Debug, Default)]
pub struct Scheme {
    /// Names of the states.
    pub states: Vec<String>,
    /// Columns of the controls.
    pub controls: Vec<String>,
    /// The sensors, in the order of the stacked measurement.
    pub sensors: Vec<Sensor>,
    /// The time at which the initial belief holds; none: at the first row of each track.
    pub time: Option<f64>,
    /// What to do where a track has rows before that time.
    pub late: &'static str,
    /// The instant from which that time counts, if it is one of the calendar.
    pub epoch: Option<Calendar>,
    /// The fixed length of a step, of which a gap is a whole number.
    pub step: Option<f64>,
    /// Tells the model from others.
    pub fingerprint: String,
}

impl Scheme {
    /// Number of measures of all sensors.
    #[must_use]
    pub fn measures(&self) -> usize {
        self.sensors.last().map_or(0, |sensor| sensor.measures.end)
    }
}

impl Model {
    /// What tables know of it.
    #[must_use]
    pub fn scheme(&self) -> Scheme {
        Scheme {
            states: self.states.clone(),
            controls: self.controls.clone(),
            sensors: self.sensors.clone(),
            time: self.time,
            late: "set `time` in [state] to the first row's or earlier, or leave it out",
            epoch: self.epoch,
            step: self.step(),
            fingerprint: self.fingerprint(),
        }
    }
}

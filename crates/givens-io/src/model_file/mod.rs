//! Model files.

mod angles;
mod beginning;
mod context;
mod covariance;
mod definitions;
mod document;
mod dynamics;
mod evaluate;
mod filter;
mod names;
mod read;
mod section;
mod sensor;
mod start;
mod state;
mod vocabulary;

pub use beginning::{BeginError, Beginning};
pub use dynamics::Dynamics;
pub use filter::{FilterSettings, Setting, SettingValue};
pub use sensor::Sensor;
pub use start::Start;
pub use state::Prior;

use givens_core::model::{At, Transition};
use givens_expr::ModelObservation;

use crate::error::InputErrors;
use crate::source::Source;
use crate::table::{Calendar, Row};

/// A model as its file describes it: sizes n states, d measures of all sensors.
///
/// ```
/// let model = givens_io::Model::parse(r#"
///     [state]
///     names = ["x", "vx"]
///     mean = [0, 1]
///     std = { x = 10, vx = "3*q" }
///     [parameters]
///     q = 0.5
///     [dynamics]
///     transition = { x = "x + dt*vx", vx = "vx" }
///     noise_cov = [["q*dt^3/3", "q*dt^2/2"], ["q*dt^2/2", "q*dt"]]
///     [[sensor]]
///     name = "radar"
///     measures = { range = "abs(x)" }
///     std = [2]
/// "#, "radar.toml")?;
/// assert_eq!(model.states, ["x", "vx"]);
/// assert_eq!(model.prior.cov, [100.0, 0.0, 0.0, 2.25]);
/// # Ok::<(), givens_io::InputErrors>(())
/// ```
#[derive(Clone, Debug)]
pub struct Model {
    /// The file as the user named it.
    pub file: String,
    /// Names of the states, in order.
    pub states: Vec<String>,
    /// Names and values of the parameters, in file order.
    pub parameters: Vec<(String, f64)>,
    /// Names of the controls, in the order in which the file first uses them; all begin with `u_`.
    pub controls: Vec<String>,
    /// The time at which the initial belief holds; none: at the first row of each track.
    pub time: Option<f64>,
    /// The instant at which `t` is zero, if the file gives `time` in RFC 3339; `time` is zero then.
    pub epoch: Option<Calendar>,
    /// The initial belief, but for the states that `start` finds.
    pub prior: Prior,
    /// What finds states from the first row of a track, or its first two.
    pub start: Option<Start>,
    /// How the state moves.
    pub dynamics: Dynamics,
    /// What all sensors measure, stacked in file order.
    pub observation: ModelObservation,
    /// The sensors, in file order.
    pub sensors: Vec<Sensor>,
    /// The two states whose track a figure draws.
    pub plane: Option<[usize; 2]>,
    /// What finds the two states of the plane from one row, if `start` can.
    pub placement: Option<Start>,
    /// What `[filter]` says.
    pub filter: FilterSettings,
    /// What it was read from.
    source: Source,
}

impl Model {
    /// Reads a model file.
    ///
    /// # Errors
    /// Everything that is wrong with the file, by line and column.
    pub fn read(path: &str) -> Result<Self, InputErrors> {
        Self::read_with(path, &[])
    }

    /// Reads a model file with other values for some of its parameters; what the file makes of them follows.
    ///
    /// # Errors
    /// As [`read`](Self::read); also for a parameter that the model lacks.
    pub fn read_with(path: &str, parameters: &[(&str, f64)]) -> Result<Self, InputErrors> {
        read::model(&Source::read_up_to(path, read::LONGEST + 1)?, parameters)
    }

    /// Reads a model from text; errors call it `name`.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(text: &str, name: &str) -> Result<Self, InputErrors> {
        Self::parse_with(text, name, &[])
    }

    /// [`parse`](Self::parse) with other values for some parameters.
    ///
    /// # Errors
    /// As [`read_with`](Self::read_with).
    pub fn parse_with(text: &str, name: &str, parameters: &[(&str, f64)]) -> Result<Self, InputErrors> {
        read::model(&Source::new(name, text.to_string()), parameters)
    }

    /// The same model with other values for some parameters, from the text that was read; what it makes of them follows.
    ///
    /// # Errors
    /// As [`read_with`](Self::read_with).
    pub fn again_with(&self, parameters: &[(&str, f64)]) -> Result<Self, InputErrors> {
        read::model(&self.source, parameters)
    }

    /// Tells the text of the model file from others.
    pub fn fingerprint(&self) -> String {
        self.source.fingerprint()
    }

    /// Number of measures of all sensors.
    pub fn measures(&self) -> usize {
        self.sensors.last().map_or(0, |sensor| sensor.measures.end)
    }

    /// The fixed length of a step, if the model is discrete and has one: a gap is then a whole number of them.
    pub fn step(&self) -> Option<f64> {
        self.dynamics.discrete().and_then(Transition::period)
    }

    /// Where a row's measurement lies in the plane of the figure, if `start` can tell from this row.
    pub fn place(&self, row: &Row) -> Option<[f64; 2]> {
        let placement = self.placement.as_ref()?;
        let has = |&index: &usize| row.z.get(index).is_some_and(|value| value.is_finite());
        if !placement.measures.iter().all(has) {
            return None;
        }
        let p: Vec<f64> = self.parameters.iter().map(|(_, value)| *value).collect();
        let (mut found, mut slopes) = ([0.0; 2], vec![0.0; 2 * self.measures()]);
        let at = At { t: row.time, dt: 0.0, u: &row.u, p: &p };
        placement.function.evaluate(&at, &row.z, &mut found, &mut slopes);
        // The function finds states in ascending order.
        let [first, second] = self.plane?;
        let point = if first < second { found } else { [found[1], found[0]] };
        point.iter().all(|value| value.is_finite()).then_some(point)
    }
}

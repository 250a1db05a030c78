//! A method as it was chosen at run time: parts and options.

use super::entry::{ENTRIES, Entry, find};
use super::setting::SettingError;
use super::words::{
    FormName, GAUGES, Kind, Precision, ROOTS, RuleName, TimeName, VARIANTS, VELOCITIES, word_of,
};
use crate::filter::Block;
use crate::filter::predict::{Gauge, Root, Variant, Velocity};
use crate::ode::{Integrator, Steps};
use crate::rule::{CentralDifference, GaussHermite, Unscented};
use crate::scalar::Shown;

/// A method chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The name it was chosen by.
    pub name: &'static str,
    /// How expectations are computed.
    pub rule: RuleName,
    /// Covariance or square root.
    pub form: FormName,
    /// The block of a square-root measurement update.
    pub block: Block,
    /// How the belief moves from one time to a later one.
    pub time_update: TimeName,
    /// How an Itô–Taylor step takes the derivative of the drift.
    pub variant: Variant,
    /// What becomes of the root of a level set between measurements.
    pub gauge: Gauge,
    /// The root of a level set that the measurement update draws its points from.
    pub root: Root,
    /// What moves a level set.
    pub velocity: Velocity,
    /// The solver, its steps and its tolerance; the steps are those of the other time updates too.
    pub integrator: Integrator,
    /// What it computes with.
    pub precision: Precision,
    /// The probability of the χ² quantile beyond which a row is not taken in; none: every row is. See [`Gated`](crate::Gated).
    pub gate: Option<f64>,
    /// Options of the unscented rule.
    pub unscented: Unscented,
    /// Options of the Gauss–Hermite rule.
    pub gauss_hermite: GaussHermite,
    /// Options of the central-difference rule.
    pub central_difference: CentralDifference,
}

impl Choice {
    /// The name it was chosen by, and the parts that were set otherwise.
    #[must_use]
    pub fn title(&self) -> String {
        let Some(preset) = find(self.name) else { return self.name.to_owned() };
        let parts = [
            ("rule", preset.rule.word(), self.rule.word()),
            ("form", preset.form.word(), self.form.word()),
            ("time update", preset.time_update.word(), self.time_update.word()),
            ("precision", Precision::F64.word(), self.precision.word()),
        ];
        let changed = parts.iter().filter(|(_, own, set)| own != set);
        let changed = changed.map(|(part, _, set)| format!("{part} {set}"));
        [self.name.to_owned()].into_iter().chain(changed).collect::<Vec<_>>().join(", ")
    }

    /// Which models it serves.
    pub const fn kind(&self) -> Kind {
        self.time_update.kind()
    }

    /// Whether a solver chooses the steps in a gap.
    pub const fn adapts(&self) -> bool {
        self.time_update.solves() && self.integrator.solver.adaptive()
    }

    /// Whether a gap is divided into steps of equal length.
    pub const fn steps_are_equal(&self) -> bool {
        matches!(self.kind(), Kind::Continuous) && !self.adapts()
    }

    /// Whether the method serves models of this kind.
    ///
    /// # Errors
    /// The method, and its counterpart for the model.
    pub fn serves(&self, kind: Kind) -> Result<(), SettingError> {
        if self.kind() == kind {
            return Ok(());
        }
        let (own, other) = (self.kind().word(), kind.word());
        let as_set = match find(self.name) {
            Some(entry) if entry.time_update == self.time_update => String::new(),
            _ => format!(" with time_update = {}", self.time_update.word()),
        };
        let message = format!("`{}`{as_set} is a {own}-time method, and the model is {other}", self.name);
        let times = match kind {
            Kind::Discrete => "time_update = transition",
            Kind::Continuous => "time_update = moment-ode or ito-taylor",
        };
        let help = match self.counterpart() {
            Some(name) => format!("its counterpart for {other} models is `{name}`"),
            None => format!("set {times}, which goes with the {} rule", self.rule.word()),
        };
        Err(SettingError::method(message, Some(help)))
    }

    /// The method of the other kind with the same rule and form.
    pub fn counterpart(&self) -> Option<&'static str> {
        let same = |entry: &&Entry| {
            entry.kind() != self.kind() && entry.rule == self.rule && entry.form == self.form
        };
        ENTRIES.iter().find(same).map(|entry| entry.name)
    }

    /// The parts and options of the time update beside its name, with their values.
    pub fn time_options(&self) -> Vec<(&'static str, String)> {
        let mut all = Vec::new();
        match self.time_update {
            TimeName::Transition => return all,
            TimeName::ItoTaylor => all.push(("variant", word_of(VARIANTS, self.variant).to_owned())),
            TimeName::LevelSet => {
                all.push(("velocity", word_of(VELOCITIES, self.velocity).to_owned()));
                all.push(("gauge", word_of(GAUGES, self.gauge).to_owned()));
                all.push(("root", word_of(ROOTS, self.root).to_owned()));
            }
            TimeName::EulerMaruyama | TimeName::MomentOde => {}
        }
        let adaptive = self.adapts();
        if self.time_update.solves() {
            all.push(("solver", self.integrator.solver.name().to_owned()));
        }
        if adaptive {
            all.push(("rtol", Shown(self.integrator.tolerance.rtol).to_string()));
            all.push(("atol", Shown(self.integrator.tolerance.atol).to_string()));
        }
        match self.integrator.steps {
            Steps::Count(count) if !adaptive => all.push(("substeps", count.to_string())),
            Steps::Count(_) => {}
            Steps::Longest(longest) => all.push(("max_step", Shown(longest).to_string())),
        }
        all
    }
}

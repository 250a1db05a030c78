//! `[dynamics]`: how the state moves, in steps or in continuous time.

mod continuous;
mod discrete;

use givens_expr::{ModelSde, ModelTransition};

use super::context::Context;
use super::document::Entry;
use super::section::Section;

/// Keys of the section.
pub(super) const KEYS: &[&str] = &["transition", "noise_cov", "step", "drift", "diffusion"];

pub(super) use discrete::step;

/// How the state of a model moves.
#[derive(Clone, Debug)]
pub enum Dynamics {
    /// In steps: `transition` and `noise_cov`.
    Discrete(ModelTransition),
    /// In continuous time: `drift` and `diffusion`.
    Continuous(ModelSde),
}

impl Dynamics {
    /// The transition of a discrete model.
    pub fn discrete(&self) -> Option<&ModelTransition> {
        match self {
            Dynamics::Discrete(transition) => Some(transition),
            Dynamics::Continuous(_) => None,
        }
    }

    /// The stochastic differential equation of a continuous model.
    pub fn continuous(&self) -> Option<&ModelSde> {
        match self {
            Dynamics::Discrete(_) => None,
            Dynamics::Continuous(sde) => Some(sde),
        }
    }
}

/// Reads the section as what it is of: a discrete model or a continuous one.
pub(super) fn read(context: &mut Context, section: &Section, states: &[String]) -> Option<Dynamics> {
    let mixed = mixed(context, section);
    if is_continuous(section) {
        let sde = continuous::read(context, section, states).filter(|_| !mixed)?;
        return Some(Dynamics::Continuous(sde));
    }
    if section.get("transition").is_none() && section.get("noise_cov").is_none() {
        let help = "write transition = { x = \"x + dt*vx\", … } for a discrete model, drift = { x = \"vx\", … } for a \
                    continuous one";
        context.findings.wrong_help(section.span, "[dynamics] has neither `transition` nor `drift`", help);
        return None;
    }
    let transition = discrete::read(context, section, states).filter(|_| !mixed)?;
    Some(Dynamics::Discrete(transition))
}

/// Whether the section is of a continuous model; with keys of both, `drift` and `transition` decide, the first of them.
pub(super) fn is_continuous(section: &Section) -> bool {
    let of = |keys: [&str; 2]| {
        let mut found = section.entries.iter().filter(|entry| keys.contains(&entry.key.as_str()));
        found.next().map(|entry| entry.key == keys[1])
    };
    of(["transition", "drift"]).or_else(|| of(["noise_cov", "diffusion"])).unwrap_or(false)
}

/// Finds keys wrong that belong to the other kind of model.
fn mixed(context: &Context, section: &Section) -> bool {
    // with both of them it is open which of the other keys are foreign
    let both = section.get("transition").is_some() && section.get("drift").is_some();
    let mut any = false;
    for entry in
        section.entries.iter().filter(|entry| !both || matches!(entry.key.as_str(), "transition" | "drift"))
    {
        if let Some((message, help)) = foreign(entry, is_continuous(section)) {
            context.findings.wrong_help(&entry.span, message, help);
            any = true;
        }
    }
    any
}

/// Why a key may not stand in the kind of model that the others make, and the remedy.
fn foreign(entry: &Entry, continuous: bool) -> Option<(&'static str, &'static str)> {
    Some(match (entry.key.as_str(), continuous) {
        ("transition", true) => (
            "[dynamics] has both `drift` and `transition`",
            "a model is continuous, with `drift` and `diffusion`, or discrete, with `transition` and `noise_cov`: \
             remove one pair",
        ),
        ("drift", false) => (
            "[dynamics] has both `transition` and `drift`",
            "a model is discrete, with `transition` and `noise_cov`, or continuous, with `drift` and `diffusion`: \
             remove one pair",
        ),
        ("noise_cov", true) => (
            "`noise_cov` is the noise of a `transition`, but the model is continuous",
            "write `diffusion`, the root of the noise per unit of time",
        ),
        ("diffusion", false) => (
            "`diffusion` is the noise of a `drift`, but the model is discrete",
            "write `noise_cov`, the covariance of the noise of a step",
        ),
        ("step", true) => (
            "`step` is the step of a `transition`, but the model is continuous",
            "remove it: measurements may come at any time; `substeps` or `max_step` in [filter] divide the gaps",
        ),
        _ => return None,
    })
}

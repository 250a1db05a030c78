//! `[dynamics]`: how the state moves.

use givens_core::scalar::Shown;
use givens_expr::{ModelTransition, Node, TransitionParts};

use super::context::Context;
use super::covariance::covariance;
use super::section::{Named, Section};
use super::vocabulary::Role;

/// Keys of the section.
pub(super) const KEYS: &[&str] = &["transition", "noise_cov", "step", "drift", "diffusion"];

/// The fixed length of a step, if the model has one. The rest of the section may depend on it.
pub(super) fn step(context: &mut Context, section: &Section) -> Option<f64> {
    let entry = section.get("step")?;
    let scope = context.scope(Role::Fixed);
    let step = context.number(&scope, &entry.value, "`step`")?;
    if step <= 0.0 {
        let message = format!("`step` is {}, but a step is longer than zero", Shown(step));
        context.findings.wrong_help(&entry.value.span, message, "write its length in seconds");
        return None;
    }
    Some(step)
}

/// Reads the transition and its noise.
pub(super) fn read(context: &mut Context, section: &Section, states: &[String]) -> Option<ModelTransition> {
    if continuous(context, section) {
        return None;
    }
    let next = transition(context, section, states);
    let noise_cov = match section.get("noise_cov") {
        None => Some(Vec::new()),
        Some(entry) => {
            let scope = context.scope(Role::ProcessNoise);
            covariance(context, &scope, &entry.value, states, "`noise_cov`")
        }
    };
    let parts = TransitionParts {
        states: states.len(),
        controls: context.controls,
        parameters: context.parameters.clone(),
        period: context.step,
        next: next?,
        noise_cov: noise_cov?,
    };
    if parts.parameters.iter().any(|value| !value.is_finite()) {
        // told where the parameter stands
        return None;
    }
    match ModelTransition::new(&mut context.graph, parts) {
        Ok(transition) => Some(transition),
        Err(error) => {
            context.findings.wrong(section.span, format!("[dynamics]: {error}"));
            None
        }
    }
}

/// Continuous models are not there yet; this is told plainly.
fn continuous(context: &Context, section: &Section) -> bool {
    let Some(entry) = section.get("drift").or_else(|| section.get("diffusion")) else { return false };
    let message =
        format!("`{}` makes the model continuous in time, which this version does not read yet", entry.key);
    let help = "write `transition` and `noise_cov`, in `dt`, for a discrete model";
    context.findings.wrong_help(&entry.span, message, help);
    true
}

fn transition(context: &mut Context, section: &Section, states: &[String]) -> Option<Vec<Node>> {
    let help = "write the next value of every state: transition = { x = \"x + dt*vx\", … }";
    let entry = section.need(context.findings, "transition", help)?;
    let named = Named { noun: "state", names: states };
    let values = named.values(context.findings, &entry.value, "`transition`")?;
    let scope = context.scope(Role::Transition);
    let mut nodes = Vec::with_capacity(values.len());
    for (value, name) in values.into_iter().zip(states) {
        nodes.push(context.finite_expression(&scope, value, &format!("the transition of `{name}`")));
    }
    nodes.into_iter().collect()
}

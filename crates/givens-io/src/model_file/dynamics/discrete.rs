//! The dynamics of a discrete model: `transition`, `noise_cov` and `step`.

use givens_core::scalar::Shown;
use givens_expr::{ModelTransition, Node, TransitionParts};

use super::super::context::Context;
use super::super::covariance::covariance;
use super::super::section::{Named, Section};
use super::super::vocabulary::Role;
use super::is_continuous;

/// The fixed length of a step, if the model has one. The rest of the section may depend on it.
pub(in crate::model_file) fn step(context: &mut Context, section: &Section) -> Option<f64> {
    let entry = section.get("step").filter(|_| !is_continuous(section))?;
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
pub(in crate::model_file) fn read(
    context: &mut Context,
    section: &Section,
    states: &[String],
) -> Option<ModelTransition> {
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

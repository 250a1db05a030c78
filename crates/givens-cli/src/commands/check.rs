//! `givens check`: what was understood of a model file.

use crate::args::CheckArgs;
use crate::message::{Stop, count};
use crate::method::{chosen, form, options};
use crate::plan::model;
use crate::stdout;
use givens::model::{Noise, Transition};
use givens::registry::Choice;
use givens::scalar::Shown;
use givens_io::Model;
use std::io::{self, Write};

/// Reads the model and its method, and tells sizes, sensors and parts.
pub fn check(args: &CheckArgs) -> Result<(), Stop> {
    let model = model(&args.model)?;
    let choice = chosen(&model, &args.method)?;
    stdout::write(|out| {
        tell(out, &model)?;
        writeln!(out, "  method      {}", parts(&model, &choice))
    })
}

fn parts(model: &Model, choice: &Choice) -> String {
    let mut parts = vec![format!("rule {}", choice.rule.word())];
    parts.extend(
        options(choice, model.states.len()).iter().map(|(key, value)| format!("{key} {}", Shown(*value))),
    );
    parts.push(format!("form {}", form(choice)));
    format!("{}: {}", choice.name, parts.join(", "))
}

fn tell(out: &mut dyn Write, model: &Model) -> io::Result<()> {
    let n = model.states.len();
    let sizes = format!("{}, {}", count(n, "state"), count(model.measures(), "measure"));
    writeln!(out, "{}: a discrete-time model, {sizes}", model.file)?;
    let step = match model.transition.period() {
        Some(step) => format!("steps of {}", Shown(step)),
        None => "one transition per gap".to_owned(),
    };
    let noisy = if model.transition.noise() == Noise::Root(0) { ", no process noise" } else { "" };
    writeln!(out, "  time        {step}{noisy}")?;
    let begins = match (model.time, &model.start) {
        (Some(_), _) if model.epoch.is_some() => {
            format!("at {}", model.epoch.map_or(String::new(), |epoch| epoch.to_string()))
        }
        (Some(time), _) => format!("at {}", Shown(time)),
        (None, Some(_)) => "at the first row that `start` can read".to_owned(),
        (None, None) => "at the first row of each track".to_owned(),
    };
    writeln!(out, "  begins      {begins}")?;
    for (i, name) in model.states.iter().enumerate() {
        let belief = match model.prior.mean[i] {
            Some(mean) => format!("{} ± {}", Shown(mean), Shown(model.prior.cov[i * n + i].sqrt())),
            None => "from `start`".to_owned(),
        };
        writeln!(out, "  state       {name}: {belief}")?;
    }
    for (name, value) in &model.parameters {
        writeln!(out, "  parameter   {name} = {}", Shown(*value))?;
    }
    if !model.controls.is_empty() {
        writeln!(out, "  controls    {}", model.controls.join(", "))?;
    }
    for sensor in &model.sensors {
        let measures = sensor.columns.iter().zip(&sensor.angles).map(|(name, angle)| match angle {
            Some(period) => format!("{name} (angle, period {})", Shown(*period)),
            None => name.clone(),
        });
        writeln!(out, "  sensor      {}: {}", sensor.name, measures.collect::<Vec<_>>().join(", "))?;
    }
    if let Some([x, y]) = model.plane {
        writeln!(out, "  plane       {} across, {} upwards", model.states[x], model.states[y])?;
    }
    Ok(())
}

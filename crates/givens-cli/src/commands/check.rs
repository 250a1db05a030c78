//! `givens check`: what was understood of a model file.

use crate::args::CheckArgs;
use crate::message::{Stop, count};
use crate::method::{chosen, parts};
use crate::plan::model;
use crate::stdout;
use givens::model::{Noise, Sde, Transition, Varies};
use givens::scalar::Shown;
use givens_expr::{ModelSde, ModelTransition};
use givens_io::{Dynamics, Model};
use std::io::{self, Write};

/// Reads the model and its method, and tells sizes, sensors and parts.
pub fn check(args: &CheckArgs) -> Result<(), Stop> {
    let model = model(&args.model)?;
    let choice = chosen(&model, &args.method)?;
    stdout::write(|out| {
        tell(out, &model)?;
        let parts = parts(&choice, model.states.len()).join(", ");
        writeln!(out, "  method      {}: {parts}", choice.name)
    })
}

/// The steps of a discrete model.
fn steps(transition: &ModelTransition) -> String {
    let step = match transition.period() {
        Some(step) => format!("steps of {}", Shown(step)),
        None => "one transition per gap".to_owned(),
    };
    let noisy = if transition.noise() == Noise::Root(0) { ", no process noise" } else { "" };
    format!("{step}{noisy}")
}

/// The noise of a continuous model: the size of G, and what it depends on.
fn diffusion(sde: &ModelSde) -> String {
    let (n, q) = (sde.states(), sde.noises());
    if q == 0 {
        return "any gap, no process noise".to_owned();
    }
    let varies = match sde.diffusion_varies() {
        Varies::Never => "",
        Varies::WithTime => ", varying with time",
        Varies::WithState => ", varying with the state",
    };
    format!("any gap, diffusion {n} × {q}{varies}")
}

fn tell(out: &mut dyn Write, model: &Model) -> io::Result<()> {
    let n = model.states.len();
    let sizes = format!("{}, {}", count(n, "state"), count(model.measures(), "measure"));
    let (kind, time) = match &model.dynamics {
        Dynamics::Discrete(transition) => ("a discrete-time", steps(transition)),
        Dynamics::Continuous(sde) => ("a continuous-time", diffusion(sde)),
    };
    writeln!(out, "{}: {kind} model, {sizes}", model.file)?;
    writeln!(out, "  time        {time}")?;
    let begins = match (model.time, &model.start) {
        (Some(_), _) if model.epoch.is_some() => {
            format!("at {}", model.epoch.map_or(String::new(), |epoch| epoch.to_string()))
        }
        (Some(time), _) => format!("at {}", Shown(time)),
        (None, Some(start)) => {
            let row = if start.two_rows { "second" } else { "first" };
            format!("at the {row} row that `start` can read")
        }
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

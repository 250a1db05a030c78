//! How the paths of a continuous model are followed in a simulation.

use crate::args::{SchemeArg, SimulateArgs};
use crate::message::{Stop, say};
use givens::model::{Sde, Varies};
use givens::ode::Steps;
use givens::simulate::{Path, Paths, Scheme};
use givens_io::{Dynamics, Model};

/// The scheme and the steps that the arguments ask for; a discrete model has none.
pub fn paths(model: &Model, args: &SimulateArgs) -> Result<Paths, Stop> {
    let Dynamics::Continuous(sde) = &model.dynamics else {
        let given = [
            ("--scheme", args.scheme.is_some()),
            ("--substeps", args.substeps.is_some()),
            ("--max-step", args.max_step.is_some()),
        ];
        return match given.iter().find(|(_, given)| *given) {
            None => Ok(Paths::default()),
            Some((option, _)) => Err(Stop::input(format!("{option}: the model is discrete"))
                .help("it belongs to continuous models (drift, diffusion); leave it out")),
        };
    };
    let with_state = sde.diffusion_varies() == Varies::WithState;
    let scheme = match args.scheme {
        Some(SchemeArg::EulerMaruyama) => Scheme::EulerMaruyama,
        None if with_state => {
            say("the diffusion depends on the state: the path is followed by euler-maruyama");
            Scheme::EulerMaruyama
        }
        Some(SchemeArg::ItoTaylor) | None => Scheme::ItoTaylor,
    };
    let default = Paths::default().steps;
    let steps = args.max_step.map(Steps::Longest).or(args.substeps.map(Steps::Count)).unwrap_or(default);
    let paths = Paths { scheme, steps };
    let option = match (with_state && scheme == Scheme::ItoTaylor, steps) {
        (true, _) => "--scheme ito-taylor",
        (_, Steps::Count(_)) => "--substeps",
        (_, Steps::Longest(_)) => "--max-step",
    };
    match Path::new(sde, paths) {
        Ok(_) => Ok(paths),
        Err(fault) => Err(Stop::input(format!("{option}: {fault}"))),
    }
}

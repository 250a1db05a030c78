//! Whether a method and a model go together.

use givens::filter::Fault;
use givens::model::{Sde, Varies};
use givens::ode::Solver;
use givens::registry::{Choice, ENTRIES, Entry, RuleName, TimeName};
use givens::rule::RuleError;

use super::part::Part;
use super::{Model, Moves};
use crate::errors::{Refusal, Result, setting};

/// What a method differentiates.
struct Needs {
    /// First derivatives of the transition or the drift, and of the measures.
    slopes: bool,
    /// Second ones of the drift.
    curvature: bool,
    /// The derivatives of the drift that a stiff solver takes.
    solver: bool,
}

impl Needs {
    fn of(choice: &Choice) -> Self {
        Self {
            slopes: choice.rule == RuleName::Taylor,
            curvature: choice.time_update == TimeName::ItoTaylor,
            solver: choice.time_update.solves() && choice.integrator.solver == Solver::Rodas4,
        }
    }
}

impl Model {
    /// Refuses a method that does not go with the model, and names those that do.
    pub fn serves(&self, choice: &Choice) -> Result<()> {
        choice.serves(self.kind()).map_err(|error| setting(error, &[]))?;
        choice.check(self.states()).map_err(|error| out_of_range(error, self.states()))?;
        if let Moves::Continuous(model) = &self.moves {
            choice.check_continuous(model).map_err(|fault| match fault {
                Fault::Option(error) => out_of_range(error, self.states()),
                Fault::StateDependentDiffusion => {
                    let message = format!("`{}`: the diffusion depends on the state", choice.name);
                    let remedy = "method=\"sr-cd-ckf2\" or time_update=\"moment-ode\", \"euler-maruyama\" serve such a model";
                    Refusal::Method(message, None, Some(remedy.to_owned()))
                }
                other => Refusal::Method(format!("`{}`: {other}", choice.name), None, None),
            })?;
        }
        self.derivatives(choice)
    }

    /// Refuses a method that differentiates what is called and has no derivatives.
    fn derivatives(&self, choice: &Choice) -> Result<()> {
        let needs = Needs::of(choice);
        let lacks = |part: &Part, curved: bool| !part.is_smooth() && (curved || !part.has_slopes());
        let moves = match &self.moves {
            Moves::Discrete(model) => model.functions().map(|functions| (&functions.next, None)),
            Moves::Continuous(model) => {
                let of = |functions| (functions, Some(model.diffusion_varies()));
                model
                    .functions()
                    .map(of)
                    .map(|(functions, varies)| (&functions.drift, varies.zip(Some(functions))))
            }
        };
        if let Some((part, noise)) = moves {
            if needs.curvature && !part.is_smooth() {
                return Err(self.refused(choice, part, "second derivatives"));
            }
            if needs.solver && !part.is_smooth() {
                let message =
                    format!("solver = rodas4 takes derivatives of the {}, which is called", part.what);
                let remedy = Some("solver=\"dp5\" takes none".to_owned());
                return Err(Refusal::Method(message, Some("solver".to_owned()), remedy));
            }
            if needs.slopes && lacks(part, false) {
                return Err(self.refused(choice, part, "derivatives"));
            }
            if let Some((varies, functions)) = noise {
                let diffusion = &functions.diffusion;
                let differentiated = match varies {
                    Varies::Never => false,
                    Varies::WithTime => needs.curvature || needs.solver,
                    Varies::WithState => needs.slopes || needs.curvature || needs.solver,
                };
                if differentiated && !diffusion.is_smooth() {
                    return Err(self.refused(choice, diffusion, "derivatives"));
                }
            }
        }
        let mut sensors = self.sensing.functions().into_iter().flat_map(|functions| &functions.sensors);
        match sensors.find(|sensor| needs.slopes && lacks(&sensor.measures, false)) {
            Some(sensor) => Err(self.refused(choice, &sensor.measures, "derivatives")),
            None => Ok(()),
        }
    }

    fn refused(&self, choice: &Choice, part: &Part, derivatives: &str) -> Refusal {
        let bring = match (derivatives, part.jacobian.is_some()) {
            (_, true) => "; `jacobian` brings the first only",
            _ => ", and has none",
        };
        let message = format!(
            "`{}` takes {derivatives} of `{}`, which is called, not traced{bring}",
            choice.name, part.what
        );
        let plain = |entry: &&Entry| {
            entry.kind() == self.kind()
                && entry.rule != RuleName::Taylor
                && entry.time_update != TimeName::ItoTaylor
        };
        let names: Vec<&str> = ENTRIES.iter().filter(plain).map(|entry| entry.name).collect();
        let first = if derivatives == "derivatives" && part.what != "diffusion" {
            "give `jacobian`, or "
        } else {
            ""
        };
        let remedy = format!("{first}use a method without derivatives: {}", names.join(", "));
        Refusal::Method(message, None, Some(remedy))
    }

    /// Whether a step of the drift may be expanded by its derivatives.
    pub fn is_smooth(&self) -> bool {
        match &self.moves {
            Moves::Discrete(_) => true,
            Moves::Continuous(model) => {
                let smooth = |part: &Part| part.is_smooth();
                let functions = model.functions();
                model.diffusion_varies() != Varies::WithState
                    && functions.is_none_or(|all| smooth(&all.drift) && smooth(&all.diffusion))
            }
        }
    }

    /// Whether evaluating the model needs the interpreter.
    pub fn needs_python(&self) -> bool {
        let moves = match &self.moves {
            Moves::Discrete(model) => {
                model.functions().is_some_and(|all| all.next.needs_python() || all.noise_cov.needs_python())
            }
            Moves::Continuous(model) => {
                model.functions().is_some_and(|all| all.drift.needs_python() || all.diffusion.needs_python())
            }
        };
        let mut sensors = self.sensing.functions().into_iter().flat_map(|all| &all.sensors);
        moves || sensors.any(|sensor| sensor.measures.needs_python() || sensor.noise.needs_python())
    }
}

/// An option out of its range.
fn out_of_range(error: RuleError, states: usize) -> Refusal {
    let remedy = error.must.contains("(n:").then(|| format!("the model has n = {states}"));
    Refusal::Method(error.to_string(), Some(error.option.to_owned()), remedy)
}

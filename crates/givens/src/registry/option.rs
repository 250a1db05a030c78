//! Parts and options: their names, and which methods read them.

use super::choice::Choice;
use super::words::{FormName, RuleName, TimeName};

/// A part or option, and the methods that read it.
#[derive(Clone, Copy, Debug)]
pub struct OptionInfo {
    /// Its name.
    pub key: &'static str,
    /// What it is, with its default.
    pub about: &'static str,
    /// Who reads it.
    pub reader: Reader,
}

/// The methods that read an option, by their parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reader {
    /// Every method: a part.
    Every,
    /// Those with this rule.
    Rule(RuleName),
    /// Those in this form.
    Form(FormName),
    /// Those with this time update.
    Time(TimeName),
    /// Those for continuous models.
    Continuous,
    /// Those that hand differential equations to a solver.
    Solver,
    /// Those that divide a gap into equal steps.
    EqualSteps,
    /// Those whose solver chooses its steps by a tolerance.
    AdaptiveSolver,
}

impl Reader {
    /// Whose it is, in a few words.
    pub const fn word(self) -> &'static str {
        match self {
            Reader::Every => "any",
            Reader::Rule(rule) => rule.word(),
            Reader::Form(form) => form.word(),
            Reader::Time(time) => time.word(),
            Reader::Continuous => "continuous",
            Reader::Solver => "moment-ode, level-set",
            Reader::EqualSteps => "equal steps",
            Reader::AdaptiveSolver => "dp5, rodas4",
        }
    }

    /// Whether `choice` is among them.
    pub fn reads(self, choice: &Choice) -> bool {
        let time = choice.time_update;
        match self {
            Reader::Every => true,
            Reader::Rule(rule) => choice.rule == rule,
            Reader::Form(form) => choice.form == form,
            Reader::Time(of) => time == of,
            Reader::Continuous => time != TimeName::Transition,
            Reader::Solver => time.solves(),
            Reader::EqualSteps => choice.steps_are_equal(),
            Reader::AdaptiveSolver => choice.adapts(),
        }
    }

    /// Why a method that is not among them does not read it, and the way out if there is one.
    pub(super) fn why(self, choice: &Choice) -> String {
        let discrete = choice.time_update == TimeName::Transition;
        match self {
            Reader::Every => String::new(),
            Reader::Rule(rule) => format!("it belongs to the {} rule", rule.word()),
            Reader::Form(form) => format!("it belongs to the {} form", form.word()),
            Reader::Time(time) => format!("it belongs to time_update = {}", time.word()),
            Reader::EqualSteps if !discrete => {
                "its solver chooses its steps by rtol and atol; max_step bounds them, and solver = euler, rk2 or rk4 \
                 takes equal ones"
                    .to_owned()
            }
            Reader::AdaptiveSolver if !discrete => {
                "it belongs to the solvers that adapt their steps, dp5 and rodas4, of time_update = moment-ode or \
                 level-set"
                    .to_owned()
            }
            Reader::Solver => "it belongs to time_update = moment-ode and level-set".to_owned(),
            Reader::Continuous | Reader::EqualSteps | Reader::AdaptiveSolver => {
                "it belongs to the methods for continuous models".to_owned()
            }
        }
    }
}

const fn option(key: &'static str, reader: Reader, about: &'static str) -> OptionInfo {
    OptionInfo { key, about, reader }
}

/// Every part and option of this version.
pub const OPTIONS: &[OptionInfo] = &[
    option("rule", Reader::Every, "how expectations are computed"),
    option("form", Reader::Every, "covariance | square-root"),
    option(
        "update",
        Reader::Form(FormName::SquareRoot),
        "joint (2010 eq 36, default) | separate (2009 Appendix B)",
    ),
    option(
        "time_update",
        Reader::Every,
        "transition; of continuous models ito-taylor | euler-maruyama | moment-ode | level-set",
    ),
    option(
        "variant",
        Reader::Time(TimeName::ItoTaylor),
        "how Lf enters the noise: full | simplified | noise-once",
    ),
    option("gauge", Reader::Time(TimeName::LevelSet), "the root between measurements: free | triangular"),
    option("root", Reader::Time(TimeName::LevelSet), "the root whose points the update draws: lower | moved"),
    option(
        "velocity",
        Reader::Time(TimeName::LevelSet),
        "standard | averaged-printed | averaged | partial | partial-printed | cubature (default)",
    ),
    option("solver", Reader::Solver, "euler | rk2 | rk4 | dp5 (default) | rodas4 (stiff)"),
    option("substeps", Reader::EqualSteps, "steps into which a gap is divided (16)"),
    option(
        "max_step",
        Reader::Continuous,
        "longest step, in place of substeps; it also bounds adapted steps",
    ),
    option(
        "rtol",
        Reader::AdaptiveSolver,
        "error of a step, in standard deviations, that is accepted (1e-6)",
    ),
    option("atol", Reader::AdaptiveSolver, "the same in the states' units, added to it (0)"),
    option("precision", Reader::Every, "what it computes with: f64 (default) | f32 (square root)"),
    option(
        "gate",
        Reader::Every,
        "rows beyond this χ² quantile are not taken in: a probability, such as 0.9999 (off)",
    ),
    option("alpha", Reader::Rule(RuleName::Unscented), "spread of the points (1)"),
    option("beta", Reader::Rule(RuleName::Unscented), "added to the centre's weight (0)"),
    option("kappa", Reader::Rule(RuleName::Unscented), "the plain transform's parameter (3 - n)"),
    option("eta", Reader::Rule(RuleName::CentralDifference), "step of the differences (sqrt 3)"),
    option("points", Reader::Rule(RuleName::GaussHermite), "points per axis (3)"),
];

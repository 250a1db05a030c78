//! A method as it was chosen at run time: parts and options.

use super::runtime::{AnyPoints, Parts};
use crate::Row;
use crate::filter::predict::OneTransition;
use crate::filter::{Block, Covariance, Gaussian, SquareRoot};
use crate::model::{Observation, Transition};
use crate::rule::{
    CentralDifference, Cubature3, Cubature5, GaussHermite, Rule, RuleError, Taylor, Unscented,
};
use crate::run::{Goal, Outcome, run};

macro_rules! words {
    ($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $word:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name {
            $($(#[$variant_doc])* $variant,)*
        }

        impl $name {
            /// All words.
            pub const WORDS: &[&str] = &[$($word),*];

            /// The word for it.
            pub const fn word(self) -> &'static str {
                match self { $(Self::$variant => $word,)* }
            }

            /// What the word stands for.
            pub fn parse(word: &str) -> Option<Self> {
                match word { $($word => Some(Self::$variant),)* _ => None }
            }
        }
    };
}

words! {
    /// A rule, by name.
    RuleName {
        /// Third-degree spherical-radial cubature.
        Cubature3 = "cubature3",
        /// Fifth-degree spherical-radial cubature.
        Cubature5 = "cubature5",
        /// The unscented transform.
        Unscented = "unscented",
        /// Gauss–Hermite quadrature.
        GaussHermite = "gauss-hermite",
        /// Central differences.
        CentralDifference = "central-difference",
        /// First-order Taylor expansion.
        Taylor = "taylor",
    }
}

words! {
    /// A form, by name.
    FormName {
        /// The covariance itself.
        Covariance = "covariance",
        /// A root of it.
        SquareRoot = "square-root",
    }
}

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
    /// Options of the unscented rule.
    pub unscented: Unscented,
    /// Options of the Gauss–Hermite rule.
    pub gauss_hermite: GaussHermite,
    /// Options of the central-difference rule.
    pub central_difference: CentralDifference,
}

impl Choice {
    /// What is wrong with the options for a model of `states` states, if anything.
    ///
    /// # Errors
    /// The option and its range.
    pub fn check(&self, states: usize) -> Result<(), RuleError> {
        match self.rule {
            RuleName::CentralDifference => self.central_difference.check(states),
            RuleName::Taylor => Taylor.check(states),
            _ => Rule::check(&self.points(), states),
        }
    }

    fn points(&self) -> AnyPoints {
        match self.rule {
            RuleName::Cubature5 => AnyPoints::Cubature5(Cubature5),
            RuleName::Unscented => AnyPoints::Unscented(self.unscented),
            RuleName::GaussHermite => AnyPoints::GaussHermite(self.gauss_hermite),
            _ => AnyPoints::Cubature3(Cubature3),
        }
    }

    /// Runs the method over a trajectory; see [`run()`].
    pub fn run<'a, M: Transition, H: Observation>(
        &self,
        model: &M,
        sensors: &H,
        rows: impl Iterator<Item = Row<'a>> + Clone,
        t0: f64,
        prior: &Gaussian,
        goal: Goal,
    ) -> Outcome {
        let covariance = self.form == FormName::Covariance;
        macro_rules! with {
            ($rule:expr) => {
                if covariance {
                    run(
                        Parts::<_, Covariance, _>::new($rule, self.block, OneTransition),
                        model,
                        sensors,
                        rows,
                        t0,
                        prior,
                        goal,
                    )
                } else {
                    run(
                        Parts::<_, SquareRoot, _>::new($rule, self.block, OneTransition),
                        model,
                        sensors,
                        rows,
                        t0,
                        prior,
                        goal,
                    )
                }
            };
        }
        match self.rule {
            RuleName::CentralDifference => with!(self.central_difference),
            RuleName::Taylor => with!(Taylor),
            _ => with!(self.points()),
        }
    }
}

//! The words by which parts are known.

use crate::filter::Block;
use crate::filter::predict::{Gauge, Root, Variant, Velocity};
use crate::ode::Solver;

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

words! {
    /// What a method computes with.
    Precision {
        /// Numbers of sixteen digits.
        F64 = "f64",
        /// Numbers of seven digits.
        F32 = "f32",
    }
}

impl Precision {
    /// The distance from one to the next larger number.
    pub(crate) const fn epsilon(self) -> f64 {
        match self {
            Precision::F64 => f64::EPSILON,
            Precision::F32 => f32::EPSILON as f64,
        }
    }
}

words! {
    /// What a model's time is, and so that of the methods which serve it.
    Kind {
        /// A transition from one time to a later one.
        Discrete = "discrete",
        /// A drift and a diffusion.
        Continuous = "continuous",
    }
}

words! {
    /// A time update, by name.
    TimeName {
        /// The transition of a discrete model.
        Transition = "transition",
        /// Steps by the Itô–Taylor expansion of order 1.5.
        ItoTaylor = "ito-taylor",
        /// Steps by Euler and Maruyama.
        EulerMaruyama = "euler-maruyama",
        /// The differential equations of mean and covariance.
        MomentOde = "moment-ode",
        /// The motion of a level set.
        LevelSet = "level-set",
    }
}

impl TimeName {
    /// Which models it serves.
    pub const fn kind(self) -> Kind {
        match self {
            TimeName::Transition => Kind::Discrete,
            _ => Kind::Continuous,
        }
    }

    /// Whether it hands differential equations to a solver.
    pub const fn solves(self) -> bool {
        matches!(self, TimeName::MomentOde | TimeName::LevelSet)
    }
}

/// Parts that the core knows by types, and their words.
pub(super) type Words<T> = &'static [(&'static str, T)];

pub(super) const UPDATES: Words<Block> = &[("joint", Block::Joint), ("separate", Block::Separate)];

pub(super) const VARIANTS: Words<Variant> =
    &[("full", Variant::Full), ("simplified", Variant::Simplified), ("noise-once", Variant::NoiseOnce)];

pub(super) const GAUGES: Words<Gauge> = &[("free", Gauge::Free), ("triangular", Gauge::Triangular)];

pub(super) const ROOTS: Words<Root> = &[("lower", Root::Lower), ("moved", Root::Moved)];

pub(super) const VELOCITIES: Words<Velocity> = &[
    ("standard", Velocity::Standard),
    ("averaged-printed", Velocity::AveragedPrinted),
    ("averaged", Velocity::Averaged),
    ("partial", Velocity::Partial),
    ("partial-printed", Velocity::PartialPrinted),
    ("cubature", Velocity::Cubature),
];

pub(super) const SOLVERS: Words<Solver> = &[
    ("euler", Solver::Euler),
    ("rk2", Solver::Rk2),
    ("rk4", Solver::Rk4),
    ("dp5", Solver::Dp5),
    ("rodas4", Solver::Rodas4),
];

/// The word for a part.
pub(super) fn word_of<T: Copy + PartialEq>(words: Words<T>, part: T) -> &'static str {
    words.iter().find(|(_, of)| *of == part).map_or("", |(word, _)| word)
}

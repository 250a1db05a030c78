//! The rows of the registry: a name, its parts, its sources.

use super::words::{FormName, Kind, RuleName, TimeName};
use crate::filter::predict::Variant;

/// A named method: a preset of parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its name in the command, the model file and Python; the Rust type is the same in camel case.
    pub name: &'static str,
    /// Other names for the same.
    pub aliases: &'static [&'static str],
    /// What it is, in words.
    pub about: &'static str,
    /// How expectations are computed.
    pub rule: RuleName,
    /// Covariance or square root.
    pub form: FormName,
    /// How the belief moves from one time to a later one.
    pub time_update: TimeName,
    /// How an Itô–Taylor step takes the derivative of the drift; others do not read it.
    pub variant: Variant,
    /// Whether a solver that takes equal steps is refused.
    pub adaptive: bool,
    /// Where it comes from.
    pub sources: &'static [&'static str],
}

impl Entry {
    /// Which models it serves.
    pub const fn kind(&self) -> Kind {
        self.time_update.kind()
    }
}

const CKF: &str = "Arasaratnam & Haykin 2009, Cubature Kalman filters, IEEE TAC 54(6)";
const SR_UPDATE: &str = "Arasaratnam, Haykin & Hurd 2010, IEEE TSP 58(10), eq 36";
const SMOOTHER: &str = "Arasaratnam & Haykin 2011, Cubature Kalman smoothers, Automatica 47(10)";
const QKF: &str =
    "Arasaratnam, Haykin & Elliott 2007, Discrete-time nonlinear filtering by Gauss-Hermite quadrature";
const CDKF: &str = "Noergaard, Poulsen & Ravn 2000, New developments in state estimation, Automatica 36(11)";
const UKF: &str =
    "Julier & Uhlmann 1997/2004, Unscented filtering and nonlinear estimation, Proc. IEEE 92(3)";
const SR_UKF: &str = "van der Merwe & Wan 2001, The square-root unscented Kalman filter";
const CKF5: &str = "Jia, Xin & Cheng 2013, High-degree cubature Kalman filter, Automatica 49(2)";
const EKF: &str = "Jazwinski 1970, Stochastic Processes and Filtering Theory";
const CD_CKF: &str = "Arasaratnam, Haykin & Hurd 2010, Cubature Kalman filtering for continuous-discrete \
                      systems, IEEE TSP 58(10)";
const CD_CKF2: &str = "Särkkä & Solin 2012, On continuous-discrete cubature Kalman filtering";
const CD_UKF: &str = "Särkkä 2007, On unscented Kalman filtering for state estimation of continuous-time \
                      nonlinear systems, IEEE TAC 52(9)";
const ACD_EKF: &str = "Kulikov & Kulikova 2014, Accurate numerical implementation of the continuous-discrete \
                       extended Kalman filter, IEEE TAC 59(1)";
const LSKF: &str = "Wang & Forger 2021, The level set Kalman filter for state estimation of \
                    continuous-discrete systems";

const fn row(
    name: &'static str,
    about: &'static str,
    rule: RuleName,
    form: FormName,
    time_update: TimeName,
    sources: &'static [&'static str],
) -> Entry {
    let (variant, adaptive) = (Variant::Simplified, false);
    Entry { name, aliases: &[], about, rule, form, time_update, variant, adaptive, sources }
}

/// Pairs of rows, in covariance and in square-root form: all of the first kind of a block, then the others.
macro_rules! entries {
    ($({$($cov:literal $(= $alias:literal)?, $sr:literal $(= $sr_alias:literal)?: $rule:ident, $time:ident
          $(, $field:ident $value:expr)?; $about:literal, $sources:expr, $sr_sources:expr;)*})* and $($last:expr,)*) => {
        /// Every method of this version.
        pub const ENTRIES: &[Entry] = &[$(
            $(Entry {
                aliases: &[$($alias)?], $($field: $value,)?
                ..row($cov, $about, RuleName::$rule, FormName::Covariance, TimeName::$time, &$sources)
            },)*
            $(Entry {
                aliases: &[$($sr_alias)?], $($field: $value,)?
                ..row($sr, $about, RuleName::$rule, FormName::SquareRoot, TimeName::$time, &$sr_sources)
            },)*
        )* $($last,)*];
    };
}

// of equal rule and form, the first is the counterpart of a method of the other kind
entries! {
    {
        "ekf", "sr-ekf": Taylor, Transition; "extended Kalman filter, exact derivatives", [EKF], [EKF, SR_UPDATE];
        "ukf", "sr-ukf": Unscented, Transition; "unscented Kalman filter", [UKF], [UKF, SR_UKF];
        "cdkf", "sr-cdkf": CentralDifference, Transition; "central-difference Kalman filter", [CDKF], [CDKF];
        "qkf" = "ghkf", "sr-qkf": GaussHermite, Transition;
            "Gauss-Hermite quadrature Kalman filter", [QKF], [QKF, SR_UPDATE];
        "ckf", "sr-ckf" = "sckf": Cubature3, Transition;
            "third-degree cubature Kalman filter", [CKF, SMOOTHER], [CKF, SR_UPDATE, SMOOTHER];
        "ckf5", "sr-ckf5": Cubature5, Transition; "fifth-degree cubature Kalman filter", [CKF5], [CKF5, SR_UPDATE];
    }
    {
        "cd-ekf", "sr-cd-ekf": Taylor, MomentOde; "extended Kalman filter by its moment equations", [EKF], [EKF, CD_CKF2];
        "acd-ekf", "sr-acd-ekf": Taylor, MomentOde, adaptive true;
            "the same by a solver that keeps its error in bounds", [ACD_EKF], [ACD_EKF, CD_CKF2];
        "cd-ukf" = "cd-ukf2", "sr-cd-ukf" = "sr-cd-ukf2": Unscented, MomentOde;
            "unscented Kalman filter by its moment equations", [CD_UKF], [CD_UKF, CD_CKF2];
        "cd-ukf1", "sr-cd-ukf1": Unscented, ItoTaylor, variant Variant::Full;
            "unscented Kalman filter, full Itô-Taylor step", [CD_CKF2], [CD_CKF2];
        "cd-ckf", "sr-cd-ckf": Cubature3, ItoTaylor;
            "cubature Kalman filter, simplified Itô-Taylor step", [CD_CKF], [CD_CKF];
        "cd-ckf1", "sr-cd-ckf1": Cubature3, ItoTaylor, variant Variant::Full;
            "cubature Kalman filter, full Itô-Taylor step", [CD_CKF, CD_CKF2], [CD_CKF, CD_CKF2];
        "cd-ckf2", "sr-cd-ckf2": Cubature3, MomentOde;
            "cubature Kalman filter by its moment equations", [CD_CKF2], [CD_CKF2];
        "cd-ghkf2", "sr-cd-ghkf2": GaussHermite, MomentOde;
            "Gauss-Hermite Kalman filter by its moment equations", [CD_CKF2], [CD_CKF2];
        "cd-ghkf1", "sr-cd-ghkf1": GaussHermite, ItoTaylor, variant Variant::Full;
            "Gauss-Hermite Kalman filter, full Itô-Taylor step", [CD_CKF2], [CD_CKF2];
    }
    and row("lskf", "level-set Kalman filter", RuleName::Cubature3, FormName::SquareRoot, TimeName::LevelSet, &[LSKF]),
}

/// The method of this name or alias.
pub fn find(name: &str) -> Option<&'static Entry> {
    ENTRIES.iter().find(|entry| entry.name == name || entry.aliases.contains(&name))
}

/// All names and aliases.
pub fn names() -> impl Iterator<Item = &'static str> {
    ENTRIES.iter().flat_map(|entry| core::iter::once(entry.name).chain(entry.aliases.iter().copied()))
}

/// The method where none is named: the best for the kind of model, not the oldest.
pub const fn default_method(kind: Kind) -> &'static str {
    match kind {
        Kind::Discrete => "sr-ckf",
        Kind::Continuous => "sr-cd-ckf",
    }
}

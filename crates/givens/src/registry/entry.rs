//! The rows of the registry: a name, its parts, its sources.

use super::choice::{FormName, RuleName};

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
    /// Where it comes from.
    pub sources: &'static [&'static str],
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

macro_rules! entries {
    ($($cov:literal $(= $alias:literal)?, $sr:literal $(= $sr_alias:literal)?: $rule:ident, $about:literal, $sources:expr, $sr_sources:expr;)*) => {
        /// Every method of this version.
        pub const ENTRIES: &[Entry] = &[
            $(Entry { name: $cov, aliases: &[$($alias)?], about: $about, rule: RuleName::$rule,
                      form: FormName::Covariance, sources: &$sources },)*
            $(Entry { name: $sr, aliases: &[$($sr_alias)?], about: $about, rule: RuleName::$rule,
                      form: FormName::SquareRoot, sources: &$sr_sources },)*
        ];
    };
}

entries! {
    "ekf", "sr-ekf": Taylor, "extended Kalman filter, exact derivatives", [EKF], [EKF, SR_UPDATE];
    "ukf", "sr-ukf": Unscented, "unscented Kalman filter", [UKF], [UKF, SR_UKF];
    "cdkf", "sr-cdkf": CentralDifference, "central-difference Kalman filter", [CDKF], [CDKF];
    "qkf" = "ghkf", "sr-qkf": GaussHermite, "Gauss-Hermite quadrature Kalman filter", [QKF], [QKF, SR_UPDATE];
    "ckf", "sr-ckf" = "sckf": Cubature3, "third-degree cubature Kalman filter", [CKF, SMOOTHER], [CKF, SR_UPDATE, SMOOTHER];
    "ckf5", "sr-ckf5": Cubature5, "fifth-degree cubature Kalman filter", [CKF5], [CKF5, SR_UPDATE];
}

/// The method of this name or alias.
pub fn find(name: &str) -> Option<&'static Entry> {
    ENTRIES.iter().find(|entry| entry.name == name || entry.aliases.contains(&name))
}

/// All names and aliases.
pub fn names() -> impl Iterator<Item = &'static str> {
    ENTRIES.iter().flat_map(|entry| core::iter::once(entry.name).chain(entry.aliases.iter().copied()))
}

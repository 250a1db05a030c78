//! A published number beside ours.

use crate::statistics::{fisher, z_of};

/// What is to be said of a published number.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// It lies within what two samples of these sizes may be apart: so many standard deviations of their difference.
    Within(f64),
    /// It does not: by so many standard deviations.
    Differs(f64),
    /// Nobody can tell, and why.
    NotRecoverable(&'static str),
    /// A statement in words that our runs bear out, or do not.
    Holds(bool),
}

/// More than this many standard deviations apart is a difference.
const APART: f64 = 3.0;

/// One published number or statement, and what we find.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// What it is about.
    pub what: String,
    /// In print.
    pub published: String,
    /// Measured.
    pub ours: String,
    /// What is to be said of it.
    pub verdict: Verdict,
    /// Why a difference stands, if that is known.
    pub remark: String,
}

impl Claim {
    /// A number against ours, each with the standard deviation of such a sample: `of_theirs` runs in print and `of_ours`
    /// here, `spread` that of one replication of ours.
    pub fn number(
        what: impl Into<String>,
        published: f64,
        ours: f64,
        spread: f64,
        of_theirs: f64,
        of_ours: f64,
    ) -> Self {
        let apart = spread * (1.0 + of_ours / of_theirs).sqrt();
        if apart.is_nan() {
            return Self::lost(what, shown(published), shown(ours), "one run tells no spread");
        }
        let z = if apart > 0.0 { (published - ours).abs() / apart } else { f64::INFINITY };
        Self::of(what, shown(published), format!("{} ± {}", shown(ours), shown(spread)), z)
    }

    /// A count among `of_theirs` against ours among `of_ours`, by Fisher's exact test.
    pub fn count(
        what: impl Into<String>,
        published: usize,
        of_theirs: usize,
        ours: usize,
        of_ours: usize,
    ) -> Self {
        let z = z_of(fisher(
            [published, of_theirs - published.min(of_theirs)],
            [ours, of_ours - ours.min(of_ours)],
        ));
        Self::of(what, format!("{published} of {of_theirs}"), format!("{ours} of {of_ours}"), z)
    }

    /// A statement in words.
    pub fn statement(what: impl Into<String>, ours: impl Into<String>, holds: bool) -> Self {
        let verdict = Verdict::Holds(holds);
        Self {
            what: what.into(),
            published: String::new(),
            ours: ours.into(),
            verdict,
            remark: String::new(),
        }
    }

    /// A number that cannot be had again, and why; `ours` is what comes of the nearest reading.
    pub fn lost(
        what: impl Into<String>,
        published: impl Into<String>,
        ours: impl Into<String>,
        why: &'static str,
    ) -> Self {
        let verdict = Verdict::NotRecoverable(why);
        Self {
            what: what.into(),
            published: published.into(),
            ours: ours.into(),
            verdict,
            remark: String::new(),
        }
    }

    /// The same with a remark.
    #[must_use]
    pub fn remark(self, remark: impl Into<String>) -> Self {
        Self { remark: remark.into(), ..self }
    }

    fn of(what: impl Into<String>, published: String, ours: String, z: f64) -> Self {
        let verdict = if z <= APART { Verdict::Within(z) } else { Verdict::Differs(z) };
        Self { what: what.into(), published, ours, verdict, remark: String::new() }
    }
}

impl core::fmt::Display for Verdict {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let size = |z: f64| if z < 100.0 { format!("{z:.1} σ") } else { "over 100 σ".to_owned() };
        match self {
            Self::Within(z) => write!(f, "within ({})", size(*z)),
            Self::Differs(z) => write!(f, "**differs** ({})", size(*z)),
            Self::NotRecoverable(why) => write!(f, "not recoverable: {why}"),
            Self::Holds(true) => f.write_str("holds"),
            Self::Holds(false) => f.write_str("**does not hold**"),
        }
    }
}

/// A number as a reader wants it: four significant digits.
pub(crate) fn shown(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{x}");
    }
    let power = x.abs().log10().floor();
    if (-3.0..6.0).contains(&power) {
        format!("{x:.*}", (3.0 - power).max(0.0) as usize)
    } else {
        format!("{x:.3e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::normal_two_sided;

    #[test]
    fn a_number_is_judged_by_both_spreads() {
        // one standard deviation of the difference of two equal samples is √2 of one
        let claim = |published| Claim::number("", published, 10.0, 1.0, 100.0, 100.0).verdict;
        assert!(matches!(claim(14.0), Verdict::Within(z) if (z - 8f64.sqrt()).abs() < 1e-12));
        assert!(matches!(claim(14.3), Verdict::Differs(_)));
    }

    #[test]
    fn a_count_is_judged_exactly() {
        assert!(matches!(Claim::count("", 0, 100, 0, 100).verdict, Verdict::Within(z) if z == 0.0));
        assert!(matches!(Claim::count("", 34, 100, 59, 100).verdict, Verdict::Differs(_)));
        assert!(matches!(Claim::count("", 56, 100, 58, 100).verdict, Verdict::Within(_)));
        assert!((normal_two_sided(3.0) - 0.002_699_796).abs() < 1e-8);
    }

    #[test]
    fn numbers_are_shown_to_four_digits() {
        assert_eq!(
            ["23.15", "0.002100", "2.480e-6"],
            [23.15, 0.0021, 2.48e-6].map(shown).each_ref().map(String::as_str)
        );
    }
}

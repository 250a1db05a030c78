//! A published number or statement beside ours.

use crate::Estimate;
use crate::estimate::{FEW, MANY, NOTHING, counted};
use crate::statistics::{fisher, z_of};

/// What is to be said of a published number or statement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// The number lies within what two samples of these sizes may be apart: so many standard deviations of their difference.
    Within(f64),
    /// It does not: by so many standard deviations.
    Differs(f64),
    /// Nobody can tell, and why.
    NotRecoverable(&'static str),
    /// A statement that our runs bear out, by more than their spread.
    Holds,
    /// One that they contradict, by more than their spread.
    Fails,
    /// A number or statement on which they decide nothing, and why.
    Undecided(&'static str),
}

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
    /// What else is known, or why a difference stands.
    pub remark: String,
}

impl Claim {
    fn new(
        what: impl Into<String>,
        published: impl Into<String>,
        ours: impl Into<String>,
        verdict: Verdict,
    ) -> Self {
        let (what, published, ours) = (what.into(), published.into(), ours.into());
        Self { what, published, ours, verdict, remark: String::new() }
    }

    /// A number against ours, whose error is that of one replication: `of_theirs` runs in print and `of_ours` here.
    pub fn number(
        what: impl Into<String>,
        published: f64,
        ours: Estimate,
        of_theirs: f64,
        of_ours: f64,
    ) -> Self {
        let apart = ours.error * (1.0 + of_ours / of_theirs).sqrt();
        let (told, off) = (shown(published), (published - ours.value).abs());
        if !ours.value.is_finite() {
            return Self::new(what, told, "–", Verdict::Undecided(NOTHING));
        }
        if apart.is_nan() {
            return Self::new(what, told, shown(ours.value), Verdict::Undecided(FEW));
        }
        let z = if apart > 0.0 { off / apart } else { f64::INFINITY };
        Self::new(what, told, format!("{} ± {}", shown(ours.value), shown(ours.error)), of(z))
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
        Self::new(what, format!("{published} of {of_theirs}"), counted(ours, of_ours), of(z))
    }

    /// A statement in words.
    pub fn statement(what: impl Into<String>, ours: impl Into<String>, verdict: Verdict) -> Self {
        Self::new(what, "", ours, verdict)
    }

    /// A number that cannot be had again, and why; `ours` is what comes of the nearest reading.
    pub fn lost(
        what: impl Into<String>,
        published: impl Into<String>,
        ours: impl Into<String>,
        why: &'static str,
    ) -> Self {
        Self::new(what, published, ours, Verdict::NotRecoverable(why))
    }

    /// The same with a remark.
    #[must_use]
    pub fn remark(self, remark: impl Into<String>) -> Self {
        Self { remark: remark.into(), ..self }
    }

    /// The same with a remark that explains why it differs or fails, and is said only where it does.
    #[must_use]
    pub fn explained(self, remark: impl Into<String>) -> Self {
        match self.verdict {
            Verdict::Differs(_) | Verdict::Fails => self.remark(remark),
            _ => self,
        }
    }
}

fn of(z: f64) -> Verdict {
    if z <= MANY { Verdict::Within(z) } else { Verdict::Differs(z) }
}

impl core::fmt::Display for Verdict {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let size = |z: f64| if z < 100.0 { format!("{z:.1} σ") } else { "over 100 σ".to_owned() };
        match self {
            Self::Within(z) => write!(f, "within ({})", size(*z)),
            Self::Differs(z) => write!(f, "**differs** ({})", size(*z)),
            Self::NotRecoverable(why) => write!(f, "not recoverable: {why}"),
            Self::Holds => f.write_str("holds"),
            Self::Fails => f.write_str("**does not hold**"),
            Self::Undecided(why) => write!(f, "undecided: {why}"),
        }
    }
}

/// A number as a reader wants it: four significant digits; a dash for none.
pub(crate) fn shown(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return if x.is_finite() { "0".to_owned() } else { "–".to_owned() };
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
        let ours = |error| Estimate { value: 10.0, error };
        let claim = |published| Claim::number("", published, ours(1.0), 100.0, 100.0).verdict;
        assert!(matches!(claim(14.0), Verdict::Within(z) if (z - 8f64.sqrt()).abs() < 1e-12));
        assert!(matches!(claim(14.3), Verdict::Differs(_)));
        let few = Claim::number("", 14.3, ours(f64::NAN), 100.0, 2.0);
        assert_eq!((few.verdict, few.ours.as_str()), (Verdict::Undecided(FEW), "10.00"));
    }

    #[test]
    fn a_count_is_judged_exactly() {
        assert!(matches!(Claim::count("", 0, 100, 0, 100).verdict, Verdict::Within(z) if z == 0.0));
        assert!(matches!(Claim::count("", 34, 100, 59, 100).verdict, Verdict::Differs(_)));
        assert!(matches!(Claim::count("", 56, 100, 58, 100).verdict, Verdict::Within(_)));
        assert!((normal_two_sided(3.0) - 0.002_699_796).abs() < 1e-8);
    }

    #[test]
    fn an_explanation_stands_only_beside_what_it_explains() {
        let said = |verdict| Claim::statement("", "", verdict).explained("why").remark;
        assert_eq!([Verdict::Fails, Verdict::Differs(4.0)].map(said), ["why", "why"]);
        assert_eq!([Verdict::Holds, Verdict::Within(1.0), Verdict::Undecided(FEW)].map(said), ["", "", ""]);
    }

    #[test]
    fn numbers_are_shown_to_four_digits() {
        assert_eq!(
            ["23.15", "0.002100", "2.480e-6", "–"],
            [23.15, 0.0021, 2.48e-6, f64::NAN].map(shown).each_ref().map(String::as_str)
        );
    }
}

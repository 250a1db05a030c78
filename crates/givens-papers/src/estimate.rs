//! A number with its standard error, and what it decides.

use crate::Verdict;
use crate::statistics::{binomial_z, share_error};

/// A number and its standard error; the error is not a number where too few runs tell it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// As measured.
    pub value: f64,
    /// The standard deviation over replications of the size that was run.
    pub error: f64,
}

/// So many standard errors decide one comparison, or each of up to six.
pub(crate) const ONE: f64 = 2.0;
/// So many decide each of more.
pub(crate) const MANY: f64 = 3.0;

impl Estimate {
    /// Whether it lies above a bound, by so many standard errors.
    pub(crate) fn above(self, bound: f64, sigmas: f64) -> Verdict {
        let over = self.value - bound;
        if over.is_nan() {
            Verdict::Undecided(NOTHING)
        } else if self.error.is_nan() {
            Verdict::Undecided(FEW)
        } else if over > sigmas * self.error {
            Verdict::Holds
        } else if over < -sigmas * self.error {
            Verdict::Fails
        } else {
            Verdict::Undecided(NEAR)
        }
    }

    /// Whether it lies below a bound.
    pub(crate) fn below(self, bound: f64, sigmas: f64) -> Verdict {
        Self { value: -self.value, ..self }.above(-bound, sigmas)
    }

    /// Whether it lies between two bounds.
    pub(crate) fn between(self, [low, high]: [f64; 2], sigmas: f64) -> Verdict {
        all([self.above(low, sigmas), self.below(high, sigmas)])
    }

    /// The difference of two that are independent.
    pub(crate) fn less(self, other: Self) -> Self {
        Self { value: self.value - other.value, error: self.error.hypot(other.error) }
    }
}

/// `value ± error`, with as many decimals as the formatter asks for; a dash for no number.
impl core::fmt::Display for Estimate {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let decimals = f.precision().unwrap_or(1);
        match (self.value.is_finite(), self.error.is_finite()) {
            (false, _) => f.write_str("–"),
            (true, false) => write!(f, "{:.decimals$}", self.value),
            (true, true) => write!(f, "{:.decimals$} ± {:.decimals$}", self.value, self.error),
        }
    }
}

pub(crate) const NEAR: &str = "within the spread of so many runs";
pub(crate) const FEW: &str = "fewer than 10 runs to tell a spread from";
pub(crate) const NOTHING: &str = "nothing to compare";

/// Whether more than `rate` of the runs are hits, by the exact binomial distribution.
pub(crate) fn more_than(hits: usize, of: usize, rate: f64, sigmas: f64) -> Verdict {
    match binomial_z(hits, of, rate) {
        _ if of == 0 => Verdict::Undecided(NOTHING),
        z if z > sigmas => Verdict::Holds,
        z if z < -sigmas => Verdict::Fails,
        _ => Verdict::Undecided(NEAR),
    }
}

/// Whether fewer are.
pub(crate) fn fewer_than(hits: usize, of: usize, rate: f64, sigmas: f64) -> Verdict {
    more_than(of - hits.min(of), of, 1.0 - rate, sigmas)
}

/// `7 of 100 (7.0 ± 2.6 %)`; none and all have no binomial error.
pub(crate) fn counted(hits: usize, of: usize) -> String {
    match hits {
        0 => format!("0 of {of}"),
        all if all == of => format!("{of} of {of}"),
        _ => {
            let percent = Estimate { value: hits as f64 / of as f64, error: share_error(hits, of) };
            let percent = Estimate { value: 100.0 * percent.value, error: 100.0 * percent.error };
            format!("{hits} of {of} ({percent:.1} %)")
        }
    }
}

/// One that fails decides against a statement of several parts; else one that is undecided leaves it so.
pub(crate) fn all(parts: impl IntoIterator<Item = Verdict>) -> Verdict {
    let mut open = None;
    for part in parts {
        match part {
            Verdict::Holds => {}
            Verdict::Undecided(_) => open = open.or(Some(part)),
            _ => return part,
        }
    }
    open.unwrap_or(Verdict::Holds)
}

/// One that holds decides for a statement of which one part will do.
pub(crate) fn any(parts: impl IntoIterator<Item = Verdict>) -> Verdict {
    let weight = |part: &Verdict| match part {
        Verdict::Holds => 2,
        Verdict::Undecided(_) => 1,
        _ => 0,
    };
    parts.into_iter().max_by_key(weight).unwrap_or(Verdict::Undecided(NOTHING))
}

/// Whether a deviation that has no spread stays below a bound.
pub(crate) fn bounded(deviation: f64, bound: f64) -> Verdict {
    Estimate { value: deviation, error: 0.0 }.below(bound, ONE)
}

/// What is exact and needs no spread.
pub(crate) fn exactly(holds: bool) -> Verdict {
    if holds { Verdict::Holds } else { Verdict::Fails }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(value: f64, error: f64) -> Estimate {
        Estimate { value, error }
    }

    #[test]
    fn what_lies_within_its_spread_decides_nothing() {
        assert_eq!(of(1.3, 0.1).above(1.0, ONE), Verdict::Holds);
        assert_eq!(of(0.7, 0.1).above(1.0, ONE), Verdict::Fails);
        assert_eq!(of(1.1, 0.1).above(1.0, ONE), Verdict::Undecided(NEAR));
        assert_eq!(of(1.0, 0.0).above(1.0, ONE), Verdict::Undecided(NEAR));
        assert_eq!(of(1.3, f64::NAN).above(1.0, ONE), Verdict::Undecided(FEW));
        assert_eq!(of(f64::NAN, f64::NAN).below(1.0, ONE), Verdict::Undecided(NOTHING));
        assert_eq!(of(1.02, 0.01).between([0.9, 1.1], MANY), Verdict::Holds);
    }

    #[test]
    fn a_share_is_judged_by_its_binomial() {
        assert_eq!(more_than(55, 100, 0.5, ONE), Verdict::Undecided(NEAR));
        assert_eq!(more_than(450, 1000, 0.5, ONE), Verdict::Fails);
        assert_eq!(more_than(98, 100, 0.5, ONE), Verdict::Holds);
        assert_eq!(more_than(2, 2, 0.5, ONE), Verdict::Undecided(NEAR));
        assert_eq!(more_than(0, 0, 0.5, ONE), Verdict::Undecided(NOTHING));
        assert_eq!(fewer_than(3, 100, 0.5, ONE), Verdict::Holds);
    }

    #[test]
    fn a_part_that_fails_weighs_more_than_one_that_is_undecided() {
        let open = Verdict::Undecided(NEAR);
        assert_eq!(all([Verdict::Holds, open, Verdict::Fails]), Verdict::Fails);
        assert_eq!(all([Verdict::Holds, open]), open);
        assert_eq!(all([Verdict::Holds; 2]), Verdict::Holds);
        assert_eq!(any([Verdict::Fails, Verdict::Holds, open]), Verdict::Holds);
        assert_eq!(any([Verdict::Fails, open]), open);
    }

    #[test]
    fn no_number_is_printed_as_nan() {
        assert_eq!(format!("{:.1} m", of(29.8, f64::NAN)), "29.8 m");
        assert_eq!(format!("{:.2}", of(f64::NAN, 1.0)), "–");
        assert_eq!(format!("{}", of(2.0, 0.3)), "2.0 ± 0.3");
        assert_eq!(counted(58, 100), "58 of 100 (58.0 ± 4.9 %)");
        assert_eq!(counted(580, 1000), "580 of 1000 (58.0 ± 1.6 %)");
        assert_eq!(counted(0, 100), "0 of 100");
    }
}

//! Least, quartiles and median; times in words.

/// Of some numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The least of them.
    pub least: f64,
    /// A quarter is less.
    pub lower: f64,
    /// One half is less.
    pub median: f64,
    /// A quarter is more.
    pub upper: f64,
}

impl Spread {
    /// None of no numbers.
    #[must_use]
    pub fn of(numbers: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut sorted: Vec<f64> = numbers.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        let least = *sorted.first()?;
        let at = |share: f64| {
            let place = share * (sorted.len() - 1) as f64;
            let (below, rest) = (place.floor() as usize, place.fract());
            let above = (below + 1).min(sorted.len() - 1);
            sorted[below] + rest * (sorted[above] - sorted[below])
        };
        Some(Self { least, lower: at(0.25), median: at(0.5), upper: at(0.75) })
    }
}

/// Nanoseconds, in a unit that suits.
#[must_use]
pub fn duration(ns: f64) -> String {
    let (value, unit) = match ns {
        ns if ns < 1e3 => return format!("{ns:.0} ns"),
        ns if ns < 1e6 => (ns / 1e3, "µs"),
        ns if ns < 1e9 => (ns / 1e6, "ms"),
        ns => (ns / 1e9, "s"),
    };
    let digits = 2_usize.saturating_sub(value.log10().floor().max(0.0) as usize);
    format!("{value:.digits$} {unit}")
}

#[cfg(test)]
mod tests {
    use super::{Spread, duration};

    #[test]
    fn quartiles_lie_between_the_numbers() {
        let spread = Spread::of([4.0, 1.0, 3.0, 2.0]).unwrap();
        assert_eq!(spread, Spread { least: 1.0, lower: 1.75, median: 2.5, upper: 3.25 });
        assert_eq!(Spread::of([]), None);
    }

    #[test]
    fn times_have_three_digits() {
        assert_eq!(duration(123.4), "123 ns");
        assert_eq!(duration(1234.0), "1.23 µs");
        assert_eq!(duration(45_670.0), "45.7 µs");
        assert_eq!(duration(1.234e8), "123 ms");
        assert_eq!(duration(3.024e9), "3.02 s");
    }
}

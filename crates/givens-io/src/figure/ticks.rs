//! Where an axis is ticked, and what its ticks say.

use super::number;
use super::scale::Scale;

/// The ticks of one axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Ticks {
    /// Values on the axis, ascending.
    pub values: Vec<f64>,
    /// What stands beside each.
    pub labels: Vec<String>,
    /// What the labels leave out: a value on the axis is its label plus this.
    pub offset: Option<String>,
}

/// Ticks inside `range`, as many as stand a `count`th of the axis apart.
pub(super) fn ticks(scale: Scale, range: [f64; 2], count: f64) -> Ticks {
    let count = count.clamp(1.0, 50.0);
    let [lo, hi] = range;
    if !(scale.holds(lo) && scale.holds(hi) && lo < hi) {
        return Ticks::default();
    }
    match scale {
        Scale::Linear => linear(lo, hi, count),
        Scale::Log => logarithmic(range, count),
        Scale::Compressed { .. } => {
            let upper = decades(1e-3 * hi.max(-lo), hi.max(-lo));
            let lower = upper.iter().rev().map(|v| -v);
            let mut values: Vec<f64> = lower.chain([0.0]).chain(upper.iter().copied()).collect();
            values.retain(|v| (lo..=hi).contains(v));
            spread(scale, range, count, &values)
        }
    }
}

/// A step of 1, 2 or 5 times a power of ten: its digit and the power.
fn nice_step(raw: f64) -> (f64, i32) {
    let power = raw.log10().floor();
    let share = raw / 10f64.powf(power);
    let power = power as i32;
    match share {
        s if s <= 1.000_001 => (1.0, power),
        s if s <= 2.000_001 => (2.0, power),
        s if s <= 5.000_001 => (5.0, power),
        _ => (1.0, power + 1),
    }
}

fn linear(lo: f64, hi: f64, count: f64) -> Ticks {
    let (digit, power) = nice_step((hi - lo) / count);
    let offset = offset(lo, hi, power);
    let (low, high) = (lo - offset, hi - offset);
    // Multiples by division where the power is negative: 3/10, not 3 × 0.1.
    let multiple = |k: f64| {
        if power < 0 { k * digit / 10f64.powi(-power) } else { k * digit * 10f64.powi(power) }
    };
    let step = multiple(1.0);
    let (first, last) = ((low / step - 1e-6).ceil(), (high / step + 1e-6).floor());
    if !(step > 0.0 && first.is_finite() && last - first <= 200.0) {
        return Ticks::default();
    }
    let marks: Vec<f64> =
        (0..=(last - first).max(0.0) as usize).map(|i| multiple(first + i as f64)).collect();
    Ticks {
        values: marks.iter().map(|v| v + offset).collect(),
        labels: number::alike(&marks, power),
        offset: (offset != 0.0).then(|| number::plain(offset, usize::try_from(-power).unwrap_or(0))),
    }
}

/// What to take off all labels where they would need too many digits to differ; else zero.
fn offset(lo: f64, hi: f64, power: i32) -> f64 {
    let size = lo.abs().max(hi.abs());
    // Large values are written with a power of ten, which leaves less room for digits.
    let most = if size < 1e7 { 1e6 } else { 1e4 };
    if size / 10f64.powi(power) < most || lo < 0.0 && hi > 0.0 || !(1e-4..1e15).contains(&size) {
        return 0.0;
    }
    // Rounded down from within the range, so that data from a round number on begin at zero.
    let coarse = (hi - lo).log10().ceil() as i32;
    let units = |v: f64| if coarse < 0 { v * 10f64.powi(-coarse) } else { v / 10f64.powi(coarse) };
    let whole = units(lo + 0.1 * (hi - lo)).floor();
    if coarse < 0 { whole / 10f64.powi(-coarse) } else { whole * 10f64.powi(coarse) }
}

/// 1, 2 and 5 times the powers of ten; in a range that has fewer than three of them, multiples of one step of 1, 2 or 5.
fn logarithmic([lo, hi]: [f64; 2], count: f64) -> Ticks {
    let round = spread(Scale::Log, [lo, hi], count, &decades(lo, hi));
    if round.values.len() >= 3 {
        return round;
    }
    let apart = (hi / lo).log10() / count * 0.999;
    let fits = |ticks: &Ticks| ticks.values.windows(2).all(|w| (w[1] / w[0]).log10() >= apart);
    let finest = (count.ceil() as u32).saturating_mul(4);
    let even = (1..=finest).rev().map(|count| linear(lo, hi, f64::from(count))).find(fits);
    even.filter(|even| even.values.len() > round.values.len()).unwrap_or(round)
}

/// 1, 2 and 5 times the powers of ten in a positive range.
fn decades(lo: f64, hi: f64) -> Vec<f64> {
    let (first, last) = (lo.log10().floor() as i32, hi.log10().ceil() as i32);
    let mut values = Vec::new();
    for power in first..=last {
        for digit in [1.0, 2.0, 5.0] {
            let v = if power < 0 { digit / 10f64.powi(-power) } else { digit * 10f64.powi(power) };
            if v >= lo * 0.999_999 && v <= hi * 1.000_001 {
                values.push(v);
            }
        }
    }
    values
}

/// Keeps of the ascending `values` those that stand at least a `count`th of the axis apart: zero first,
/// then from the ends inwards. Where 1, 2 and 5 have no room, only powers of ten are kept.
fn spread(scale: Scale, range: [f64; 2], count: f64, values: &[f64]) -> Ticks {
    let [a, b] = range.map(|v| scale.forward(v));
    let apart = (b - a) / count * 0.999;
    let decade = if scale == Scale::Log { 1.0 } else { core::f64::consts::LN_10 };
    let all = apart <= decade * core::f64::consts::LOG10_2 || b - a < decade;
    let round = |v: f64| v == 0.0 || (v.abs().log10() - v.abs().log10().round()).abs() < 1e-9;
    let mut kept: Vec<f64> = values.iter().copied().filter(|v| *v == 0.0).collect();
    let positive = values.iter().rev().take_while(|v| **v > 0.0);
    let negative = values.iter().take_while(|v| **v < 0.0);
    for v in positive.chain(negative).copied().filter(|v| all || round(*v)) {
        if kept.iter().all(|k| (scale.forward(*k) - scale.forward(v)).abs() >= apart) {
            kept.push(v);
        }
    }
    kept.sort_by(f64::total_cmp);
    Ticks { labels: kept.iter().map(|v| number::short(*v)).collect(), values: kept, offset: None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn labels(lo: f64, hi: f64, count: f64) -> Vec<String> {
        ticks(Scale::Linear, [lo, hi], count).labels
    }

    #[test]
    fn steps_are_one_two_or_five() {
        assert_eq!(labels(0.0, 10.0, 5.0), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(labels(-0.12, 0.31, 5.0), ["−0.1", "0.0", "0.1", "0.2", "0.3"]);
        assert_eq!(labels(0.0, 31_000.0, 4.0), ["0", "10\u{2009}000", "20\u{2009}000", "30\u{2009}000"]);
        assert_eq!(labels(1.0, 9.0, 2.0), ["5"]);
    }

    #[test]
    fn very_large_and_small_values_use_powers_of_ten() {
        assert_eq!(labels(0.0, 2e9, 2.0), ["0", "1×10⁹", "2×10⁹"]);
        assert_eq!(labels(0.0, 3e-7, 3.0), ["0", "1×10⁻⁷", "2×10⁻⁷", "3×10⁻⁷"]);
    }

    #[test]
    fn labels_that_differ_in_the_last_digits_share_an_offset() {
        let t = ticks(Scale::Linear, [1_700_000_003.0, 1_700_000_103.0], 5.0);
        assert_eq!(t.offset.as_deref(), Some("1\u{2009}700\u{2009}000\u{2009}000"));
        assert_eq!(t.labels, ["20", "40", "60", "80", "100"]);
        assert_eq!(t.values[0], 1_700_000_020.0);
    }

    #[test]
    fn log_ticks_are_powers_of_ten() {
        assert_eq!(ticks(Scale::Log, [1.0, 1000.0], 4.0).labels, ["1", "10", "100", "1000"]);
    }

    #[test]
    fn a_short_log_axis_has_round_steps() {
        let labels = |lo, hi| ticks(Scale::Log, [lo, hi], 8.0).labels;
        assert_eq!(labels(500.0, 1250.0), ["600", "800", "1000", "1200"]);
        assert_eq!(labels(24.0, 47.0), ["25", "30", "35", "40", "45"]);
        assert_eq!(labels(12.0, 340.0), ["20", "50", "100", "200"]);
    }

    #[test]
    fn compressed_ticks_start_at_zero_and_reach_the_outlier() {
        let t = ticks(Scale::Compressed { unit: 1.5 }, [0.0, 1200.0], 5.0);
        assert_eq!((t.values[0], t.values[t.values.len() - 1]), (0.0, 1000.0));
    }

    proptest! {
        #[test]
        fn ticks_ascend_inside_any_range(a in proptest::num::f64::ANY, b in proptest::num::f64::ANY, n in -1.0..100.0f64, kind in 0..3) {
            let scale = match kind { 0 => Scale::Linear, 1 => Scale::Log, _ => Scale::Compressed { unit: b } };
            let range = scale.range(Some([a, b]), 0.04);
            let t = ticks(scale, range, n);
            prop_assert_eq!(t.values.len(), t.labels.len());
            prop_assert!(t.values.len() <= 101);
            prop_assert!(t.values.windows(2).all(|w| w[0] <= w[1]));
            let slack = 1e-5 * (range[1] - range[0]) + 1e-9 * range[1].abs();
            prop_assert!(t.values.iter().all(|v| *v >= range[0] - slack && *v <= range[1] + slack));
        }
    }
}

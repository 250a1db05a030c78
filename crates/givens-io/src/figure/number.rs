//! Numbers as a reader of a figure wants them: a true minus, thin spaces between thousands, powers of
//! ten written out.

/// `v` with `decimals` digits after the point.
pub(super) fn plain(v: f64, decimals: usize) -> String {
    let digits = format!("{:.*}", decimals.min(17), v.abs());
    let (whole, rest) = digits.split_at(digits.find('.').unwrap_or(digits.len()));
    let negative = v < 0.0 && digits.bytes().any(|b| (b'1'..=b'9').contains(&b));
    let mut out = String::from(if negative { "−" } else { "" });
    for (i, c) in whole.chars().enumerate() {
        // Four digits read well unbroken.
        if i > 0 && whole.len() > 4 && (whole.len() - i).is_multiple_of(3) {
            out.push('\u{2009}');
        }
        out.push(c);
    }
    out + rest
}

/// Labels for the ticks of one axis, all in one form; `power` is the power of ten of their step.
pub(super) fn alike(values: &[f64], power: i32) -> Vec<String> {
    let size = values.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    let large = if size > 0.0 { size.log10().floor() as i32 } else { 0 };
    if (-4..7).contains(&large) && power > -7 {
        let decimals = usize::try_from(-power).unwrap_or(0);
        return values.iter().map(|v| plain(*v, decimals)).collect();
    }
    let decimals = usize::try_from(large - power).unwrap_or(0);
    let mantissa = |v: f64| plain(v / 10f64.powi(large), decimals);
    values.iter().map(|v| if *v == 0.0 { "0".into() } else { scientific(&mantissa(*v), large) }).collect()
}

/// One number in its shortest form, to three significant digits.
pub(super) fn short(v: f64) -> String {
    if v == 0.0 || !v.is_finite() {
        return if v == 0.0 { "0".into() } else { format!("{v}") };
    }
    let power = v.abs().log10().floor() as i32;
    let trimmed = |v: f64, decimals: usize| {
        let text = plain(v, decimals);
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    };
    if (-4..7).contains(&power) {
        trimmed(v, usize::try_from(2 - power).unwrap_or(0))
    } else {
        scientific(&trimmed(v / 10f64.powi(power), 2), power)
    }
}

fn scientific(mantissa: &str, power: i32) -> String {
    let exponent: String = power
        .to_string()
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            '4' => '⁴',
            '5' => '⁵',
            '6' => '⁶',
            '7' => '⁷',
            '8' => '⁸',
            '9' => '⁹',
            _ => '⁰',
        })
        .collect();
    format!("{mantissa}×10{exponent}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_set_as_in_print() {
        assert_eq!(plain(-1234.5, 1), "−1234.5");
        assert_eq!(plain(12_345_678.0, 0), "12\u{2009}345\u{2009}678");
        assert_eq!(plain(-0.001, 1), "0.0");
        assert_eq!(short(1200.0), "1200");
        assert_eq!(short(0.05), "0.05");
        assert_eq!(short(-3.2e-9), "−3.2×10⁻⁹");
        assert_eq!(short(1e30), "1×10³⁰");
    }
}

//! Scales: how a value becomes a place along an axis.

/// How an axis spreads its values.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Scale {
    /// Equal steps are equally long.
    #[default]
    Linear,
    /// Equal ratios are equally long; values of zero and below are not drawn.
    Log,
    /// Linear well below `unit`, logarithmic well above it: ln(1 + |v|/unit), with the sign of v. For
    /// values of which a few are very large and must not flatten the rest.
    Compressed {
        /// Where the one turns into the other; positive.
        unit: f64,
    },
}

/// Beyond this, differences of values could overflow.
const LARGEST: f64 = 1e290;

impl Scale {
    /// Whether `v` has a place on this scale.
    pub(super) fn holds(self, v: f64) -> bool {
        v.is_finite() && v.abs() < LARGEST && (self != Self::Log || v > 1.0 / LARGEST)
    }

    /// From the value to a coordinate in which the axis is even.
    pub(super) fn forward(self, v: f64) -> f64 {
        match self {
            Self::Linear => v,
            Self::Log => v.log10(),
            Self::Compressed { unit } => (v.abs() / positive(unit)).ln_1p().copysign(v),
        }
    }

    /// Back from the even coordinate to the value.
    pub(super) fn backward(self, u: f64) -> f64 {
        match self {
            Self::Linear => u,
            Self::Log => 10f64.powf(u),
            Self::Compressed { unit } => (u.abs().exp_m1() * positive(unit)).copysign(u),
        }
    }

    /// A range that can be drawn: `lo < hi`, both on the scale, with `padding` as a share of the length
    /// added at each end. `None` for no data.
    pub(super) fn range(self, span: Option<[f64; 2]>, padding: f64) -> [f64; 2] {
        let empty = if self == Self::Log { [1.0, 10.0] } else { [0.0, 1.0] };
        let Some([lo, hi]) = span.filter(|s| self.holds(s[0]) && self.holds(s[1])) else { return empty };
        let (lo, hi) = (lo.min(hi), lo.max(hi));
        let (a, b) = (self.forward(lo), self.forward(hi));
        let size = a.abs().max(b.abs());
        let pad = if b - a > size * 1e-12 && b - a > 1.0 / LARGEST {
            (b - a) * padding
        } else if self == Self::Log {
            0.5
        } else if size > 1.0 / LARGEST {
            0.1 * size
        } else {
            1.0
        };
        let out = [self.backward(a - pad), self.backward(b + pad)];
        if self.holds(out[0]) && self.holds(out[1]) { out } else { [lo, hi] }
    }
}

fn positive(unit: f64) -> f64 {
    if unit.is_finite() && unit > 1e-200 { unit } else { 1.0 }
}

/// The smallest and largest of the values that the scale holds.
pub(super) fn span(scale: Scale, values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.filter(|&v| scale.holds(v)).fold(None, |span, v| match span {
        None => Some([v, v]),
        Some([lo, hi]) => Some([lo.min(v), hi.max(v)]),
    })
}

/// A scale laid on pixels: `range` runs from `pixels[0]` to `pixels[1]`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ruler {
    pub scale: Scale,
    pub range: [f64; 2],
    pub pixels: [f64; 2],
}

impl Ruler {
    /// The pixel of `v`; `None` where the scale does not hold it.
    pub fn place(&self, v: f64) -> Option<f64> {
        if !self.scale.holds(v) {
            return None;
        }
        let [a, b] = self.range.map(|v| self.scale.forward(v));
        let share = (self.scale.forward(v) - a) / (b - a);
        let pixel = self.pixels[0] + share * (self.pixels[1] - self.pixels[0]);
        pixel.is_finite().then_some(pixel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forward_and_backward_are_inverse() {
        for scale in [Scale::Linear, Scale::Log, Scale::Compressed { unit: 2.0 }] {
            for v in [1e-6, 0.5, 3.0, 4e7] {
                let back = scale.backward(scale.forward(v));
                assert!((back - v).abs() < 1e-9 * v, "{scale:?} {v} came back as {back}");
            }
        }
    }

    #[test]
    fn a_constant_still_has_a_range() {
        for v in [0.0, -0.05, 1e9, 1e-300, 1e289] {
            let [lo, hi] = Scale::Linear.range(Some([v, v]), 0.04);
            assert!(lo < hi || v == 1e289, "{v}: {lo} {hi}");
        }
        let [lo, hi] = Scale::Log.range(Some([5.0, 5.0]), 0.04);
        assert!(lo < 5.0 && 5.0 < hi);
    }
}

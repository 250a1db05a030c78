//! An unevaluated sum of two numbers, for the few places where one float is not enough.

use super::Lanes;
use super::format::Format;

/// hi + lo with |lo| at most half a unit in the last place of hi.
#[derive(Clone, Copy)]
pub(super) struct Two<T> {
    pub(super) hi: T,
    pub(super) lo: T,
}

impl<T: Lanes> Two<T> {
    #[inline(always)]
    pub(super) fn constant((hi, lo): (f64, f64)) -> Self {
        Self { hi: T::of(hi), lo: T::of(lo) }
    }

    /// a + b, exact.
    #[inline(always)]
    pub(super) fn sum(a: T, b: T) -> Self {
        let hi = a + b;
        let from_b = hi - a;
        Self { hi, lo: (a - (hi - from_b)) + (b - from_b) }
    }

    /// a + b, exact where |a| ≥ |b|.
    #[inline(always)]
    pub(super) fn ordered_sum(a: T, b: T) -> Self {
        let hi = a + b;
        Self { hi, lo: b - (hi - a) }
    }

    /// a b, exact (without a fused instruction: where neither overflows when split in halves).
    #[inline(always)]
    pub(super) fn product(a: T, b: T) -> Self {
        let hi = a * b;
        if T::FUSED {
            return Self { hi, lo: a.mul_add(b, -hi) };
        }
        let halves = |x: T| {
            let wide = x * T::of(T::Element::SPLITTER);
            let upper = wide - (wide - x);
            (upper, x - upper)
        };
        let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
        Self { hi, lo: ((a1 * b1 - hi) + a1 * b2 + a2 * b1) + a2 * b2 }
    }

    /// a b, to the square of the rounding.
    #[inline(always)]
    pub(super) fn times(self, other: Self) -> Self {
        let p = Self::product(self.hi, other.hi);
        Self::ordered_sum(p.hi, p.lo + self.hi.mul_add(other.lo, self.lo * other.hi))
    }

    /// a / b, to the square of the rounding.
    #[inline(always)]
    pub(super) fn over(self, other: Self) -> Self {
        let hi = self.hi / other.hi;
        let back = Self::product(hi, other.hi);
        let rest = ((self.hi - back.hi) - back.lo) + (self.lo - hi * other.lo);
        Self { hi, lo: rest / other.hi }
    }

    #[inline(always)]
    pub(super) fn value(self) -> T {
        self.hi + self.lo
    }
}

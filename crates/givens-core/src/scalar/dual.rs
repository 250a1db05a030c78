//! Second-order duals: a value with its first and second derivative along one direction.

mod operators;

use super::{Inside, Real};

/// x(s) = v + d s + ½ dd s² + …: a value, and its first and second derivative along one direction s.
///
/// Every operation carries both derivatives exactly (to rounding). Comparisons look at the value alone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Dual2<T> {
    /// The value.
    pub v: T,
    /// The first derivative along s.
    pub d: T,
    /// The second derivative along s.
    pub dd: T,
}

/// The memory of `3 k` scalars as `k` duals; what is left over at the end is not used.
///
/// ```
/// let mut memory = [0.0_f64; 7];
/// assert_eq!(givens_core::scalar::as_duals(&mut memory).len(), 2);
/// ```
#[allow(unsafe_code)]
#[inline(always)]
pub fn as_duals<T: Real>(memory: &mut [T]) -> &mut [Dual2<T>] {
    // SAFETY: `Dual2<T>` is three `T` in `repr(C)`: same alignment, three times the size, no padding, and
    // any three `T` are a valid dual. The slice keeps the borrow of `memory`.
    unsafe { core::slice::from_raw_parts_mut(memory.as_mut_ptr().cast(), memory.len() / 3) }
}

impl<T: Real> Dual2<T> {
    /// The variable of differentiation itself: d = 1.
    #[inline(always)]
    pub fn variable(v: T) -> Self {
        Self::along(v, T::one())
    }

    /// A value that moves with slope `d`.
    #[inline(always)]
    pub fn along(v: T, d: T) -> Self {
        Self { v, d, dd: T::zero() }
    }

    /// A value that does not move.
    #[inline(always)]
    pub fn constant(v: T) -> Self {
        Self::along(v, T::zero())
    }

    /// f(self), from f and its first two derivatives at the value. What does not move has no derivative, also
    /// where f has an infinite one (√ at zero).
    #[inline(always)]
    fn chain(self, f: T, f1: T, f2: T) -> Self {
        let still = self.d.same(T::zero());
        let first = |d: T| T::select(d.same(T::zero()), T::zero(), f1 * d);
        let bend = T::select(still, T::zero(), f2 * self.d * self.d);
        Self { v: f, d: first(self.d), dd: first(self.dd) + bend }
    }
}

/// 2/√π e^(−x²), the slope of the error function.
#[inline(always)]
fn bell<T: Real>(x: T) -> T {
    T::of(core::f64::consts::FRAC_2_SQRT_PI) * (-(x * x)).exp()
}

impl<T: Real> Real for Dual2<T> {
    type Mask = T::Mask;
    const EPSILON: f64 = T::EPSILON;
    const FAINT: f64 = T::FAINT;
    const DEPTH: usize = T::DEPTH + 1;

    #[inline(always)]
    fn within<W: Inside>(work: W) -> W::Output {
        T::within(work)
    }

    #[inline(always)]
    fn of(value: f64) -> Self {
        Self::constant(T::of(value))
    }
    #[inline(always)]
    fn first(self) -> f64 {
        self.v.first()
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    #[inline(always)]
    fn recip(self) -> Self {
        let r = self.v.recip();
        let r2 = r * r;
        self.chain(r, -r2, (r2 + r2) * r)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let r = self.v.sqrt();
        let f1 = T::of(0.5) / r;
        self.chain(r, f1, -f1 / (self.v + self.v))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self::select(self.v.lt(T::zero()), -self, self)
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        let turned = self.v.copysign(sign.v).same(self.v);
        Self::select(turned, self, -self)
    }
    #[inline(always)]
    fn floor(self) -> Self {
        Self::constant(self.v.floor())
    }
    #[inline(always)]
    fn exp(self) -> Self {
        let e = self.v.exp();
        self.chain(e, e, e)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        let r = self.v.recip();
        self.chain(self.v.ln(), r, -(r * r))
    }
    #[inline(always)]
    fn log10(self) -> Self {
        let r = self.v.recip() * T::of(core::f64::consts::LOG10_E);
        self.chain(self.v.log10(), r, -(r / self.v))
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.v.sin_cos();
        (self.chain(s, c, -s), self.chain(c, -s, -c))
    }
    #[inline(always)]
    fn tan(self) -> Self {
        let t = self.v.tan();
        let f1 = t.mul_add(t, T::one());
        self.chain(t, f1, (t + t) * f1)
    }
    #[inline(always)]
    fn asin(self) -> Self {
        let w = (T::one() - self.v) * (T::one() + self.v);
        let f1 = w.sqrt().recip();
        self.chain(self.v.asin(), f1, self.v * f1 / w)
    }
    #[inline(always)]
    fn acos(self) -> Self {
        let w = (T::one() - self.v) * (T::one() + self.v);
        let f1 = -w.sqrt().recip();
        self.chain(self.v.acos(), f1, self.v * f1 / w)
    }
    #[inline(always)]
    fn atan(self) -> Self {
        let f1 = self.v.mul_add(self.v, T::one()).recip();
        self.chain(self.v.atan(), f1, -(self.v + self.v) * f1 * f1)
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        // with y = self and r² = x² + y²: θ' = (x y' − y x') / r², and that once more
        let (y, zero) = (self, T::zero());
        let r2 = x.v.mul_add(x.v, y.v * y.v);
        let still = y.d.same(zero) & x.d.same(zero) & y.dd.same(zero) & x.dd.same(zero);
        let turn = (x.v * y.d - y.v * x.d) / r2;
        let stretch = (x.v * x.d + y.v * y.d) / r2;
        let bend = (x.v * y.dd - y.v * x.dd) / r2 - (turn + turn) * stretch;
        Self { v: y.v.atan2(x.v), d: T::select(still, zero, turn), dd: T::select(still, zero, bend) }
    }
    #[inline(always)]
    fn sinh(self) -> Self {
        let (s, c) = (self.v.sinh(), self.v.cosh());
        self.chain(s, c, s)
    }
    #[inline(always)]
    fn cosh(self) -> Self {
        let (s, c) = (self.v.sinh(), self.v.cosh());
        self.chain(c, s, c)
    }
    #[inline(always)]
    fn tanh(self) -> Self {
        let t = self.v.tanh();
        let f1 = (T::one() - t) * (T::one() + t);
        self.chain(t, f1, -(t + t) * f1)
    }
    #[inline(always)]
    fn erf(self) -> Self {
        let f1 = bell(self.v);
        self.chain(self.v.erf(), f1, -(self.v + self.v) * f1)
    }
    #[inline(always)]
    fn erfc(self) -> Self {
        let f1 = -bell(self.v);
        self.chain(self.v.erfc(), f1, -(self.v + self.v) * f1)
    }
    #[inline(always)]
    fn pow(self, e: Self) -> Self {
        let zero = T::zero();
        let p = self.v.pow(e.v);
        // for a fixed exponent, the power rule holds for every base
        let f1 = e.v * self.v.pow(e.v - T::one());
        let f2 = e.v * (e.v - T::one()) * self.v.pow(e.v - T::of(2.0));
        let fixed = self.chain(p, f1, f2);
        let moving = (e * Self { v: self.v, d: self.d, dd: self.dd }.ln()).exp();
        let still = e.d.same(zero) & e.dd.same(zero);
        let mut r = Self::select(still, fixed, moving);
        r.v = p;
        r
    }
    #[inline(always)]
    fn powi(self, e: i32) -> Self {
        let n = T::of(f64::from(e));
        let f1 = if e == 0 { T::zero() } else { n * self.v.powi(e - 1) };
        let f2 = if e == 0 || e == 1 { T::zero() } else { n * (n - T::one()) * self.v.powi(e - 2) };
        self.chain(self.v.powi(e), f1, f2)
    }
    #[inline(always)]
    fn hypot(self, y: Self) -> Self {
        let (x, zero) = (self, T::zero());
        let r = x.v.hypot(y.v);
        let still = y.d.same(zero) & x.d.same(zero) & y.dd.same(zero) & x.dd.same(zero);
        let (c, s) = (x.v / r, y.v / r);
        let d = c * x.d + s * y.d;
        let across = c * y.d - s * x.d;
        let dd = c * x.dd + s * y.dd + across * across / r;
        Self { v: r, d: T::select(still, zero, d), dd: T::select(still, zero, dd) }
    }
    #[inline(always)]
    fn lt(self, other: Self) -> T::Mask {
        self.v.lt(other.v)
    }
    #[inline(always)]
    fn le(self, other: Self) -> T::Mask {
        self.v.le(other.v)
    }
    #[inline(always)]
    fn same(self, other: Self) -> T::Mask {
        self.v.same(other.v)
    }
    #[inline(always)]
    fn select(mask: T::Mask, yes: Self, no: Self) -> Self {
        Self {
            v: T::select(mask, yes.v, no.v),
            d: T::select(mask, yes.d, no.d),
            dd: T::select(mask, yes.dd, no.dd),
        }
    }
}

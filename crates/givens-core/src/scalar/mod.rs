//! The scalar of every model and kernel: `f64`, `f32`, packs of several side by side, and second-order duals over any
//! of these.

mod dual;
mod float;
mod grain;
mod math;
mod pack;
mod shown;

pub use dual::{Dual2, as_duals};
pub(crate) use grain::{Grain, Word, floats, floats_mut, numbers, numbers_mut, words, words_mut};
pub use pack::{Element, InstructionSet, Job, LaneMask, MAX_WIDTH, Pack, gather, scatter};
pub(crate) use pack::{LANES, NARROW};
pub use shown::Shown;

use core::fmt::Debug;
use core::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, MulAssign, Neg, Not, Sub, SubAssign};

/// The outcome of a comparison, one truth value for each lane of the scalar.
pub trait Mask: Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// The same value in every lane.
    fn splat(value: bool) -> Self;
    /// True in every lane.
    fn all(self) -> bool;
    /// True in at least one lane.
    fn any(self) -> bool;
}

impl Mask for bool {
    #[inline(always)]
    fn splat(value: bool) -> bool {
        value
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
}

/// Work on numbers whose instructions a program built for any machine may use in part of its functions only; see
/// [`Real::within`].
pub trait Inside {
    /// What the work gives.
    type Output;
    /// The work. To be marked `#[inline(always)]`, with all that it calls.
    fn go(self) -> Self::Output;
}

/// A real number, or several side by side, with or without derivatives.
///
/// Models and kernels are written once over this trait. They never branch on a value: they compare to a
/// [`Mask`] and [`select`](Real::select), so that one body serves scalars and packs.
///
/// ```
/// use givens_core::scalar::{Dual2, Real};
/// fn range<T: Real>(x: T, y: T) -> T { x.hypot(y) }
/// assert_eq!(range(3.0, 4.0), 5.0);
/// // the derivative of the range along x, exact
/// let r = range(Dual2::variable(3.0), Dual2::of(4.0));
/// assert!((r.d - 0.6).abs() < 1e-15);
/// ```
pub trait Real:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// What a comparison gives.
    type Mask: Mask;
    /// The distance from one to the next larger number of the underlying float.
    const EPSILON: f64;
    /// A power of two below which squares of the underlying float, or products with them, may run out of digits.
    const FAINT: f64;
    /// How many times the number is derived.
    const DEPTH: usize = 0;

    /// Does work on such numbers in a function of its own, compiled with the instructions that they need: a place where code
    /// over packs need not be inlined any further.
    #[inline(always)]
    fn within<W: Inside>(work: W) -> W::Output {
        fn inside<W: Inside>(work: W) -> W::Output {
            work.go()
        }
        inside(work)
    }

    /// The same for a kernel, for whose loops over plain floats the compiler may use the vectors of the machine. The numbers
    /// are those that it gives without.
    #[inline(always)]
    fn vectorised<W: Inside>(kernel: W) -> W::Output {
        Self::within(kernel)
    }

    /// The constant `value`, in every lane and without derivative.
    fn of(value: f64) -> Self;
    /// The value of the first lane, without derivative.
    fn first(self) -> f64;

    /// `self * b + c`, fused where the machine does that in one instruction.
    fn mul_add(self, b: Self, c: Self) -> Self;
    /// 1 / self.
    fn recip(self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// The magnitude of `self` with the sign of `sign`.
    fn copysign(self, sign: Self) -> Self;
    /// The largest whole number not above `self`; its derivative is taken as zero.
    fn floor(self) -> Self;
    /// e to the power `self`.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Decimal logarithm.
    fn log10(self) -> Self;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// Tangent of an angle in radians.
    fn tan(self) -> Self;
    /// Arc sine, in radians.
    fn asin(self) -> Self;
    /// Arc cosine, in radians.
    fn acos(self) -> Self;
    /// Arc tangent, in radians.
    fn atan(self) -> Self;
    /// The angle of the point (x, self), in radians, in [−π, π].
    fn atan2(self, x: Self) -> Self;
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// The error function, 2/√π times the integral of e^(−s²) from 0 to `self`.
    fn erf(self) -> Self;
    /// 1 − erf, which keeps its digits where erf is next to 1; to three units in the last place.
    fn erfc(self) -> Self;
    /// `self` to the power `e`.
    fn pow(self, e: Self) -> Self;
    /// `self` to a whole power.
    fn powi(self, e: i32) -> Self;
    /// √(self² + y²) without overflow.
    fn hypot(self, y: Self) -> Self;

    /// self < other.
    fn lt(self, other: Self) -> Self::Mask;
    /// self ≤ other.
    fn le(self, other: Self) -> Self::Mask;
    /// self = other, of the values.
    fn same(self, other: Self) -> Self::Mask;
    /// `yes` in the lanes where the mask is true, `no` in the others.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// Zero.
    #[inline(always)]
    fn zero() -> Self {
        Self::of(0.0)
    }
    /// One.
    #[inline(always)]
    fn one() -> Self {
        Self::of(1.0)
    }
    /// Sine of an angle in radians.
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine of an angle in radians.
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// The larger of two; a NaN in either gives NaN.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(other.lt(self) | !self.same(self), self, other)
    }
    /// The smaller of two; a NaN in either gives NaN.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(self.lt(other) | !self.same(self), self, other)
    }
    /// −1, 0 or 1; NaN for NaN.
    #[inline(always)]
    fn sign(self) -> Self {
        let z = Self::zero();
        let side = Self::select(z.lt(self), Self::one(), -Self::one());
        Self::select(z.lt(self) | self.lt(z), side, self * z)
    }
    /// True in the lanes that hold a finite value.
    #[inline(always)]
    fn finite(self) -> Self::Mask {
        (self - self).same(Self::zero())
    }
    /// `self` moved by whole periods into [−period/2, period/2).
    #[inline(always)]
    fn wrap(self, period: Self) -> Self {
        self - period * (self / period + Self::of(0.5)).floor()
    }
}

//! The operations that a graph knows, and what each computes.

use givens_core::scalar::Real;

/// Operations on one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unary {
    /// −a.
    Neg,
    /// |a|. Its derivative at zero is taken from the right.
    Abs,
    /// −1, 0 or 1; not-a-number of itself. Its derivative is zero everywhere.
    Sign,
    /// The largest whole number not above a. Its derivative is zero everywhere.
    Floor,
    /// Square root.
    Sqrt,
    /// e to the power a.
    Exp,
    /// Natural logarithm.
    Log,
    /// Decimal logarithm.
    Log10,
    /// Sine of radians.
    Sin,
    /// Cosine of radians.
    Cos,
    /// Tangent of radians.
    Tan,
    /// Arc sine, radians.
    Asin,
    /// Arc cosine, radians.
    Acos,
    /// Arc tangent, radians.
    Atan,
    /// Hyperbolic sine.
    Sinh,
    /// Hyperbolic cosine.
    Cosh,
    /// Hyperbolic tangent.
    Tanh,
    /// The error function.
    Erf,
    /// 1 − the error function.
    Erfc,
    /// Whether a condition does not hold.
    Not,
}

/// Operations on two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binary {
    /// a + b.
    Add,
    /// a − b.
    Sub,
    /// a b.
    Mul,
    /// a / b.
    Div,
    /// a to the power b.
    Pow,
    /// The angle of the point (b, a), radians: a is the ordinate.
    Atan2,
    /// √(a² + b²) without overflow.
    Hypot,
    /// The smaller one; not-a-number if either is. Where they are equal the derivative is b's.
    Min,
    /// The larger one; not-a-number if either is. Where they are equal the derivative is b's.
    Max,
    /// Whether a < b.
    Less,
    /// Whether a ≤ b.
    LessEqual,
    /// Whether a = b.
    Equal,
    /// Whether both conditions hold.
    And,
    /// Whether at least one of two conditions holds.
    Or,
    /// a b, but zero where b is zero and a infinite or not a number: the product of the chain rule, in which what
    /// does not move has no derivative, also where the slope is infinite (√ at zero).
    Scale,
}

/// The number of a condition.
#[inline(always)]
pub(crate) fn number<T: Real>(condition: T::Mask) -> T {
    T::select(condition, T::one(), T::zero())
}

/// The value of a choice.
#[inline(always)]
pub(crate) fn choose<T: Real>(condition: T, yes: T, no: T) -> T {
    T::select(condition.same(T::zero()), no, yes)
}

impl Unary {
    /// Whether the result is a condition.
    #[must_use]
    pub fn is_condition(self) -> bool {
        self == Unary::Not
    }

    /// The value of the operation.
    #[inline(always)]
    pub fn apply<T: Real>(self, a: T) -> T {
        match self {
            Unary::Neg => -a,
            Unary::Abs => a.abs(),
            Unary::Sign => T::select(a.same(a), a.sign(), a),
            Unary::Floor => a.floor(),
            Unary::Sqrt => a.sqrt(),
            Unary::Exp => a.exp(),
            Unary::Log => a.ln(),
            Unary::Log10 => a.log10(),
            Unary::Sin => a.sin(),
            Unary::Cos => a.cos(),
            Unary::Tan => a.tan(),
            Unary::Asin => a.asin(),
            Unary::Acos => a.acos(),
            Unary::Atan => a.atan(),
            Unary::Sinh => a.sinh(),
            Unary::Cosh => a.cosh(),
            Unary::Tanh => a.tanh(),
            Unary::Erf => a.erf(),
            Unary::Erfc => a.erfc(),
            Unary::Not => number(a.same(T::zero())),
        }
    }
}

impl Binary {
    /// Whether the result is a condition.
    #[must_use]
    pub fn is_condition(self) -> bool {
        matches!(self, Binary::Less | Binary::LessEqual | Binary::Equal | Binary::And | Binary::Or)
    }

    /// Whether exchanging the operands changes nothing, not even rounding.
    pub(crate) fn is_symmetric(self) -> bool {
        matches!(self, Binary::Add | Binary::Mul | Binary::Equal | Binary::And | Binary::Or)
    }

    /// The value of the operation.
    #[inline(always)]
    pub fn apply<T: Real>(self, a: T, b: T) -> T {
        let zero = T::zero();
        match self {
            Binary::Add => a + b,
            Binary::Sub => a - b,
            Binary::Mul => a * b,
            Binary::Div => a / b,
            Binary::Pow => a.pow(b),
            Binary::Atan2 => a.atan2(b),
            Binary::Hypot => a.hypot(b),
            Binary::Min => a.min(b),
            Binary::Max => a.max(b),
            Binary::Less => number(a.lt(b)),
            Binary::LessEqual => number(a.le(b)),
            Binary::Equal => number(a.same(b)),
            Binary::And => number(!(a.same(zero) | b.same(zero))),
            Binary::Or => number(!(a.same(zero) & b.same(zero))),
            Binary::Scale => T::select(b.same(zero) & !a.finite(), zero, a * b),
        }
    }
}

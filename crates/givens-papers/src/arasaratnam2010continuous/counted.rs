//! A scalar that counts what is done with it.

use core::cell::Cell;
use core::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};
use givens::scalar::Real;

/// Operations by kind. Signs, absolute values and selections are free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Count {
    pub additions: u64,
    pub multiplications: u64,
    pub divisions: u64,
    pub roots: u64,
    pub comparisons: u64,
    /// Elementary functions, a rounding to a whole number among them.
    pub functions: u64,
}

impl Count {
    const NONE: Self =
        Self { additions: 0, multiplications: 0, divisions: 0, roots: 0, comparisons: 0, functions: 0 };

    /// Additions, multiplications, divisions and roots: what is commonly called flops.
    pub fn flops(self) -> u64 {
        self.additions + self.multiplications + self.divisions + self.roots
    }
}

std::thread_local! {
    static COUNT: Cell<Count> = const { Cell::new(Count::NONE) };
    static PAUSED: Cell<bool> = const { Cell::new(false) };
}

fn note(add: impl FnOnce(&mut Count)) {
    if PAUSED.get() {
        return;
    }
    let mut count = COUNT.get();
    add(&mut count);
    COUNT.set(count);
}

fn one_more(of: &mut u64) {
    *of += 1;
}

/// What `work` does, counted, and its answer.
pub(super) fn counted<R>(work: impl FnOnce() -> R) -> (Count, R) {
    COUNT.set(Count::NONE);
    let answer = work();
    (COUNT.get(), answer)
}

/// Does `work` without counting: the functions of a model are no part of the method.
pub(super) fn uncounted<R>(work: impl FnOnce() -> R) -> R {
    let before = PAUSED.replace(true);
    let answer = work();
    PAUSED.set(before);
    answer
}

/// A number of double precision whose operations are counted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counted(pub f64);

macro_rules! operators {
    ($($trait:ident $method:ident $op:tt $kind:ident;)*) => {$(
        impl $trait for Counted {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                note(|count| one_more(&mut count.$kind));
                Self(self.0 $op other.0)
            }
        }
    )*};
}

operators! {
    Add add + additions;
    Sub sub - additions;
    Mul mul * multiplications;
    Div div / divisions;
}

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl AddAssign for Counted {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Counted {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign for Counted {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

macro_rules! functions {
    ($($name:ident)*) => {$(
        fn $name(self) -> Self {
            note(|count| count.functions += 1);
            Self(Real::$name(self.0))
        }
    )*};
}

macro_rules! comparisons {
    ($($name:ident)*) => {$(
        fn $name(self, other: Self) -> bool {
            note(|count| count.comparisons += 1);
            Real::$name(self.0, other.0)
        }
    )*};
}

impl Real for Counted {
    type Mask = bool;
    const EPSILON: f64 = f64::EPSILON;
    const FAINT: f64 = f64::FAINT;

    fn of(value: f64) -> Self {
        Self(value)
    }
    fn first(self) -> f64 {
        self.0
    }
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    fn recip(self) -> Self {
        Self(1.0) / self
    }
    fn sqrt(self) -> Self {
        note(|count| count.roots += 1);
        Self(Real::sqrt(self.0))
    }
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    fn copysign(self, sign: Self) -> Self {
        Self(self.0.copysign(sign.0))
    }
    fn sin_cos(self) -> (Self, Self) {
        note(|count| count.functions += 2);
        let (sin, cos) = Real::sin_cos(self.0);
        (Self(sin), Self(cos))
    }
    fn atan2(self, x: Self) -> Self {
        note(|count| count.functions += 1);
        Self(Real::atan2(self.0, x.0))
    }
    fn pow(self, e: Self) -> Self {
        note(|count| count.functions += 1);
        Self(Real::pow(self.0, e.0))
    }
    fn powi(self, e: i32) -> Self {
        note(|count| count.functions += 1);
        Self(Real::powi(self.0, e))
    }
    fn hypot(self, y: Self) -> Self {
        note(|count| count.functions += 1);
        Self(Real::hypot(self.0, y.0))
    }
    functions! { floor exp ln log10 tan asin acos atan sinh cosh tanh erf erfc }
    comparisons! { lt le same }
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_operation_is_counted_once_and_none_while_paused() {
        let (x, y) = (Counted(3.0), Counted(4.0));
        let (count, z) = counted(|| {
            uncounted(|| x * y);
            x.mul_add(y, x - y) / y.sqrt()
        });
        assert_eq!(z.0, 5.5);
        let wanted = Count { additions: 2, multiplications: 1, divisions: 1, roots: 1, ..Count::NONE };
        assert_eq!((count, count.flops()), (wanted, 5));
        assert_eq!(counted(|| x.lt(y)).0, Count { comparisons: 1, ..Count::NONE });
    }
}

//! The pack of every machine: an array, its operations one lane after the other.

use super::real::{assigning, elementary};
use super::{Element, LaneMask, MAX_WIDTH, Pack, padded};
use crate::scalar::math::{self, Format, Lanes};
use crate::scalar::{Mask, Real};
use core::array;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// N floats.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct Array<E, const N: usize>([E; N]);

/// N truth values.
#[derive(Clone, Copy, Debug)]
pub struct Truths<const N: usize>([bool; N]);

impl<E: Element, const N: usize> Array<E, N> {
    #[inline(always)]
    fn each(self, f: impl Fn(E) -> E) -> Self {
        Self(array::from_fn(|i| f(self.0[i])))
    }
    #[inline(always)]
    fn with(self, o: Self, f: impl Fn(E, E) -> E) -> Self {
        Self(array::from_fn(|i| f(self.0[i], o.0[i])))
    }
    #[inline(always)]
    fn compare(self, o: Self, f: impl Fn(E, E) -> bool) -> Truths<N> {
        Truths(array::from_fn(|i| f(self.0[i], o.0[i])))
    }
    #[inline(always)]
    fn patterns(self, o: Self, f: impl Fn(u64, u64) -> u64) -> Self {
        self.with(o, |a, b| E::of_pattern(f(a.pattern(), b.pattern())))
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $op:tt),*) => {
        $(impl<E: Element, const N: usize> $trait for Array<E, N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                self.with(o, |a, b| a $op b)
            }
        })*
    };
}
operators!(Add add +, Sub sub -, Mul mul *, Div div /);
assigning!([<E: Element, const N: usize>] Array<E, N>);

impl<E: Element, const N: usize> Neg for Array<E, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.each(|x| -x)
    }
}

impl<E: Element, const N: usize> Real for Array<E, N> {
    type Mask = Truths<N>;
    const EPSILON: f64 = E::EPSILON;
    const FAINT: f64 = E::FAINT;

    #[inline(always)]
    fn of(value: f64) -> Self {
        Self([E::of(value); N])
    }
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        Self(array::from_fn(|i| self.0[i].mul_add(b.0[i], c.0[i])))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.each(E::sqrt)
    }
    #[inline(always)]
    fn floor(self) -> Self {
        self.each(E::floor)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Truths<N> {
        self.compare(other, E::lt)
    }
    #[inline(always)]
    fn le(self, other: Self) -> Truths<N> {
        self.compare(other, E::le)
    }
    #[inline(always)]
    fn same(self, other: Self) -> Truths<N> {
        self.compare(other, E::same)
    }
    #[inline(always)]
    fn select(mask: Truths<N>, yes: Self, no: Self) -> Self {
        Self(array::from_fn(|i| if mask.0[i] { yes.0[i] } else { no.0[i] }))
    }
    elementary!();
}

impl<E: Element, const N: usize> Pack for Array<E, N> {
    type Element = E;
    const WIDTH: usize = N;

    #[inline(always)]
    fn splat(number: E) -> Self {
        Self([number; N])
    }
    #[inline(always)]
    fn load(numbers: &[E]) -> Self {
        match numbers.first_chunk() {
            Some(lanes) => Self(*lanes),
            None => Self(array::from_fn(|i| padded(numbers)[i])),
        }
    }
    #[inline(always)]
    fn store(self, numbers: &mut [E]) {
        numbers.iter_mut().zip(self.0).for_each(|(number, lane)| *number = lane);
    }
}

impl<E: Element, const N: usize> Lanes for Array<E, N> {
    // as `mul_add` of the floats themselves
    const FUSED: bool = cfg!(all(feature = "std", target_feature = "fma"));

    #[inline(always)]
    fn pattern(bits: u64) -> Self {
        Self([E::of_pattern(bits); N])
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self.patterns(other, |a, b| a & b)
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        self.patterns(other, |a, b| a | b)
    }
    #[inline(always)]
    fn xor(self, other: Self) -> Self {
        self.patterns(other, |a, b| a ^ b)
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self.patterns(other, u64::wrapping_add)
    }
    #[inline(always)]
    fn shifted_up(self, by: u32) -> Self {
        self.each(|x| E::of_pattern(x.pattern() << by))
    }
    #[inline(always)]
    fn shifted_down(self, by: u32) -> Self {
        self.each(|x| E::of_pattern(x.pattern() >> by))
    }
    #[inline(always)]
    fn negative(self) -> Truths<N> {
        Truths(self.0.map(|x| x.pattern() >> (<E as Format>::BITS - 1) == 1))
    }
}

macro_rules! logic {
    ($($trait:ident $method:ident $op:tt),*) => {
        $(impl<const N: usize> $trait for Truths<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                Self(array::from_fn(|i| self.0[i] $op o.0[i]))
            }
        })*
    };
}
logic!(BitAnd bitand &, BitOr bitor |);

impl<const N: usize> Not for Truths<N> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(self.0.map(|truth| !truth))
    }
}

impl<const N: usize> Mask for Truths<N> {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        Self([value; N])
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.0.into_iter().fold(true, |all, truth| all & truth)
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.0.into_iter().fold(false, |any, truth| any | truth)
    }
}

impl<const N: usize> LaneMask for Truths<N> {
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.into_iter().enumerate().fold(0, |bits, (i, truth)| bits | u32::from(truth) << i)
    }
    #[inline(always)]
    fn of_bits(bits: u32) -> Self {
        Self(array::from_fn(|i| bits >> i & 1 == 1))
    }
}

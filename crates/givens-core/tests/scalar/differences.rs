//! Derivatives against differences of the function itself, and derivatives of derivatives.

use givens_core::scalar::{Dual2, Real};
use proptest::prelude::*;

/// A function of two numbers, whatever the scalar.
trait Function {
    fn at<T: Real>(&self, x: T, y: T) -> T;
}

/// Every function of `Real` by its number, the arguments moved into where it is smooth.
struct Numbered(usize);
const COUNT: usize = 22;

impl Function for Numbered {
    fn at<T: Real>(&self, x: T, y: T) -> T {
        let two = T::of(2.0);
        let positive = x.mul_add(x, T::of(0.5));
        let within = T::of(0.4) * x;
        match self.0 {
            0 => x * y - x / positive,
            1 => positive.recip(),
            2 => positive.sqrt(),
            3 => (x - T::of(5.0)).abs() * y,
            4 => positive.copysign(y - T::of(5.0)),
            5 => x.exp() * y,
            6 => positive.ln() * y,
            7 => positive.log10(),
            8 => x.sin() * y.cos(),
            9 => (x * T::of(0.5)).tan(),
            10 => within.asin() * y,
            11 => within.acos(),
            12 => (x * y).atan(),
            13 => y.atan2(x - T::of(3.0)),
            14 => x.sinh() - y.cosh(),
            15 => (x - y).tanh() * (x + y).erf() + x.erfc(),
            16 => positive.pow(y),
            17 => x.powi(3) + (x - T::of(4.0)).powi(-2),
            18 => (x + two).hypot(y),
            19 => x.max(y - T::of(9.0)) * y.min(x + T::of(9.0)),
            20 => x.mul_add(y, x) + x.floor() * T::of(0.0),
            _ => (x * T::of(0.1)).wrap(T::of(7.0)) * y.sign().max(y - T::of(9.0)) * x,
        }
    }
}

fn along(f: &Numbered, [x, y]: [f64; 2], [xd, yd]: [f64; 2], s: f64) -> f64 {
    f.at(x + xd * s, y + yd * s)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn derivatives_are_the_limits_of_differences(
        point in prop::array::uniform2(-1.5..1.5f64),
        direction in prop::array::uniform2(-1.0..1.0f64),
    ) {
        // no fractional power of a base that a step of h carries to zero, and no sign that turns
        prop_assume!(point[1].abs() > 0.05);
        for number in 0..COUNT {
            let f = Numbered(number);
            let dual = |i: usize| Dual2::along(point[i], direction[i]);
            let found = f.at(dual(0), dual(1));
            // central differences of fourth order: errors of h⁴ and ε/h², at most a few 1e-9
            let (h, g) = (2e-3, |k: f64| along(&f, point, direction, k * 2e-3));
            let first = (8.0 * (g(1.0) - g(-1.0)) - (g(2.0) - g(-2.0))) / (12.0 * h);
            let second = (16.0 * (g(1.0) + g(-1.0)) - (g(2.0) + g(-2.0)) - 30.0 * g(0.0)) / (12.0 * h * h);
            prop_assert_eq!(found.v, g(0.0), "value of {}", number);
            let size = 1.0 + found.v.abs() + found.d.abs() + found.dd.abs();
            prop_assert!((found.d - first).abs() < 1e-7 * size, "{}: {} for {}", number, found.d, first);
            prop_assert!((found.dd - second).abs() < 1e-6 * size, "{}: {} for {}", number, found.dd, second);
        }
    }

    /// The derivative of a derivative, by a dual over a dual, is the second derivative.
    #[test]
    fn a_dual_of_duals_gives_the_same_second_derivative(
        point in prop::array::uniform2(-1.5..1.5f64),
        direction in prop::array::uniform2(-1.0..1.0f64),
    ) {
        prop_assume!(point[1].abs() > 0.05);
        for number in 0..COUNT {
            let f = Numbered(number);
            let dual = |i: usize| Dual2::along(point[i], direction[i]);
            let nested = |i: usize| Dual2::along(dual(i), Dual2::constant(direction[i]));
            let (found, twice) = (f.at(dual(0), dual(1)), f.at(nested(0), nested(1)));
            let size = 1.0 + found.v.abs() + found.d.abs() + found.dd.abs();
            for (what, other) in [("inner", twice.v.dd), ("mixed", twice.d.d), ("outer", twice.dd.v)] {
                prop_assert!((found.dd - other).abs() < 1e-12 * size, "{} {}: {} {}", number, what, found.dd, other);
            }
            prop_assert!((twice.d.dd - twice.dd.d).abs() < 1e-10 * (size + twice.d.dd.abs()), "third of {}", number);
        }
    }
}

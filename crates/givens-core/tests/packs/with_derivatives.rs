//! Derivatives carried over packs are those carried over floats.

use super::every_set::{Check, every_pack};
use givens_core::scalar::{Dual2, InstructionSet, Pack, Real};

/// An expression that meets every function.
fn expression<T: Real>(x: T, y: T) -> T {
    let (s, c) = (x * y).sin_cos();
    let near = T::of(0.3) * s;
    let circular = near.asin() + near.acos() + near.tan() + (x / y).atan() + s.atan2(c + T::of(2.0));
    let growing = near.exp()
        + near.sinh() * near.cosh()
        + near.tanh()
        + near.erf() * y.erfc()
        + y.abs().ln()
        + y.abs().log10();
    let powers = y.abs().pow(near) + x.powi(3) + x.hypot(y) + y.abs().sqrt() + y.recip();
    T::select(x.lt(y), circular, growing)
        + powers.max(circular).min(growing * growing)
        + x.copysign(y)
        + x.wrap(T::of(7.0))
}

struct Duals;
impl Check for Duals {
    fn holds<P: Pack>(_: InstructionSet) {
        let sample = |i: usize, scale: f64| P::Element::of(((i as f64 * 0.618).fract() - 0.5) * scale + 0.01);
        for first in (0..160).step_by(P::WIDTH) {
            let fill =
                |scale: f64| -> Vec<P::Element> { (0..P::WIDTH).map(|l| sample(first + l, scale)).collect() };
            let (x, dx, y, dy) = (fill(3.0), fill(1.0), fill(5.0), fill(-2.0));
            let pack =
                expression(Dual2::along(P::load(&x), P::load(&dx)), Dual2::along(P::load(&y), P::load(&dy)));
            for l in 0..P::WIDTH {
                let float = expression(Dual2::along(x[l], dx[l]), Dual2::along(y[l], dy[l]));
                for (found, expected) in [(pack.v, float.v), (pack.d, float.d), (pack.dd, float.dd)] {
                    let (found, expected) = (found.lane(l).first(), expected.first());
                    // a few roundings, of terms that partly cancel in the derivatives
                    let allowed = 200.0 * P::EPSILON * (1.0 + expected.abs());
                    assert!((found - expected).abs() <= allowed, "{found} {expected}");
                }
            }
        }
    }
}

#[test]
fn derivatives_over_packs_are_those_over_floats() {
    every_pack::<Duals>();
}

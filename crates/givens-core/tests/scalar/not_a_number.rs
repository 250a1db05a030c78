//! A number that is none is never passed over.

use givens_core::scalar::{Dual2, Mask, Real};

fn kept<T: Real>(name: &str) {
    let (nan, one) = (T::of(f64::NAN), T::one());
    let infinite = T::of(f64::INFINITY);
    for (what, found) in [
        ("max", nan.max(one)),
        ("max", one.max(nan)),
        ("min", nan.min(one)),
        ("min", one.min(nan)),
        ("sign", nan.sign()),
        ("wrap", nan.wrap(one)),
        ("wrap by", one.wrap(nan)),
        ("wrap of infinity", infinite.wrap(one)),
        ("abs", nan.abs()),
        ("floor", nan.floor()),
    ] {
        assert!(found.first().is_nan(), "{name}: {what} is {found:?}");
    }
    assert!(!nan.finite().any() && !infinite.finite().any() && one.finite().all(), "{name}");
    assert!(!nan.same(nan).any() && !nan.lt(one).any() && !one.le(nan).any(), "{name}");
}

#[test]
fn no_choice_passes_over_it() {
    kept::<f64>("f64");
    kept::<f32>("f32");
    kept::<Dual2<f64>>("dual");
    kept::<Dual2<f32>>("dual of f32");
    kept::<Dual2<Dual2<f64>>>("dual of duals");
}

#[test]
fn the_ordinary_numbers_are_what_they_are() {
    assert_eq!((Real::max(2.0, 3.0), Real::max(3.0, 2.0), Real::max(-0.5, -0.25)), (3.0, 3.0, -0.25));
    assert_eq!((Real::min(2.0, 3.0), Real::min(3.0, 2.0)), (2.0, 2.0));
    assert_eq!([-3.0, 0.0, 0.1].map(Real::sign), [-1.0, 0.0, 1.0]);
    assert_eq!((f64::INFINITY.sign(), f64::NEG_INFINITY.sign()), (1.0, -1.0));
    // into [−period/2, period/2)
    let wrapped = [0.0, 179.0, 180.0, -180.0, 359.0, -541.0, 720.0].map(|x| Real::wrap(x, 360.0));
    assert_eq!(wrapped, [0.0, 179.0, -180.0, -180.0, -1.0, 179.0, 0.0]);
}

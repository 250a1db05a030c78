//! Zeros, infinities, the ends of the range, and what is not a number, as the platform has them and each in its lane.

use super::accuracy::{FUNCTIONS, function};
use super::every_set::{Check, every_pack, identical, units};
use givens_core::scalar::{InstructionSet, Pack, Real};

/// Where functions begin, end, change their formula or overflow.
fn edges<P: Pack>() -> Vec<P::Element> {
    let single = P::EPSILON > 1e-10;
    let (least, normal, most) =
        if single { (-149, -126, f64::from(f32::MAX)) } else { (-1074, -1022, f64::MAX) };
    let power = |e: i32| 2f64.powi(e / 2) * 2f64.powi(e - e / 2);
    let ends = [power(least), 3.0 * power(least), power(normal), most, most / 2.0, f64::INFINITY, 0.0];
    let ordinary = [
        1.0,
        0.5,
        2.0,
        3.0,
        0.55,
        1e-3,
        1e-9,
        22.5,
        1e5,
        1e7,
        1e10,
        1e30,
        2.5,
        2f64.powi(24),
        2f64.powi(53) - 1.0,
    ];
    let limits: [f64; 6] = if single {
        [88.722_83, 88.722_85, 87.336_5, 103.972, 103.98, 89.415_98]
    } else {
        [709.782_712_893_383_9, 709.782_712_893_384_1, 745.133_219_101_941_2, 745.2, 710.475_8, 708.396]
    };
    let all = ends.into_iter().chain(ordinary).chain(limits);
    all.flat_map(|x| [x, -x]).chain([f64::NAN]).map(P::Element::of).collect()
}

struct Edges;
impl Check for Edges {
    fn holds<P: Pack>(set: InstructionSet) {
        let edges = edges::<P>();
        for name in FUNCTIONS {
            for &x in &edges {
                for ys in edges.chunks(P::WIDTH) {
                    let result = function(name, P::splat(x), P::load(ys));
                    for (l, &y) in ys.iter().enumerate() {
                        let (found, platform) = (result.lane(l), function(name, x, y));
                        let said =
                            format!("{set:?} {name}({x:?}, {y:?}): {found:?}, the platform has {platform:?}");
                        let (a, b) = (found.first(), platform.first());
                        assert!(a.is_nan() == b.is_nan() && a.is_infinite() == b.is_infinite(), "{said}");
                        assert!(a.is_nan() || a.is_sign_negative() == b.is_sign_negative(), "{said}");
                        // two of ours, one of the platform's
                        assert!(a == b || units(found, b, 0.0) <= 3.0, "{said}");
                    }
                }
            }
        }
    }
}

#[test]
fn the_ends_of_the_range_are_those_of_the_platform() {
    every_pack::<Edges>();
}

struct Neighbours;
impl Check for Neighbours {
    fn holds<P: Pack>(_: InstructionSet) {
        let lanes: Vec<_> =
            (0..P::WIDTH).map(|l| P::Element::of(0.1 + 0.8 * l as f64 / P::WIDTH as f64)).collect();
        let (x, y) = (P::load(&lanes), P::of(0.7));
        for name in FUNCTIONS {
            let undisturbed = function(name, x, y);
            for l in 0..P::WIDTH {
                for strange in [f64::NAN, f64::INFINITY, -1e30, 0.0, 1e-320] {
                    let strange = P::Element::of(strange);
                    let result = function(name, x.with_lane(l, strange), y);
                    for other in (0..P::WIDTH).filter(|&other| other != l) {
                        assert!(identical(result.lane(other), undisturbed.lane(other)), "{name} {result:?}");
                    }
                    let alone = function(name, P::splat(strange), y);
                    assert!(identical(result.lane(l), alone.lane(l)), "{name} {result:?}");
                }
            }
        }
    }
}

#[test]
fn what_is_in_one_lane_does_not_touch_the_others() {
    every_pack::<Neighbours>();
}

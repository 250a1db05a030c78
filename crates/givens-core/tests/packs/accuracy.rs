//! No elementary function of a pack errs by more than two units in the last place; erfc, which is libm's, by three.
//!
//! In double precision against values of 60 digits (`reference.csv`, drawn over the whole range, with the worst of a
//! search through some 10⁶ points of every function; `reference.py` writes it); in single precision against the functions
//! of f64, over every 40 961st float there is. `cargo test -p givens-core --test packs -- --nocapture accuracy` prints
//! the table.

use super::every_set::{Check, every_pack, units};
use super::reference::{Point, points};
use givens_core::scalar::{InstructionSet, Pack, Real};

pub const FUNCTIONS: [&str; 17] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "exp", "ln", "log10", "sinh", "cosh", "tanh",
    "erf", "erfc", "pow", "hypot",
];

/// The function of that name; those of one number ignore y.
pub fn function<T: Real>(name: &str, x: T, y: T) -> T {
    match name {
        "sin" => x.sin(),
        "cos" => x.cos(),
        "tan" => x.tan(),
        "asin" => x.asin(),
        "acos" => x.acos(),
        "atan" => x.atan(),
        "atan2" => x.atan2(y),
        "exp" => x.exp(),
        "ln" => x.ln(),
        "log10" => x.log10(),
        "sinh" => x.sinh(),
        "cosh" => x.cosh(),
        "tanh" => x.tanh(),
        "erf" => x.erf(),
        "erfc" => x.erfc(),
        "pow" => x.pow(y),
        "hypot" => x.hypot(y),
        _ => panic!("{name}"),
    }
}

/// Every 40 961st float, each with another one.
fn floats(name: &str) -> Vec<Point> {
    (0..=u32::MAX / 40_961)
        .map(|i| {
            let (x, y) = (f32::from_bits(i * 40_961), f32::from_bits(i.wrapping_mul(2_654_435_761)));
            let (x, y) = (f64::from(x), f64::from(y));
            // powers that neither vanish nor overflow, of the same bases
            let y = if name == "pow" {
                f64::from((y.to_bits() % 997) as f32 / x.abs().ln() as f32 * 0.09)
            } else {
                y
            };
            Point { x, y, hi: function(name, x, y), lo: 0.0 }
        })
        .collect()
}

/// The largest error of a pack over the points, and where.
fn worst<P: Pack>(name: &str, points: &[Point]) -> (f64, f64, f64) {
    let mut worst = (0.0, 0.0, 0.0);
    for chunk in points.chunks(P::WIDTH) {
        let load =
            |of: fn(&Point) -> f64| P::load(&chunk.iter().map(|p| P::Element::of(of(p))).collect::<Vec<_>>());
        let result = function(name, load(|p| p.x), load(|p| p.y));
        let mut lanes = vec![P::Element::zero(); P::WIDTH];
        result.store(&mut lanes);
        for (&lane, point) in lanes.iter().zip(chunk) {
            let error = units(lane, point.hi, point.lo);
            if error > worst.0 {
                worst = (error, point.x, point.y);
            }
        }
    }
    worst
}

struct Accuracy;
impl Check for Accuracy {
    fn holds<P: Pack>(set: InstructionSet) {
        let single = P::EPSILON > 1e-10;
        println!("{set:?} {} × {}", P::WIDTH, if single { "f32" } else { "f64" });
        for name in FUNCTIONS {
            let points = if single { floats(name) } else { points(name) };
            let (error, x, y) = worst::<P>(name, &points);
            println!("{name:>8} {error:.3} of {:>6} points, at {x:e} {y:e}", points.len());
            let most = if name == "erfc" { 3.0 } else { 2.0 };
            assert!(error <= most, "{set:?}: {name}({x:e}, {y:e}) errs by {error} units in the last place");
        }
    }
}

#[test]
fn functions_err_by_two_units_in_the_last_place_at_most_and_erfc_by_three() {
    every_pack::<Accuracy>();
}

struct Platform;
impl Check for Platform {
    fn holds<P: Pack>(_: InstructionSet) {
        // far more points than the file has; the platform's own functions err by one unit at most
        for name in FUNCTIONS {
            let points: Vec<Point> = (0..20_000)
                .map(|i| {
                    let at = |step: f64| ((f64::from(i) * step).fract() - 0.5) * 2.0;
                    let (x, y) = (at(0.618_033_988_75), at(0.414_213_562_37));
                    let scale = [0.999, 8.0, 1e3, 1e7, 1e-3][i as usize % 5];
                    let (x, y) = (P::Element::of(x * scale).first(), P::Element::of(y * 8.0).first());
                    Point { x, y, hi: function(name, x, y), lo: 0.0 }
                })
                .collect();
            let (error, x, y) = worst::<P>(name, &points);
            assert!(error <= 3.0, "{name}({x:e}, {y:e}) is {error} units from the platform's");
        }
    }
}

#[test]
fn functions_agree_with_those_of_the_platform() {
    every_pack::<Platform>();
}

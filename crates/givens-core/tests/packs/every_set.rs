//! One check for the packs of all sets and both precisions.

use givens_core::scalar::{Element, InstructionSet, Job, Pack};

/// A claim about a pack type.
pub trait Check {
    fn holds<P: Pack>(set: InstructionSet);
}

struct Run<C>(InstructionSet, core::marker::PhantomData<C>);

impl<C: Check, E: Element> Job<E> for Run<C> {
    type Output = ();

    #[inline(always)]
    fn run<P: Pack<Element = E>>(self) {
        C::holds::<P>(self.0);
    }
}

/// The claim of every pack that this machine can run.
pub fn every_pack<C: Check>() {
    for set in InstructionSet::ALL {
        let one = set.run::<f64, _>(Run::<C>(set, core::marker::PhantomData));
        let two = set.run::<f32, _>(Run::<C>(set, core::marker::PhantomData));
        if one.and(two).is_none() {
            eprintln!("{set:?}: skipped, this machine lacks it");
        }
    }
}

/// Numbers of all sizes and both signs, zeros, infinities and NaN among them.
pub fn numbers<E: Element>() -> Vec<E> {
    let ordinary = (0..400).map(|i| {
        let fraction = (f64::from(i) * 0.618_033_988_749_895).fract() + 0.5;
        let exponent = (i * 37) % 61 - 30;
        let sign = if i % 3 == 0 { -1.0 } else { 1.0 };
        sign * fraction * 2f64.powi(if i % 2 == 0 { exponent } else { exponent / 10 })
    });
    let least = 2f64.powi(if E::EPSILON > 1e-10 { -149 } else { -1074 });
    let most = if E::EPSILON > 1e-10 { f64::from(f32::MAX) } else { f64::MAX };
    let special =
        [0.0, 1.0, 0.5, 2.0, 1.5, 2.5, 3.0, 7.0, least, 1000.0 * least, most, f64::INFINITY, 1e6, 0.7];
    let special = special.into_iter().flat_map(|x| [x, -x]).chain([f64::NAN]);
    ordinary.chain(special).map(E::of).collect()
}

/// Equal to the bit, or both not a number.
pub fn identical<E: Element>(a: E, b: E) -> bool {
    let (a, b) = (a.first(), b.first());
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}

/// The distance of `x` from hi + lo in units of the last place of that, 0 if both are not a number or the same infinity.
pub fn units<E: Element>(x: E, hi: f64, lo: f64) -> f64 {
    let (mantissa, least, most) =
        if E::EPSILON > 1e-10 { (23, -149, f64::from(f32::MAX)) } else { (52, -1074, f64::MAX) };
    let x = x.first();
    if x.is_nan() || hi.is_nan() {
        return if x.is_nan() && hi.is_nan() { 0.0 } else { f64::INFINITY };
    }
    if hi.is_infinite() || x.is_infinite() || hi.abs() > most {
        // what rounds to infinity may also be the largest number
        let near = |v: f64| v.abs() >= most * (1.0 - E::EPSILON);
        return if near(x) && near(hi) && x.signum() == hi.signum() { 0.0 } else { f64::INFINITY };
    }
    let exponent = ((hi.to_bits() >> 52 & 0x7ff) as i32 - 1023).max(least + mantissa);
    // in two steps: the unit may be below the normal numbers
    let scale = |v: f64| v * 2f64.powi(-(exponent / 2)) * 2f64.powi(mantissa - (exponent - exponent / 2));
    (scale(x - hi) - scale(lo)).abs()
}

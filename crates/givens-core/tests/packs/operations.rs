//! Arithmetic, comparisons and selection, lane by lane as those of a float, to the bit.

use super::every_set::{Check, every_pack, identical, numbers};
use givens_core::scalar::{InstructionSet, LaneMask, Mask, Pack, Real};

/// `pack` of the pairs, and `float` of every pair.
fn alike<P: Pack>(
    name: &str,
    pack: impl Fn(P, P) -> P,
    float: impl Fn(P::Element, P::Element) -> P::Element,
) {
    let all = numbers::<P::Element>();
    for shift in [0, 1, 7, 40, 133] {
        let others: Vec<_> = (0..all.len()).map(|i| all[(i + shift) % all.len()]).collect();
        for (x, y) in all.chunks(P::WIDTH).zip(others.chunks(P::WIDTH)) {
            let result = pack(P::load(x), P::load(y));
            for i in 0..x.len() {
                let expected = float(x[i], y[i]);
                let found = result.lane(i);
                assert!(
                    identical(found, expected),
                    "{name}({:?}, {:?}): {found:?}, not {expected:?}",
                    x[i],
                    y[i]
                );
            }
        }
    }
}

/// One of two numbers, as 1 and 0, by the mask.
fn told<P: Pack>(mask: P::Mask) -> P {
    P::select(mask, P::one(), P::zero())
}

struct Arithmetic;
impl Check for Arithmetic {
    fn holds<P: Pack>(_: InstructionSet) {
        alike::<P>("+", |x, y| x + y, |x, y| x + y);
        alike::<P>("−", |x, y| x - y, |x, y| x - y);
        alike::<P>("·", |x, y| x * y, |x, y| x * y);
        alike::<P>("/", |x, y| x / y, |x, y| x / y);
        alike::<P>("negated", |x, _| -x, |x, _| -x);
        alike::<P>("sqrt", |x, _| x.sqrt(), |x, _| x.sqrt());
        alike::<P>("recip", |x, _| x.recip(), |x, _| x.recip());
        alike::<P>("abs", |x, _| x.abs(), |x, _| x.abs());
        alike::<P>("copysign", P::copysign, P::Element::copysign);
        alike::<P>("floor", |x, _| x.floor(), |x, _| x.floor());
        alike::<P>("max", P::max, P::Element::max);
        alike::<P>("min", P::min, P::Element::min);
        alike::<P>("sign", |x, _| x.sign(), |x, _| x.sign());
        alike::<P>(
            "+=",
            |mut x, y| {
                x += y;
                x
            },
            |x, y| x + y,
        );
        alike::<P>(
            "−=",
            |mut x, y| {
                x -= y;
                x
            },
            |x, y| x - y,
        );
        alike::<P>(
            "·=",
            |mut x, y| {
                x *= y;
                x
            },
            |x, y| x * y,
        );
        for e in [0, 1, 2, 3, 7, -1, -2, 13, i32::MAX, i32::MIN] {
            alike::<P>("powi", |x, _| x.powi(e), |x, _| x.powi(e));
        }
    }
}

#[test]
fn arithmetic_is_that_of_a_float_to_the_bit() {
    every_pack::<Arithmetic>();
}

struct Fused;
impl Check for Fused {
    fn holds<P: Pack>(set: InstructionSet) {
        let once = |x: P::Element, y: P::Element, z: P::Element| {
            if P::EPSILON > 1e-10 {
                // the product of two f32 is exact in f64; the sum of that is rounded to odd, then once
                let value = f32::mul_add(x.first() as f32, y.first() as f32, z.first() as f32);
                P::Element::of(f64::from(value))
            } else {
                P::Element::of(f64::mul_add(x.first(), y.first(), z.first()))
            }
        };
        let z = P::Element::of(0.3);
        // arrays do as a float does; the instruction sets have the instruction
        let fused = set != InstructionSet::Portable;
        let float = |x: P::Element, y: P::Element| if fused { once(x, y, z) } else { x.mul_add(y, z) };
        alike::<P>("mul_add", |x, y| x.mul_add(y, P::splat(z)), float);
    }
}

#[test]
fn mul_add_rounds_once_where_there_is_an_instruction_and_as_a_float_elsewhere() {
    every_pack::<Fused>();
}

struct Comparisons;
impl Check for Comparisons {
    fn holds<P: Pack>(_: InstructionSet) {
        let as_number = |truth: bool| P::Element::of(f64::from(u8::from(truth)));
        alike::<P>("lt", |x, y| told(x.lt(y)), |x, y| as_number(x.lt(y)));
        alike::<P>("le", |x, y| told(x.le(y)), |x, y| as_number(x.le(y)));
        alike::<P>("same", |x, y| told(x.same(y)), |x, y| as_number(x.same(y)));
        alike::<P>("not", |x, y| told(!x.lt(y)), |x, y| as_number(!x.lt(y)));
        alike::<P>(
            "and",
            |x, y| told(x.lt(y) & y.lt(P::one())),
            |x, y| as_number(x.lt(y) & y.lt(P::Element::one())),
        );
        alike::<P>(
            "or",
            |x, y| told(x.lt(y) | y.lt(P::one())),
            |x, y| as_number(x.lt(y) | y.lt(P::Element::one())),
        );
        alike::<P>("finite", |x, _| told(x.finite()), |x, _| as_number(x.finite()));
        alike::<P>("select", |x, y| P::select(x.lt(y), x, y), |x, y| if x.lt(y) { x } else { y });
    }
}

#[test]
fn comparisons_and_selection_are_those_of_a_float() {
    every_pack::<Comparisons>();
}

struct Masks;
impl Check for Masks {
    fn holds<P: Pack>(_: InstructionSet) {
        let full = (1 << P::WIDTH) - 1;
        for bits in [0, 1, 2, 3, 5, 0x5555, 0xaaaa, 0xfffe, full, u32::MAX, 1 << (P::WIDTH - 1)] {
            let mask = P::Mask::of_bits(bits);
            assert_eq!(mask.bits(), bits & full);
            assert_eq!((!mask).bits(), !bits & full);
            assert_eq!((mask.all(), mask.any()), (bits & full == full, bits & full != 0));
            for i in 0..=P::WIDTH {
                assert_eq!(mask.lane(i), i < P::WIDTH && bits >> i & 1 == 1);
            }
            // a mask that was not compared selects and combines like one that was
            let told = told::<P>(mask);
            assert_eq!(told.same(P::one()).bits(), bits & full);
            assert_eq!((told.same(P::one()) & mask).bits(), bits & full);
            assert_eq!((told.same(P::zero()) | mask).bits(), full);
        }
        assert!(P::Mask::splat(true).all() && !P::Mask::splat(false).any());
    }
}

#[test]
fn a_mask_holds_one_truth_for_each_lane() {
    every_pack::<Masks>();
}

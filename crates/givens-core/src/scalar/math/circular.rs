//! Sine, cosine, tangent.

use super::format::Format;
use super::two::Two;
use super::{Lanes, huge, nearest, polynomial};
use crate::scalar::Mask;
use crate::scalar::pack::MAX_WIDTH;
use core::f64::consts::FRAC_2_PI;

/// x = q π/2 + r + rest with |r| ≤ π/4; q as the lowest bits of the first pattern. `rest` is right where products are
/// not fused.
#[inline(always)]
fn reduced<T: Lanes>(x: T, fused: bool) -> (T, T, T) {
    let (q, mut quadrant) = nearest(x, FRAC_2_PI);
    let (parts, limit) = if fused { T::Element::HALF_PI_FUSED } else { T::Element::HALF_PI };
    // every product is exact, or fused with its sum, and so is every difference in which digits cancel
    let (mut r, mut rest) = ((-q).mul_add(T::of(parts[0]), x), T::zero());
    for &part in &parts[1..] {
        let next = (-q).mul_add(T::of(part), r);
        rest += (-q).mul_add(T::of(part), r - next);
        r = next;
    }
    let size = x.unsigned();
    let far = T::of(limit).lt(size) & size.lt(T::of(f64::INFINITY));
    if far.any() {
        let zero = T::Element::of_f64(0.0);
        let (mut arguments, mut quadrants, mut rests) =
            ([zero; MAX_WIDTH], [zero; MAX_WIDTH], [zero; MAX_WIDTH]);
        x.store(&mut arguments);
        huge::reduce(&mut arguments[..T::WIDTH], &mut quadrants, &mut rests);
        quadrant = T::select(far, T::load(&quadrants) + T::of(T::Element::MAGIC), quadrant);
        r = T::select(far, T::load(&arguments), r);
        rest = T::select(far, T::load(&rests), rest);
    }
    (quadrant, r, rest)
}

/// What sine and cosine of r + rest add to r and 1; with `fused`, r is so near that the rest does not matter.
#[inline(always)]
fn beyond_first<T: Lanes>(r: T, rest: T, fused: bool) -> (T, T) {
    let z = r * r;
    let sine = polynomial(T::Element::SIN, z);
    let cosine = (z * z).mul_add(polynomial(T::Element::COS, z), z * T::of(-0.5));
    if fused { ((r * z) * sine, cosine) } else { ((r * z).mul_add(sine, rest), (-r).mul_add(rest, cosine)) }
}

#[inline(always)]
pub(in crate::scalar) fn sin_cos<T: Lanes>(x: T) -> (T, T) {
    let (quadrant, r, rest) = reduced(x, T::FUSED);
    let (sine, cosine) = beyond_first(r, rest, T::FUSED);
    // the sum of two zeros has lost their sign
    let (sine, cosine) = ((r + sine).signed_as(r), T::one() + cosine);
    let second = quadrant.shifted_up(T::Element::BITS - 2);
    let first = second.shifted_up(1);
    let odd = first.negative();
    let sign = T::sign_bit();
    let s = T::select(odd, cosine, sine).xor(second.and(sign));
    let c = T::select(odd, sine, cosine).xor(second.xor(first).and(sign));
    (s, c)
}

#[inline(always)]
pub(in crate::scalar) fn tan<T: Lanes>(x: T) -> T {
    let (quadrant, r, rest) = reduced(x, false);
    let (sine, cosine) = beyond_first(r, rest, false);
    let (sine, cosine) = (Two::ordered_sum(r, sine), Two::ordered_sum(T::one(), cosine));
    let odd = quadrant.shifted_up(T::Element::BITS - 1).negative();
    let pick = |a: Two<T>, b: Two<T>| Two { hi: T::select(odd, b.hi, a.hi), lo: T::select(odd, b.lo, a.lo) };
    let ratio = pick(sine, cosine).over(pick(cosine, sine)).value();
    let turned = T::select(odd, ratio.turned(), ratio);
    T::select(x.same(T::zero()), x, turned)
}

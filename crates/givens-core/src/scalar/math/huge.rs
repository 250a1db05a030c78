//! Angles of many turns, one lane at a time, in whole numbers (Payne and Hanek's reduction).

use super::format::Format;

/// 2/π in binary: 64 zeros, then the first 1216 bits behind the point; they reach 2^1024.
const TWO_OVER_PI: [u64; 20] = [
    0,
    0xa2f9_836e_4e44_1529,
    0xfc27_57d1_f534_ddc0,
    0xdb62_9599_3c43_9041,
    0xfe51_63ab_debb_c561,
    0xb724_6e3a_424d_d2e0,
    0x0649_2eea_09d1_921c,
    0xfe1d_eb1c_b129_a73e,
    0xe882_35f5_2ebb_4484,
    0xe99c_7026_b45f_7e41,
    0x3991_d639_8353_39f4,
    0x9c84_5f8b_bdf9_283b,
    0x1ff8_97ff_de05_980f,
    0xef2f_118b_5a0a_6d1f,
    0x6d36_7ecf_27cb_09b7,
    0x4f46_3f66_9e5f_ea2d,
    0x7527_bac7_ebe5_f17b,
    0x3d07_39f7_8a52_92ea,
    0x6bfb_5fb1_1f8d_5d08,
    0x5603_3046_fc7b_6bab,
];

/// Each argument by its remainder of a quarter turn, the quarters modulo four, and what the remainder is short of.
#[cold]
#[inline(never)]
pub(super) fn reduce<F: Format>(arguments: &mut [F], quadrants: &mut [F], rests: &mut [F]) {
    for ((x, quadrant), rest) in arguments.iter_mut().zip(quadrants).zip(rests) {
        let (q, hi, lo) = remainder(x.to_f64());
        *quadrant = F::of_f64(q);
        *x = F::of_f64(hi);
        *rest = F::of_f64((hi - x.to_f64()) + lo);
    }
}

/// x = q π/2 + hi + lo, q in 0..4 modulo four; for arguments of at least 1 (smaller ones are not sent here).
fn remainder(x: f64) -> (f64, f64, f64) {
    let bits = x.to_bits();
    let exponent = (bits >> 52) as usize & 0x7ff;
    if !(1023..2047).contains(&exponent) {
        return (0.0, x, 0.0);
    }
    let mantissa = u128::from(bits & ((1 << 52) - 1) | 1 << 52);
    // x = mantissa 2^(exponent − 1075). Bits of 2/π that this makes multiples of four do not matter; of those behind
    // them, 192 leave 2^-137 of the fraction, and no f64 is nearer than 2^-62 to a multiple of π/2.
    let start = exponent + 62 - 1075;
    let (word, shift) = (start / 64, start % 64);
    let at = |i: usize| u128::from(TWO_OVER_PI.get(word + i).copied().unwrap_or(0));
    let window = |i: usize| (at(i) << 64 | at(i + 1)) << shift >> 64 & u128::from(u64::MAX);
    // the product modulo 2^192, its upper two bits the quarter turns
    let low = mantissa * window(2);
    let middle = mantissa * window(1) + (low >> 64);
    let high = (mantissa * window(0) + (middle >> 64)) & u128::from(u64::MAX);
    let (middle, low) = (middle & u128::from(u64::MAX), low & u128::from(u64::MAX));
    let fraction = ((high << 64 | middle) << 2 | low >> 62).cast_signed();
    let quarters = (high >> 62) as u32 + u32::from(fraction < 0);
    let unit = f64::from_bits((1023 - 128) << 52);
    let upper = fraction as f64;
    let lower = (fraction - upper as i128) as f64 * unit;
    let upper = upper * unit;
    let (c, c_rest) = (core::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17);
    // upper c exactly, by halves
    let half = |x: f64| f64::from_bits(x.to_bits() & !((1 << 27) - 1));
    let product = upper * c;
    let ((u1, c1), (u2, c2)) = ((half(upper), half(c)), (upper - half(upper), c - half(c)));
    let error = ((u1 * c1 - product) + u1 * c2 + u2 * c1) + u2 * c2;
    let rest = error + upper * c_rest + lower * c;
    let hi = product + rest;
    let lo = rest - (hi - product);
    if x < 0.0 { (f64::from((4 - quarters % 4) % 4), -hi, -lo) } else { (f64::from(quarters % 4), hi, lo) }
}

//! 128 bits of ARM. Its instructions are part of every aarch64 target that has the feature at all.
#![allow(unsafe_code, unused_unsafe, reason = "the instructions; `register!` says why they are there")]

use super::real::{assigning, elementary};
use super::register::{apply, register, truths};
use super::{LaneMask, MAX_WIDTH, Pack, padded};
use crate::scalar::math::{self, Lanes};
use crate::scalar::{Inside, Mask, Real};
#[allow(clippy::wildcard_imports, reason = "a hundred names of instructions, all with their prefix")]
use core::arch::aarch64::*;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

register! {
    /// Two `f64`.
    NeonF64: 2 x f64 in float64x2_t, mask NeonF64Mask, needs "neon",
    load [vld1q_f64], store [vst1q_f64], splat [vdupq_n_f64], pattern [|bits| vreinterpretq_f64_u64(vdupq_n_u64(bits))],
    add [vaddq_f64], sub [vsubq_f64], mul [vmulq_f64], div [vdivq_f64], fused [|a, b, c| vfmaq_f64(c, a, b)], sqrt [vsqrtq_f64],
    floor [vrndmq_f64], lt [vcltq_f64], le [vcleq_f64], eq [vceqq_f64], blend [vbslq_f64],
    negative [|a| vcltzq_s64(vreinterpretq_s64_f64(a))],
    and [|a, b| vreinterpretq_f64_u64(vandq_u64(vreinterpretq_u64_f64(a), vreinterpretq_u64_f64(b)))],
    or [|a, b| vreinterpretq_f64_u64(vorrq_u64(vreinterpretq_u64_f64(a), vreinterpretq_u64_f64(b)))],
    xor [|a, b| vreinterpretq_f64_u64(veorq_u64(vreinterpretq_u64_f64(a), vreinterpretq_u64_f64(b)))],
    plus [|a, b| vreinterpretq_f64_u64(vaddq_u64(vreinterpretq_u64_f64(a), vreinterpretq_u64_f64(b)))],
    up [|a, by| vreinterpretq_f64_u64(vshlq_u64(vreinterpretq_u64_f64(a), vdupq_n_s64(i64::from(by))))],
    down [|a, by| vreinterpretq_f64_u64(vshlq_u64(vreinterpretq_u64_f64(a), vdupq_n_s64(-i64::from(by))))]
}

truths! {
    NeonF64Mask in uint64x2_t, 2, and [vandq_u64], or [vorrq_u64], not [|a| veorq_u64(a, vdupq_n_u64(u64::MAX))],
    bits [|a| vaddvq_u64(vandq_u64(a, vld1q_u64([1, 2].as_ptr()))) as u32],
    of [|bits| vtstq_u64(vdupq_n_u64(u64::from(bits)), vld1q_u64([1, 2].as_ptr()))]
}

register! {
    /// Four `f32`.
    NeonF32: 4 x f32 in float32x4_t, mask NeonF32Mask, needs "neon",
    load [vld1q_f32], store [vst1q_f32], splat [vdupq_n_f32], pattern [|bits| vreinterpretq_f32_u32(vdupq_n_u32(bits as u32))],
    add [vaddq_f32], sub [vsubq_f32], mul [vmulq_f32], div [vdivq_f32], fused [|a, b, c| vfmaq_f32(c, a, b)], sqrt [vsqrtq_f32],
    floor [vrndmq_f32], lt [vcltq_f32], le [vcleq_f32], eq [vceqq_f32], blend [vbslq_f32],
    negative [|a| vcltzq_s32(vreinterpretq_s32_f32(a))],
    and [|a, b| vreinterpretq_f32_u32(vandq_u32(vreinterpretq_u32_f32(a), vreinterpretq_u32_f32(b)))],
    or [|a, b| vreinterpretq_f32_u32(vorrq_u32(vreinterpretq_u32_f32(a), vreinterpretq_u32_f32(b)))],
    xor [|a, b| vreinterpretq_f32_u32(veorq_u32(vreinterpretq_u32_f32(a), vreinterpretq_u32_f32(b)))],
    plus [|a, b| vreinterpretq_f32_u32(vaddq_u32(vreinterpretq_u32_f32(a), vreinterpretq_u32_f32(b)))],
    up [|a, by| vreinterpretq_f32_u32(vshlq_u32(vreinterpretq_u32_f32(a), vdupq_n_s32(by.cast_signed())))],
    down [|a, by| vreinterpretq_f32_u32(vshlq_u32(vreinterpretq_u32_f32(a), vdupq_n_s32(-(by.cast_signed()))))]
}

truths! {
    NeonF32Mask in uint32x4_t, 4, and [vandq_u32], or [vorrq_u32], not [|a| veorq_u32(a, vdupq_n_u32(u32::MAX))],
    bits [|a| vaddvq_u32(vandq_u32(a, vld1q_u32([1, 2, 4, 8].as_ptr())))],
    of [|bits| vtstq_u32(vdupq_n_u32(bits), vld1q_u32([1, 2, 4, 8].as_ptr()))]
}

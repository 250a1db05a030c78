//! 256 bits of x86, with fused multiply-add.
#![allow(unsafe_code, unused_unsafe, reason = "the instructions; `register!` says why they are there")]

use super::real::{assigning, elementary};
use super::register::{apply, register, truths};
use super::{LaneMask, MAX_WIDTH, Pack, padded};
use crate::scalar::math::{self, Lanes};
use crate::scalar::{Inside, Mask, Real};
#[allow(clippy::wildcard_imports, reason = "a hundred names of instructions, all with their prefix")]
use core::arch::x86_64::*;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// The number of a shift, where the instructions take it.
#[inline(always)]
fn count(by: u32) -> __m128i {
    // SAFETY: SSE2 is part of every x86-64.
    unsafe { _mm_cvtsi32_si128(by.cast_signed()) }
}

register! {
    /// Four `f64`.
    Avx2F64: 4 x f64 in __m256d, mask Avx2F64Mask, needs "avx2,fma",
    load [_mm256_loadu_pd], store [_mm256_storeu_pd], splat [_mm256_set1_pd],
    pattern [|bits| _mm256_castsi256_pd(_mm256_set1_epi64x(bits.cast_signed()))],
    add [_mm256_add_pd], sub [_mm256_sub_pd], mul [_mm256_mul_pd], div [_mm256_div_pd], fused [_mm256_fmadd_pd], sqrt [_mm256_sqrt_pd],
    floor [_mm256_floor_pd],
    lt [_mm256_cmp_pd::<_CMP_LT_OQ>], le [_mm256_cmp_pd::<_CMP_LE_OQ>], eq [_mm256_cmp_pd::<_CMP_EQ_OQ>],
    blend [|mask, yes, no| _mm256_blendv_pd(no, yes, mask)], negative [|a| a],
    and [_mm256_and_pd], or [_mm256_or_pd], xor [_mm256_xor_pd],
    plus [|a, b| _mm256_castsi256_pd(_mm256_add_epi64(_mm256_castpd_si256(a), _mm256_castpd_si256(b)))],
    up [|a, by| _mm256_castsi256_pd(_mm256_sll_epi64(_mm256_castpd_si256(a), count(by)))],
    down [|a, by| _mm256_castsi256_pd(_mm256_srl_epi64(_mm256_castpd_si256(a), count(by)))]
}

// a lane is true where its sign bit is set: that is what blend and movemask look at
truths! {
    Avx2F64Mask in __m256d, 4, and [_mm256_and_pd], or [_mm256_or_pd],
    not [|a| _mm256_xor_pd(a, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)))],
    bits [|a| _mm256_movemask_pd(a) as u32],
    of [|bits| {
        let each = _mm256_and_si256(_mm256_set1_epi64x(i64::from(bits)), _mm256_setr_epi64x(1, 2, 4, 8));
        _mm256_castsi256_pd(_mm256_cmpgt_epi64(each, _mm256_setzero_si256()))
    }]
}

register! {
    /// Eight `f32`.
    Avx2F32: 8 x f32 in __m256, mask Avx2F32Mask, needs "avx2,fma",
    load [_mm256_loadu_ps], store [_mm256_storeu_ps], splat [_mm256_set1_ps],
    pattern [|bits| _mm256_castsi256_ps(_mm256_set1_epi32(bits as i32))],
    add [_mm256_add_ps], sub [_mm256_sub_ps], mul [_mm256_mul_ps], div [_mm256_div_ps], fused [_mm256_fmadd_ps], sqrt [_mm256_sqrt_ps],
    floor [_mm256_floor_ps],
    lt [_mm256_cmp_ps::<_CMP_LT_OQ>], le [_mm256_cmp_ps::<_CMP_LE_OQ>], eq [_mm256_cmp_ps::<_CMP_EQ_OQ>],
    blend [|mask, yes, no| _mm256_blendv_ps(no, yes, mask)], negative [|a| a],
    and [_mm256_and_ps], or [_mm256_or_ps], xor [_mm256_xor_ps],
    plus [|a, b| _mm256_castsi256_ps(_mm256_add_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)))],
    up [|a, by| _mm256_castsi256_ps(_mm256_sll_epi32(_mm256_castps_si256(a), count(by)))],
    down [|a, by| _mm256_castsi256_ps(_mm256_srl_epi32(_mm256_castps_si256(a), count(by)))]
}

truths! {
    Avx2F32Mask in __m256, 8, and [_mm256_and_ps], or [_mm256_or_ps],
    not [|a| _mm256_xor_ps(a, _mm256_castsi256_ps(_mm256_set1_epi32(-1)))],
    bits [|a| _mm256_movemask_ps(a) as u32],
    of [|bits| {
        let each = _mm256_and_si256(_mm256_set1_epi32(bits.cast_signed()), _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128));
        _mm256_castsi256_ps(_mm256_cmpgt_epi32(each, _mm256_setzero_si256()))
    }]
}

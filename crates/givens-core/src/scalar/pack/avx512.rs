//! 512 bits of x86.
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

const DOWN: i32 = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;

register! {
    /// Eight `f64`.
    Avx512F64: 8 x f64 in __m512d, mask Avx512F64Mask, needs "avx512f,avx512dq,avx512vl,avx2,fma",
    load [_mm512_loadu_pd], store [_mm512_storeu_pd], splat [_mm512_set1_pd],
    pattern [|bits| _mm512_castsi512_pd(_mm512_set1_epi64(bits.cast_signed()))],
    add [_mm512_add_pd], sub [_mm512_sub_pd], mul [_mm512_mul_pd], div [_mm512_div_pd], fused [_mm512_fmadd_pd], sqrt [_mm512_sqrt_pd],
    floor [_mm512_roundscale_pd::<DOWN>],
    lt [_mm512_cmp_pd_mask::<_CMP_LT_OQ>], le [_mm512_cmp_pd_mask::<_CMP_LE_OQ>], eq [_mm512_cmp_pd_mask::<_CMP_EQ_OQ>],
    blend [|mask, yes, no| _mm512_mask_blend_pd(mask, no, yes)],
    negative [|a| _mm512_movepi64_mask(_mm512_castpd_si512(a))],
    and [_mm512_and_pd], or [_mm512_or_pd], xor [_mm512_xor_pd],
    plus [|a, b| _mm512_castsi512_pd(_mm512_add_epi64(_mm512_castpd_si512(a), _mm512_castpd_si512(b)))],
    up [|a, by| _mm512_castsi512_pd(_mm512_sll_epi64(_mm512_castpd_si512(a), count(by)))],
    down [|a, by| _mm512_castsi512_pd(_mm512_srl_epi64(_mm512_castpd_si512(a), count(by)))]
}

truths! {
    Avx512F64Mask in __mmask8, 8, and [BitAnd::bitand], or [BitOr::bitor], not [Not::not], bits [u32::from], of [|bits| bits as u8]
}

register! {
    /// Sixteen `f32`.
    Avx512F32: 16 x f32 in __m512, mask Avx512F32Mask, needs "avx512f,avx512dq,avx512vl,avx2,fma",
    load [_mm512_loadu_ps], store [_mm512_storeu_ps], splat [_mm512_set1_ps],
    pattern [|bits| _mm512_castsi512_ps(_mm512_set1_epi32(bits as i32))],
    add [_mm512_add_ps], sub [_mm512_sub_ps], mul [_mm512_mul_ps], div [_mm512_div_ps], fused [_mm512_fmadd_ps], sqrt [_mm512_sqrt_ps],
    floor [_mm512_roundscale_ps::<DOWN>],
    lt [_mm512_cmp_ps_mask::<_CMP_LT_OQ>], le [_mm512_cmp_ps_mask::<_CMP_LE_OQ>], eq [_mm512_cmp_ps_mask::<_CMP_EQ_OQ>],
    blend [|mask, yes, no| _mm512_mask_blend_ps(mask, no, yes)],
    negative [|a| _mm512_movepi32_mask(_mm512_castps_si512(a))],
    and [_mm512_and_ps], or [_mm512_or_ps], xor [_mm512_xor_ps],
    plus [|a, b| _mm512_castsi512_ps(_mm512_add_epi32(_mm512_castps_si512(a), _mm512_castps_si512(b)))],
    up [|a, by| _mm512_castsi512_ps(_mm512_sll_epi32(_mm512_castps_si512(a), count(by)))],
    down [|a, by| _mm512_castsi512_ps(_mm512_srl_epi32(_mm512_castps_si512(a), count(by)))]
}

truths! {
    Avx512F32Mask in __mmask16, 16, and [BitAnd::bitand], or [BitOr::bitor], not [Not::not], bits [u32::from], of [|bits| bits as u16]
}

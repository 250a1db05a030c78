//! What numbers are made of, found out at run time: the way for a model behind a pointer to be asked for any of them.

use super::{Dual2, InstructionSet, Real, pack};
use core::any::TypeId;

/// A kind of number made of floats: one or a pack of them, and how many times derived.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Grain {
    /// Made of `f32`; else of `f64`.
    pub single: bool,
    /// The registers that it fills; none for one float.
    pub set: Option<InstructionSet>,
    /// How deep its derivatives are nested.
    pub depth: usize,
}

impl Grain {
    /// That of `T`, if it is one of those that a model behind a pointer is compiled for: `f64` and `f32` up to two derivatives
    /// deep, and packs of them in registers one deep.
    #[inline(always)]
    pub fn of<T: Real>() -> Option<Self> {
        match made_of::<T, f64, pack::Narrow, pack::Wide>() {
            Some((set, depth)) => Some(Self { single: false, set, depth }),
            None => made_of::<T, f32, pack::NarrowSingle, pack::WideSingle>()
                .map(|(set, depth)| Self { single: true, set, depth }),
        }
    }

    /// Whether `T` is `f64` itself.
    #[inline(always)]
    pub fn is_double<T: Real>() -> bool {
        is::<T, f64>()
    }

    /// Whether `T` is made of `f64`.
    #[inline(always)]
    fn is_of_doubles<T: Real>() -> bool {
        matches!(Self::of::<T>(), Some(Self { single: false, .. }))
    }
}

/// Whether `T` is made of floats `E` or of packs `P` or `W` of them: the set and the depth.
#[inline(always)]
fn made_of<T: Real, E: Real, P: Real, W: Real>() -> Option<(Option<InstructionSet>, usize)> {
    if is::<T, Dual2<Dual2<E>>>() {
        return Some((None, 2));
    }
    let (numbers, narrow, wide) = (depth_over::<T, E>(), depth_over::<T, P>(), depth_over::<T, W>());
    let in_packs = |depth: usize, set| (Some(set), depth);
    match (numbers, narrow) {
        (Some(depth), _) => Some((None, depth)),
        (None, Some(depth)) => Some(in_packs(depth, pack::NARROW)),
        (None, None) => wide.map(|depth| in_packs(depth, pack::WIDE)),
    }
}

/// How often `U` is derived in `T`, at most once.
#[inline(always)]
fn depth_over<T: Real, U: Real>() -> Option<usize> {
    if is::<T, U>() { Some(0) } else { is::<T, Dual2<U>>().then_some(1) }
}

#[inline(always)]
fn is<T: 'static, U: 'static>() -> bool {
    TypeId::of::<T>() == TypeId::of::<U>()
}

/// What all the numbers of [`Grain::of`] are made of: an `f32` is one word, an `f64` two.
pub(crate) type Word = u32;

/// The words that numbers are made of; nothing if they are none of [`Grain::of`].
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn words<T: Real>(numbers: &[T]) -> &[Word] {
    if Grain::of::<T>().is_none() {
        return &[];
    }
    // SAFETY: the types of `Grain::of` are floats, registers of floats and `repr(C)` structs of these: arrays of words without
    // padding, at least as aligned. The slice keeps the borrow.
    unsafe { core::slice::from_raw_parts(numbers.as_ptr().cast(), size_of_val(numbers) / size_of::<Word>()) }
}

/// [`words`], to be written to.
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn words_mut<T: Real>(numbers: &mut [T]) -> &mut [Word] {
    if Grain::of::<T>().is_none() {
        return &mut [];
    }
    let len = size_of_val(numbers) / size_of::<Word>();
    // SAFETY: as in `words`; and any words make a valid number of those types.
    unsafe { core::slice::from_raw_parts_mut(numbers.as_mut_ptr().cast(), len) }
}

/// The numbers that words make, as many as there are whole ones; none where they are not aligned as those must be, or `T` is
/// none of [`Grain::of`].
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn numbers<T: Real>(words: &[Word]) -> &[T] {
    if Grain::of::<T>().is_none() || !words.as_ptr().cast::<T>().is_aligned() {
        return &[];
    }
    // SAFETY: the line above has seen to type and alignment; any words make a valid number of those types.
    unsafe { core::slice::from_raw_parts(words.as_ptr().cast(), size_of_val(words) / size_of::<T>()) }
}

/// [`numbers`], to be written to.
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn numbers_mut<T: Real>(words: &mut [Word]) -> &mut [T] {
    if Grain::of::<T>().is_none() || !words.as_ptr().cast::<T>().is_aligned() {
        return &mut [];
    }
    let len = size_of_val(words) / size_of::<T>();
    // SAFETY: as in `numbers`; the types are made of words, so that what is written are words.
    unsafe { core::slice::from_raw_parts_mut(words.as_mut_ptr().cast(), len) }
}

/// The `f64` that numbers are made of; nothing if they are made of others.
#[inline(always)]
pub(crate) fn floats<T: Real>(of: &[T]) -> &[f64] {
    if Grain::is_of_doubles::<T>() { numbers(words(of)) } else { &[] }
}

/// [`floats`], to be written to.
#[inline(always)]
pub(crate) fn floats_mut<T: Real>(of: &mut [T]) -> &mut [f64] {
    if Grain::is_of_doubles::<T>() { numbers_mut(words_mut(of)) } else { &mut [] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_their_floats_and_back() {
        let duals = [Dual2 { v: 1.0, d: 2.0, dd: 3.0 }, Dual2 { v: 4.0, d: 5.0, dd: 6.0 }];
        assert_eq!(floats(&duals), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!(numbers::<Dual2<f64>>(words(&duals)), duals);
        assert_eq!(numbers::<Dual2<f64>>(words(&[1.0, 2.0, 3.0, 4.0])), &duals[..1]);
        let singles = [Dual2 { v: 1.0_f32, d: 2.0, dd: 3.0 }];
        assert_eq!(numbers::<f32>(words(&singles)), [1.0, 2.0, 3.0]);
        assert!(floats(&singles).is_empty());
        assert_eq!(numbers::<Dual2<f32>>(words(&singles)), singles);
        assert_eq!((words(&[1.0_f32]).len(), words(&[1.0_f64]).len()), (1, 2));
    }

    #[test]
    fn what_is_not_aligned_is_no_pack() {
        let memory = [0.0_f64; 16];
        let words = words(&memory);
        let aligned =
            |whole: usize| (0..whole).filter(|&k| !numbers::<pack::Narrow>(&words[k..]).is_empty()).count();
        assert_eq!(aligned(16), 16 * size_of::<Word>() / align_of::<pack::Narrow>());
        let aligned = (0..16).filter(|&k| !numbers::<pack::NarrowSingle>(&words[k..]).is_empty()).count();
        assert_eq!(aligned, 16 * size_of::<Word>() / align_of::<pack::NarrowSingle>());
    }
}

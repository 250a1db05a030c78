//! What numbers are made of, found out at run time: the way for a model behind a pointer to be asked for any of them.

use super::{Dual2, InstructionSet, Real, pack};
use core::any::TypeId;

/// A kind of number made of `f64`: one or a pack of them, and how many times derived.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Grain {
    /// The registers that it fills; none for one `f64`.
    pub set: Option<InstructionSet>,
    /// How deep its derivatives are nested.
    pub depth: usize,
}

impl Grain {
    /// That of `T`, if it is one of those that a model behind a pointer is compiled for: `f64` up to two derivatives deep,
    /// and packs of `f64`, but not those of AVX-512, one deep.
    #[inline(always)]
    pub fn of<T: Real>() -> Option<Self> {
        let plain = |depth| Some(Self { set: None, depth });
        if is::<T, f64>() {
            return plain(0);
        }
        if is::<T, Dual2<f64>>() {
            return plain(1);
        }
        if is::<T, Dual2<Dual2<f64>>>() {
            return plain(2);
        }
        let wide = |depth| Some(Self { set: Some(pack::NARROW), depth });
        if is::<T, pack::Narrow>() {
            return wide(0);
        }
        if is::<T, Dual2<pack::Narrow>>() {
            return wide(1);
        }
        None
    }
}

fn is<T: 'static, U: 'static>() -> bool {
    TypeId::of::<T>() == TypeId::of::<U>()
}

/// The `f64` that numbers are made of; nothing if they are none of [`Grain::of`].
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn floats<T: Real>(numbers: &[T]) -> &[f64] {
    if Grain::of::<T>().is_none() {
        return &[];
    }
    // SAFETY: the types of `Grain::of` are `f64`, registers of `f64` and `repr(C)` structs of these: arrays of `f64` without
    // padding, at least as aligned. The slice keeps the borrow.
    unsafe { core::slice::from_raw_parts(numbers.as_ptr().cast(), size_of_val(numbers) / size_of::<f64>()) }
}

/// [`floats`], to be written to.
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn floats_mut<T: Real>(numbers: &mut [T]) -> &mut [f64] {
    if Grain::of::<T>().is_none() {
        return &mut [];
    }
    let len = size_of_val(numbers) / size_of::<f64>();
    // SAFETY: as in `floats`; and any `f64` make a valid number of those types.
    unsafe { core::slice::from_raw_parts_mut(numbers.as_mut_ptr().cast(), len) }
}

/// The numbers that `f64` make, as many as there are whole ones; none where they are not aligned as those must be, or `T` is
/// none of [`Grain::of`].
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn numbers<T: Real>(floats: &[f64]) -> &[T] {
    if Grain::of::<T>().is_none() || !floats.as_ptr().cast::<T>().is_aligned() {
        return &[];
    }
    // SAFETY: the line above has seen to type and alignment; any `f64` make a valid number of those types.
    unsafe { core::slice::from_raw_parts(floats.as_ptr().cast(), size_of_val(floats) / size_of::<T>()) }
}

/// [`numbers`], to be written to.
#[allow(unsafe_code)]
#[inline(always)]
pub(crate) fn numbers_mut<T: Real>(floats: &mut [f64]) -> &mut [T] {
    if Grain::of::<T>().is_none() || !floats.as_ptr().cast::<T>().is_aligned() {
        return &mut [];
    }
    let len = size_of_val(floats) / size_of::<T>();
    // SAFETY: as in `numbers`; the types are made of `f64`, so that what is written are `f64`.
    unsafe { core::slice::from_raw_parts_mut(floats.as_mut_ptr().cast(), len) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_their_floats_and_back() {
        let duals = [Dual2 { v: 1.0, d: 2.0, dd: 3.0 }, Dual2 { v: 4.0, d: 5.0, dd: 6.0 }];
        assert_eq!(floats(&duals), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        assert_eq!(numbers::<Dual2<f64>>(floats(&duals)), duals);
        assert_eq!(
            numbers::<Dual2<f64>>(&[1.0, 2.0, 3.0, 4.0]),
            &duals[..1][..1].iter().map(|_| Dual2 { v: 1.0, d: 2.0, dd: 3.0 }).collect::<std::vec::Vec<_>>()
                [..]
        );
        assert!(floats(&[1.0_f32]).is_empty() && numbers::<f32>(&[1.0]).is_empty());
    }

    #[test]
    fn what_is_not_aligned_is_no_pack() {
        let memory = [0.0_f64; 16];
        let aligned = (0..8).filter(|&k| !numbers::<pack::Narrow>(&memory[k..]).is_empty()).count();
        assert_eq!(aligned, 8 * size_of::<f64>() / align_of::<pack::Narrow>());
    }
}

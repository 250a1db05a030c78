//! Memory for methods that are lent none.

use givens_core::scalar::Real;

/// Calls `f` with `len` scalars on the stack; programs that need more than 256 get them from the heap.
#[inline]
pub(super) fn with_frame<T: Real, R>(len: usize, f: impl FnOnce(&mut [T]) -> R) -> R {
    match len {
        0..=24 => f(&mut [T::zero(); 24][..len]),
        25..=256 => f(&mut [T::zero(); 256][..len]),
        _ => f(&mut vec![T::zero(); len]),
    }
}

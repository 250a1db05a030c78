//! Packs: several floats side by side in one register, as one scalar.
//!
//! A pack implements [`Real`], so that every model, kernel and filter runs on it, and [`Pack`], by which its lanes
//! are filled and read at the boundary. There is one for each instruction set and precision: AVX2 with FMA
//! (4 × `f64`, 8 × `f32`), AVX-512 (8 × `f64`, 16 × `f32`), NEON (2 × `f64`, 4 × `f32`), and arrays of 4 and 8 for
//! every machine. `f64` and `f32` themselves are packs of one lane.
//!
//! # Why the SIMD types have no names
//!
//! Generic code makes scalars out of nothing (`T::of(0.5)`, `T::zero()`), so those must be safe functions; but a safe
//! function that executes an AVX-512 instruction on any machine would be unsound. A token passed to every
//! constructor would settle that, and no longer fit `T: Real`. Here the *type* is the token: the SIMD types are
//! private, and the only way to them is [`InstructionSet::run`], which looks whether the machine has the set and then
//! calls [`Job::run`] with the type as its parameter. Whoever holds such a `P` runs on a machine that has it; no
//! safe code can write one down elsewhere. The same call is the `#[target_feature]` function around the whole loop,
//! into which everything below is inlined: the one place where the choice is made, and the reason why a program
//! built for any machine runs at the speed of this one.

mod array;
#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
#[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
mod neon;
mod real;
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
mod register;
mod scalar;
mod set;
mod tracks;

// without `std`, nobody asks the machine: there it is what the program is built for
#[cfg(all(
    target_arch = "x86_64",
    any(feature = "std", all(target_feature = "avx2", target_feature = "fma"))
))]
mod narrow {
    pub(in crate::scalar) type Narrow = super::avx2::Avx2F64;
    pub(in crate::scalar) type NarrowSingle = super::avx2::Avx2F32;
    pub(crate) const NARROW: super::InstructionSet = super::InstructionSet::Avx2;
}
#[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
mod narrow {
    pub(in crate::scalar) type Narrow = super::neon::NeonF64;
    pub(in crate::scalar) type NarrowSingle = super::neon::NeonF32;
    pub(crate) const NARROW: super::InstructionSet = super::InstructionSet::Neon;
}
#[cfg(not(any(
    all(target_arch = "x86_64", any(feature = "std", all(target_feature = "avx2", target_feature = "fma"))),
    all(target_arch = "aarch64", target_feature = "neon")
)))]
mod narrow {
    pub(in crate::scalar) type Narrow = super::array::Array<f64, 4>;
    pub(in crate::scalar) type NarrowSingle = super::array::Array<f32, 8>;
    pub(crate) const NARROW: super::InstructionSet = super::InstructionSet::Portable;
}

pub(crate) use narrow::NARROW;
/// The packs of `f64` and of `f32` whose lanes are the points of one filter, and their set: of vectors twice as wide, it would
/// leave most lanes empty.
pub(super) use narrow::{Narrow, NarrowSingle};

/// The lanes of that of `f64`; one where the machine has no registers for them.
pub(crate) const LANES: usize = match NARROW {
    InstructionSet::Portable => 1,
    InstructionSet::Neon => 2,
    _ => 4,
};

/// The packs beside these that models behind a pointer are compiled for, where the machine may have wider ones.
#[cfg(target_arch = "x86_64")]
pub(super) type Wide = avx512::Avx512F64;
#[cfg(target_arch = "x86_64")]
pub(super) type WideSingle = avx512::Avx512F32;
#[cfg(target_arch = "x86_64")]
pub(super) const WIDE: InstructionSet = InstructionSet::Avx512;
#[cfg(not(target_arch = "x86_64"))]
pub(super) use {NARROW as WIDE, Narrow as Wide, NarrowSingle as WideSingle};

pub use set::{InstructionSet, Job};
pub use tracks::{gather, scatter};

use super::{Mask, Real, math};

/// The lanes of the widest pack.
pub const MAX_WIDTH: usize = 16;

/// The precision of a pack's lanes: `f64` or `f32`.
pub trait Element: Real<Mask = bool> + Pack<Element = Self> + math::Format + set::Dispatch {}

impl Element for f64 {}
impl Element for f32 {}

/// The truth values of a pack's lanes, one at a time.
pub trait LaneMask: Mask {
    /// Lane i as bit i, from the lowest.
    fn bits(self) -> u32;
    /// Lane i from bit i; bits beyond the lanes do not matter.
    fn of_bits(bits: u32) -> Self;
    /// The value of lane i; false beyond the lanes.
    #[inline(always)]
    fn lane(self, i: usize) -> bool {
        i < u32::BITS as usize && self.bits() >> i & 1 == 1
    }
}

/// Several numbers side by side, lane by lane.
///
/// ```
/// use givens_core::scalar::{InstructionSet, Job, Pack};
///
/// /// Writes √x over every x.
/// struct Roots<'a>(&'a mut [f64]);
/// impl Job<f64> for Roots<'_> {
///     type Output = ();
///     #[inline(always)]
///     fn run<P: Pack<Element = f64>>(self) {
///         for lanes in self.0.chunks_mut(P::WIDTH) {
///             P::load(lanes).sqrt().store(lanes);
///         }
///     }
/// }
/// let mut x = [1.0, 4.0, 9.0, 16.0, 25.0];
/// InstructionSet::best().run(Roots(&mut x));
/// assert_eq!(x, [1.0, 2.0, 3.0, 4.0, 5.0]);
/// ```
pub trait Pack: Real<Mask: LaneMask> {
    /// The precision of the lanes.
    type Element: Element;
    /// The number of lanes, a power of two and at most [`MAX_WIDTH`].
    const WIDTH: usize;

    /// The same number in every lane.
    fn splat(number: Self::Element) -> Self;
    /// The first numbers of a slice; where it is too short, its last one again in the lanes left over (NaN if it is
    /// empty).
    fn load(numbers: &[Self::Element]) -> Self;
    /// Writes the lanes to the start of a slice, as many as it has room for.
    fn store(self, numbers: &mut [Self::Element]);

    /// The sum of all lanes.
    #[inline(always)]
    fn sum(self) -> Self::Element {
        let mut lanes = [Self::Element::zero(); MAX_WIDTH];
        self.store(&mut lanes);
        let mut width = Self::WIDTH;
        while width > 1 {
            width /= 2;
            for i in 0..width {
                lanes[i] += lanes[i + width];
            }
        }
        lanes[0]
    }
    /// The number of lane i; NaN beyond the lanes.
    #[inline(always)]
    fn lane(self, i: usize) -> Self::Element {
        let mut lanes = [Self::Element::of(f64::NAN); MAX_WIDTH];
        self.store(&mut lanes);
        lanes.get(i).copied().unwrap_or(Self::Element::of(f64::NAN))
    }
    /// `self` with another number in lane i; unchanged if there is no such lane.
    #[inline(always)]
    fn with_lane(self, i: usize, number: Self::Element) -> Self {
        if i >= Self::WIDTH {
            return self;
        }
        Self::select(Self::Mask::of_bits(1 << i), Self::splat(number), self)
    }
}

/// The first `width` numbers that [`Pack::load`] takes from a slice that is too short.
#[inline(always)]
fn padded<E: Element>(numbers: &[E]) -> [E; MAX_WIDTH] {
    let last = numbers.last().copied().unwrap_or(E::of(f64::NAN));
    let mut lanes = [last; MAX_WIDTH];
    lanes.iter_mut().zip(numbers).for_each(|(lane, &number)| *lane = number);
    lanes
}

//! Which instruction set, and the way into it.

use super::{Element, Pack, array};
use crate::scalar::Inside;

/// An instruction set that packs exist for.
///
/// Every one has a value on every machine, so that a tool can name it; [`available`](Self::available) says whether
/// this machine has it, and [`run`](Self::run) does nothing where it has not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum InstructionSet {
    /// Arrays of floats, on any machine.
    Portable,
    /// 128 bits of ARM: 2 × `f64`, 4 × `f32`.
    Neon,
    /// 256 bits of x86 with fused multiply-add: 4 × `f64`, 8 × `f32`.
    Avx2,
    /// 512 bits of x86 (AVX-512 F, DQ and VL): 8 × `f64`, 16 × `f32`.
    Avx512,
}

/// Work written once for packs of any width: what [`InstructionSet::run`] calls with the pack of that set.
///
/// The whole loop belongs into `run`, and `#[inline(always)]` on it and on all that it calls: code that is not
/// inlined is compiled for the oldest machine, where every operation of a pack is a call. A closure cannot be marked
/// so; one that is called in several places, or passed on by reference (`for_each(&mut f)`), had better be a function.
pub trait Job<E: Element> {
    /// What the work gives.
    type Output;
    /// Whether it is compiled for AVX-512 too. Its vectors are twice as wide as AVX2's, but many machines do not compute more
    /// with them: long work may not be worth the compiling. It is then as if no machine had the set.
    const AVX512: bool = true;
    /// The work, on packs of type `P`.
    fn run<P: Pack<Element = E>>(self) -> Self::Output;
}

/// Whether the machine has the listed features; without `std`, whether the program is built for them.
#[cfg(target_arch = "x86_64")]
macro_rules! has {
    ($($feature:tt),*) => {{
        #[cfg(feature = "std")]
        { $(std::arch::is_x86_feature_detected!($feature))&&* }
        #[cfg(not(feature = "std"))]
        { $(cfg!(target_feature = $feature))&&* }
    }};
}

impl InstructionSet {
    /// Every set, the narrowest first.
    pub const ALL: [Self; 4] = [Self::Portable, Self::Neon, Self::Avx2, Self::Avx512];

    /// Whether this machine has it. Without the feature `std`: whether the program is built for it.
    #[inline]
    pub fn available(self) -> bool {
        match self {
            Self::Portable => true,
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => has!("avx2", "fma"),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => has!("avx512f", "avx512dq", "avx512vl", "avx2", "fma"),
            #[cfg(target_arch = "aarch64")]
            Self::Neon => cfg!(target_feature = "neon"),
            _ => false,
        }
    }

    /// The widest set of this machine.
    pub fn best() -> Self {
        Self::ALL.into_iter().rev().find(|set| set.available()).unwrap_or(Self::Portable)
    }

    /// Does the work on packs of this set; `None`, and nothing done, if the machine lacks it.
    pub fn run<E: Element, J: Job<E>>(self, job: J) -> Option<J::Output> {
        self.available().then(|| {
            // SAFETY: the line above has seen that the set is available.
            #[allow(unsafe_code)]
            unsafe {
                E::dispatch(self, job)
            }
        })
    }

    /// Does work that knows nothing of packs, compiled with the instructions of this set if the machine has it.
    #[inline(always)]
    pub(crate) fn vectorised<W: Inside>(self, work: W) -> W::Output {
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx2,fma")]
        fn avx2<W: Inside>(work: W) -> W::Output {
            work.go()
        }
        fn inside<W: Inside>(work: W) -> W::Output {
            work.go()
        }
        #[cfg(target_arch = "x86_64")]
        if self == Self::Avx2 && self.available() {
            // SAFETY: the line above has seen that the set is available.
            #[allow(unsafe_code)]
            return unsafe { avx2(work) };
        }
        inside(work)
    }

    /// Does the work on packs of this set if they are registers; else gives it back. Arrays are not compiled for it.
    ///
    /// # Errors
    /// The work, undone: the machine lacks the set, or it is the portable one.
    #[allow(clippy::result_large_err, reason = "the job comes back as it was")]
    pub fn run_in_registers<E: Element, J: Job<E>>(self, job: J) -> Result<J::Output, J> {
        if !self.available() {
            return Err(job);
        }
        // SAFETY: the line above has seen that the set is available.
        #[allow(unsafe_code)]
        unsafe {
            E::dispatch_registers(self, job)
        }
    }
}

/// From a set and a precision to the type of the pack.
pub trait Dispatch: Sized {
    /// Does the work on packs of `set`.
    ///
    /// # Safety
    /// The set must be available on this machine.
    #[allow(unsafe_code)]
    unsafe fn dispatch<J: Job<Self>>(set: InstructionSet, job: J) -> J::Output
    where
        Self: Element;

    /// Does the work on packs of `set` if they are registers; else gives it back.
    ///
    /// # Safety
    /// The set must be available on this machine.
    #[allow(unsafe_code)]
    unsafe fn dispatch_registers<J: Job<Self>>(set: InstructionSet, job: J) -> Result<J::Output, J>
    where
        Self: Element;
}

macro_rules! dispatch {
    ($float:ident, $array:ty, $avx2:ident, $avx512:ident, $neon:ident) => {
        #[allow(unsafe_code)]
        impl Dispatch for $float {
            // Safety: what the trait asks for.
            #[inline(always)]
            unsafe fn dispatch<J: Job<$float>>(set: InstructionSet, job: J) -> J::Output {
                // SAFETY: the caller promises what this one asks for.
                match unsafe { Self::dispatch_registers(set, job) } {
                    Ok(output) => output,
                    Err(job) => job.run::<$array>(),
                }
            }

            // Safety: what the trait asks for.
            #[inline(always)]
            unsafe fn dispatch_registers<J: Job<$float>>(
                set: InstructionSet,
                job: J,
            ) -> Result<J::Output, J> {
                #[cfg(target_arch = "x86_64")]
                #[target_feature(enable = "avx2,fma")]
                fn avx2<J: Job<$float>>(job: J) -> J::Output {
                    job.run::<super::avx2::$avx2>()
                }
                #[cfg(target_arch = "x86_64")]
                #[target_feature(enable = "avx512f,avx512dq,avx512vl,avx2,fma")]
                fn avx512<J: Job<$float>>(job: J) -> J::Output {
                    job.run::<super::avx512::$avx512>()
                }
                #[cfg(target_arch = "x86_64")]
                if J::AVX512 && set == InstructionSet::Avx512 {
                    // SAFETY: the caller promises that the machine has the set, and with it the features of the function.
                    return Ok(unsafe { avx512(job) });
                }
                match set {
                    // SAFETY: the caller promises that the machine has the set, and with it the features of the function.
                    #[cfg(target_arch = "x86_64")]
                    InstructionSet::Avx2 => Ok(unsafe { avx2(job) }),
                    // NEON is part of every aarch64 that has it at all: no function of its own is needed
                    #[cfg(all(target_arch = "aarch64", target_feature = "neon"))]
                    InstructionSet::Neon => Ok(job.run::<super::neon::$neon>()),
                    _ => Err(job),
                }
            }
        }
    };
}

dispatch!(f64, array::Array<f64, 4>, Avx2F64, Avx512F64, NeonF64);
dispatch!(f32, array::Array<f32, 8>, Avx2F32, Avx512F32, NeonF32);

//! A SIMD register as a pack: everything that one instruction does.

/// An instruction by its name, or written out over its operands; not as a closure, which would not always be inlined.
macro_rules! apply {
    ([|$a:ident| $of:expr] $x:expr) => {{
        let $a = $x;
        $of
    }};
    ([|$a:ident, $b:ident| $of:expr] $x:expr, $y:expr) => {{
        let ($a, $b) = ($x, $y);
        $of
    }};
    ([|$a:ident, $b:ident, $c:ident| $of:expr] $x:expr, $y:expr, $z:expr) => {{
        let ($a, $b, $c) = ($x, $y, $z);
        $of
    }};
    ([$instruction:expr] $($x:expr),*) => {
        $instruction($($x),*)
    };
}

/// A pack over a register type of `core::arch`, from the names of its instructions.
///
/// Every function of it is safe and executes instructions of the set `needs`; that is sound because the types are
/// private and `InstructionSet::run` alone hands them out, on a machine that it has asked for the set.
macro_rules! register {
    (
        $(#[$doc:meta])* $pack:ident: $width:literal x $element:ident in $register:ty, mask $mask:ident, needs $needs:literal,
        load $load:tt, store $store:tt, splat $splat:tt, pattern $pattern:tt,
        add $add:tt, sub $sub:tt, mul $mul:tt, div $div:tt, fused $fused:tt, sqrt $sqrt:tt,
        floor $floor:tt, lt $lt:tt, le $le:tt, eq $eq:tt, blend $blend:tt, negative $negative:tt,
        and $and:tt, or $or:tt, xor $xor:tt, plus $plus:tt, up $up:tt, down $down:tt
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub struct $pack($register);

        register!(@operators $pack, Add add $add, Sub sub $sub, Mul mul $mul, Div div $div);
        assigning!([] $pack);

        impl Neg for $pack {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                self.turned()
            }
        }

        impl Real for $pack {
            type Mask = $mask;
            const EPSILON: f64 = $element::EPSILON as f64;
            const FAINT: f64 = $element::FAINT;

            #[inline(always)]
            fn within<W: Inside>(work: W) -> W::Output {
                #[target_feature(enable = $needs)]
                fn inside<W: Inside>(work: W) -> W::Output {
                    work.go()
                }
                // SAFETY: the type exists only where its instruction set does.
                unsafe { inside(work) }
            }
            #[inline(always)]
            fn of(value: f64) -> Self {
                Self::splat(value as $element)
            }
            #[inline(always)]
            fn mul_add(self, b: Self, c: Self) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($fused self.0, b.0, c.0) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($sqrt self.0) })
            }
            #[inline(always)]
            fn floor(self) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($floor self.0) })
            }
            #[inline(always)]
            fn lt(self, other: Self) -> $mask {
                // SAFETY: the type exists only where its instruction set does.
                $mask(unsafe { apply!($lt self.0, other.0) })
            }
            #[inline(always)]
            fn le(self, other: Self) -> $mask {
                // SAFETY: the type exists only where its instruction set does.
                $mask(unsafe { apply!($le self.0, other.0) })
            }
            #[inline(always)]
            fn same(self, other: Self) -> $mask {
                // SAFETY: the type exists only where its instruction set does.
                $mask(unsafe { apply!($eq self.0, other.0) })
            }
            #[inline(always)]
            fn select(mask: $mask, yes: Self, no: Self) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($blend mask.0, yes.0, no.0) })
            }
            elementary!();
        }

        impl Pack for $pack {
            type Element = $element;
            const WIDTH: usize = $width;

            #[inline(always)]
            fn splat(number: $element) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($splat number) })
            }
            #[inline(always)]
            fn load(numbers: &[$element]) -> Self {
                let lanes: [$element; $width] = match numbers.first_chunk() {
                    Some(lanes) => *lanes,
                    None => core::array::from_fn(|i| padded(numbers)[i]),
                };
                // SAFETY: the type exists only where its instruction set does; the array has room for its lanes.
                Self(unsafe { apply!($load lanes.as_ptr().cast()) })
            }
            #[inline(always)]
            fn store(self, numbers: &mut [$element]) {
                let mut lanes = [0.0; $width];
                // SAFETY: the type exists only where its instruction set does; the array has room for its lanes.
                unsafe { apply!($store lanes.as_mut_ptr().cast(), self.0) };
                match numbers.first_chunk_mut() {
                    Some(whole) => *whole = lanes,
                    None => numbers.iter_mut().zip(lanes).for_each(|(number, lane)| *number = lane),
                }
            }
        }

        impl Lanes for $pack {
            const FUSED: bool = true;

            #[inline(always)]
            fn pattern(bits: u64) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($pattern bits) })
            }
            #[inline(always)]
            fn shifted_up(self, by: u32) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($up self.0, by) })
            }
            #[inline(always)]
            fn shifted_down(self, by: u32) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($down self.0, by) })
            }
            #[inline(always)]
            fn negative(self) -> $mask {
                // SAFETY: the type exists only where its instruction set does.
                $mask(unsafe { apply!($negative self.0) })
            }
            register!(@bits and $and, or $or, xor $xor, plus $plus);
        }
    };
    (@operators $pack:ident, $($trait:ident $method:ident $instruction:tt),*) => {
        $(impl $trait for $pack {
            type Output = Self;
            #[inline(always)]
            fn $method(self, o: Self) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($instruction self.0, o.0) })
            }
        })*
    };
    (@bits $($method:ident $instruction:tt),*) => {
        $(#[inline(always)]
        fn $method(self, o: Self) -> Self {
            // SAFETY: the type exists only where its instruction set does.
            Self(unsafe { apply!($instruction self.0, o.0) })
        })*
    };
}

/// The truth values of a pack: `of` and `bits` from and to a pattern of bits, one for each lane.
macro_rules! truths {
    ($mask:ident in $register:ty, $width:literal, and $and:tt, or $or:tt, not $not:tt, bits $bits:tt, of $of:tt) => {
        /// Truth values of as many lanes.
        #[derive(Clone, Copy)]
        #[repr(transparent)]
        pub struct $mask($register);

        impl BitAnd for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitand(self, o: Self) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($and self.0, o.0) })
            }
        }
        impl BitOr for $mask {
            type Output = Self;
            #[inline(always)]
            fn bitor(self, o: Self) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($or self.0, o.0) })
            }
        }
        impl Not for $mask {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($not self.0) })
            }
        }
        impl core::fmt::Debug for $mask {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.debug_list().entries((0..$width).map(|i| self.lane(i))).finish()
            }
        }
        impl Mask for $mask {
            #[inline(always)]
            fn splat(value: bool) -> Self {
                Self::of_bits(if value { u32::MAX } else { 0 })
            }
            #[inline(always)]
            fn all(self) -> bool {
                self.bits() == (1 << $width) - 1
            }
            #[inline(always)]
            fn any(self) -> bool {
                self.bits() != 0
            }
        }
        impl LaneMask for $mask {
            #[inline(always)]
            fn bits(self) -> u32 {
                // SAFETY: the type exists only where its instruction set does.
                unsafe { apply!($bits self.0) }
            }
            #[inline(always)]
            fn of_bits(bits: u32) -> Self {
                // SAFETY: the type exists only where its instruction set does.
                Self(unsafe { apply!($of bits) })
            }
        }
    };
}

pub(super) use {apply, register, truths};

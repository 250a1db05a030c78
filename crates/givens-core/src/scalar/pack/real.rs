//! What all packs have alike: the operators that assign, and the functions of `math` in place of the platform's.

macro_rules! assigning {
    ([$($generics:tt)*] $pack:ty) => {
        impl $($generics)* core::ops::AddAssign for $pack {
            #[inline(always)]
            fn add_assign(&mut self, o: Self) {
                *self = *self + o;
            }
        }
        impl $($generics)* core::ops::SubAssign for $pack {
            #[inline(always)]
            fn sub_assign(&mut self, o: Self) {
                *self = *self - o;
            }
        }
        impl $($generics)* core::ops::MulAssign for $pack {
            #[inline(always)]
            fn mul_assign(&mut self, o: Self) {
                *self = *self * o;
            }
        }
        impl $($generics)* core::fmt::Debug for $pack {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                let mut lanes = [<Self as Pack>::Element::of(0.0); MAX_WIDTH];
                self.store(&mut lanes);
                f.debug_list().entries(&lanes[..<Self as Pack>::WIDTH]).finish()
            }
        }
    };
}

/// The part of `impl Real` that is the same for every pack.
macro_rules! elementary {
    () => {
        #[inline(always)]
        fn first(self) -> f64 {
            math::Format::to_f64(self.lane(0))
        }
        #[inline(always)]
        fn recip(self) -> Self {
            Self::one() / self
        }
        #[inline(always)]
        fn abs(self) -> Self {
            self.unsigned()
        }
        #[inline(always)]
        fn copysign(self, sign: Self) -> Self {
            self.unsigned().signed_as(sign)
        }
        #[inline(always)]
        fn powi(self, e: i32) -> Self {
            math::powi(self, e)
        }
        #[inline(always)]
        fn sin_cos(self) -> (Self, Self) {
            math::sin_cos(self)
        }
        elementary!(exp ln log10 tan asin acos atan sinh cosh tanh erf erfc);
        elementary!(binary atan2 pow hypot);
    };
    (binary $($function:ident)*) => {
        $(#[inline(always)]
        fn $function(self, other: Self) -> Self {
            math::$function(self, other)
        })*
    };
    ($($function:ident)*) => {
        $(#[inline(always)]
        fn $function(self) -> Self {
            math::$function(self)
        })*
    };
}

pub(super) use {assigning, elementary};

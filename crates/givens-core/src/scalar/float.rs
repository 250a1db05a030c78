//! `f64` and `f32`: the platform's functions with `std`, libm's without.

use super::{Inside, NARROW, Real};

/// One elementary function of the platform, or libm's of the same name.
macro_rules! elementary {
    ($float:ident, $x:expr, $method:ident, $libm:path $(, $arg:expr)*) => {{
        #[cfg(feature = "std")]
        { $float::$method($x $(, $arg)*) }
        #[cfg(not(feature = "std"))]
        { $libm($x $(, $arg)*) }
    }};
}

macro_rules! float {
    ($float:ident, $faint:expr, $sqrt:path, $floor:path, $exp:path, $ln:path, $log10:path, $sincos:path, $tan:path,
     $asin:path, $acos:path, $atan:path, $atan2:path, $sinh:path, $cosh:path, $tanh:path, $pow:path,
     $hypot:path, $erf:path, $erfc:path) => {
        impl Real for $float {
            type Mask = bool;
            const EPSILON: f64 = $float::EPSILON as f64;
            const FAINT: f64 = $faint;

            #[inline(always)]
            fn vectorised<W: Inside>(kernel: W) -> W::Output {
                NARROW.vectorised(kernel)
            }
            #[inline(always)]
            #[allow(clippy::cast_lossless)]
            fn of(value: f64) -> $float {
                value as $float
            }
            #[inline(always)]
            #[allow(clippy::cast_lossless)]
            fn first(self) -> f64 {
                self as f64
            }
            #[inline(always)]
            fn mul_add(self, b: $float, c: $float) -> $float {
                // without the instruction, `mul_add` is a slow call into libm
                #[cfg(all(feature = "std", target_feature = "fma"))]
                {
                    $float::mul_add(self, b, c)
                }
                #[cfg(not(all(feature = "std", target_feature = "fma")))]
                {
                    self * b + c
                }
            }
            #[inline(always)]
            fn recip(self) -> $float {
                1.0 / self
            }
            #[inline(always)]
            fn sqrt(self) -> $float {
                elementary!($float, self, sqrt, $sqrt)
            }
            #[inline(always)]
            fn abs(self) -> $float {
                $float::abs(self)
            }
            #[inline(always)]
            fn copysign(self, sign: $float) -> $float {
                $float::copysign(self, sign)
            }
            #[inline(always)]
            fn floor(self) -> $float {
                elementary!($float, self, floor, $floor)
            }
            #[inline(always)]
            fn exp(self) -> $float {
                elementary!($float, self, exp, $exp)
            }
            #[inline(always)]
            fn ln(self) -> $float {
                elementary!($float, self, ln, $ln)
            }
            #[inline(always)]
            fn log10(self) -> $float {
                elementary!($float, self, log10, $log10)
            }
            #[inline(always)]
            fn sin_cos(self) -> ($float, $float) {
                elementary!($float, self, sin_cos, $sincos)
            }
            #[inline(always)]
            fn tan(self) -> $float {
                elementary!($float, self, tan, $tan)
            }
            #[inline(always)]
            fn asin(self) -> $float {
                elementary!($float, self, asin, $asin)
            }
            #[inline(always)]
            fn acos(self) -> $float {
                elementary!($float, self, acos, $acos)
            }
            #[inline(always)]
            fn atan(self) -> $float {
                elementary!($float, self, atan, $atan)
            }
            #[inline(always)]
            fn atan2(self, x: $float) -> $float {
                elementary!($float, self, atan2, $atan2, x)
            }
            #[inline(always)]
            fn sinh(self) -> $float {
                elementary!($float, self, sinh, $sinh)
            }
            #[inline(always)]
            fn cosh(self) -> $float {
                elementary!($float, self, cosh, $cosh)
            }
            #[inline(always)]
            fn tanh(self) -> $float {
                elementary!($float, self, tanh, $tanh)
            }
            // the standard library has neither yet
            #[inline(always)]
            fn erf(self) -> $float {
                $erf(self)
            }
            #[inline(always)]
            fn erfc(self) -> $float {
                $erfc(self)
            }
            #[inline(always)]
            fn pow(self, e: $float) -> $float {
                elementary!($float, self, powf, $pow, e)
            }
            #[inline(always)]
            fn powi(self, e: i32) -> $float {
                let (mut base, mut left, mut product) = (self, e.unsigned_abs(), 1.0);
                while left > 0 {
                    if left & 1 == 1 {
                        product *= base;
                    }
                    base *= base;
                    left >>= 1;
                }
                if e < 0 { 1.0 / product } else { product }
            }
            #[inline(always)]
            fn hypot(self, y: $float) -> $float {
                elementary!($float, self, hypot, $hypot, y)
            }
            #[inline(always)]
            fn lt(self, other: $float) -> bool {
                self < other
            }
            #[inline(always)]
            fn le(self, other: $float) -> bool {
                self <= other
            }
            #[inline(always)]
            fn same(self, other: $float) -> bool {
                self == other
            }
            #[inline(always)]
            fn select(mask: bool, yes: $float, no: $float) -> $float {
                if mask { yes } else { no }
            }
        }
    };
}

/// In double precision: libm's own errs by more than two units in the last place.
fn erfcf(x: f32) -> f32 {
    libm::erfc(f64::from(x)) as f32
}

float!(
    f64,
    f64::from_bits((1023 - 260) << 52),
    libm::sqrt,
    libm::floor,
    libm::exp,
    libm::log,
    libm::log10,
    libm::sincos,
    libm::tan,
    libm::asin,
    libm::acos,
    libm::atan,
    libm::atan2,
    libm::sinh,
    libm::cosh,
    libm::tanh,
    libm::pow,
    libm::hypot,
    libm::erf,
    libm::erfc
);
float!(
    f32,
    f64::from_bits((1023 - 36) << 52),
    libm::sqrtf,
    libm::floorf,
    libm::expf,
    libm::logf,
    libm::log10f,
    libm::sincosf,
    libm::tanf,
    libm::asinf,
    libm::acosf,
    libm::atanf,
    libm::atan2f,
    libm::sinhf,
    libm::coshf,
    libm::tanhf,
    libm::powf,
    libm::hypotf,
    libm::erff,
    erfcf
);

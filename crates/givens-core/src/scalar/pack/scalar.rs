//! A float is a pack of one lane.

use super::{LaneMask, Pack};

impl LaneMask for bool {
    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self)
    }
    #[inline(always)]
    fn of_bits(bits: u32) -> bool {
        bits & 1 == 1
    }
}

macro_rules! one_lane {
    ($float:ident) => {
        impl Pack for $float {
            type Element = $float;
            const WIDTH: usize = 1;

            #[inline(always)]
            fn splat(number: $float) -> $float {
                number
            }
            #[inline(always)]
            fn load(numbers: &[$float]) -> $float {
                numbers.first().copied().unwrap_or($float::NAN)
            }
            #[inline(always)]
            fn store(self, numbers: &mut [$float]) {
                if let Some(first) = numbers.first_mut() {
                    *first = self;
                }
            }
        }
    };
}

one_lane!(f64);
one_lane!(f32);

//! What the type of a continuous method brings beside its parts: its defaults and the length of its memory, as constants.

macro_rules! continuous_constants {
    ($name:ident: $rule:ident { $($field:ident = $default:expr),* },
     $time:ident { $($option:ident = $option_default:expr),* } by |$m:ident| $make:expr) => {
        impl $name {
            /// The method with its options as they are by default, as a constant.
            pub const DEFAULT: Self = Self { $($field: $default,)* $($option: $option_default,)* };

            /// The sizes of a filter, with the scratch that a model and a sensor need which override no provided method;
            /// [`process_noise`](Sizes::process_noise) of `sizes` is the number q of columns of G, which is not to depend on
            /// the state.
            ///
            /// ```
            /// # use givens_core::filter::Sizes;
            #[doc = concat!("# use givens_core::filter::", stringify!($name), ";")]
            /// // two states, one of them driven by noise, one measure
            #[doc = concat!("const METHOD: ", stringify!($name), " = ", stringify!($name), "::DEFAULT;")]
            /// const SIZES: Sizes = METHOD.sizes_for(Sizes { process_noise: 1, ..Sizes::new(2, 1) });
            /// let memory = [0.0_f64; METHOD.memory(SIZES)];
            /// # assert!(memory.len() > 20);
            /// ```
            #[must_use]
            pub const fn sizes_for(&self, sizes: Sizes) -> Sizes {
                self.time().sizes_for(sizes, self.parts().shape_for(sizes.states))
            }

            /// Scalars of memory of a filter of these sizes, which come from [`sizes_for`](Self::sizes_for) or from the model.
            #[must_use]
            pub const fn memory(&self, sizes: Sizes) -> usize {
                self.time().layout(sizes, self.parts().shape_for(sizes.states), false).len
            }

            /// Scalars of memory of a filter of these sizes whose predictions leave what a smoother needs.
            #[must_use]
            pub const fn smoothing_memory(&self, sizes: Sizes) -> usize {
                self.time().layout(sizes, self.parts().shape_for(sizes.states), true).len
            }

            const fn parts(&self) -> $rule {
                $rule { $($field: self.$field,)* }
            }

            const fn time(&self) -> $time {
                let $m = self;
                $make
            }
        }

        impl Default for $name {
            fn default() -> Self {
                Self::DEFAULT
            }
        }
    };
}

pub(super) use continuous_constants;

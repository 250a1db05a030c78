//! A model behind a pointer, word for word the model.

/// Makes the trait of what can be asked behind a pointer, which every such model is, and the model that asks it. What is known
/// of a model once for all is asked once; what else has no numbers of the filter's kind passes through by itself; the
/// functions of numbers follow.
macro_rules! behind_a_pointer {
    (
        $any:ident is a $model:ident by $calls:ident;
        known { $(fn $known:ident() -> $what:ty;)* }
        passing { $(fn $name:ident($($arg:ident: $of:ty)?) -> $answer:ty;)* }
        asking { $($functions:tt)* }
    ) => {
        #[doc = concat!("What can be asked of a [`", stringify!($model), "`] behind a pointer; every one is it.")]
        pub trait $calls: Sync {
            $(
                #[doc = concat!("See [`", stringify!($model), "::", stringify!($known), "`].")]
                fn $known(&self) -> $what;
            )*
            $(
                #[doc = concat!("See [`", stringify!($model), "::", stringify!($name), "`].")]
                fn $name(&self $(, $arg: $of)?) -> $answer;
            )*
            /// Its functions.
            fn ask(&self, question: Question);
        }

        impl<M: $model + Sync> $calls for M {
            $(
                fn $known(&self) -> $what {
                    $model::$known(self)
                }
            )*
            $(
                fn $name(&self $(, $arg: $of)?) -> $answer {
                    $model::$name(self $(, $arg)?)
                }
            )*
            fn ask(&self, question: Question) {
                answer(&Asked(self), question);
            }
        }

        #[doc = concat!("Any [`", stringify!($model), "`], behind a pointer.")]
        #[derive(Clone, Copy)]
        pub struct $any<'m> {
            model: &'m dyn $calls,
            $($known: $what,)*
        }

        impl<'m> $any<'m> {
            #[doc = concat!("This [`", stringify!($model), "`].")]
            #[must_use]
            pub fn new(model: &'m dyn $calls) -> Self {
                Self { model, $($known: model.$known(),)* }
            }
        }

        impl core::fmt::Debug for $any<'_> {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.debug_tuple(stringify!($any)).field(&self.states).finish()
            }
        }

        impl $model for $any<'_> {
            $(
                #[inline(always)]
                fn $known(&self) -> $what {
                    self.$known
                }
            )*
            $(
                fn $name(&self $(, $arg: $of)?) -> $answer {
                    self.model.$name($($arg)?)
                }
            )*
            $($functions)*
        }
    };
}

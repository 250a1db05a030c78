//! A model behind a pointer, word for word the model.

/// Makes the trait of what can be asked behind a pointer, which every such model is, and the model that asks it. What has no
/// numbers of the filter's kind passes through by itself; the functions of numbers follow.
macro_rules! behind_a_pointer {
    (
        $any:ident is a $model:ident by $calls:ident;
        passing { $(fn $name:ident($($arg:ident: $of:ty)?) -> $answer:ty;)* }
        asking { $($functions:tt)* }
    ) => {
        #[doc = concat!("What can be asked of a [`", stringify!($model), "`] behind a pointer; every one is it.")]
        pub trait $calls: Sync {
            $(
                #[doc = concat!("See [`", stringify!($model), "::", stringify!($name), "`].")]
                fn $name(&self $(, $arg: $of)?) -> $answer;
            )*
            /// Its functions.
            fn ask(&self, question: Question);
        }

        impl<M: $model + Sync> $calls for M {
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
        pub struct $any<'m>(pub &'m dyn $calls);

        impl core::fmt::Debug for $any<'_> {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.debug_tuple(stringify!($any)).field(&self.0.states()).finish()
            }
        }

        impl $model for $any<'_> {
            $(
                fn $name(&self $(, $arg: $of)?) -> $answer {
                    self.0.$name($($arg)?)
                }
            )*
            $($functions)*
        }
    };
}

//! A kernel as a function of its own for each type of numbers, compiled with the instructions that these need.
//!
//! Within a pack's instructions all that is called is inlined, or its operations become calls. A kernel is where that may end:
//! it knows its numbers only, is compiled once for all filters, and costs far more than the call.

/// Makes the function, whose body is the inlined `$body`.
macro_rules! outlined {
    ($(#[$about:meta])* $vis:vis fn $name:ident($($arg:ident: $of:ty),*) -> $answer:ty = $body:ident) => {
        $(#[$about])*
        $vis fn $name<T: Real>($($arg: $of),*) -> $answer {
            struct Call<A>(A);
            impl<T: Real> crate::scalar::Inside for Call<($($of,)*)> {
                type Output = $answer;
                #[inline(always)]
                fn go(self) -> $answer {
                    let ($($arg,)*) = self.0;
                    $body($($arg),*)
                }
            }
            T::vectorised(Call(($($arg,)*)))
        }
    };
}
pub(crate) use outlined;

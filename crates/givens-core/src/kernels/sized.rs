//! Lengths that the compiler knows.

/// Does the work with a length that is a constant wherever it is small, so that the loops over it unroll: for kernels as
/// functions of their own, which are compiled once for each such length. Without `std` they are compiled once: a program
/// for a microcontroller has one length or two, and 18 KB are much to it, more than two per cent of the time.
macro_rules! sized {
    ($n:ident => $work:expr) => {{
        #[cfg(feature = "std")]
        let done = crate::kernels::sized!(@ $n 1 2 3 4 5 6 7 8 9 => $work);
        #[cfg(not(feature = "std"))]
        let done = crate::kernels::sized!(@ $n => $work);
        done
    }};
    (@ $n:ident $($known:literal)* => $work:expr) => {
        match $n {
            $($known => {
                let $n = $known;
                $work
            })*
            _ => $work,
        }
    };
}
pub(crate) use sized;

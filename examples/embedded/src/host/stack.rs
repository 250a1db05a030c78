//! How deep a call goes into the stack: the memory below is painted, and the paint that is left shows where it ended.

use core::hint::black_box;
use core::ptr::with_exposed_provenance;

const WORDS: usize = 2048;
/// Bytes painted; a call that goes deeper is told as so many.
pub const PAINTED: usize = WORDS * size_of::<u64>();
const PAINT: u64 = 0x5bad_c0de_5bad_c0de;

/// Bytes of stack that a call takes, from the frame of this function downwards.
#[inline(never)]
pub fn depth_of<A>(call: fn(&mut A), on: &mut A) -> usize {
    let here = 0_u64;
    let top = (&raw const here).expose_provenance();
    paint();
    // not to be inlined: its frame is to lie where the paint is
    black_box(call)(on);
    black_box(&here);
    top - lowest(top)
}

/// Leaves its frame full of paint.
#[inline(never)]
fn paint() {
    black_box(&mut [PAINT; WORDS]);
}

/// The lowest word that is no longer paint.
#[inline(never)]
fn lowest(top: usize) -> usize {
    let bottom = top - PAINTED;
    // SAFETY: these words lie in the frame that `paint` had, within the thread's stack, and are aligned as `here` is; that
    // frame ended below its caller's, so that the first of them is painted.
    let is_paint = |at: &usize| unsafe { with_exposed_provenance::<u64>(*at).read_volatile() } == PAINT;
    (bottom..top).step_by(size_of::<u64>()).find(|at| !is_paint(at)).unwrap_or(top)
}

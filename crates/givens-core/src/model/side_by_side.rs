//! The points of one filter side by side in the lanes of packs: a map of one point costs nearly as much as that of four.

use super::{At, Map};
use crate::scalar::{Grain, Job, LANES, NARROW, Pack, Real, floats, floats_mut, numbers_mut, words_mut};

/// How many points a filter over `T` had better evaluate by `g` in place of `points`, so that they fill the lanes: no more
/// where they go one by one.
#[inline(always)]
pub(crate) fn filled<T: Real, G: Map>(g: &G, points: usize) -> usize {
    if lanes_of_its_own::<T>() || !g.serves_packs() { points } else { points.next_multiple_of(LANES) }
}

/// Scalars before the first one at which a pack may start.
#[inline(always)]
#[allow(clippy::modulo_one, reason = "some machines have one lane")]
pub(crate) fn misaligned<T: Real>(memory: &[T]) -> usize {
    if lanes_of_its_own::<T>() {
        return 0;
    }
    // by the address: `align_offset` need not find any
    let behind = memory.as_ptr().addr() / size_of::<f64>() % LANES;
    (LANES - behind) % LANES
}

/// Scalars that [`misaligned`] may skip, and that [`filled`] may add to a row.
pub(crate) const SLACK: usize = LANES - 1;

/// A map's scratch, if its points may go side by side: `narrow` is its own for all points, `wide` for a number of packs
/// that holds them, and `beside` the number of controls and parameters together.
pub(crate) const fn side_by_side_scratch(narrow: usize, wide: usize, beside: usize) -> usize {
    let packs = wide.saturating_add(beside).saturating_add(1).saturating_mul(LANES);
    if LANES == 1 || narrow > packs { narrow } else { packs }
}

/// The same of a map that tells its scratch.
pub(crate) fn scratch_for(scratch: impl Fn(usize) -> usize, points: usize, beside: usize) -> usize {
    side_by_side_scratch(scratch(points), scratch(points.div_ceil(LANES)), beside)
}

/// Only the points of one filter in `f64` are laid side by side.
#[inline(always)]
fn lanes_of_its_own<T: Real>() -> bool {
    !Grain::is_double::<T>()
}

/// Evaluates `g` at [`filled`] points, in packs where the machine and the memory are fit for them. `x` and `y` as in
/// [`Map::points`], to begin where a pack may.
#[inline(always)]
pub(crate) fn evaluate_side_by_side<T: Real, G: Map>(
    g: &G,
    at: &At<T>,
    points: usize,
    x: &mut [T],
    y: &mut [T],
    scratch: &mut [T],
) {
    if !lanes_of_its_own::<T>() && LANES > 1 && g.serves_packs() {
        let (u, p) = (floats(at.u), floats(at.p));
        let whole = At { t: at.t.first(), dt: at.dt.first(), u, p };
        let (x, y, scratch) = (floats_mut(x), floats_mut(y), floats_mut(scratch));
        let job = SideBySide { g, at: whole, points, x, y, scratch };
        if job.fits() && NARROW.run_in_registers(job).is_ok() {
            return;
        }
    }
    g.points(at, points, x, y, scratch);
}

struct SideBySide<'s, G> {
    g: &'s G,
    at: At<'s, f64>,
    points: usize,
    x: &'s mut [f64],
    y: &'s mut [f64],
    scratch: &'s mut [f64],
}

impl<G: Map> SideBySide<'_, G> {
    fn beside(&self) -> usize {
        self.at.u.len() + self.at.p.len()
    }

    fn fits(&self) -> bool {
        let needed = LANES * (self.g.scratch(self.points / LANES) + self.beside());
        let free = self.scratch.len().saturating_sub(misaligned(self.scratch));
        self.points.is_multiple_of(LANES)
            && misaligned(self.x) == 0
            && misaligned(self.y) == 0
            && needed <= free
    }
}

impl<G: Map> Job<f64> for SideBySide<'_, G> {
    type Output = ();
    const AVX512: bool = false;
    #[inline(always)]
    fn run<P: Pack<Element = f64>>(self) {
        let beside = self.beside();
        let Self { g, at, points, x, y, scratch } = self;
        let skip = misaligned(scratch);
        let (constants, rest) = scratch[skip..].split_at_mut(beside * P::WIDTH);
        let constants = numbers_mut::<P>(words_mut(constants));
        for (to, &of) in constants.iter_mut().zip(at.u.iter().chain(at.p)) {
            *to = P::splat(of);
        }
        let (u, p) = constants.split_at(at.u.len());
        let at = At { t: P::splat(at.t), dt: P::splat(at.dt), u, p };
        g.points(
            &at,
            points / P::WIDTH,
            numbers_mut(words_mut(x)),
            numbers_mut(words_mut(y)),
            numbers_mut(words_mut(rest)),
        );
    }
}

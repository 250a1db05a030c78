//! Between the vectors of several tracks and one vector of packs: the transposes at the boundary.

use super::{MAX_WIDTH, Pack};
use crate::scalar::Real;

/// Component i of `packs` from component i of every track, track l in lane l.
///
/// Lanes without a track repeat the last one; components that a track lacks are NaN.
///
/// ```
/// use givens_core::scalar::gather;
/// let mut x = [0.0_f64; 2];
/// gather(&[&[1.0, 2.0]], &mut x); // a pack of one lane
/// assert_eq!(x, [1.0, 2.0]);
/// ```
#[inline(always)]
pub fn gather<P: Pack>(tracks: &[&[P::Element]], packs: &mut [P]) {
    let none = P::Element::of(f64::NAN);
    for (i, pack) in packs.iter_mut().enumerate() {
        let mut lanes = [none; MAX_WIDTH];
        let mut last = none;
        for (l, lane) in lanes[..P::WIDTH].iter_mut().enumerate() {
            if let Some(track) = tracks.get(l) {
                last = track.get(i).copied().unwrap_or(none);
            }
            *lane = last;
        }
        *pack = P::load(&lanes[..P::WIDTH]);
    }
}

/// Component i of track l from lane l of component i of `packs`, where both have it.
#[inline(always)]
pub fn scatter<P: Pack>(packs: &[P], tracks: &mut [&mut [P::Element]]) {
    for (i, pack) in packs.iter().enumerate() {
        let mut lanes = [P::Element::of(0.0); MAX_WIDTH];
        pack.store(&mut lanes);
        for (track, &number) in tracks.iter_mut().zip(&lanes[..P::WIDTH]) {
            if let Some(component) = track.get_mut(i) {
                *component = number;
            }
        }
    }
}

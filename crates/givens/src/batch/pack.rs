//! Which tracks go together: this depends on the tracks alone, never on the threads.

use super::Track;
use crate::filter::predict::TimeUpdate;
use crate::filter::{Form, Over};
use crate::run::Goal;

/// Work that one thread does in one piece: the tracks of a pack, or one.
#[derive(Debug)]
pub(super) struct Unit {
    /// Their numbers, the longest first.
    pub tracks: Vec<usize>,
}

/// Whether a method may run in packs.
pub(super) fn packable<X: Over<M>, M>(method: &X, goal: Goal) -> bool {
    let time = method.time_update();
    match goal {
        Goal::Filter => time.lockstep(false),
        Goal::Interval => X::Form::SQUARE_ROOT && time.lockstep(true),
        Goal::Lag(_) | Goal::Point(_) => false,
    }
}

/// The tracks in packs of up to `width` that have their model and sensors in common, the longest first: so those of a pack
/// are of nearly one length, and none of the longest is left to one thread at the end.
pub(super) fn units<M, H>(tracks: &[Track<M, H>], width: usize) -> Vec<Unit> {
    let mut order: Vec<usize> = (0..tracks.len()).collect();
    order.sort_by_key(|&k| core::cmp::Reverse(tracks[k].data.len()));
    let mut units: Vec<Unit> = Vec::new();
    // the pack of each model and its sensors that still has room
    let mut open: Vec<((*const M, *const H), usize)> = Vec::new();
    for k in order {
        let track = &tracks[k];
        if width > 1 && track.at.is_empty() {
            let owner = (core::ptr::from_ref(track.model), core::ptr::from_ref(track.sensors));
            let found = open.iter().position(|(other, _)| *other == owner);
            if let Some(unit) = found.map(|i| open[i].1).filter(|&unit| units[unit].tracks.len() < width) {
                units[unit].tracks.push(k);
                continue;
            }
            match found {
                Some(i) => open[i].1 = units.len(),
                None => open.push((owner, units.len())),
            }
        }
        units.push(Unit { tracks: vec![k] });
    }
    units
}

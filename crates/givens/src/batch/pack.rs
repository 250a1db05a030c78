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
    let (hollow, mut units): (Vec<_>, Vec<_>) =
        units.into_iter().partition(|unit| is_hollow(unit, tracks, width));
    units.extend(hollow.into_iter().flat_map(|unit| unit.tracks).map(|k| Unit { tracks: vec![k] }));
    units.sort_by_key(|unit| core::cmp::Reverse(tracks[unit.tracks[0]].data.len()));
    units
}

/// Rows of all lanes together from which a pack's memory counts.
const MANY: usize = 1 << 16;

/// Whether less than a third of the rows that a pack's lanes have room for would be used: a long track and a short one, or two
/// long ones where there are eight lanes. Alone they take as little time, and far less memory.
fn is_hollow<M, H>(unit: &Unit, tracks: &[Track<M, H>], width: usize) -> bool {
    let rows = |&k: &usize| tracks[k].data.len();
    let room = width * unit.tracks.first().map_or(0, rows);
    unit.tracks.len() > 1 && room > MANY && room > 3 * unit.tracks.iter().map(rows).sum::<usize>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Data;
    use crate::filter::Gaussian;

    fn sizes(lengths: &[usize], width: usize) -> Vec<Vec<usize>> {
        let data: Vec<Data> = lengths
            .iter()
            .map(|&rows| {
                let mut data = Data::new(0).starting_at(0.0);
                (0..rows).for_each(|k| data.push(k as f64, &[]).unwrap());
                data
            })
            .collect();
        let prior = Gaussian::from_std(&[0.0], &[1.0]).unwrap();
        let tracks: Vec<Track<(), ()>> = data.iter().map(|data| Track::new(&(), &(), data, &prior)).collect();
        units(&tracks, width).iter().map(|unit| unit.tracks.iter().map(|&k| lengths[k]).collect()).collect()
    }

    #[test]
    fn packs_are_of_nearly_one_length_and_never_mostly_empty() {
        assert_eq!(sizes(&[3, 9, 8, 1, 7], 2), [vec![9, 8], vec![7, 3], vec![1]]);
        assert_eq!(sizes(&[20_000, 1], 4), [vec![20_000], vec![1]]);
        assert_eq!(sizes(&[9_000, 9_000], 8), [vec![9_000], vec![9_000]]);
        assert_eq!(sizes(&[9_000, 9_000, 9_000], 8), [vec![9_000; 3]]);
        assert_eq!(sizes(&[50, 1], 8), [vec![50, 1]]);
    }
}

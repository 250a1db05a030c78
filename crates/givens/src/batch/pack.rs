//! Which tracks go together: this depends on the tracks alone, never on the threads.

use super::Track;
use crate::Data;
use crate::filter::predict::TimeUpdate;
use crate::filter::{Form, Over};
use crate::run::Goal;

/// Work that one thread does in one piece: the tracks of a pack, or one.
#[derive(Debug)]
pub(super) struct Unit {
    /// Their numbers, the longest first.
    pub tracks: Vec<usize>,
    /// Of a pack, whether every measurement of its tracks has all of its components; none for a track that goes alone.
    pub whole: Option<bool>,
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

/// The most rows, times n², of a track that goes in a pack. What a smoother remembers of a pack is that of all lanes, also where it
/// holds one track; and of two long tracks each keeps a thread busy.
const MOST: usize = 1 << 20;

/// The tracks in packs of up to `width` that have their model and sensors in common, the longest first: so those of a pack
/// are of nearly one length, and none of the longest is left to one thread at the end. Whether a track goes in a pack, and of
/// which kind, depends on itself alone.
pub(super) fn units<M, H>(tracks: &[Track<M, H>], width: usize) -> Vec<Unit> {
    let mut order: Vec<usize> = (0..tracks.len()).collect();
    order.sort_by_key(|&k| core::cmp::Reverse(tracks[k].data.len()));
    let mut units: Vec<Unit> = Vec::new();
    // the pack of each model and its sensors, and of each kind, that still has room
    let mut open: Vec<((*const M, *const H, bool), usize)> = Vec::new();
    for k in order {
        let track = &tracks[k];
        let covariances = track.data.len().saturating_mul(track.prior.mean().len().pow(2));
        if width < 2 || !track.at.is_empty() || covariances > MOST {
            units.push(Unit { tracks: vec![k], whole: None });
            continue;
        }
        let whole = is_whole(track.data);
        let kind = (core::ptr::from_ref(track.model), core::ptr::from_ref(track.sensors), whole);
        let found = open.iter().position(|(other, _)| *other == kind);
        if let Some(unit) = found.map(|i| open[i].1).filter(|&unit| units[unit].tracks.len() < width) {
            units[unit].tracks.push(k);
            continue;
        }
        match found {
            Some(i) => open[i].1 = units.len(),
            None => open.push((kind, units.len())),
        }
        units.push(Unit { tracks: vec![k], whole: Some(whole) });
    }
    units
}

/// Whether each of its rows has all components of a measurement, or none.
fn is_whole(data: &Data) -> bool {
    data.rows().all(|row| row.z.iter().all(|z| z.is_nan() == row.z[0].is_nan()))
}

#[cfg(test)]
mod tests {
    use super::*;
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
    fn packs_are_of_nearly_one_length() {
        assert_eq!(sizes(&[3, 9, 8, 1, 7], 2), [vec![9, 8], vec![7, 3], vec![1]]);
        assert_eq!(sizes(&[20_000, 1], 4), [vec![20_000, 1]]);
        assert_eq!(sizes(&[1_100_000, 2, 1_200_000], 8), [vec![1_200_000], vec![1_100_000], vec![2]]);
    }
}

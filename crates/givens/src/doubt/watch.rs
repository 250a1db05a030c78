//! Which gaps are looked at.

/// So many tracks have their first gap looked at.
const TRACKS: usize = 64;
/// What is so many times the most so far is looked at: the length of a gap, and what a prediction does.
const MORE: [f64; 3] = [1.5, 2.0, 2.0];

/// The gaps so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Watch {
    gaps: usize,
    /// Tracks that began, and the last of them.
    tracks: (usize, Option<usize>),
    /// The longest gap that was looked at, and the most that a prediction did in one.
    most: [f64; 3],
}

impl Watch {
    /// Notes a gap of a track, and what the prediction over it has done; whether it is looked at.
    pub fn notes(&mut self, track: usize, length: f64, [wider, moved]: [f64; 2]) -> bool {
        if length <= 0.0 {
            return false;
        }
        self.gaps += 1;
        let begins = self.tracks.1.replace(track) != Some(track);
        self.tracks.0 += usize::from(begins);
        let mut more = false;
        for ((most, found), times) in self.most.iter_mut().zip([length, wider, moved]).zip(MORE) {
            if found > times * *most {
                *most = found;
                more = true;
            }
        }
        more || self.gaps.is_power_of_two() || (begins && self.tracks.0 <= TRACKS)
    }
}

//! The true states beside the data: which of their rows are of which row of the data.

use crate::columns::{ignored, source_name};
use crate::message::Stop;
use givens_io::{Model, Tracks, read_truth};
use std::io;

/// A truth that knows at least one row of the data.
pub struct Truth {
    /// For each state of the model its values, if the truth has it.
    pub states: Vec<Option<Vec<f64>>>,
    times: Vec<f64>,
    /// The rows of the truth that are of each track, in order of time.
    pub rows: Vec<Vec<usize>>,
    /// Tells its text from others.
    pub fingerprint: String,
}

impl Truth {
    /// Reads the truth of some tracks.
    pub fn read(path: &str, model: &Model, tracks: &Tracks) -> Result<Self, Stop> {
        let found = read_truth(path, model, tracks)?;
        let states = model.states.iter().zip(&found.states);
        let absent = states.filter(|(_, column)| column.is_none()).map(|(name, _)| name.as_str());
        ignored(path, &found.ignored, &absent.collect::<Vec<_>>());
        let mut rows = vec![Vec::new(); tracks.tracks.len()];
        for (row, &track) in found.tracks.iter().enumerate() {
            rows[track].push(row);
        }
        let truth = Self { states: found.states, times: found.times, rows, fingerprint: found.fingerprint };
        for (i, track) in tracks.tracks.iter().enumerate() {
            for t in track.rows.iter().map(|row| Ok(row?.time)).chain([Ok(track.start)]) {
                if truth.row(i, t.map_err(|error: io::Error| Stop::from(error))?).is_some() {
                    return Ok(truth);
                }
            }
        }
        Err(truth.apart(path, tracks))
    }

    /// The row of the truth at time `t` of track `i`.
    pub fn row(&self, i: usize, t: f64) -> Option<usize> {
        let rows = &self.rows[i];
        let near = rows.partition_point(|&k| self.times[k] < t - close(t));
        rows.get(near).copied().filter(|&k| (self.times[k] - t).abs() <= close(t))
    }

    /// The refusal of a truth that has no time in common with the data.
    fn apart(&self, path: &str, tracks: &Tracks) -> Stop {
        let message = format!("{}: no time of the truth is that of a row of the data", source_name(path));
        let both = tracks.tracks.iter().zip(&self.rows).find(|(_, rows)| !rows.is_empty());
        let spans = both.and_then(|(track, rows)| {
            let text = |row: &usize| track.time_text(self.times[*row]);
            let (first, last) = (track.rows.first()?, track.rows.last()?);
            let of = track.id.as_ref().map_or(String::new(), |id| format!(" of track {id}"));
            Some(format!(
                "the truth{of} goes from {} to {}, the data from {} to {}",
                text(rows.first()?),
                text(rows.last()?),
                track.time_text(first.time),
                track.time_text(last.time)
            ))
        });
        let stop = Stop::input(message);
        match spans {
            Some(spans) => stop.help(spans),
            None => stop,
        }
    }
}

/// Times that differ by rounding only are the same.
fn close(t: f64) -> f64 {
    1e-9 * t.abs().max(1.0)
}

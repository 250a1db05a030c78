//! Answers as CSV.

use core::fmt::Write as _;
use std::io;

use givens::scalar::Shown;

use super::{Line, told};
use crate::table::Tracks;

/// The header.
pub(super) fn header(tracks: &Tracks, gated: bool) -> io::Result<Vec<u8>> {
    let mut header = vec!["time".to_owned()];
    header.extend(tracks.has_track_id.then(|| "track_id".to_owned()));
    header.extend(tracks.has_sensor.then(|| "sensor".to_owned()));
    header.extend(tracks.scheme.states.iter().cloned());
    header.extend(tracks.scheme.states.iter().map(|name| format!("{name}_std")));
    header.extend(["nis", "nis_dof", "log_likelihood"].map(str::to_owned));
    header.extend(gated.then(|| "gated".to_owned()));
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(&header).map_err(told)?;
    table.into_inner().map_err(csv::IntoInnerError::into_error)
}

/// The rows of these lines.
pub(super) fn rows(tracks: &Tracks, gated: bool, lines: &[Line]) -> io::Result<Vec<u8>> {
    let mut rows = Rows { table: csv::Writer::from_writer(Vec::new()), digits: String::new() };
    let n = tracks.scheme.states.len();
    for line in lines {
        rows.text(&line.row.time_text)?;
        if tracks.has_track_id {
            rows.text(line.track.unwrap_or_default())?;
        }
        if tracks.has_sensor {
            rows.text(line.sensor.unwrap_or_default())?;
        }
        match line.estimate {
            Some((est, k)) => {
                est.mean(k).iter().try_for_each(|&x| rows.number(x))?;
                (0..n).try_for_each(|i| rows.number(est.std(k, i)))?;
                match est.nis[k] {
                    nis if nis.is_nan() => rows.text("")?,
                    nis => rows.number(nis)?,
                }
                if line.started {
                    rows.text("")?;
                    rows.text("")?;
                } else {
                    rows.number(est.nis_dof[k] as f64)?;
                    rows.number(est.log_likelihood[k])?;
                }
            }
            None => (0..2 * n + 3).try_for_each(|_| rows.text(""))?,
        }
        if gated {
            let of = line.estimate.filter(|_| !line.started).map(|(est, k)| est.gated[k]);
            rows.text(of.map_or("", |gated| if gated { "1" } else { "0" }))?;
        }
        rows.end()?;
    }
    rows.table.into_inner().map_err(csv::IntoInnerError::into_error)
}

/// A table in the making, cell by cell.
struct Rows {
    table: csv::Writer<Vec<u8>>,
    /// Of one number: its memory is used again.
    digits: String,
}

impl Rows {
    fn text(&mut self, text: &str) -> io::Result<()> {
        self.table.write_field(text).map_err(told)
    }

    /// A number that reads back exactly.
    fn number(&mut self, x: f64) -> io::Result<()> {
        self.digits.clear();
        // writing to a string cannot fail
        let _ = write!(self.digits, "{}", Shown(x));
        self.table.write_field(&self.digits).map_err(told)
    }

    fn end(&mut self) -> io::Result<()> {
        self.table.write_record(None::<&[u8]>).map_err(told)
    }
}

//! Answers as CSV.

use std::io::{self, Write};

use super::{Line, digits, told};
use crate::model_file::Model;
use crate::table::Tracks;

pub(super) fn write(out: &mut dyn Write, model: &Model, tracks: &Tracks, lines: &[Line]) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let mut header = vec!["time".to_owned()];
    header.extend(tracks.has_track_id.then(|| "track_id".to_owned()));
    header.extend(tracks.has_sensor.then(|| "sensor".to_owned()));
    header.extend(model.states.iter().cloned());
    header.extend(model.states.iter().map(|name| format!("{name}_std")));
    header.extend(["nis", "nis_dof", "log_likelihood"].map(str::to_owned));
    table.write_record(&header).map_err(told)?;
    let n = model.states.len();
    let mut cells: Vec<String> = Vec::with_capacity(header.len());
    for line in lines {
        cells.clear();
        cells.push(line.row.time_text.clone());
        cells.extend(tracks.has_track_id.then(|| line.track.unwrap_or_default().to_owned()));
        cells.extend(tracks.has_sensor.then(|| line.sensor.unwrap_or_default().to_owned()));
        match line.estimate {
            Some((est, k)) => {
                cells.extend(est.mean(k).iter().map(|&x| digits(x)));
                cells.extend((0..n).map(|i| digits(est.std(k, i))));
                let measured = !line.started;
                let nis = est.nis[k];
                cells.push(if nis.is_nan() { String::new() } else { digits(nis) });
                cells.push(if measured { est.nis_dof[k].to_string() } else { String::new() });
                cells.push(if measured { digits(est.log_likelihood[k]) } else { String::new() });
            }
            None => cells.resize(header.len(), String::new()),
        }
        table.write_record(&cells).map_err(told)?;
    }
    table.flush()
}

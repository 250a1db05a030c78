//! The times of `--at`, and the answers there as a table.

use crate::message::Stop;
use crate::plan::Plan;
use givens::scalar::Shown;
use givens_io::{Beginning, Row, Rows, Track, Tracks};

/// The times asked for, of each track in increasing order, with their texts.
pub struct Instants(Vec<Vec<(f64, String)>>);

/// More times than this are a mistake.
const MOST: f64 = 1e7;

impl Instants {
    /// Reads `T,…` or `every:DT` on the axis of each track.
    pub fn read(text: &str, plan: &Plan) -> Result<Self, Stop> {
        let tracks = plan.tracks.tracks.iter().zip(&plan.beginnings);
        let times = tracks.enumerate().map(|(i, (track, begin))| {
            if plan.unbegun.contains_key(&i) {
                return Ok(Vec::new());
            }
            let mut times = match text.strip_prefix("every:") {
                Some(step) => every(text, step, track, begin)?,
                None => listed(text, track)?,
            };
            times.sort_by(|a, b| a.0.total_cmp(&b.0));
            times.dedup_by(|a, b| a.0 == b.0);
            check(text, &times, plan, track, begin)?;
            named(&mut times, track)?;
            Ok(times)
        });
        times.collect::<Result<_, Stop>>().map(Self)
    }

    /// The times of track `i`.
    pub fn of(&self, i: usize) -> Vec<f64> {
        self.0[i].iter().map(|(time, _)| *time).collect()
    }

    /// Tracks whose rows are these times.
    pub fn tracks(&self, plan: &Plan) -> Tracks {
        let (d, controls) = (plan.model.measures(), plan.model.controls.len());
        let mut index = 0;
        let tracks = plan.tracks.tracks.iter().zip(&self.0).map(|(track, times)| {
            let rows = times.iter().map(|(time, text)| {
                index += 1;
                let (z, u) = (vec![f64::NAN; d], vec![0.0; controls]);
                Row { line: 0, index, time: *time, time_text: text.clone(), sensor: None, z, u }
            });
            let rows = Rows::from(rows.collect::<Vec<_>>());
            Track { id: track.id.clone(), start: track.start, rows, origin: track.origin }
        });
        let tracks = tracks.collect();
        Tracks {
            scheme: plan.tracks.scheme.clone(),
            tracks,
            refused: Vec::new(),
            ignored: Vec::new(),
            has_track_id: plan.tracks.has_track_id,
            ids: plan.tracks.ids,
            dated: plan.tracks.dated,
            has_sensor: false,
            ranges: Vec::new(),
            fingerprint: String::new(),
        }
    }
}

/// Times that are those of rows have their texts. Both stand in order.
fn named(times: &mut [(f64, String)], track: &Track) -> Result<(), Stop> {
    let mut rest = times;
    for row in track.rows.iter() {
        let row = row?;
        let passed = rest.partition_point(|(time, _)| *time < row.time);
        rest = &mut rest[passed..];
        match rest.first_mut() {
            Some((time, text)) if *time == row.time => text.clone_from(&row.time_text),
            Some(_) => {}
            None => break,
        }
    }
    Ok(())
}

fn listed(text: &str, track: &Track) -> Result<Vec<(f64, String)>, Stop> {
    let time = |text: &str| match track.parse_time(text) {
        Ok(time) => Ok((time, text.trim().to_owned())),
        Err(error) => Err(Stop::input(format!("--at: {error}"))
            .help("write times with commas between them (1,2.5,3), or every:DT")),
    };
    text.split(',').map(time).collect()
}

fn every(text: &str, step: &str, track: &Track, begin: &Beginning) -> Result<Vec<(f64, String)>, Stop> {
    let wrong = |why: &str| Stop::input(format!("--at {text}: {why}"));
    let step: f64 = step.trim().parse().map_err(|_| wrong("DT is no number of seconds").help("every:0.5"))?;
    if !(step > 0.0 && step.is_finite()) {
        return Err(wrong("DT must be above 0"));
    }
    let end = track.rows.last().map_or(begin.time, |row| row.time);
    // a span that is a whole number of steps, but for rounding, has its last time too
    let count = (end - begin.time) / step * (1.0 + 1e-12);
    if count > MOST {
        return Err(wrong(&format!("these are {} times", Shown(count.floor()))).help("take a longer DT"));
    }
    let times = (0..=count as usize).map(|k| (begin.time + k as f64 * step).min(end));
    Ok(times.map(|time| (time, track.time_text(time))).collect())
}

/// No time before the belief holds, and only whole steps of a model that has a step.
fn check(
    text: &str,
    times: &[(f64, String)],
    plan: &Plan,
    track: &Track,
    begin: &Beginning,
) -> Result<(), Stop> {
    let of = track.id.as_ref().map_or(String::new(), |id| format!(" of track {id}"));
    for (time, word) in times {
        if *time < begin.time {
            let start = track.time_text(begin.time);
            return Err(Stop::input(format!(
                "--at {word}: before the initial belief{of}, which holds at {start}"
            )));
        }
        let Some(step) = plan.model.step() else { continue };
        let steps = (time - begin.time) / step;
        if (steps - steps.round()).abs() > 1e-6 {
            let message = format!(
                "--at {text}: {word} is {} steps of {step} after the initial belief{of}, not a whole number",
                Shown(steps)
            );
            return Err(Stop::input(message).help("the model moves by whole steps ([dynamics] step)"));
        }
    }
    Ok(())
}

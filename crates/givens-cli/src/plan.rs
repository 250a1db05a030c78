//! From what the user typed to a checked plan: every input is read and judged before anything runs.

use crate::args::{FilterArgs, ModelArgs};
use crate::columns::{ignored, source_name};
use crate::message::{Stop, say};
use crate::method::{chosen, pair};
use crate::truth::Truth;
use core::f64::consts::TAU;
use givens::Goal;
use givens::metrics::Truth as States;
use givens::registry::Choice;
use givens::scalar::Shown;
use givens_io::{Beginning, Model, Track, Tracks, read_tracks};
use std::collections::BTreeMap;

/// Everything that a run over data needs, read and checked.
pub struct Plan {
    pub model: Model,
    pub data: String,
    pub tracks: Tracks,
    /// Where each track begins; of those that do not, behind their last row.
    pub beginnings: Vec<Beginning>,
    /// Why tracks cannot begin, in words.
    pub unbegun: BTreeMap<usize, String>,
    pub choice: Choice,
    pub truth: Option<Truth>,
}

impl Plan {
    pub fn new(args: &FilterArgs) -> Result<Self, Stop> {
        let model = model(&args.model)?;
        let choice = chosen(&model, &args.method)?;
        Self::with(model, choice, &args.data, args.truth.as_deref())
    }

    pub fn with(model: Model, choice: Choice, data: &str, truth: Option<&str>) -> Result<Self, Stop> {
        let tracks = read_tracks(data, &model)?;
        ignored(data, &tracks.ignored, &absent(&model, &tracks));
        let data = source_name(data);
        degrees(data, &model, &tracks);
        let (beginnings, unbegun) = begun(&model, data, &tracks)?;
        let truth = truth.map(|path| Truth::read(path, &model, &tracks)).transpose()?;
        Ok(Self { model, data: data.to_owned(), tracks, beginnings, unbegun, choice, truth })
    }

    /// The truth that estimates of track `i` at these times are of, NaN where there is none.
    pub fn truth_at(&self, i: usize, goal: Goal, times: impl Iterator<Item = f64>) -> Option<States> {
        let truth = self.truth.as_ref()?;
        let mut states = Vec::new();
        for t in times {
            // a fixed point is of one time, whatever the row
            let t = if let Goal::Point(t) = goal { t } else { t };
            let row = truth.row(i, t);
            let of = |column: &Vec<f64>| row.map_or(f64::NAN, |k| column[k]);
            states.extend(truth.states.iter().map(|column| column.as_ref().map_or(f64::NAN, of)));
        }
        Some(States { states })
    }

    /// The time at which `--point` stands on the axis of each track.
    pub fn points(&self, text: &str) -> Result<Vec<Goal>, Stop> {
        let point = |(i, (track, begin)): (usize, (&Track, &Beginning))| {
            if self.unbegun.contains_key(&i) {
                return Ok(Goal::Point(begin.time));
            }
            let t = track.parse_time(text).map_err(|error| Stop::input(format!("--point: {error}")))?;
            let at = track.rows.before(t)?.max(begin.row);
            let beside = track.rows.read(at.saturating_sub(1).max(begin.row)..at + 1)?;
            if t == begin.time || beside.iter().any(|row| row.time == t) {
                return Ok(Goal::Point(t));
            }
            let near = beside.iter().min_by(|a, b| (a.time - t).abs().total_cmp(&(b.time - t).abs()));
            let name = track.id.as_ref().map_or(String::new(), |id| format!(" of track {id}"));
            let stop = Stop::input(format!(
                "--point {text}: neither a row{name} nor the initial belief stands at this time"
            ));
            Err(match near {
                Some(row) => {
                    let help = "a row without measures, added there, makes it one";
                    stop.help(format!("the nearest row is at {}; {help}", row.time_text))
                }
                None => stop,
            })
        };
        let goals = self.tracks.tracks.iter().zip(&self.beginnings).enumerate().map(point);
        let goals = goals.collect::<Result<Vec<_>, _>>()?;
        let known = |(i, goal): (usize, &Goal)| match (&self.truth, goal) {
            _ if self.unbegun.contains_key(&i) => false,
            (Some(truth), Goal::Point(t)) => truth.row(i, *t).is_some(),
            _ => true,
        };
        if !goals.iter().enumerate().any(known) {
            return Err(Stop::input(format!("--point {text}: the truth has no row at this time"))
                .help("leave --truth out, or add the row to it"));
        }
        Ok(goals)
    }
}

/// Where each track begins, and why some do not; an error if none does.
fn begun(
    model: &Model,
    data: &str,
    tracks: &Tracks,
) -> Result<(Vec<Beginning>, BTreeMap<usize, String>), Stop> {
    let mut begun = None;
    let mut unbegun = BTreeMap::new();
    let beginnings: Vec<_> = tracks.tracks.iter().map(|track| model.begin(track)).collect();
    for (i, (track, beginning)) in tracks.tracks.iter().zip(&beginnings).enumerate() {
        match beginning {
            Ok(beginning) => begun = begun.or(Some(beginning.clone())),
            Err(error) => {
                let line = error.line.map_or(String::new(), |line| format!("{line}:"));
                let name = track.id.as_ref().map_or(String::new(), |id| format!("track {id}: "));
                let message = format!("{data}:{line} {name}{}\n  help: {}", error.message, error.help);
                unbegun.insert(i, message);
            }
        }
    }
    let Some(begun) = begun else {
        return Err(unbegun.into_values().next().map_or_else(|| Stop::input("no track"), Stop::input));
    };
    let never = |track: &Track| {
        let time = track.rows.last().map_or(track.start, |row| row.time);
        Beginning { time, row: track.rows.len(), started: false, ..begun.clone() }
    };
    let beginnings = tracks.tracks.iter().zip(beginnings);
    Ok((beginnings.map(|(track, begun)| begun.unwrap_or_else(|_| never(track))).collect(), unbegun))
}

/// Columns that a table could have and has not.
pub fn absent<'m>(model: &'m Model, tracks: &Tracks) -> Vec<&'m str> {
    let empty = |i: usize| tracks.ranges.get(i).is_none_or(Option::is_none);
    let measures = model.sensors.iter().flat_map(|sensor| &sensor.columns).enumerate();
    let mut names: Vec<&str> = measures.filter(|(i, _)| empty(*i)).map(|(_, name)| name.as_str()).collect();
    names.extend((!tracks.has_sensor).then_some("sensor"));
    names.extend((!tracks.has_track_id).then_some("track_id"));
    names
}

/// A note on angles of period 2π with values that look like degrees.
fn degrees(file: &str, model: &Model, tracks: &Tracks) {
    for sensor in &model.sensors {
        for ((name, period), i) in sensor.columns.iter().zip(&sensor.angles).zip(sensor.measures.clone()) {
            let range = tracks.ranges.get(i).copied().flatten().unwrap_or([0.0; 2]);
            let beyond = range.into_iter().find(|z| z.abs() > TAU + 0.1);
            if let (Some(z), true) = (beyond, *period == Some(TAU)) {
                say(&format!(
                    "{file}: `{name}` has values such as {}, beyond 2π\n  help: if it is in degrees, write angles = {{ {name} = \
                     360 }} in [[sensor]]",
                    Shown(z)
                ));
            }
        }
    }
}

/// Reads the model file with the parameters of the command line.
pub fn model(args: &ModelArgs) -> Result<Model, Stop> {
    let mut params = Vec::new();
    for text in &args.params {
        let (name, value) = pair("--param", text)?;
        let number = value.parse().ok().filter(|value: &f64| value.is_finite());
        let Some(number) = number else {
            return Err(Stop::input(format!("--param {text}: `{value}` is not a finite number")));
        };
        params.push((name, number));
    }
    Ok(Model::read_with(&args.model, &params)?)
}

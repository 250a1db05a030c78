//! The figure of a run.

use crate::message::Stop;
use crate::plan::Plan;
use crate::thin::{ALL, Counts};
use givens::metrics::chi_squared_band;
use givens::{Estimates, Goal};
use givens_io::figure::{NisSeries, PlaneTrack, StateSeries, Track, TrackFigure, png, svg};
use std::collections::HashMap;
use std::io;
use std::path::Path;

/// Only these endings are drawn; told before anything runs.
pub fn check(path: &Path) -> Result<(), Stop> {
    match ending(path).as_str() {
        "svg" | "png" => Ok(()),
        _ => Err(Stop::input(format!("--plot {}: the name must end in .svg or .png", path.display()))),
    }
}

fn ending(path: &Path) -> String {
    path.extension().map_or(String::new(), |ending| ending.to_string_lossy().to_lowercase())
}

/// What of a track is drawn.
pub struct Shown<'e> {
    pub goal: Goal,
    /// The rows, or of a long run some of them.
    pub rows: &'e Estimates,
    /// The states at the times of `--at`.
    pub at: Option<&'e Estimates>,
    /// What was counted of all rows, where only some are drawn.
    pub counts: Option<&'e Counts>,
}

/// Draws the run: the bytes of the file `path`, SVG or PNG by its ending.
pub fn draw(path: &Path, plan: &Plan, shown: &[Shown]) -> Result<Vec<u8>, Stop> {
    let model = &plan.model;
    let plane = model.plane;
    let name = |i: usize| model.states[i].clone();
    let smoothed = shown.iter().any(|shown| shown.rows.is_smoothed());
    let what = if smoothed { "smoothed" } else { "filtered" };
    let tracks = shown.iter().enumerate().map(|(i, shown)| track(plan, shown, i));
    let tracks = tracks.collect::<Result<Vec<_>, Stop>>()?;
    let figure = TrackFigure {
        title: format!("{} — {what} by {}", stem(&model.file), plan.choice.title()),
        plane_labels: plane.map_or_else(Default::default, |[x, y]| [name(x), name(y)]),
        tracks,
        smoothed,
        ..TrackFigure::default()
    };
    let figure = figure.figure();
    match ending(path).as_str() {
        "png" => png(&figure).map_err(|error| Stop::failed(format!("--plot: {error}"))),
        _ => Ok(svg(&figure).into_bytes()),
    }
}

fn stem(file: &str) -> &str {
    Path::new(file).file_stem().and_then(|stem| stem.to_str()).unwrap_or(file)
}

fn track(plan: &Plan, shown: &Shown, i: usize) -> Result<Track, Stop> {
    let est = shown.rows;
    let drawn = in_order(est, shown.at);
    let n = est.states();
    let truth = plan.truth_at(i, shown.goal, drawn.iter().map(|(est, row)| est.time[*row]));
    let states = (0..n).map(|state| StateSeries {
        name: plan.model.states[state].clone(),
        time: drawn.iter().map(|(est, row)| est.time[*row]).collect(),
        mean: drawn.iter().map(|(est, row)| est.mean(*row)[state]).collect(),
        std: drawn.iter().map(|(est, row)| est.std(*row, state)).collect(),
        filtered: est
            .is_smoothed()
            .then(|| drawn.iter().map(|(est, row)| est.filtered_mean(*row)[state]).collect()),
        // a state that the truth does not know has no error to draw
        truth: truth
            .as_ref()
            .map(|truth| truth.states.iter().skip(state).step_by(n).copied().collect::<Vec<_>>())
            .filter(|x| x.iter().any(|x| !x.is_nan())),
        inside: shown.counts.map(|counts| counts.states[state]),
    });
    let measurements = measured(plan, i)?;
    let plane = plan.model.plane.map(|[x, y]| {
        let pair = |of: &[f64]| [of[x], of[y]];
        PlaneTrack {
            estimate: drawn.iter().map(|(est, row)| pair(est.mean(*row))).collect(),
            covariance: drawn
                .iter()
                .map(|(est, row)| est.cov(*row))
                .map(|p| [p[x * n + x], p[x * n + y], p[y * n + y]])
                .collect(),
            filtered: est
                .is_smoothed()
                .then(|| drawn.iter().map(|(est, row)| pair(est.filtered_mean(*row))).collect()),
            measurements,
            truth: true_way(plan, i, x, y),
        }
    });
    let name = plan.tracks.tracks[i].id.clone().unwrap_or_default();
    Ok(Track { name, plane, states: states.collect(), nis: Some(nis(shown)) })
}

/// Where measurements of a track lie in the plane; of a long one, those of rows at equal distances.
fn measured(plan: &Plan, i: usize) -> io::Result<Vec<[f64; 2]>> {
    let rows = &plan.tracks.tracks[i].rows;
    if plan.model.plane.is_none() {
        return Ok(Vec::new());
    }
    let drawn = rows.iter().step_by(rows.len().div_ceil(ALL).max(1));
    drawn.filter_map(|row| row.map(|row| plan.model.place(&row)).transpose()).collect()
}

/// The rows, and the times of `--at` that are none of theirs, in order of time: estimates and which of them.
fn in_order<'e>(rows: &'e Estimates, at: Option<&'e Estimates>) -> Vec<(&'e Estimates, usize)> {
    let mut drawn: Vec<_> = (0..rows.len()).map(|row| (rows, row)).collect();
    if let Some(at) = at {
        let own = |t: f64| rows.time.binary_search_by(|row| row.total_cmp(&t)).is_ok();
        drawn.extend((0..at.len()).filter(|&k| !own(at.time[k])).map(|k| (at, k)));
    }
    drawn.sort_by(|(a, i), (b, j)| a.time[*i].total_cmp(&b.time[*j]));
    drawn
}

/// The whole true track in the plane, between the rows too.
fn true_way(plan: &Plan, i: usize, x: usize, y: usize) -> Option<Vec<[f64; 2]>> {
    let truth = plan.truth.as_ref()?;
    let (xs, ys) = (truth.states[x].as_ref()?, truth.states[y].as_ref()?);
    Some(truth.rows[i].iter().map(|&k| [xs[k], ys[k]]).collect())
}

fn nis(shown: &Shown) -> NisSeries {
    let est = shown.rows;
    let mut bands: HashMap<usize, (f64, f64)> = HashMap::new();
    let mut band = |dof: usize| *bands.entry(dof).or_insert_with(|| chi_squared_band(dof as f64));
    let (lower, upper) = est.nis_dof.iter().map(|&dof| band(dof)).unzip();
    let all = shown.counts.map(|counts| counts.nis.clone());
    let (time, nis, gated) = (est.time.clone(), est.nis.clone(), est.gated.clone());
    NisSeries { time, nis, lower, upper, gated, all }
}

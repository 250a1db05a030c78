//! The panel of the plane: tracks, their 2σ ellipses, measurements and truth.

use super::{Look, PlaneTrack, TrackFigure};
use crate::figure::colour::Colour;
use crate::figure::plot::{Axis, Mark, Panel, Shape};

/// Ellipses nearer to each other than this, in pixels, would blot.
const ELLIPSES_APART: f64 = 16.0;

/// The plane, and its height as a share of its width.
pub(super) fn panel(figure: &TrackFigure) -> Option<(Panel, f64)> {
    let tracks: Vec<(Look, &PlaneTrack)> = figure
        .tracks
        .iter()
        .enumerate()
        .filter_map(|(i, t)| Some((Look::of(figure, i), t.plane.as_ref()?)))
        .collect();
    if tracks.is_empty() {
        return None;
    }
    let detailed = tracks.len() <= Look::MOST_NAMED;
    let mut marks = Vec::new();
    let lines = tracks.iter().flat_map(|(_, t)| t.estimate.iter().chain(t.truth.iter().flatten()));
    let ranges = extent(lines.copied(), tracks.iter().flat_map(|(_, t)| t.measurements.iter().copied()));
    let all: Vec<[f64; 2]> = tracks.iter().flat_map(|(_, t)| t.measurements.iter().copied()).collect();
    let known = all.iter().filter(|p| p[0].is_finite() && p[1].is_finite());
    let beyond = ranges.map_or(0, |r| known.filter(|p| !within(p, &r)).count());
    if !all.is_empty() {
        let shape = Shape::Dots { points: all, radius: 1.9, hollow: true };
        marks.push(Mark::new("measurements", Colour::GREY, shape));
    }
    for (Look { name, colour }, track) in &tracks {
        if detailed {
            let (centres, covariances) = (track.estimate.clone(), track.covariance.clone());
            let shape = Shape::Ellipses { centres, covariances, sigmas: 2.0, apart: ELLIPSES_APART };
            marks.push(Mark::new("2σ ellipses", *colour, shape));
        }
        if let Some(filtered) = &track.filtered {
            let shape = Shape::Line { points: filtered.clone(), width: 0.9, dashed: false };
            marks.push(Mark::new("filtered", Colour::SKY, shape));
        }
        let width = if detailed { 1.7 } else { 1.1 };
        let shape = Shape::Line { points: track.estimate.clone(), width, dashed: false };
        marks.push(Mark::new(name, *colour, shape));
    }
    for (_, track) in &tracks {
        if let Some(truth) = &track.truth {
            let shape = Shape::Line { points: truth.clone(), width: 1.1, dashed: true };
            marks.push(Mark::new("truth", Colour::INK, shape));
        }
    }
    let remark = match beyond {
        0 => String::new(),
        1 => "1 measurement beyond the frame".to_owned(),
        n => format!("{n} measurements beyond the frame"),
    };
    let [x_label, y_label] = figure.plane_labels.clone();
    let axis = |label: String, k: usize| Axis { label, range: ranges.map(|r| r[k]), ..Axis::default() };
    let (x, y) = (axis(x_label, 0), axis(y_label, 1));
    let panel = Panel { heading: "track in the plane".into(), remark, x, y, equal: true, key: false, marks };
    Some((panel, ranges.map_or(1.0, aspect)))
}

fn within([x, y]: &[f64; 2], [across, up]: &[[f64; 2]; 2]) -> bool {
    (across[0]..=across[1]).contains(x) && (up[0]..=up[1]).contains(y)
}

fn aspect([x, y]: [[f64; 2]; 2]) -> f64 {
    let ratio = (y[1] - y[0]) / (x[1] - x[0]);
    if ratio.is_finite() { ratio.clamp(0.05, 20.0) } else { 1.0 }
}

/// The box of the lines, grown to hold those measurements that lie within its own size of it: one
/// stray measurement must not make the track a dot.
fn extent(
    lines: impl Iterator<Item = [f64; 2]>,
    measurements: impl Iterator<Item = [f64; 2]> + Clone,
) -> Option<[[f64; 2]; 2]> {
    let sound = |p: &[f64; 2]| p.iter().all(|v| v.is_finite() && v.abs() < 1e280);
    let cover = |found: Option<[[f64; 2]; 2]>, p: [f64; 2]| {
        let [x, y] = found.unwrap_or([[p[0]; 2], [p[1]; 2]]);
        Some([[x[0].min(p[0]), x[1].max(p[0])], [y[0].min(p[1]), y[1].max(p[1])]])
    };
    let core = lines.filter(sound).fold(None, cover);
    let size = core.map_or(0.0, |[x, y]: [[f64; 2]; 2]| (x[1] - x[0]).max(y[1] - y[0]));
    let near =
        |p: &[f64; 2]| core.is_none_or(|r| size <= 0.0 || within(p, &r.map(|[a, b]| [a - size, b + size])));
    let [x, y] = measurements.filter(sound).filter(near).fold(core, cover)?;
    let pad = 0.05 * (x[1] - x[0]).max(y[1] - y[0]);
    let pad = if pad > 0.0 { pad } else { 0.1 * x[0].abs().max(y[0].abs()).max(1e-3) };
    Some([x, y].map(|[a, b]| [a - pad, b + pad]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stray_measurement_is_told_and_does_not_shrink_the_track() {
        let estimate: Vec<[f64; 2]> = (0..50).map(|i| [f64::from(i), f64::from(i)]).collect();
        let mut measurements = estimate.clone();
        measurements.push([1e6, -1e6]);
        let plane = PlaneTrack { estimate, measurements, ..PlaneTrack::default() };
        let track = super::super::Track { plane: Some(plane), ..Default::default() };
        let (panel, ratio) = panel(&TrackFigure { tracks: vec![track], ..TrackFigure::default() }).unwrap();
        assert_eq!(panel.remark, "1 measurement beyond the frame");
        assert!(panel.x.range.unwrap()[1] < 60.0 && (ratio - 1.0).abs() < 1e-9);
    }
}

//! Panels of one state: the estimate with its band, and its error against ±2σ.

use super::{Look, StateSeries};
use crate::figure::colour::Colour;
use crate::figure::number;
use crate::figure::plot::{Axis, Mark, Panel, Shape};

/// Opacity of the ±2σ band.
const BAND: u8 = 44;

/// The estimate over time.
pub(super) fn estimate(state: &StateSeries, x: Axis, look: &Look) -> Panel {
    let rows = |f: &dyn Fn(usize) -> f64| -> Vec<[f64; 2]> {
        (0..length(state)).map(|i| [state.time[i], f(i)]).collect()
    };
    let of = |values: &Vec<f64>| -> Vec<[f64; 2]> {
        state.time.iter().zip(values).map(|(t, v)| [*t, *v]).collect()
    };
    let band: Vec<[f64; 3]> = (0..length(state))
        .map(|i| [state.time[i], state.mean[i] - 2.0 * state.std[i], state.mean[i] + 2.0 * state.std[i]])
        .collect();
    let centre = state.mean.iter().chain(state.truth.iter().flatten()).copied();
    let (range, remark) = held(&band, centre);
    let mut marks = vec![Mark::new("±2σ", look.colour.faded(BAND), Shape::Band { rows: band })];
    if let Some(filtered) = state.filtered.as_ref() {
        let shape = Shape::Line { points: of(filtered), width: 0.9, dashed: false };
        marks.push(Mark::new("filtered", Colour::SKY, shape));
    }
    let shape = Shape::Line { points: rows(&|i| state.mean[i]), width: 1.5, dashed: false };
    marks.push(Mark::new(&look.name, look.colour, shape));
    if let Some(truth) = &state.truth {
        let shape = Shape::Line { points: known(of(truth)), width: 1.1, dashed: true };
        marks.push(Mark::new("truth", Colour::INK, shape));
    }
    let y = Axis { range, ..Axis::default() };
    Panel { heading: state.name.clone(), remark, x, y, marks, ..Panel::default() }
}

/// Estimate minus truth over time, and how much of it lies within ±2σ.
pub(super) fn error(state: &StateSeries, truth: &[f64], x: Axis, look: &Look) -> Panel {
    let rows = length(state).min(truth.len());
    let band: Vec<[f64; 3]> =
        (0..rows).map(|i| [state.time[i], -2.0 * state.std[i], 2.0 * state.std[i]]).collect();
    let points: Vec<[f64; 2]> = (0..rows).map(|i| [state.time[i], state.mean[i] - truth[i]]).collect();
    let judged: Vec<usize> =
        (0..rows).filter(|&i| points[i][1].is_finite() && state.std[i].is_finite()).collect();
    let counted =
        [judged.iter().filter(|&&i| points[i][1].abs() <= 2.0 * state.std[i]).count(), judged.len()];
    let [inside, judged] = state.inside.unwrap_or(counted);
    let (range, cut) = held(&band, points.iter().map(|p| p[1]));
    let mut remark = cut;
    if judged > 0 {
        let share = 100.0 * inside as f64 / judged as f64;
        let within = format!("{}\u{2009}% within ±2σ", number::short(share.round()));
        remark = if remark.is_empty() { within } else { format!("{within} · {remark}") };
    }
    let marks = vec![
        Mark::new("±2σ", look.colour.faded(BAND), Shape::Band { rows: band }),
        Mark::new("", Colour::AXIS, Shape::Level { y: 0.0, dashed: false }),
        Mark::new("", Colour::VERMILION, Shape::Line { points: known(points), width: 1.2, dashed: false }),
    ];
    let y = Axis { range, ..Axis::default() };
    Panel { heading: format!("error of {}", state.name), remark, x, y, marks, ..Panel::default() }
}

/// What is known: a truth has fewer times than an estimate, and its line goes from each to the next.
fn known(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.retain(|point| !point[1].is_nan());
    points
}

/// Rows that have a time, a mean and a standard deviation.
fn length(state: &StateSeries) -> usize {
    state.time.len().min(state.mean.len()).min(state.std.len())
}

/// A range that shows `centre` whole and the band where it is of ordinary width: a few wide rows, as
/// at the start, must not flatten all others. Where that cuts the band, the remark tells how far it reaches.
fn held(band: &[[f64; 3]], centre: impl Iterator<Item = f64>) -> (Option<[f64; 2]>, String) {
    let finite = |v: &f64| v.is_finite();
    let (lo, hi) =
        centre.filter(finite).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let edge = |side: usize| -> Vec<f64> {
        let mut edge: Vec<f64> = band.iter().map(|r| r[side]).filter(finite).collect();
        edge.sort_by(f64::total_cmp);
        edge
    };
    let (lower, upper) = (edge(1), edge(2));
    let (Some(least), Some(most)) = (lower.first(), upper.last()) else { return (None, String::new()) };
    if lo > hi {
        return (None, String::new());
    }
    let at =
        |edge: &[f64], share: f64| edge.get((share * (edge.len() as f64 - 1.0)).round() as usize).copied();
    let usual = [lo.min(at(&lower, 0.05).unwrap_or(lo)), hi.max(at(&upper, 0.95).unwrap_or(hi))];
    let whole = [lo.min(*least), hi.max(*most)];
    let pad = 0.06 * (usual[1] - usual[0]);
    if !(whole[1] - whole[0] > 2.5 * (usual[1] - usual[0]) && pad > 0.0) {
        return (None, String::new());
    }
    let far = if whole[1] - usual[1] > usual[0] - whole[0] { whole[1] } else { whole[0] };
    (Some([usual[0] - pad, usual[1] + pad]), format!("band cut; it reaches {}", number::short(far)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(std: impl Fn(usize) -> f64) -> StateSeries {
        StateSeries {
            name: "x".into(),
            time: (0..200).map(f64::from).collect(),
            mean: (0..200).map(|i| (f64::from(i) / 30.0).sin()).collect(),
            std: (0..200).map(std).collect(),
            ..StateSeries::default()
        }
    }

    fn look() -> Look {
        Look { name: "estimate".into(), colour: Colour::BLUE }
    }

    #[test]
    fn a_wide_start_does_not_flatten_the_rest_and_is_told() {
        let panel = estimate(&series(|i| if i < 3 { 1e4 } else { 0.1 }), Axis::default(), &look());
        let range = panel.y.range.unwrap();
        assert!(range[0] > -2.0 && range[1] < 2.0, "{range:?}");
        assert_eq!(panel.remark, "band cut; it reaches 20\u{2009}000");
        assert!(estimate(&series(|_| 0.1), Axis::default(), &look()).y.range.is_none());
    }

    #[test]
    fn the_share_within_two_sigma_is_counted_where_the_truth_is_known() {
        let state = series(|_| 1.0);
        let truth: Vec<f64> = state
            .mean
            .iter()
            .enumerate()
            .map(|(i, m)| if i < 100 { f64::NAN } else { m + if i < 125 { 3.0 } else { 1.0 } })
            .collect();
        assert!(error(&state, &truth, Axis::default(), &look()).remark.starts_with("75\u{2009}% within"));
    }

    #[test]
    fn a_truth_at_every_other_time_is_a_line_through_these() {
        let mut state = series(|_| 1.0);
        let truth: Vec<f64> = (0..200).map(|i| if i % 2 == 0 { 0.5 } else { f64::NAN }).collect();
        state.truth = Some(truth.clone());
        let lines = [
            estimate(&state, Axis::default(), &look()).marks.pop(),
            error(&state, &truth, Axis::default(), &look()).marks.pop(),
        ];
        for line in lines {
            let Some(Mark { shape: Shape::Line { points, .. }, .. }) = line else { panic!("{line:?}") };
            assert!(points.len() == 100 && points.iter().all(|p| p[1].is_finite()));
        }
    }
}

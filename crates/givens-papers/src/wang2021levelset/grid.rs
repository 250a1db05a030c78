//! A row of panels for each turn rate, a column for each error and one for the runs lost.

use super::comparison::{OF, Outcome, RATES};
use crate::drawing::{axis, panel};
use givens_io::figure::{Axis, Block, Colour, Figure, Grid, Mark, Panel, Scale, Shape};

/// One method's curve: its name, colour, and whether dashed.
pub(super) type Style = (&'static str, Colour, bool);

/// The figure of outcomes by turn rate, then by style; each a curve of (x, outcome).
pub(super) fn drawn(
    title: &str,
    note: &str,
    x: &Axis,
    styles: &[Style],
    curves: &[Vec<Vec<(f64, &Outcome)>>],
) -> Figure {
    let mut cells = Vec::new();
    for (rate, curves) in RATES.iter().zip(curves) {
        for (i, of) in OF.iter().enumerate() {
            let marks = marks(styles, curves, |outcome| outcome.errors[i].value);
            let heading = format!("ω₀ = {rate}°/s");
            let y = Axis { padding: 0.08, ..axis(&format!("RMSE of {of}"), Scale::Log) };
            cells.push(Some(panel(&heading, x.clone(), y, marks)));
        }
        let share = |outcome: &Outcome| 100.0 * outcome.lost.count() as f64 / outcome.runs as f64;
        let y = Axis { range: Some([-3.0, 103.0]), ..axis("diverged, % of runs", Scale::Linear) };
        let marks = marks(styles, curves, share);
        cells.push(Some(Panel { x: x.clone(), y, marks, ..Panel::default() }));
    }
    let body = Block::Grid(Grid { columns: vec![1.0; 4], rows: vec![1.0; RATES.len()], cells });
    Figure {
        title: title.to_owned(),
        notes: vec![format!("{note}. Where a method lost every run it has no point.")],
        key: true,
        body,
        width: 1400.0,
        height: 900.0,
    }
}

fn marks(styles: &[Style], curves: &[Vec<(f64, &Outcome)>], of: impl Fn(&Outcome) -> f64) -> Vec<Mark> {
    let marks = styles.iter().zip(curves).flat_map(|(&(name, colour, dashed), curve)| {
        let points: Vec<[f64; 2]> = curve.iter().map(|(x, outcome)| [*x, of(outcome)]).collect();
        let dots = Shape::Dots { points: points.clone(), radius: 2.4, hollow: false };
        let dots = (!dashed).then(|| Mark::new("", colour, dots));
        [Some(Mark::new(name, colour, Shape::Line { points, width: 1.6, dashed })), dots]
    });
    marks.flatten().collect()
}

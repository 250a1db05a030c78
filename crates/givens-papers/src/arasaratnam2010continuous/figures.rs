//! Figures 2–5: accumulated errors in position, velocity and turn rate against the number of steps, for three turn rates.

use super::runs::{Cells, METHODS, OMEGAS, STEPS};
use crate::drawing::{COLOURS, axis, line};
use crate::statistics::root_mean;
use givens_io::figure::{Block, Figure, Grid, Panel, Scale};

/// Accumulated error: 0 in position, 1 in velocity, 2 in turn rate; not a number where no run was kept.
pub(super) fn error(cells: &Cells, at: [usize; 4], which: usize) -> f64 {
    let [reading, omega, method, steps] = at;
    let squares = &cells.get(reading, omega, method, steps).squares;
    root_mean(squares.iter().map(|square| square[which]))
}

/// Of the first reading.
pub(super) fn draw(cells: &Cells, number: usize, interval: f64) -> Figure {
    const LABELS: [&str; 3] = ["position, m", "velocity, m/s", "turn rate, °/s"];
    let panel = |omega: usize, which: usize| {
        let unit = if which == 2 { 1f64.to_degrees() } else { 1.0 };
        let curve = |method: usize| {
            let point = |s: usize| [STEPS[s] as f64, unit * error(cells, [0, omega, method, s], which)];
            line(METHODS[method].0, COLOURS[method], (0..STEPS.len()).map(point).collect())
        };
        Panel {
            heading: format!("ω = {}°/s", OMEGAS[omega]),
            x: axis("steps of an interval, m", Scale::Log),
            y: axis(LABELS[which], Scale::Log),
            marks: (0..METHODS.len()).map(curve).collect(),
            ..Panel::default()
        }
    };
    let cells = (0..9).map(|k| Some(panel(k / 3, k % 3))).collect();
    Figure {
        title: format!("Figure {number}: accumulated errors of the runs that were kept, T = {interval} s"),
        notes: vec![],
        key: true,
        body: Block::Grid(Grid { columns: vec![1.0; 3], rows: vec![1.0; 3], cells }),
        width: 960.0,
        height: 720.0,
    }
}

//! Figures 2–5: accumulated errors in position, velocity and turn rate against the number of steps, for three turn rates.

use super::runs::{Cells, METHODS, OMEGAS, STEPS};
use crate::Estimate;
use crate::drawing::{COLOURS, axis, marked, panel, steps};
use crate::statistics::root_of;
use givens_io::figure::{Block, Figure, Grid, Scale};

/// Accumulated error: 0 in position, 1 in velocity, 2 in turn rate; not a number where no run was kept.
pub(super) fn error(cells: &Cells, at: [usize; 4], which: usize) -> Estimate {
    let [reading, omega, method, steps] = at;
    let squares = &cells.get(reading, omega, method, steps).squares;
    root_of(squares.iter().flatten().map(|square| square[which]))
}

/// Why a point may lack.
pub(super) const NO_POINT: &str = "Where a filter lost every run it has no point.";

/// Of the first reading.
pub(super) fn draw(cells: &Cells, number: usize, interval: f64) -> Figure {
    const LABELS: [&str; 3] = ["position, m", "velocity, m/s", "turn rate, °/s"];
    let one = |omega: usize, which: usize| {
        let unit = if which == 2 { 1f64.to_degrees() } else { 1.0 };
        let curve = |method: usize| {
            let point = |s: usize| [STEPS[s] as f64, unit * error(cells, [0, omega, method, s], which).value];
            marked(METHODS[method].0, COLOURS[method], (0..STEPS.len()).map(point).collect())
        };
        let (x, y) = (steps("steps of an interval, m", &STEPS), axis(LABELS[which], Scale::Log));
        panel(&format!("ω = {}°/s", OMEGAS[omega]), x, y, (0..METHODS.len()).flat_map(curve).collect())
    };
    let cells = (0..9).map(|k| Some(one(k / 3, k % 3))).collect();
    Figure {
        title: format!("Figure {number}: accumulated errors of the runs that were kept, T = {interval} s"),
        notes: vec![NO_POINT.to_owned()],
        key: true,
        body: Block::Grid(Grid { columns: vec![1.0; 3], rows: vec![1.0; 3], cells }),
        width: 960.0,
        height: 720.0,
    }
}

//! Figures 8 and 10: the errors of the CDKF and the CKF over time, true and estimated.

use super::levels::{CDKF, CKF, ESTIMATED, FIRST, Levels, NAMES, QUANTITIES, TRUE};
use super::turn::SCANS;
use crate::drawing::{axis, figure};
use crate::page::Table;
use givens_io::figure::{Axis, Colour, Figure, Mark, Panel, Scale, Shape};

/// The filter, its colour and the width of its lines, which are the paper's.
const DRAWN: [(usize, Colour, f64); 2] = [(CDKF, Colour::VERMILION, 1.0), (CKF, Colour::BLUE, 2.2)];
const HEADINGS: [&str; 3] = ["(a) position", "(b) velocity", "(c) turn rate"];

/// The figure: solid true, dashed estimated.
pub(super) fn shown(title: &str, levels: &Levels) -> Figure {
    let panel = |i: usize| {
        let mut marks = Vec::new();
        for (filter, colour, width) in DRAWN {
            for (rows, word, dashed) in [(TRUE, "true", false), (ESTIMATED, "estimated", true)] {
                let point = |k: usize| [(FIRST + k) as f64, levels.at(filter, rows, k, i)];
                let points = (0..=SCANS - FIRST).map(point).collect();
                let shape = Shape::Line { points, width, dashed };
                marks.push(Mark::new(&format!("{} {word}", NAMES[filter]), colour, shape));
            }
        }
        let x = Axis { range: Some([50.0, 100.0]), ..axis("time, s", Scale::Linear) };
        let y = axis(&format!("RMSE, {}", QUANTITIES[i].rsplit(' ').next().unwrap_or("")), Scale::Linear);
        Panel { heading: HEADINGS[i].to_owned(), x, y, marks, ..Panel::default() }
    };
    figure(title, false, vec![panel(0), panel(1), panel(2)])
}

/// The same numbers.
pub(super) fn table(levels: &Levels) -> Table {
    let mut columns = vec!["time".to_owned()];
    let mut rows: Vec<Vec<_>> = (FIRST..=SCANS).map(|k| vec![k.into()]).collect();
    for (filter, name) in NAMES.iter().enumerate() {
        for (word, of) in [("true", TRUE), ("estimated", ESTIMATED)] {
            for (i, quantity) in QUANTITIES.iter().enumerate() {
                columns.push(format!("{name} {word} {quantity}"));
                rows.iter_mut().enumerate().for_each(|(k, row)| row.push(levels.at(filter, of, k, i).into()));
            }
        }
    }
    Table { name: "rmse", columns, rows }
}

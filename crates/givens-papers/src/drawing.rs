//! The manner of the figures.

use givens_io::figure::{Axis, Block, Colour, Figure, Grid, Mark, Panel, Scale, Shape};

/// Colours in the order in which methods are drawn.
pub(crate) const COLOURS: [Colour; 7] = [
    Colour::BLUE,
    Colour::VERMILION,
    Colour::GREEN,
    Colour::ORANGE,
    Colour::PURPLE,
    Colour::SKY,
    Colour::GREY,
];

/// A line by name.
pub(crate) fn line(name: &str, colour: Colour, points: Vec<[f64; 2]>) -> Mark {
    Mark::new(name, colour, Shape::Line { points, width: 1.6, dashed: false })
}

/// An axis with a label.
pub(crate) fn axis(label: &str, scale: Scale) -> Axis {
    Axis { label: label.to_owned(), scale, ..Axis::default() }
}

/// Panels side by side, or one above the other.
pub(crate) fn figure(title: &str, across: bool, panels: Vec<Panel>) -> Figure {
    let ones = vec![1.0; panels.len()];
    let height = if across { 380.0 } else { 250.0 * panels.len() as f64 };
    let (columns, rows) = if across { (ones, vec![1.0]) } else { (vec![1.0], ones) };
    let cells = panels.into_iter().map(Some).collect();
    let body = Block::Grid(Grid { columns, rows, cells });
    Figure { title: title.to_owned(), notes: vec![], key: true, body, width: 860.0, height }
}

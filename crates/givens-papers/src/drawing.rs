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

/// A line through few points, each of them marked: a point between two that are none stands alone.
pub(crate) fn marked(name: &str, colour: Colour, points: Vec<[f64; 2]>) -> [Mark; 2] {
    let dots = Shape::Dots { points: points.clone(), radius: 2.4, hollow: false };
    [line(name, colour, points), Mark::new("", colour, dots)]
}

/// An axis with a label.
pub(crate) fn axis(label: &str, scale: Scale) -> Axis {
    Axis { label: label.to_owned(), scale, ..Axis::default() }
}

/// A logarithmic axis that is ticked at these numbers of steps.
pub(crate) fn steps(label: &str, counts: &[usize]) -> Axis {
    let ticks = counts.iter().map(|&m| (m as f64, m.to_string())).collect();
    Axis { ticks, ..axis(label, Scale::Log) }
}

/// An axis of names, at 1, 2, …
pub(crate) fn names(names: &[&str]) -> Axis {
    let ticks = names.iter().zip(1u32..).map(|(name, k)| (f64::from(k), (*name).to_owned())).collect();
    let range = Some([0.5, names.len() as f64 + 0.5]);
    Axis { ticks, range, ..axis("", Scale::Linear) }
}

/// A panel, which says so where no filter kept a run.
pub(crate) fn panel(heading: &str, x: Axis, y: Axis, marks: Vec<Mark>) -> Panel {
    let drawn = |mark: &Mark| match &mark.shape {
        Shape::Line { points, .. } => points.iter().any(|point| point[1].is_finite()),
        _ => false,
    };
    let remark = if marks.iter().any(drawn) { "" } else { "every run was lost" };
    Panel { heading: heading.to_owned(), remark: remark.to_owned(), x, y, marks, ..Panel::default() }
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

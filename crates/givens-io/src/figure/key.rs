//! The key: what each mark is, beside a sample of it, outside the axes.

use super::colour::Colour;
use super::font::Fonts;
use super::marks::{DASH, size};
use super::plot::{Mark, Panel, Shape};
use super::scene::{Anchor, Item, Marker, Point, Stroke, Text, Weight};

/// Height of one line of a key in pixels.
pub(super) const LINE: f64 = 18.0;
const SIZE: f64 = 11.5;
const SAMPLE: f64 = 24.0;
const DOT_SAMPLE: f64 = 10.0;
const GAP: f64 = 20.0;

/// The first mark of each name: lines, the boldest first, then areas, then
/// dots, each in order of appearance.
pub(super) fn entries<'a>(panels: impl IntoIterator<Item = &'a Panel>) -> Vec<&'a Mark> {
    let mut found: Vec<&Mark> = Vec::new();
    for mark in panels.into_iter().flat_map(|p| &p.marks) {
        // The key of a figure with hundreds of series would hide it.
        let known = found.iter().any(|f| f.name == mark.name);
        if !(mark.name.is_empty() || known || found.len() >= 24) {
            found.push(mark);
        }
    }
    let rank = |mark: &Mark| match &mark.shape {
        Shape::Line { width, .. } => -size(*width),
        Shape::Band { .. } => 1.0,
        Shape::Ellipses { .. } => 2.0,
        Shape::Dots { .. } => 3.0,
        Shape::Level { .. } => 4.0,
    };
    found.sort_by(|a, b| rank(a).total_cmp(&rank(b)));
    found
}

/// The entries broken into lines of at most `width` pixels, each with its start and its text.
pub(super) fn lines<'a>(
    entries: &[&'a Mark],
    width: f64,
    fonts: &Fonts,
) -> Vec<Vec<(f64, &'a Mark, String)>> {
    let mut rows: Vec<Vec<(f64, &Mark, String)>> = Vec::new();
    let mut x = f64::INFINITY;
    for mark in entries {
        let text = fonts.fit(&mark.name, Weight::Regular, SIZE, (width - SAMPLE - 6.0).max(20.0));
        let length = sample_width(mark) + 6.0 + fonts.width(&text, Weight::Regular, SIZE);
        if x + length > width {
            rows.push(Vec::new());
            x = 0.0;
        }
        if let Some(row) = rows.last_mut() {
            row.push((x, *mark, text));
        }
        x += length + GAP;
    }
    rows
}

fn sample_width(mark: &Mark) -> f64 {
    if matches!(mark.shape, Shape::Dots { .. }) { DOT_SAMPLE } else { SAMPLE }
}

/// Draws one line of a key with its baseline starting at `at`.
pub(super) fn draw(row: &[(f64, &Mark, String)], at: Point, items: &mut Vec<Item>) {
    for (x, mark, text) in row {
        let [x, y] = [at[0] + x, at[1]];
        sample(mark, [x, y - 0.36 * SIZE], items);
        let (at, weight, colour) = ([x + sample_width(mark) + 6.0, y], Weight::Regular, Colour::INK);
        let anchor = Anchor::Start;
        items.push(Item::Text(Text {
            at,
            line: text.clone(),
            size: SIZE,
            weight,
            colour,
            anchor,
            turned: false,
        }));
    }
}

fn sample(mark: &Mark, [x, y]: Point, items: &mut Vec<Item>) {
    let line = |width: f64, dashed: bool| Item::Lines {
        runs: vec![vec![[x, y], [x + SAMPLE, y]]],
        stroke: Stroke { colour: mark.colour, width, dash: dashed.then_some(DASH) },
    };
    items.push(match &mark.shape {
        Shape::Line { width, dashed, .. } => line(size(*width).clamp(0.5, 4.0), *dashed),
        Shape::Level { dashed, .. } => line(1.0, *dashed),
        Shape::Dots { radius, hollow, .. } => Item::Markers {
            at: vec![[x + DOT_SAMPLE / 2.0, y]],
            marker: if *hollow { Marker::Ring } else { Marker::Disc },
            radius: size(*radius).clamp(1.8, 5.0),
            colour: mark.colour,
        },
        Shape::Band { .. } => Item::Rings {
            rings: vec![vec![[x, y - 5.0], [x + SAMPLE, y - 5.0], [x + SAMPLE, y + 5.0], [x, y + 5.0]]],
            fill: Some(mark.colour),
            stroke: None,
        },
        Shape::Ellipses { .. } => Item::Rings {
            rings: vec![oval([x + SAMPLE / 2.0, y])],
            fill: Some(mark.colour.faded(34)),
            stroke: Some(Stroke { colour: mark.colour.faded(170), width: 0.9, dash: None }),
        },
    });
}

fn oval(c: Point) -> Vec<Point> {
    let turn = |k: u32| core::f64::consts::TAU * f64::from(k) / 32.0;
    (0..32).map(|k| [c[0] + 9.0 * turn(k).cos(), c[1] + 4.5 * turn(k).sin()]).collect()
}

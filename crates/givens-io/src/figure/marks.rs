//! From marks to shapes in pixels: placed, thinned and clipped.

use super::clip;
use super::colour::Colour;
use super::decimate;
use super::plot::{Mark, Shape};
use super::scale::Ruler;
use super::scene::{Item, Marker, Point, Rect, Stroke};

pub(super) const DASH: [f64; 2] = [5.0, 3.0];
/// Shapes are kept this far beyond the axes, so that the ends of strokes are not seen.
const BEYOND: f64 = 30.0;

/// The two rulers of a panel and the rectangle between them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub x: Ruler,
    pub y: Ruler,
    pub rect: Rect,
}

impl Frame {
    fn place(&self, [x, y]: [f64; 2]) -> Option<Point> {
        Some([self.x.place(x)?, self.y.place(y)?])
    }

    /// The runs between gaps, in pixels.
    fn runs(&self, points: &[[f64; 2]]) -> Vec<Vec<Point>> {
        let mut runs = vec![Vec::new()];
        for p in points {
            match (self.place(*p), runs.last_mut()) {
                (Some(p), Some(run)) => run.push(p),
                _ => runs.push(Vec::new()),
            }
        }
        runs.retain(|run| !run.is_empty());
        runs
    }
}

/// Appends what `mark` draws.
pub(super) fn draw(mark: &Mark, frame: &Frame, items: &mut Vec<Item>) {
    match &mark.shape {
        Shape::Line { points, width, dashed } => line(points, *width, *dashed, mark.colour, frame, items),
        Shape::Dots { points, radius, hollow } => {
            let placed: Vec<Point> = points.iter().filter_map(|p| frame.place(*p)).collect();
            let seen: Vec<Point> =
                placed.into_iter().filter(|p| frame.rect.grown(*radius).contains(*p)).collect();
            let marker = if *hollow { Marker::Ring } else { Marker::Disc };
            let at = decimate::markers(&seen);
            // Many dots are drawn smaller, or they would be one blot.
            let shrink = if at.len() > 1500 { 0.6 } else { 1.0 };
            let radius = shrink * size(*radius);
            if !at.is_empty() {
                items.push(Item::Markers { at, marker, radius, colour: mark.colour });
            }
        }
        Shape::Band { rows } => band(rows, mark.colour, frame, items),
        Shape::Ellipses { centres, covariances, sigmas, apart } => {
            let rings = ellipses(centres, covariances, *sigmas, *apart, frame);
            let stroke = Stroke { colour: mark.colour.faded(170), width: 0.9, dash: None };
            if !rings.is_empty() {
                items.push(Item::Rings { rings, fill: Some(mark.colour.faded(34)), stroke: Some(stroke) });
            }
        }
        Shape::Level { y, dashed } => {
            let Some(y) = frame.y.place(*y).filter(|y| (frame.rect.y..=frame.rect.bottom()).contains(y))
            else {
                return;
            };
            let stroke = Stroke { colour: mark.colour, width: 1.0, dash: dashed.then_some(DASH) };
            items.push(Item::Lines { runs: vec![vec![[frame.rect.x, y], [frame.rect.right(), y]]], stroke });
        }
    }
}

/// A width or radius that can be drawn.
pub(super) fn size(given: f64) -> f64 {
    if given.is_finite() { given.clamp(0.2, 50.0) } else { 1.0 }
}

fn line(points: &[[f64; 2]], width: f64, dashed: bool, colour: Colour, frame: &Frame, items: &mut Vec<Item>) {
    let width = size(width);
    let (mut drawn, mut alone) = (Vec::new(), Vec::new());
    for run in frame.runs(points) {
        match run.as_slice() {
            [one] if frame.rect.contains(*one) => alone.push(*one),
            _ => drawn.extend(clip::lines(&decimate::run(&run), &frame.rect.grown(BEYOND))),
        }
    }
    if !drawn.is_empty() {
        items.push(Item::Lines {
            runs: drawn,
            stroke: Stroke { colour, width, dash: dashed.then_some(DASH) },
        });
    }
    if !alone.is_empty() {
        items.push(Item::Markers { at: alone, marker: Marker::Disc, radius: 0.9 * width, colour });
    }
}

fn band(rows: &[[f64; 3]], colour: Colour, frame: &Frame, items: &mut Vec<Item>) {
    let placed =
        rows.iter().map(|r| Some([frame.x.place(r[0])?, frame.y.place(r[1])?, frame.y.place(r[2])?]));
    let mut runs: Vec<Vec<[f64; 3]>> = vec![Vec::new()];
    for row in placed {
        match (row, runs.last_mut()) {
            (Some(row), Some(run)) => run.push(row),
            _ => runs.push(Vec::new()),
        }
    }
    let around = frame.rect.grown(BEYOND);
    let mut rings: Vec<Vec<Point>> = Vec::new();
    for run in runs.iter().map(|run| decimate::band(run)) {
        let there = run.iter().map(|r| [r[0], r[2]]);
        let back = run.iter().rev().map(|r| [r[0], r[1]]);
        rings.push(clip::ring(&there.chain(back).collect::<Vec<_>>(), &around));
    }
    rings.retain(|ring| ring.len() > 2);
    if !rings.is_empty() {
        items.push(Item::Rings { rings, fill: Some(colour), stroke: None });
    }
}

fn ellipses(
    centres: &[[f64; 2]],
    covariances: &[[f64; 3]],
    sigmas: f64,
    apart: f64,
    frame: &Frame,
) -> Vec<Vec<Point>> {
    let (mut rings, mut last) = (Vec::new(), None::<Point>);
    let end = centres.iter().rposition(|c| frame.place(*c).is_some());
    for (i, (centre, cov)) in centres.iter().zip(covariances).enumerate() {
        let Some(at) = frame.place(*centre) else { continue };
        let near = last.is_some_and(|l| (at[0] - l[0]).hypot(at[1] - l[1]) < apart);
        if near && Some(i) != end {
            continue;
        }
        let Some(ring) = ellipse(*centre, *cov, sigmas, frame) else { continue };
        let seen = clip::ring(&ring, &frame.rect.grown(BEYOND));
        if seen.len() > 2 {
            rings.push(seen);
            last = Some(at);
        }
    }
    rings
}

/// The ring at `sigmas` standard deviations; `None` where the matrix is no covariance.
fn ellipse(centre: [f64; 2], [xx, xy, yy]: [f64; 3], sigmas: f64, frame: &Frame) -> Option<Vec<Point>> {
    const CORNERS: u32 = 56;
    if !(xx >= 0.0 && yy >= 0.0 && xy.is_finite()) {
        return None;
    }
    let l11 = xx.sqrt();
    let l21 = if l11 > 0.0 { xy / l11 } else { 0.0 };
    let rest = yy - l21 * l21;
    if rest < -1e-9 * yy {
        return None;
    }
    let l22 = rest.max(0.0).sqrt();
    (0..CORNERS)
        .map(|k| {
            let (sin, cos) = (core::f64::consts::TAU * f64::from(k) / f64::from(CORNERS)).sin_cos();
            frame.place([centre[0] + sigmas * l11 * cos, centre[1] + sigmas * (l21 * cos + l22 * sin)])
        })
        .collect()
}

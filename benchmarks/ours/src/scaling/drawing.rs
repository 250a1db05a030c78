//! The figures: both axes logarithmic, medians with their quartiles.

use super::study::{Besides, Point, Series, Study};
use givens_io::figure::{Axis, Block, Colour, Figure, Grid, Mark, Panel, Scale, Shape};

const GUIDES: [Colour; 2] = [Colour::INK, Colour::GREY];
/// Opacity of what lies between the quartiles.
const QUARTILES: u8 = 56;

/// The study's.
pub fn figure(study: &Study) -> Figure {
    let mut panels = vec![times(study)];
    if study.besides == Besides::SpeedUp {
        panels.push(speed_up(study));
    }
    let grid = Grid {
        columns: vec![1.0; panels.len()],
        rows: vec![1.0],
        cells: panels.into_iter().map(Some).collect(),
    };
    let (title, body) = (study.title.to_owned(), Block::Grid(grid));
    Figure { title, notes: Vec::new(), key: true, body, width: 860.0, height: 420.0 }
}

fn axis(label: String, sizes: &[usize]) -> Axis {
    let ticks = sizes.iter().map(|&x| (x as f64, x.to_string())).collect();
    Axis { label, scale: Scale::Log, ticks, ..Axis::default() }
}

fn times(study: &Study) -> Panel {
    let mut marks = Vec::new();
    for (guide, colour) in study.guides.iter().zip(GUIDES) {
        let point = |&x: &usize| Some([x as f64, (guide.at)(&study.series, x)? / 1e3]);
        let points = study.sizes().iter().filter_map(point).collect();
        marks.push(Mark::new(&guide.name, colour, Shape::Line { points, width: 1.1, dashed: true }));
    }
    for (series, colour) in study.series.iter().zip((0..).map(Colour::series)) {
        let of = |point: &Point| Some((point.x as f64, point.time?));
        let times: Vec<_> = series.points.iter().filter_map(of).collect();
        let rows = times.iter().map(|(x, time)| [*x, time.lower / 1e3, time.upper / 1e3]).collect();
        marks.push(Mark::new("", colour.faded(QUARTILES), Shape::Band { rows }));
        let points = times.iter().map(|(x, time)| [*x, time.median / 1e3]).collect();
        marks.extend(line(series.name, colour, points));
    }
    let (x, y) = (axis(study.x.to_owned(), &study.sizes()), axis(format!("time of {}, µs", study.y), &[]));
    Panel { x, y, marks, ..Panel::default() }
}

fn speed_up(study: &Study) -> Panel {
    let sizes = study.sizes();
    let ideal = sizes.iter().map(|&x| [x as f64, x as f64]).collect();
    let mut marks = vec![Mark::new("", GUIDES[0], Shape::Line { points: ideal, width: 1.1, dashed: true })];
    for (series, colour) in study.series.iter().zip((0..).map(Colour::series)) {
        let point = |&x: &usize| Some([x as f64, faster(series, x)?]);
        marks.extend(line("", colour, sizes.iter().filter_map(point).collect()));
    }
    let (x, y) = (axis(study.x.to_owned(), &sizes), axis("times as fast as one thread".to_owned(), &sizes));
    Panel { x, y, marks, ..Panel::default() }
}

/// How many times faster than the first of its series.
pub fn faster(series: &Series, x: usize) -> Option<f64> {
    Some(series.points.first()?.time?.median / series.at(x)?.median)
}

/// A line through few points, each of them marked.
fn line(name: &str, colour: Colour, points: Vec<[f64; 2]>) -> [Mark; 2] {
    let dots = Shape::Dots { points: points.clone(), radius: 2.4, hollow: false };
    [Mark::new(name, colour, Shape::Line { points, width: 1.6, dashed: false }), Mark::new("", colour, dots)]
}

//! The figures.

use crate::predict::Way;
use crate::sweep::{Curve, SOLVED, SUBSTEPS, Sample, Sweep};
use givens::filter::predict::Velocity;
use givens::ode::Solver;
use givens_io::figure::{Axis, Block, Colour, Figure, Grid, Mark, Panel, Scale, Shape};

/// The errors that are drawn, in standard deviations.
const SHOWN: [f64; 2] = [1e-14, 10.0];

const fn colour(solver: Solver) -> Colour {
    match solver {
        Solver::Euler => Colour::GREY,
        Solver::Rk2 => Colour::ORANGE,
        Solver::Rk4 => Colour::GREEN,
        Solver::Dp5 => Colour::BLUE,
        Solver::Rodas4 => Colour::VERMILION,
    }
}

/// A line through all its points, each with a disc; the name stands at the line.
fn line(name: &str, colour: Colour, points: Vec<[f64; 2]>) -> [Mark; 2] {
    let dots = Shape::Dots { points: points.clone(), radius: 2.4, hollow: false };
    [Mark::new(name, colour, Shape::Line { points, width: 1.5, dashed: false }), Mark::new("", colour, dots)]
}

fn axis(label: &str, range: Option<[f64; 2]>) -> Axis {
    Axis { label: label.into(), scale: Scale::Log, range, ..Axis::default() }
}

fn panel(heading: &str, marks: Vec<Mark>, labelled: bool, across: [f64; 2]) -> Panel {
    let label = if labelled { "error, standard deviations" } else { "" };
    Panel {
        heading: heading.into(),
        x: axis("drift evaluations per prediction", Some(across)),
        y: axis(label, Some(SHOWN)),
        key: true,
        marks,
        ..Panel::default()
    }
}

/// Three panels: the solvers of the moment equations and of the level set, each against its own limit; and the time updates,
/// by dp5 or by substeps, against the moment equations.
pub fn figure(title: &str, sweep: &Sweep) -> Figure {
    let solvers = |wanted: Way| {
        let of = sweep.curves.iter().filter(|curve| curve.way == wanted);
        of.filter_map(|curve| Some((curve, curve.solver?)))
            .flat_map(|(curve, solver)| line(solver.name(), colour(solver), points(curve, true)))
            .collect()
    };
    let averaged = Way::LevelSet(Velocity::Averaged);
    let (moments, level) = (solvers(Way::Moments), solvers(averaged));
    let names = SOLVED.into_iter().chain(SUBSTEPS);
    let colours = [Colour::BLUE, Colour::SKY, Colour::PURPLE, Colour::INK, Colour::GREY];
    let compared = names.zip(colours).flat_map(|((way, name), colour)| {
        let of = |curve: &&Curve| curve.way == way && curve.solver.is_none_or(|solver| solver == Solver::Dp5);
        let points = sweep.curves.iter().find(of).map(|curve| points(curve, false));
        line(name, colour, points.unwrap_or_default())
    });
    let all = sweep.curves.iter().flat_map(|curve| points(curve, true));
    let across = all.filter(|[_, error]| *error < SHOWN[1]).map(|[evaluations, _]| evaluations);
    let across = across.fold([f64::INFINITY, 0.0], |[a, b], x| [x.min(a), x.max(b)]);
    let across = [across[0] / 1.5, across[1] * 1.5];
    let panels = [
        panel("moment equations, by solver", moments, true, across),
        panel("level set (averaged), by solver", level, false, across),
        panel("time updates against the moment equations", compared.collect(), false, across),
    ];
    let body = Block::Grid(Grid {
        columns: vec![1.0; panels.len()],
        rows: vec![1.0],
        cells: panels.into_iter().map(Some).collect(),
    });
    Figure { title: title.into(), notes: vec![], key: false, body, width: 1280.0, height: 440.0 }
}

fn points(curve: &Curve, own: bool) -> Vec<[f64; 2]> {
    let error = |sample: &Sample| if own { sample.own } else { sample.moments }.worst();
    curve.samples.iter().map(|sample| [sample.predicted.evaluations as f64, error(sample)]).collect()
}

/// Evaluations of the drift over the stiffness, of two solvers at one tolerance.
pub fn stiffness(rows: &[(f64, [usize; 2])]) -> Figure {
    let marks = [Solver::Dp5, Solver::Rodas4].into_iter().enumerate().flat_map(|(k, solver)| {
        let points = rows.iter().map(|(stiffness, of)| [*stiffness, of[k] as f64]).collect();
        line(solver.name(), colour(solver), points)
    });
    let panel = Panel {
        heading: "Van der Pol over 1, moment equations, rtol = 1e-6".into(),
        x: axis("μ", None),
        y: axis("drift evaluations per prediction", None),
        key: true,
        marks: marks.collect(),
        ..Panel::default()
    };
    let body = Block::Grid(Grid { columns: vec![1.0], rows: vec![1.0], cells: vec![Some(panel)] });
    Figure { title: String::new(), notes: vec![], key: false, body, width: 640.0, height: 360.0 }
}

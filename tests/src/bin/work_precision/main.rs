//! Measures what an answer of a given precision costs: the tables of `docs/work-precision.md` to stdout, its figures into a folder.
//!
//! `cargo run --release -p givens-tests --features reports --bin work_precision -- docs/images`

mod drawing;
mod predict;
mod problem;
mod sweep;
mod table;

use givens::model::Sde;
use givens::ode::Solver;
use givens_io::figure::{Figure, write};
use predict::{Problem, Setting, Way};
use std::path::PathBuf;
use sweep::{Sweep, sweep};

fn main() {
    let folder: PathBuf = std::env::args_os().nth(1).unwrap_or_else(|| "docs/images".into()).into();
    let draw = |name: &str, figure: &Figure| {
        write(folder.join(format!("work-precision-{name}.svg")), figure).unwrap();
    };
    let sweeps = [
        done(&problem::turn(), draw),
        done(&problem::van_der_pol(), draw),
        done(&problem::lorenz(), draw),
        done(&problem::stiff(1000.0), draw),
    ];
    table::limits(sweeps.iter().map(|(name, sweep)| (*name, sweep)));
    stiffness(draw);
}

/// One problem: its table, its figure.
fn done<M: Sde + Copy>(problem: &Problem<M>, draw: impl Fn(&str, &Figure)) -> (&'static str, Sweep) {
    let found = sweep(problem);
    println!("### {}\n", problem.title);
    table::curves(&found);
    println!();
    draw(problem.name, &drawing::figure(problem.title, &found));
    (problem.title, found)
}

/// When the solver for stiff equations pays.
fn stiffness(draw: impl Fn(&str, &Figure)) {
    println!(
        "\n| μ | dp5: drift | steps | time, µs | rodas4: drift | steps | time, µs |\n|{}",
        "--:|".repeat(7)
    );
    let mut rows = Vec::new();
    for power in 0..=8 {
        let stiffness = 10_f64.powf(0.5 * f64::from(power)).round();
        let problem = problem::stiff(stiffness);
        let found = [Solver::Dp5, Solver::Rodas4]
            .map(|solver| problem.predict(Way::Moments, solver, Setting::Rtol(1e-6), true).unwrap());
        let cells = found.each_ref().map(|found| {
            let (steps, time) = (found.work.accepted + found.work.rejected, found.microseconds);
            format!("{} | {steps} | {time:.0}", found.evaluations)
        });
        println!("| {stiffness} | {} |", cells.join(" | "));
        rows.push((stiffness, found.map(|found| found.evaluations)));
    }
    draw("stiffness", &drawing::stiffness(&rows));
}

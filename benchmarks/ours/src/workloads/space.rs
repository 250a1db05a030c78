//! W3a, P1: continuous time; W3b: the drift inside a discrete filter; P2: P1's update alone.

use super::unknown;
use crate::models::{SpaceRadar, SpaceStep, SpaceTurn};
use crate::problem::{Problem, prior};
use crate::{packs, single};
use givens_contest::{Entry, Failure, Inputs, Table};
use givens_core::filter::{CdCkf, CdCkf2, Ckf, SrCdCkf, SrCdCkf2, SrCkf};
use givens_core::ode::Solver;

/// One trajectory, a row every `dt`.
pub fn problem<X, M>(
    method: X,
    model: M,
    dt: f64,
    rows: Table,
    every: usize,
) -> Result<Problem<X, M, SpaceRadar>, Failure> {
    let mean = [1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 6.0_f64.to_radians()];
    let prior = prior(&mean, &[100.0, 10.0, 100.0, 10.0, 100.0, 10.0, 1e-4])?;
    let steps = rows.rows();
    Ok(Problem { method, model, sensor: SpaceRadar, prior, dt, rows, steps, every })
}

#[cfg(feature = "scaling")]
/// Many trajectories in continuous time, a row every second, each with `steps` of them.
pub fn split<X>(method: X, rows: Table, steps: usize) -> Result<Problem<X, SpaceTurn, SpaceRadar>, Failure> {
    Ok(Problem { steps, ..problem(method, SpaceTurn, 1.0, rows, steps)? })
}

pub fn moments(contestant: &str, inputs: &Inputs) -> Result<Entry<'static>, Failure> {
    let rows = inputs.csv("space")?;
    let root = SrCdCkf2 { solver: Solver::Rk4, substeps: 16, ..Default::default() };
    let adaptive = SrCdCkf2 { rtol: 1e-5, ..Default::default() };
    let cov = CdCkf2 { solver: Solver::Rk4, substeps: 16, ..Default::default() };
    Ok(match contestant {
        "sr-cd-ckf2" => single::entry(problem(root, SpaceTurn, 4.0, rows, 1)?)?,
        "sr-cd-ckf2 dp5" => single::entry(problem(adaptive, SpaceTurn, 4.0, rows, 1)?)?,
        "cd-ckf2" => single::entry(problem(cov, SpaceTurn, 4.0, rows, 1)?)?,
        "sr-cd-ckf2 packs" => packs::entry::<f64, _, _, _>(problem(root, SpaceTurn, 4.0, rows, 1)?)?,
        _ => return unknown(contestant),
    })
}

pub fn discrete(contestant: &str, inputs: &Inputs) -> Result<Entry<'static>, Failure> {
    let rows = inputs.csv("space")?;
    Ok(match contestant {
        "sr-ckf" => single::entry(problem(SrCkf::default(), SpaceStep, 4.0, rows, 1)?)?,
        "ckf" => single::entry(problem(Ckf::default(), SpaceStep, 4.0, rows, 1)?)?,
        _ => return unknown(contestant),
    })
}

pub fn ito_taylor(contestant: &str, inputs: &Inputs) -> Result<Entry<'static>, Failure> {
    let rows = inputs.csv("space_fast")?;
    let root = SrCdCkf { substeps: 8, ..Default::default() };
    let cov = CdCkf { substeps: 8, ..Default::default() };
    Ok(match contestant {
        "sr-cd-ckf" => single::entry(problem(root, SpaceTurn, 1.0, rows, 10)?)?,
        "cd-ckf" => single::entry(problem(cov, SpaceTurn, 1.0, rows, 10)?)?,
        "sr-cd-ckf packs" => packs::entry::<f64, _, _, _>(problem(root, SpaceTurn, 1.0, rows, 10)?)?,
        "sr-cd-ckf packs f32" => packs::entry::<f32, _, _, _>(problem(root, SpaceTurn, 1.0, rows, 10)?)?,
        _ => return unknown(contestant),
    })
}

/// The time between rows is nothing: there is nothing to predict.
pub fn updates(contestant: &str, inputs: &Inputs) -> Result<Entry<'static>, Failure> {
    let rows = inputs.csv("space_still")?;
    let root = SrCdCkf { substeps: 8, ..Default::default() };
    Ok(match contestant {
        "sr-ckf" => single::entry(problem(SrCkf::default(), SpaceStep, 0.0, rows, 200)?)?,
        "sr-cd-ckf packs" => packs::entry::<f64, _, _, _>(problem(root, SpaceTurn, 0.0, rows, 200)?)?,
        "sr-cd-ckf packs f32" => packs::entry::<f32, _, _, _>(problem(root, SpaceTurn, 0.0, rows, 200)?)?,
        _ => return unknown(contestant),
    })
}

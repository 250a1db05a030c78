//! W1: one trajectory of 1000 steps; W2: 1000 of 100; W4: one, smoothed.

use super::unknown;
use crate::models::{PlaneRadar, PlaneTurn};
use crate::problem::{Problem, prior};
use crate::{batch, packs, single, smooth};
use core::num::NonZeroUsize;
use givens_contest::{Entry, Failure, Inputs, Table};
use givens_core::filter::{Ckf, SrCkf};

type Plane<X> = Problem<X, PlaneTurn, PlaneRadar>;

/// Its radar's rows; each trajectory has `steps` of them.
pub fn problem<X>(method: X, rows: Table, steps: usize, every: usize) -> Result<Plane<X>, Failure> {
    let mean = [20000.0, 300.0, 20000.0, 0.0, -3.0_f64.to_radians()];
    let prior = prior(&mean, &[100.0, 10.0, 100.0, 10.0, 1e-5])?;
    Ok(Problem { method, model: PlaneTurn, sensor: PlaneRadar, prior, dt: 1.0, rows, steps, every })
}

pub fn one(contestant: &str, inputs: &Inputs) -> Result<Entry<'static>, Failure> {
    let rows = inputs.csv("plane")?;
    Ok(match contestant {
        "sr-ckf" => single::entry(problem(SrCkf::default(), rows, 1000, 10)?)?,
        "ckf" => single::entry(problem(Ckf::default(), rows, 1000, 10)?)?,
        _ => return unknown(contestant),
    })
}

pub fn many(contestant: &str, inputs: &Inputs) -> Result<Entry<'static>, Failure> {
    let rows = inputs.f32("plane_tracks", 2)?;
    Ok(match contestant {
        "sr-ckf" => single::entry(problem(SrCkf::default(), rows, 100, 100)?)?,
        "sr-ckf packs" => packs::entry::<f64, _, _, _>(problem(SrCkf::default(), rows, 100, 100)?)?,
        "sr-ckf batch" => batch::entry(problem(SrCkf::default(), rows, 100, 100)?, NonZeroUsize::MIN)?,
        "sr-ckf packs f32" => packs::entry::<f32, _, _, _>(problem(SrCkf::default(), rows, 100, 100)?)?,
        _ => return unknown(contestant),
    })
}

pub fn smoothed(contestant: &str, inputs: &Inputs) -> Result<Entry<'static>, Failure> {
    let rows = inputs.csv("plane")?;
    Ok(match contestant {
        "sr-ckf" => smooth::entry(problem(SrCkf::default(), rows, 1000, 10)?)?,
        "ckf" => smooth::entry(problem(Ckf::default(), rows, 1000, 10)?)?,
        "sr-ckf packs" => smooth::packed::<f64, _, _, _>(problem(SrCkf::default(), rows, 1000, 10)?)?,
        _ => return unknown(contestant),
    })
}

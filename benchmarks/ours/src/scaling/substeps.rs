//! Against the number of sub-steps between two rows.

use super::study::{Besides, Point, Series, Study};
use crate::models::SpaceTurn;
use crate::workloads::space;
use crate::{packs, single};
use givens_contest::{Failure, Inputs, Table};
use givens_core::filter::{Lskf, Over, SrCdCkf, SrCdCkf2};
use givens_core::ode::Solver;

const SIZES: [usize; 7] = [1, 2, 4, 8, 16, 32, 64];

pub fn study(inputs: &Inputs) -> Result<Study, Failure> {
    let rows = inputs.csv("space_fast")?;
    let ito_taylor = |substeps| SrCdCkf { substeps, ..Default::default() };
    let level_set = |substeps| Lskf { solver: Solver::Rk4, substeps, ..Default::default() };
    let moments = |substeps| SrCdCkf2 { solver: Solver::Rk4, substeps, ..Default::default() };
    let names = [
        ["Itô–Taylor", "Itô–Taylor, packs"],
        ["moments, rk4", "moments, rk4, packs"],
        ["level set, rk4", "level set, rk4, packs"],
    ];
    let mut series = Vec::new();
    series.extend(alone_and_in_packs(names[0], ito_taylor, &rows)?);
    series.extend(alone_and_in_packs(names[1], moments, &rows)?);
    series.extend(alone_and_in_packs(names[2], level_set, &rows)?);
    Ok(Study {
        name: "substeps",
        title: "Against the number of sub-steps",
        about: "The turn in space of P1, seven states, a row every second: prediction in equal sub-steps and update, in square-root form. Itô–Taylor is `sr-cd-ckf` (one sub-step of order 1.5), the moment equations `sr-cd-ckf2`, the level set \
                `lskf`, both by `rk4`. Sub-steps are not worth the same: docs/work-precision.md has what each of them achieves. In packs, the time is that of one track.",
        x: "sub-steps",
        y: "one row",
        wall: false,
        series,
        guides: Vec::new(),
        besides: Besides::Nothing,
    })
}

fn alone_and_in_packs<X: Over<SpaceTurn> + 'static>(
    [alone, packed]: [&'static str; 2],
    method: impl Fn(usize) -> X,
    rows: &Table,
) -> Result<[Series; 2], Failure> {
    let problem = |substeps| space::problem(method(substeps), SpaceTurn, 1.0, rows.clone(), 10);
    let one = |&substeps: &usize| Ok(Point::new(substeps, single::untold(problem(substeps)?)));
    let many =
        |&substeps: &usize| Ok(Point::new(substeps, packs::entry::<f64, _, _, _>(problem(substeps)?)?));
    Ok([
        Series { name: alone, points: SIZES.iter().map(one).collect::<Result<_, Failure>>()? },
        Series { name: packed, points: SIZES.iter().map(many).collect::<Result<_, Failure>>()? },
    ])
}

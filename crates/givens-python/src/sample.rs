//! Whole trajectories drawn from what a smoother knows of them.

use givens::simulate::Stream;
use givens::{Draws, Failure, Samples};
use numpy::{PyArrayDyn, PyReadonlyArrayDyn};
use pyo3::prelude::*;

use crate::choice::Choice;
use crate::crowd::aside;
use crate::errors::{Refusal, Result};
use crate::failure::{At, noted, refusal};
use crate::memory::room;
use crate::model::{Model, Moves};
use crate::numbers::frozen;
use crate::rows::{belief, rows};
use crate::watch::{Watched, detached};

type Numbers<'py> = PyReadonlyArrayDyn<'py, f64>;

/// States of all draws from which the way back, which no signal ends, may take long.
const LONG: usize = 100_000;

/// Draws trajectories jointly, given all rows; see the stub.
#[pyfunction]
#[pyo3(signature = (model, choice, mean, cov, t0, time, z, u=None, *, draws, seed, track=0))]
pub fn sample<'py>(
    py: Python<'py>,
    model: &Model,
    choice: &Choice,
    mean: Numbers<'py>,
    cov: Numbers<'py>,
    t0: Option<f64>,
    time: Numbers<'py>,
    z: Numbers<'py>,
    u: Option<Numbers<'py>>,
    draws: u32,
    seed: u64,
    track: u32,
) -> Result<Bound<'py, PyArrayDyn<f64>>> {
    let choice = choice.0;
    model.serves(&choice)?;
    let prior = belief(model, &mean, &cov)?;
    let data = rows(model, t0, &time, &z, u.as_ref())?;
    let (k, n, count) = (data.len(), model.states(), draws as usize);
    room("n", draws, k.saturating_mul(n).saturating_mul(8).saturating_add(size_of::<Stream>()))?;
    let draws = Draws { count: draws, seed, track };
    let own = model.clone();
    let draw = move || {
        let (rows, t0, sensing) = (Watched(data.rows()), data.start(), &own.sensing);
        match &own.moves {
            Moves::Discrete(moves) => choice.sample(moves, sensing, rows, t0, &prior, draws),
            Moves::Continuous(moves) => choice.sample_continuous(moves, sensing, rows, t0, &prior, draws),
        }
    };
    let drawn = if k.saturating_mul(count.max(1)) >= LONG && !model.needs_python() {
        aside(py, draw)?
    } else {
        match detached(py, draw) {
            (drawn, None) => drawn,
            (Err(Failure { row, error, .. }), Some(raised)) => {
                return Err(noted(py, raised, Some(row), Some(&error)).into());
            }
            (Ok(_), Some(raised)) => return Err(raised.into()),
        }
    };
    let failed = |Failure { row, error, mean, .. }: Failure| -> Refusal {
        refusal(py, model, Some(&choice), &error, At { row: Some(row), mean: &mean })
    };
    let Samples { x, .. } = drawn.map_err(failed)?;
    Ok(frozen(py, x, &[count, k, n])?)
}

//! Trajectories drawn from a model.

use givens::Data;
use givens::filter::{Fault, Gaussian, Quantity, StepError};
use givens::ode::Steps;
use givens::simulate::{Paths, Scheme, Simulation, Stream, simulate as draw, simulate_continuous};
use numpy::{PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::crowd::{each, threads};
use crate::errors::{Input, Refusal, Result};
use crate::failure::{At, refusal};
use crate::memory::room;
use crate::model::{Model, Moves};
use crate::numbers::frozen;
use crate::rows::{belief, rows};
use crate::watch::Watched;

/// What is drawn.
struct Draw<'m> {
    model: &'m Model,
    prior: Gaussian,
    data: Data,
    paths: Paths,
    seed: u64,
    track: u32,
}

impl Draw<'_> {
    fn run(&self, run: u32) -> core::result::Result<Simulation, StepError> {
        let Self { model, prior, data, paths, .. } = self;
        let stream = &mut Stream::new(self.seed, self.track, run);
        let (rows, t0, sensing) = (Watched(data.rows()), data.start(), &model.sensing);
        match &model.moves {
            Moves::Discrete(moves) => draw(moves, sensing, rows, t0, prior, stream),
            Moves::Continuous(moves) => simulate_continuous(moves, sensing, rows, t0, prior, paths, stream),
        }
    }
}

type Arrays<'py> = (Bound<'py, PyArrayDyn<f64>>, Bound<'py, PyArrayDyn<f64>>);

/// Draws states and measurements of `runs` runs; see the stub.
#[pyfunction]
#[pyo3(signature = (model, mean, cov, t0, time, seed, runs=1, *, z=None, u=None, track=0, substeps=16, threads=None, first_run=0))]
pub fn simulate<'py>(
    py: Python<'py>,
    model: &Model,
    mean: PyReadonlyArrayDyn<'py, f64>,
    cov: PyReadonlyArrayDyn<'py, f64>,
    t0: Option<f64>,
    time: PyReadonlyArrayDyn<'py, f64>,
    seed: u64,
    runs: u32,
    z: Option<PyReadonlyArrayDyn<'py, f64>>,
    u: Option<PyReadonlyArrayDyn<'py, f64>>,
    track: u32,
    substeps: usize,
    threads: Option<usize>,
    first_run: u32,
) -> Result<Arrays<'py>> {
    if substeps == 0 {
        return Err(Input::new("substeps", "`substeps` is 0: a gap is at least one step").into());
    }
    let (k, n, d) = (time.len(), model.states(), model.measures());
    let z = z.unwrap_or_else(|| PyArrayDyn::zeros(py, vec![k, d], false).readonly());
    let prior = belief(model, &mean, &cov)?;
    let data = rows(model, t0, &time, &z, u.as_ref())?;
    let scheme = if model.is_smooth() { Scheme::ItoTaylor } else { Scheme::EulerMaruyama };
    let paths = Paths { scheme, steps: Steps::Count(substeps) };
    let draw = Draw { model, prior, data, paths, seed, track };
    // numbers are kept twice while they are put together
    let bytes = k.saturating_mul(n + d).saturating_mul(16).saturating_add(size_of::<Option<Simulation>>());
    room("runs", runs, bytes)?;
    let threads = if model.needs_python() { 1 } else { self::threads(threads)? };
    let drawn = each(py, runs as usize, threads, |run| draw.run(first_run.saturating_add(run as u32)));
    let drawn = drawn.map_err(|ended| ended.raised)?;
    let (mut states, mut measured) = (Vec::new(), Vec::new());
    for one in drawn {
        let one = one.map_err(|error| {
            let at = At { row: Some(error.step), mean: &[] };
            longer(refusal(py, model, None, &error, at), &error, substeps)
        })?;
        states.extend_from_slice(&one.states);
        measured.extend_from_slice(&one.z);
    }
    let runs = runs as usize;
    Ok((frozen(py, states, &[runs, k, n])?, frozen(py, measured, &[runs, k, d])?))
}

/// A drift that ran away has most often been followed in steps that are too long.
fn longer(refusal: Refusal, error: &StepError, substeps: usize) -> Refusal {
    use Quantity::{Drift, DriftDerivative, Estimate};
    match (refusal, error.fault) {
        (
            Refusal::Step(message, _, fields),
            Fault::NotFinite { quantity: Drift | DriftDerivative | Estimate, .. },
        ) => {
            let more = format!(
                "more steps in each gap, substeps=… (it took {substeps}): they must be short against the motion of the drift"
            );
            Refusal::Step(message, Some(more), fields)
        }
        (refusal, _) => refusal,
    }
}

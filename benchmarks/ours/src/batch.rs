//! Many trajectories as a user runs them: `Batch`, with all that its estimates hold.

use crate::VERSION;
use crate::problem::Problem;
use core::num::NonZeroUsize;
use givens::batch::{Batch, Track};
use givens::{Data, Outcome};
use givens_contest::{Entry, Failure, Rows, Table};
use givens_core::filter::Over;
use givens_core::model::Observation;

/// The contestant.
pub fn entry<X, M, H>(problem: Problem<X, M, H>, threads: NonZeroUsize) -> Result<Entry<'static>, Failure>
where
    X: Over<M> + Sync + 'static,
    M: Sync + 'static,
    H: Observation + Sync + 'static,
{
    let tracks = split(&problem.rows, problem.dt, problem.steps)?;
    let batch = Batch { threads: Some(threads), ..Batch::default() };
    let mut told = Rows::every(1);
    run(batch, &problem, &tracks, Some(&mut told));
    Ok(Entry {
        version: VERSION.to_owned(),
        steps: problem.rows.rows(),
        result: told.numbers,
        go: Box::new(move || Ok(run(batch, &problem, &tracks, None))),
    })
}

fn run<X, M, H>(batch: Batch, problem: &Problem<X, M, H>, tracks: &[Data], mut told: Option<&mut Rows>) -> f64
where
    X: Over<M> + Sync,
    M: Sync,
    H: Observation + Sync,
{
    let track = |data| Track::new(&problem.model, &problem.sensor, data, &problem.prior);
    let tracks: Vec<_> = tracks.iter().map(track).collect();
    ends(&batch.run(problem.method, &tracks), &mut told)
}

/// Rows of trajectories, `steps` of each, as tracks.
pub fn split(rows: &Table, dt: f64, steps: usize) -> Result<Vec<Data>, Failure> {
    let mut tracks = Vec::new();
    for first in (0..rows.rows()).step_by(steps) {
        let mut data = Data::new(rows.columns).starting_at(0.0);
        for k in 0..steps {
            data.push(dt * (k + 1) as f64, rows.row(first + k))?;
        }
        tracks.push(data);
    }
    Ok(tracks)
}

/// Reports the last row of each track.
pub fn ends(outcomes: &[Option<Outcome>], told: &mut Option<&mut Rows>) -> f64 {
    let mut end = 0.0;
    for outcome in outcomes.iter().flatten() {
        let est = &outcome.estimates;
        let Some(last) = est.len().checked_sub(1) else { continue };
        end = est.mean(last)[0];
        if let Some(told) = told.as_deref_mut() {
            let (cov, n) = (est.cov(last), est.mean(last).len());
            told.next(est.mean(last).iter().copied(), |i| cov[i * (n + 1)]);
        }
    }
    end
}

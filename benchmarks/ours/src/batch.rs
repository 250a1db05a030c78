//! Many trajectories as a user runs them: `Batch`, with all that its estimates hold, in one thread.

use crate::VERSION;
use crate::problem::Problem;
use core::num::NonZeroUsize;
use givens::Data;
use givens::batch::{Batch, Track};
use givens_contest::{Entry, Failure, Rows};
use givens_core::filter::Over;
use givens_core::model::Observation;

/// The contestant.
pub fn entry<X, M, H>(problem: Problem<X, M, H>) -> Result<Entry<'static>, Failure>
where
    X: Over<M> + Sync + 'static,
    M: Sync + 'static,
    H: Observation + Sync + 'static,
{
    let mut tracks = Vec::new();
    for track in 0..problem.tracks() {
        let mut data = Data::new(problem.sensor.measures()).starting_at(0.0);
        for k in 0..problem.steps {
            data.push(problem.dt * (k + 1) as f64, problem.rows.row(track * problem.steps + k))?;
        }
        tracks.push(data);
    }
    let mut told = Rows::every(1);
    run(&problem, &tracks, Some(&mut told));
    Ok(Entry {
        version: VERSION.to_owned(),
        steps: problem.rows.rows(),
        result: told.numbers,
        go: Box::new(move || Ok(run(&problem, &tracks, None))),
    })
}

fn run<X, M, H>(problem: &Problem<X, M, H>, tracks: &[Data], mut told: Option<&mut Rows>) -> f64
where
    X: Over<M> + Sync,
    M: Sync,
    H: Observation + Sync,
{
    let track = |data| Track::new(&problem.model, &problem.sensor, data, &problem.prior);
    let tracks: Vec<_> = tracks.iter().map(track).collect();
    let batch = Batch { threads: Some(NonZeroUsize::MIN), ..Batch::default() };
    let mut last = 0.0;
    for outcome in batch.run(problem.method, &tracks).into_iter().flatten() {
        let est = outcome.estimates;
        let (k, n) = (est.len() - 1, problem.prior.mean().len());
        last = est.mean(k)[0];
        if let Some(told) = told.as_deref_mut() {
            let cov = est.cov(k);
            told.next(est.mean(k).iter().copied(), |i| cov[i * (n + 1)]);
        }
    }
    last
}

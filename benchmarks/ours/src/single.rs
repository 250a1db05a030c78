//! One filter at a time, by hand: predict, update, in memory that is laid out once.

use crate::VERSION;
use crate::problem::{self, Problem};
use givens_contest::{Entry, Failure, Rows};
use givens_core::filter::{Filter, Over};
use givens_core::model::Observation;
use givens_core::rule::Rule;

struct Single<X, M, H> {
    problem: Problem<X, M, H>,
    memory: Vec<f64>,
}

/// The contestant: every trajectory of the problem, one after the other.
pub fn entry<X, M, H>(problem: Problem<X, M, H>) -> Result<Entry<'static>, Failure>
where
    X: Over<M> + 'static,
    M: 'static,
    H: Observation + 'static,
{
    let mut told = Rows::every(problem.every);
    let mut single = Single { problem, memory: Vec::new() };
    single.run(Some(&mut told))?;
    Ok(Entry { result: told.numbers, ..untold(single.problem) })
}

/// The same, with nothing told of its result.
pub fn untold<X, M, H>(problem: Problem<X, M, H>) -> Entry<'static>
where
    X: Over<M> + 'static,
    M: 'static,
    H: Observation + 'static,
{
    let steps = problem.rows.rows();
    let mut single = Single { problem, memory: Vec::new() };
    Entry { version: VERSION.to_owned(), steps, result: Vec::new(), go: Box::new(move || single.run(None)) }
}

impl<X: Over<M>, M, H: Observation> Single<X, M, H> {
    fn run(&mut self, mut told: Option<&mut Rows>) -> Result<f64, Failure> {
        let Problem { method, ref model, ref sensor, ref rows, dt, steps, .. } = self.problem;
        let n = self.problem.prior.mean().len();
        let sizes = problem::sizes(&method, model)?.with_sensor(sensor, method.rule().shape(n));
        let len = Filter::<X, M, f64, &mut [f64]>::memory_len(&method, sizes, false);
        self.memory.resize(len, 0.0);
        let mut last = 0.0;
        for track in 0..self.problem.tracks() {
            let memory = self.memory.as_mut_slice();
            let mut f = Filter::start_in(method, model, sizes, false, self.problem.start(), memory)?;
            for k in 0..steps {
                f.predict(dt * (k + 1) as f64)?;
                f.update(sensor, rows.row(track * steps + k))?;
                if let Some(told) = told.as_deref_mut() {
                    let mut cov = vec![0.0; n * n];
                    f.write_cov(&mut cov);
                    told.next(f.mean().iter().copied(), |i| cov[i * (n + 1)]);
                }
            }
            last = f.mean()[0];
        }
        Ok(last)
    }
}

//! A filter and the way back over its record.

use crate::VERSION;
use crate::packs::vectors;
use crate::problem::{self, Problem};
use core::marker::PhantomData;
use givens_contest::{Entry, Failure, Rows};
use givens_core::filter::{Filter, Form, Method, Over};
use givens_core::model::Observation;
use givens_core::rule::Rule;
use givens_core::scalar::{Element, Job, LaneMask, MAX_WIDTH, Mask, Pack, Real};
use givens_core::smoother::{History, Smoothed};

/// The contestant: one trajectory at a time.
pub fn entry<X, M, H>(problem: Problem<X, M, H>) -> Result<Entry<'static>, Failure>
where
    X: Over<M> + 'static,
    M: 'static,
    H: Observation + 'static,
{
    let mut told = Rows::every(problem.every);
    single(&problem, &mut Vec::new(), Some(&mut told))?;
    let mut memory = Vec::new();
    Ok(Entry {
        version: VERSION.to_owned(),
        steps: problem.rows.rows(),
        result: told.numbers,
        go: Box::new(move || single(&problem, &mut memory, None)),
    })
}

fn single<X: Over<M>, M, H: Observation>(
    problem: &Problem<X, M, H>,
    memory: &mut Vec<f64>,
    told: Option<&mut Rows>,
) -> Result<f64, Failure> {
    let Problem { method, ref model, ref sensor, ref rows, dt, .. } = *problem;
    let n = problem.prior.mean().len();
    let sizes = problem::sizes(&method, model)?.with_sensor(sensor, method.rule().shape(n));
    let own = Filter::<X, M, f64, &mut [f64]>::memory_len(&method, sizes, true);
    memory.resize(own + History::<f64, &mut [f64]>::memory_len(n, rows.rows()), 0.0);
    let (own, records) = memory.split_at_mut(own);
    let mut f = Filter::start_in(method, model, sizes, true, problem.start(), own)?;
    let mut history = History::new(n, <X as Method>::Form::SQUARE_ROOT, records);
    for k in 0..rows.rows() {
        history.predict(&mut f, dt * (k + 1) as f64)?;
        f.update(sensor, rows.row(k))?;
    }
    let mut way = Way::new(told.is_some(), 0);
    history.smooth(&f, rows.rows() - 1, |_, smoothed| way.gather(smoothed))?;
    Ok(way.end(told))
}

/// The smoothed beliefs, the latest first, or only the last of them.
struct Way {
    gathering: bool,
    lane: usize,
    beliefs: Vec<(Vec<f64>, Vec<f64>)>,
    last: f64,
}

impl Way {
    fn new(gathering: bool, lane: usize) -> Self {
        Self { gathering, lane, beliefs: Vec::new(), last: 0.0 }
    }

    #[inline(always)]
    fn gather<P: Pack>(&mut self, smoothed: &Smoothed<P>) {
        let (belief, n) = (&smoothed.belief, smoothed.belief.mean.len());
        self.last = belief.mean[0].lane(self.lane).first();
        if self.gathering {
            let number = |x: &P| x.lane(self.lane).first();
            let row = |i: usize| &belief.factor[i * n..(i + 1) * n];
            let variance = |i: usize| row(i).iter().map(|s| number(s) * number(s)).sum();
            self.beliefs.push((belief.mean.iter().map(number).collect(), (0..n).map(variance).collect()));
        }
    }

    fn end(self, told: Option<&mut Rows>) -> f64 {
        if let Some(told) = told {
            for (mean, variances) in self.beliefs.into_iter().rev() {
                told.next(mean, |i| variances[i]);
            }
        }
        self.last
    }
}

/// The contestant: the same trajectory in every lane of a pack; its steps count as many times.
pub fn packed<E: Element, X, M, H>(problem: Problem<X, M, H>) -> Result<Entry<'static>, Failure>
where
    X: Over<M> + 'static,
    M: 'static,
    H: Observation + 'static,
{
    let (set, width) = vectors::<E>()?;
    let mut told = Rows::every(problem.every);
    set.run_in_registers(Packed::<E, _, _, _> { problem: &problem, told: Some(&mut told), of: PhantomData })
        .map_err(|_| "no packs")??;
    Ok(Entry {
        version: format!("{VERSION}, {set:?}, {width} lanes"),
        steps: problem.rows.rows() * width,
        result: told.numbers,
        go: Box::new(move || {
            let job = Packed::<E, _, _, _> { problem: &problem, told: None, of: PhantomData };
            set.run_in_registers(job).map_err(|_| "no packs")?
        }),
    })
}

struct Packed<'a, E, X, M, H> {
    problem: &'a Problem<X, M, H>,
    told: Option<&'a mut Rows>,
    of: PhantomData<E>,
}

impl<E: Element, X: Over<M>, M, H: Observation> Job<E> for Packed<'_, E, X, M, H> {
    type Output = Result<f64, Failure>;

    #[inline(always)]
    fn run<P: Pack<Element = E>>(self) -> Self::Output {
        let Self { problem, told, .. } = self;
        let Problem { method, ref model, ref sensor, ref rows, dt, .. } = *problem;
        let (n, d, steps) = (problem.prior.mean().len(), sensor.measures(), rows.rows());
        let sizes = problem::sizes(&method, model)?.with_sensor_in_lanes(sensor, method.rule().shape(n));
        let mut memory = vec![P::zero(); Filter::<X, M, P, &mut [P]>::memory_len(&method, sizes, true)];
        let mut records = vec![P::zero(); History::<P, &mut [P]>::memory_len(n, steps)];
        let mut spare = vec![P::zero(); Filter::<X, M, P, &mut [P]>::spare_len(n)];
        let mut z = vec![P::zero(); d];
        let mut f = Filter::start_in(method, model, sizes, true, problem.start(), memory.as_mut_slice())?;
        let mut history = History::new(n, X::Form::SQUARE_ROOT, records.as_mut_slice());
        let mut sick = P::Mask::splat(false);
        for k in 0..steps {
            let (from, to) = ([dt * k as f64; MAX_WIDTH], [dt * (k + 1) as f64; MAX_WIDTH]);
            z.iter_mut().zip(rows.row(k)).for_each(|(z, &number)| *z = P::of(number));
            sick = sick | history.predict_lanes(&mut f, &from, &to, &mut spare);
            sick = sick | f.update_lanes(sensor, &to, &z, None);
        }
        if sick.any() {
            return Err(format!("lanes {:b} are sick", sick.bits()).into());
        }
        let mut way = Way::new(told.is_some(), P::WIDTH - 1);
        history.smooth(&f, steps - 1, |_, smoothed| way.gather(smoothed))?;
        Ok(way.end(told))
    }
}

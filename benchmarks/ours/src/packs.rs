//! Trajectories side by side in packs of as many as a vector register holds, by hand: `predict_lanes`, `update_lanes`.

use crate::VERSION;
use crate::problem::{self, Problem};
use core::marker::PhantomData;
use givens_contest::{Entry, Failure, Rows};
use givens_core::filter::{Filter, Over};
use givens_core::model::Observation;
use givens_core::rule::Rule;
use givens_core::scalar::{Element, InstructionSet, Job, LaneMask, MAX_WIDTH, Mask, Pack, Real};

/// The contestant, in the precision `E`: packs of AVX2 or NEON, as in a batch. Of a problem with one trajectory, every lane
/// runs the same; its steps count as many times.
pub fn entry<E: Element, X, M, H>(problem: Problem<X, M, H>) -> Result<Entry<'static>, Failure>
where
    X: Over<M> + 'static,
    M: 'static,
    H: Observation + 'static,
{
    let (set, width) = vectors::<E>()?;
    let mut told = Rows::every(if problem.tracks() == 1 { problem.every } else { 1 });
    let copies = if problem.tracks() == 1 { width } else { 1 };
    set.run_in_registers(Packed::<E, _, _, _> { problem: &problem, told: Some(&mut told), of: PhantomData })
        .map_err(|_| "no packs")??;
    Ok(Entry {
        version: format!("{VERSION}, {set:?}, {width} lanes"),
        steps: problem.rows.rows() * copies,
        result: told.numbers,
        go: Box::new(move || {
            let job = Packed::<E, _, _, _> { problem: &problem, told: None, of: PhantomData };
            set.run_in_registers(job).map_err(|_| "no packs")?
        }),
    })
}

/// The vectors that batches use, and how many lanes they have.
pub fn vectors<E: Element>() -> Result<(InstructionSet, usize), Failure> {
    let set = InstructionSet::best();
    Ok((set, set.run_in_registers::<E, _>(Width).map_err(|_| "no packs")?))
}

struct Width;

impl<E: Element> Job<E> for Width {
    type Output = usize;
    #[inline(always)]
    fn run<P: Pack<Element = E>>(self) -> usize {
        P::WIDTH
    }
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
        let Self { problem, mut told, .. } = self;
        let Problem { method, ref model, ref sensor, ref rows, dt, steps, .. } = *problem;
        let (n, d, tracks) = (problem.prior.mean().len(), sensor.measures(), problem.tracks());
        let sizes = problem::sizes(&method, model)?.with_sensor_in_lanes(sensor, method.rule().shape(n));
        let mut memory = vec![P::zero(); Filter::<X, M, P, &mut [P]>::memory_len(&method, sizes, false)];
        let mut spare = vec![P::zero(); Filter::<X, M, P, &mut [P]>::spare_len(n)];
        let mut z = vec![P::zero(); d];
        let mut last = 0.0;
        for first in (0..tracks).step_by(P::WIDTH) {
            let memory = memory.as_mut_slice();
            let mut f = Filter::start_in(method, model, sizes, false, problem.start(), memory)?;
            let mut sick = P::Mask::splat(false);
            for k in 0..steps {
                let (from, to) = ([dt * k as f64; MAX_WIDTH], [dt * (k + 1) as f64; MAX_WIDTH]);
                for (i, z) in z.iter_mut().enumerate() {
                    let mut lanes = [E::of(0.0); MAX_WIDTH];
                    for (lane, number) in lanes[..P::WIDTH].iter_mut().enumerate() {
                        let track = (first + lane).min(tracks - 1);
                        *number = E::of(rows.values[(track * steps + k) * d + i]);
                    }
                    *z = P::load(&lanes[..P::WIDTH]);
                }
                sick = sick | f.predict_lanes(&from, &to, &mut spare);
                sick = sick | f.update_lanes(sensor, &to, &z, None);
                if let Some(told) = told.as_deref_mut().filter(|_| tracks == 1) {
                    tell(told, &f, 0);
                }
            }
            if sick.any() {
                return Err(format!("lanes {:b} from track {first} are sick", sick.bits()).into());
            }
            if let Some(told) = told.as_deref_mut().filter(|_| tracks > 1) {
                (0..P::WIDTH.min(tracks - first)).for_each(|lane| tell(told, &f, lane));
            }
            last = f.mean()[0].lane(0).first();
        }
        Ok(last)
    }
}

/// Reports one lane of a belief.
fn tell<X: Over<M>, M, P: Pack>(told: &mut Rows, f: &Filter<'_, X, M, P, &mut [P]>, lane: usize) {
    let n = f.mean().len();
    let mut cov = vec![P::zero(); n * n];
    f.write_cov(&mut cov);
    told.next(f.mean().iter().map(|m| m.lane(lane).first()), |i| cov[i * (n + 1)].lane(lane).first());
}

//! Whatever goes wrong in one lane of a pack, at a row of its own: its track fails as it does alone, at the same row and for the
//! same reason, and the others go on.

use crate::packs::{alone, apart, steady};
use givens::batch::{Batch, Track};
use givens::filter::Gaussian;
use givens::model::{At, Noise, Observation, Sde, Transition, Varies};
use givens::scalar::Real;
use givens::{Data, Goal, Outcome};
use givens_tests::choices::choices;

/// What a row's controls make of model and sensor.
const CONTROLS: usize = 6;
/// What scales the first measure, the noise of both, the share of the second state in the second measure, the motion of that
/// state, its noise, and what bends the first measure.
const USUAL: [f64; CONTROLS] = [1.0, 0.3, 1.0, 1.0, 0.2, 0.1];

struct Plant;

impl Plant {
    fn second<T: Real>(at: &At<T>, x: &[T]) -> T {
        at.u[3] * (T::of(0.9) * x[1] - T::of(0.05) * x[0].sin())
    }
}

impl Transition for Plant {
    fn states(&self) -> usize {
        2
    }
    fn controls(&self) -> usize {
        CONTROLS
    }
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        out.copy_from_slice(&[x[0] + T::of(0.1) * x[1], Self::second(at, x)]);
    }
    fn noise(&self) -> Noise {
        Noise::Root(2)
    }
    fn process_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        out.copy_from_slice(&[at.u[4], T::zero(), T::of(0.5) * at.u[4], at.u[4]]);
    }
}

impl Sde for Plant {
    fn states(&self) -> usize {
        2
    }
    fn noises(&self) -> usize {
        2
    }
    fn controls(&self) -> usize {
        CONTROLS
    }
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        dx.copy_from_slice(&[T::of(0.1) * x[1], Self::second(at, x) - x[1]]);
    }
    fn diffusion<T: Real>(&self, at: &At<T>, _: &[T], g: &mut [T]) {
        g.copy_from_slice(&[at.u[4], T::zero(), T::of(0.5) * at.u[4], at.u[4]]);
    }
    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}

struct Eye;

impl Observation for Eye {
    fn states(&self) -> usize {
        2
    }
    fn measures(&self) -> usize {
        2
    }
    fn controls(&self) -> usize {
        CONTROLS
    }
    fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        out.copy_from_slice(&[at.u[0] * (x[0] + at.u[5] * x[1] * x[1]), x[0] + at.u[2] * x[1]]);
    }
    fn noise(&self) -> Noise {
        Noise::Root(2)
    }
    fn measurement_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        out.copy_from_slice(&[at.u[1], T::zero(), T::zero(), at.u[1]]);
    }
}

/// The controls, and the measurement, of a row at which something goes wrong, or nothing.
fn kinds() -> Vec<([f64; CONTROLS], [f64; 2])> {
    let with = |changes: &[(usize, f64)]| {
        let mut u = USUAL;
        changes.iter().for_each(|&(k, x)| u[k] = x);
        (u, [2.0, 1.5])
    };
    vec![
        with(&[]),
        // what is measured overflows, at once or in its square; its noise does
        with(&[(0, 1.7e308)]),
        with(&[(0, 1e170)]),
        with(&[(1, 1e170)]),
        // two measures without noise that say the same; the same with little, and hardly any
        with(&[(1, 0.0), (2, 0.0), (5, 0.0)]),
        with(&[(1, 8e-8), (2, 0.0), (5, 0.0)]),
        with(&[(1, 1e-9), (2, 0.0), (5, 0.0)]),
        // a measure without noise: a state is known exactly
        with(&[(1, 0.0)]),
        // far more bent than the rule can see
        with(&[(5, 300.0)]),
        // the motion overflows, at once or in its square; its noise does
        with(&[(3, 1.7e308)]),
        with(&[(3, 1e170)]),
        with(&[(4, 1e170)]),
        // neither motion nor noise
        with(&[(3, 0.0), (4, 0.0)]),
        // a measurement out of this world, and none of one component
        (USUAL, [1e200, 1.5]),
        (USUAL, [f64::NAN, 1.5]),
    ]
}

/// Three tracks of each kind, that go wrong at rows of their own, so that packs of the next are beside them.
fn tracks() -> Vec<Data> {
    let kinds = kinds();
    let one = |track: usize| {
        let mut data = Data::with_controls(2, CONTROLS).starting_at(0.0);
        for row in 0..8 {
            let (u, z) = if row == 1 + track % 5 { kinds[track % kinds.len()] } else { kinds[0] };
            let own = 0.1 * ((3 * row + track) % 7) as f64;
            data.push_controlled(0.5 * (row + 1) as f64, &[z[0] + own, z[1] - own], &u).unwrap();
        }
        data
    };
    (0..3 * kinds.len()).map(one).collect()
}

/// All tracks by one method.
type Runs<'a> = &'a dyn Fn(&[Track<'_, Plant, Eye>], &Batch) -> Vec<Outcome>;

fn every_lane_is_as_alone(name: &str, data: &[Data], run: Runs<'_>) -> usize {
    let prior = Gaussian::from_std(&[1.0, 2.0], &[0.8, 0.6]).unwrap();
    let tracks: Vec<Track<'_, Plant, Eye>> =
        data.iter().map(|data| Track::new(&Plant, &Eye, data, &prior)).collect();
    let mut failed = 0;
    for goal in [Goal::Filter, Goal::Interval] {
        let expected = run(&tracks, &Batch { goal, ..alone() });
        let found = run(&tracks, &Batch { goal, ..Batch::default() });
        for (k, (found, expected)) in found.iter().zip(&expected).enumerate() {
            let what = format!("{name} {goal:?}, track {k}");
            assert_eq!(format!("{:?}", found.failure), format!("{:?}", expected.failure), "{what}");
            let apart = apart(found, expected);
            assert!(apart < 1e-6, "{what}: {apart:e}");
        }
        failed += expected.iter().filter(|outcome| outcome.failure.is_some()).count();
    }
    failed
}

fn all(outcomes: Vec<Option<Outcome>>) -> Vec<Outcome> {
    outcomes.into_iter().map(Option::unwrap).collect()
}

#[test]
fn what_goes_wrong_in_a_lane_goes_wrong_there_alone_in_every_discrete_method() {
    let data = tracks();
    for (name, choice) in choices(2) {
        let run = |tracks: &[Track<'_, Plant, Eye>], batch: &Batch| all(choice.run_batch(tracks, batch));
        let failed = every_lane_is_as_alone(&name, &data, &run);
        assert!(failed >= 30, "{name}: {failed}");
    }
}

#[test]
fn what_goes_wrong_in_a_lane_goes_wrong_there_alone_in_every_continuous_method() {
    let data = tracks();
    for (name, choice) in steady(2) {
        let run =
            |tracks: &[Track<'_, Plant, Eye>], batch: &Batch| all(choice.run_batch_continuous(tracks, batch));
        let failed = every_lane_is_as_alone(&name, &data, &run);
        assert!(failed >= 30, "{name}: {failed}");
    }
}

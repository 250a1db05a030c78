//! The points of one filter go through a model side by side, in packs, or one by one: the estimates are the same.

use core::any::TypeId;
use givens::filter::{Ckf, Gaussian, Lskf, Over, SrCdCkf, SrCdCkf2, SrCkf, SrUkf};
use givens::model::zoo::{CoordinatedTurn, RangeBearing, Turn3d};
use givens::model::{At, Noise, Observation, Sde, Transition, Varies};
use givens::scalar::Real;

/// The same model, which serves no packs: whatever else it is asked for, it gives NaN.
struct Alone<M>(M);

/// One number, or one with its derivatives.
fn served<T: Real>() -> bool {
    TypeId::of::<T>() == TypeId::of::<f64>() || core::any::type_name::<T>().contains("Dual2<f64>")
}

impl<M: Transition> Transition for Alone<M> {
    fn states(&self) -> usize {
        self.0.states()
    }
    fn serves_packs(&self) -> bool {
        false
    }
    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        self.0.transition(at, x, out);
        if !served::<T>() {
            out.fill(T::of(f64::NAN));
        }
    }
    fn noise(&self) -> Noise {
        self.0.noise()
    }
    fn process_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        self.0.process_noise(at, out);
    }
}

impl<M: Observation> Observation for Alone<M> {
    fn states(&self) -> usize {
        self.0.states()
    }
    fn measures(&self) -> usize {
        self.0.measures()
    }
    fn angle(&self, i: usize) -> Option<f64> {
        self.0.angle(i)
    }
    fn serves_packs(&self) -> bool {
        false
    }
    fn observe<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        self.0.observe(at, x, out);
        if !served::<T>() {
            out.fill(T::of(f64::NAN));
        }
    }
    fn noise(&self) -> Noise {
        self.0.noise()
    }
    fn measurement_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        self.0.measurement_noise(at, out);
    }
}

impl<M: Sde> Sde for Alone<M> {
    fn states(&self) -> usize {
        self.0.states()
    }
    fn noises(&self) -> usize {
        self.0.noises()
    }
    fn serves_packs(&self) -> bool {
        false
    }
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        self.0.drift(at, x, dx);
        if !served::<T>() {
            dx.fill(T::of(f64::NAN));
        }
    }
    fn diffusion<T: Real>(&self, at: &At<T>, x: &[T], g: &mut [T]) {
        self.0.diffusion(at, x, g);
    }
    fn diffusion_varies(&self) -> Varies {
        self.0.diffusion_varies()
    }
}

/// Twenty predictions and updates; mean and factor.
fn estimate<X: Over<M>, M, H: Observation>(
    method: X,
    model: &M,
    sensor: &H,
    prior: &Gaussian,
    z: &[f64],
) -> (Vec<f64>, Vec<f64>) {
    let mut filter = method.start(model, 0.0, prior.clone()).unwrap();
    for k in 1..=20 {
        filter.predict(0.25 * f64::from(k)).unwrap();
        filter.update(sensor, z).unwrap();
    }
    (filter.mean().to_vec(), filter.factor().to_vec())
}

fn agree((mean, factor): &(Vec<f64>, Vec<f64>), other: &(Vec<f64>, Vec<f64>), what: &str) {
    let n = mean.len();
    for i in 0..n {
        let sigma = factor[i * n..(i + 1) * n].iter().map(|s| s * s).sum::<f64>().sqrt();
        assert!((mean[i] - other.0[i]).abs() < 1e-10 * sigma, "{what}: mean {i}");
        for j in 0..n {
            let difference = (factor[i * n + j] - other.1[i * n + j]).abs();
            assert!(difference < 1e-10 * sigma, "{what}: factor {i} {j}");
        }
    }
}

#[test]
fn points_side_by_side_give_what_they_give_one_by_one() {
    let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
    let prior =
        Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01]).unwrap();
    let z = [1700.0, 0.6];
    let (alone, watched) = (Alone(turn), Alone(radar));
    macro_rules! same {
        ($($method:expr),*) => {$(
            let beside = estimate($method, &turn, &radar, &prior, &z);
            agree(&beside, &estimate($method, &alone, &watched, &prior, &z), stringify!($method));
        )*};
    }
    same!(SrCkf::default(), Ckf::default(), SrUkf::default());
}

#[test]
fn drifts_side_by_side_give_what_they_give_one_by_one() {
    struct First;
    impl Observation for First {
        fn states(&self) -> usize {
            7
        }
        fn measures(&self) -> usize {
            1
        }
        fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
            out[0] = (x[0] * x[0] + x[2] * x[2] + x[4] * x[4]).sqrt();
        }
        fn noise(&self) -> Noise {
            Noise::Root(1)
        }
        fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
            out[0] = T::of(50.0);
        }
    }
    let turn = Turn3d::default();
    let prior = Gaussian::from_std(
        &[1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 0.1],
        &[10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 0.01],
    )
    .unwrap();
    macro_rules! same {
        ($($method:expr),*) => {$(
            let beside = estimate($method, &turn, &First, &prior, &[2840.0]);
            let alone = estimate($method, &Alone(turn), &Alone(First), &prior, &[2840.0]);
            agree(&beside, &alone, stringify!($method));
        )*};
    }
    same!(SrCdCkf { substeps: 3, ..SrCdCkf::default() }, SrCdCkf2::default(), Lskf::default());
}

//! Paths of stochastic differential equations: one step by the oracle's numbers, and the strong orders of both schemes, from
//! fine and coarse steps that the same noise drives.
#![allow(clippy::unwrap_used)]

use givens::Data;
use givens::filter::{Fault, Gaussian};
use givens::model::zoo::{Radar3d, Turn3d};
use givens::model::{At, Sde, Varies};
use givens::ode::Steps;
use givens::scalar::Real;
use givens::simulate::{Path, Paths, Scheme, Stream, simulate_continuous};

/// dx = (a x + bend sin 3x) dt + g (1 + rate t) dβ, and a second component that is driven by it.
struct Coupled {
    a: f64,
    bend: f64,
    rate: f64,
}

impl Sde for Coupled {
    fn states(&self) -> usize {
        2
    }
    fn noises(&self) -> usize {
        2
    }
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        dx[0] = T::of(self.a) * x[0] + T::of(self.bend) * (T::of(3.0) * x[0]).sin();
        dx[1] = x[0] - T::of(0.5) * x[1] + (at.t * T::of(2.0)).sin();
    }
    fn diffusion<T: Real>(&self, at: &At<T>, _: &[T], g: &mut [T]) {
        let scale = T::of(0.5) * (T::one() + T::of(self.rate) * at.t);
        g.copy_from_slice(&[scale, T::zero(), T::of(0.2), T::of(0.1)]);
    }
    fn diffusion_varies(&self) -> Varies {
        Varies::WithTime
    }
}

/// The noise of a path over [0, 1] in 2^12 steps, of two components.
struct Noise {
    u1: Vec<[f64; 2]>,
    u2: Vec<[f64; 2]>,
}

const FINE: usize = 1 << 12;

impl Noise {
    fn new(run: u32) -> Self {
        let mut stream = Stream::new(17, 0, run);
        let mut draw = || (0..FINE).map(|_| [stream.normal(), stream.normal()]).collect();
        Self { u1: draw(), u2: draw() }
    }

    /// The path's end in `count` steps of the same noise: w and y of a coarse step are those of its fine ones, joined.
    fn end<M: Sde>(&self, model: &M, scheme: Scheme, count: usize) -> [f64; 2] {
        let mut path = Path::new(model, Paths { scheme, ..Paths::default() }).unwrap();
        let (joined, fine, dt) = (FINE / count, 1.0 / FINE as f64, 1.0 / count as f64);
        let mut x = [0.7, -0.2];
        for k in 0..count {
            let (mut w, mut y) = ([0.0; 2], [0.0; 2]);
            for (u1, u2) in self.u1.iter().zip(&self.u2).skip(k * joined).take(joined) {
                for j in 0..2 {
                    y[j] += w[j] * fine + 0.5 * fine.powf(1.5) * (u1[j] + u2[j] / 3f64.sqrt());
                    w[j] += fine.sqrt() * u1[j];
                }
            }
            let u1 = w.map(|w| w / dt.sqrt());
            let u2: Vec<f64> =
                y.iter().zip(u1).map(|(y, u1)| 3f64.sqrt() * (2.0 * y / dt.powf(1.5) - u1)).collect();
            let at = At { t: k as f64 * dt, dt, u: &[], p: &[] };
            path.step(&at, &mut x, &u1, &u2).unwrap();
        }
        x
    }
}

/// The root of the mean squared distance of the ends in `count` steps from those in fine ones, over 100 paths.
fn strong_error<M: Sde>(model: &M, scheme: Scheme, count: usize) -> f64 {
    let square = |run| {
        let noise = Noise::new(run);
        let (coarse, fine) = (noise.end(model, scheme, count), noise.end(model, Scheme::ItoTaylor, FINE));
        (coarse[0] - fine[0]).powi(2) + (coarse[1] - fine[1]).powi(2)
    };
    ((0..100).map(square).sum::<f64>() / 100.0).sqrt()
}

fn order<M: Sde>(model: &M, scheme: Scheme) -> f64 {
    (strong_error(model, scheme, 16) / strong_error(model, scheme, 256)).log2() / 4.0
}

/// The term of order 1.5 is that of ∂²f, so that a linear drift has order 2.
#[test]
fn the_schemes_have_their_strong_orders() {
    let ornstein_uhlenbeck = Coupled { a: -0.8, bend: 0.0, rate: 0.0 };
    let growing = Coupled { a: 0.6, bend: 0.0, rate: 0.0 };
    let nonlinear = Coupled { a: 0.0, bend: 0.4, rate: 0.0 };
    let by_time = Coupled { a: 0.0, bend: 0.4, rate: 1.0 };
    for (name, model, expected) in [
        ("Ornstein-Uhlenbeck", ornstein_uhlenbeck, 2.0),
        ("growing", growing, 2.0),
        ("nonlinear", nonlinear, 1.5),
        ("diffusion by time", by_time, 1.5),
    ] {
        let (taylor, euler) = (order(&model, Scheme::ItoTaylor), order(&model, Scheme::EulerMaruyama));
        assert!((taylor - expected).abs() < 0.15, "{name}: {taylor}");
        assert!((euler - 1.0).abs() < 0.15, "{name}: {euler}");
    }
}

/// Of the Ornstein–Uhlenbeck process the end is known: e^(a t) x₀ + ∫ e^(a (t − s)) g dβ.
#[test]
fn fine_paths_end_where_the_solution_does() {
    let (a, model) = (-0.8, Coupled { a: -0.8, bend: 0.0, rate: 0.0 });
    for run in 0..20 {
        let noise = Noise::new(run);
        let fine = 1.0 / FINE as f64;
        let mut x = f64::exp(a) * 0.7;
        for (k, (u1, u2)) in noise.u1.iter().zip(&noise.u2).enumerate() {
            let w = fine.sqrt() * u1[0];
            let y = 0.5 * fine.powf(1.5) * (u1[0] + u2[0] / 3f64.sqrt());
            // over a fine step e^(a (t − s)) is linear to δ²
            x += 0.5 * f64::exp(a * (1.0 - (k + 1) as f64 * fine)) * (w + a * y);
        }
        let end = noise.end(&model, Scheme::ItoTaylor, 256);
        assert!((end[0] - x).abs() < 1e-4, "{} and {x}", end[0]);
    }
}

#[test]
fn simulated_moments_are_those_of_the_process() {
    let (model, radar) = (Coupled { a: -0.8, bend: 0.0, rate: 0.0 }, First);
    let prior = Gaussian::from_std(&[0.7, -0.2], &[0.1, 0.0]).unwrap();
    let mut times = Data::new(1).starting_at(0.0);
    times.push(1.5, &[f64::NAN]).unwrap();
    let runs = 4000;
    let end = |run| {
        let stream = &mut Stream::new(3, 0, run);
        let drawn = simulate_continuous(&model, &radar, times.rows(), 0.0, &prior, &Paths::default(), stream)
            .unwrap();
        drawn.states[0]
    };
    let ends: Vec<f64> = (0..runs).map(end).collect();
    let mean = ends.iter().sum::<f64>() / f64::from(runs);
    let variance = ends.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / f64::from(runs);
    let decay = f64::exp(-1.2);
    let expected = decay * decay * 0.01 + 0.25 * (1.0 - decay * decay) / 1.6;
    let std = (expected / f64::from(runs)).sqrt();
    assert!((mean - decay * 0.7).abs() < 4.0 * std, "{mean}");
    assert!((variance / expected - 1.0).abs() < 4.0 * (2.0 / f64::from(runs)).sqrt(), "{variance}");
}

/// Measures the first component, without noise.
struct First;

impl givens::model::Observation for First {
    fn states(&self) -> usize {
        2
    }
    fn measures(&self) -> usize {
        1
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], z: &mut [T]) {
        z[0] = x[0];
    }
    fn noise(&self) -> givens::model::Noise {
        givens::model::Noise::Root(0)
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, _: &mut [T]) {}
}

#[test]
fn equal_streams_draw_equal_paths_and_steps_may_be_given_by_length() {
    let (turn, radar) = (Turn3d::default(), Radar3d::default());
    let mean = [1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 0.1];
    let prior = Gaussian::from_std(&mean, &[1.0; 7]).unwrap();
    let mut times = Data::new(3).starting_at(0.0);
    for time in [0.0, 0.5, 2.0, 2.0, 3.5] {
        times.push(time, &[0.0; 3]).unwrap();
    }
    let draw = |run, steps| {
        let paths = Paths { scheme: Scheme::ItoTaylor, steps };
        let stream = &mut Stream::new(1, 0, run);
        simulate_continuous(&turn, &radar, times.rows(), 0.0, &prior, &paths, stream).unwrap()
    };
    let (count, longest) = (Steps::Count(16), Steps::Longest(0.1));
    assert_eq!(draw(0, count), draw(0, count));
    assert_ne!(draw(0, count), draw(1, count));
    assert_eq!(draw(0, longest).time, [0.0, 0.5, 2.0, 2.0, 3.5]);
    assert_eq!(draw(0, longest).states[14..21], draw(0, longest).states[21..28]);
}

/// dx = x dβ.
struct Multiplied;

impl Sde for Multiplied {
    fn states(&self) -> usize {
        1
    }
    fn noises(&self) -> usize {
        1
    }
    fn drift<T: Real>(&self, _: &At<T>, _: &[T], dx: &mut [T]) {
        dx[0] = T::zero();
    }
    fn diffusion<T: Real>(&self, _: &At<T>, x: &[T], g: &mut [T]) {
        g[0] = x[0];
    }
    fn diffusion_varies(&self) -> Varies {
        Varies::WithState
    }
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let paths = |scheme, steps| Paths { scheme, steps };
    let of = |scheme, steps| Path::new(&Multiplied, paths(scheme, steps)).map(|_| ());
    assert!(matches!(of(Scheme::ItoTaylor, Steps::Count(4)), Err(Fault::Mismatch { .. })));
    assert!(of(Scheme::EulerMaruyama, Steps::Count(4)).is_ok());
    for steps in [Steps::Count(0), Steps::Longest(0.0), Steps::Longest(f64::NAN)] {
        assert!(matches!(of(Scheme::EulerMaruyama, steps), Err(Fault::Option(_))));
    }
    let mut path = Path::new(&Multiplied, paths(Scheme::EulerMaruyama, Steps::Count(1))).unwrap();
    let at = At { t: 0.0, dt: 0.1, u: &[], p: &[] };
    assert!(matches!(path.step(&at, &mut [1.0], &[], &[]), Err(Fault::Length { of: "u1", .. })));
    assert!(matches!(path.step(&at, &mut [f64::NAN], &[0.0], &[0.0]), Err(Fault::NotFinite { .. })));
}

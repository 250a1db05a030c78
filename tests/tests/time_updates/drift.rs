//! Random nonlinear drifts whose degree is known, and what the methods make of them. But for the last kind, x · f does not
//! grow faster than |x|²: neither a state nor the moments of one run away in a finite time.

use givens::filter::Gaussian;
use givens::model::{At, Sde, Varies};
use givens::registry::{Choice, Setting, resolve};
use givens::scalar::Real;
use givens::{Estimates, Goal, Row};
use givens_tests::models::{Normals, Sensor};
use givens_tests::{cov_error, mean_error, worst};
use nalgebra::DMatrix;

/// How a drift departs from a linear one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// (c · x) (B − Bᵀ) x, c the first row of C; x²/5 of a single state.
    Quadratic,
    /// The last state times a rotation of the others, as in a turn: products of two states, and no squares. Nothing of
    /// fewer than three states.
    Bilinear,
    /// −Bᵀ (B x)³, the cube of every component.
    Cubic,
    /// sin (B x)_i + cos (C x)_i.
    Trigonometric,
    /// (B x)_i².
    Square,
}

/// Those beyond quadratic.
pub const STEEP: [Kind; 2] = [Kind::Cubic, Kind::Trigonometric];
/// Those at most quadratic.
pub const FLAT: [Kind; 2] = [Kind::Quadratic, Kind::Bilinear];

/// dx = (A x + bend × that) dt + G dβ.
#[derive(Clone, Debug)]
pub struct Drift {
    pub kind: Kind,
    pub a: DMatrix<f64>,
    pub b: DMatrix<f64>,
    pub c: DMatrix<f64>,
    pub g: DMatrix<f64>,
    pub bend: f64,
}

fn row<T: Real>(matrix: &DMatrix<f64>, i: usize, x: &[T]) -> T {
    x.iter().enumerate().fold(T::zero(), |sum, (j, &x)| T::of(matrix[(i, j)]).mul_add(x, sum))
}

impl Sde for Drift {
    fn states(&self) -> usize {
        self.a.nrows()
    }
    fn noises(&self) -> usize {
        self.g.ncols()
    }
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        let last = x.len() - 1;
        let turn = |i: usize, x: &[T]| {
            x.iter()
                .enumerate()
                .fold(T::zero(), |sum, (j, &x)| T::of(self.b[(i, j)] - self.b[(j, i)]).mul_add(x, sum))
        };
        for (i, dx) in dx.iter_mut().enumerate() {
            let b = row(&self.b, i, x);
            let far = match self.kind {
                Kind::Quadratic if last == 0 => T::of(0.2) * x[0] * x[0],
                Kind::Quadratic => row(&self.c, 0, x) * turn(i, x),
                Kind::Bilinear if i < last => x[last] * turn(i, &x[..last]),
                Kind::Bilinear => T::zero(),
                Kind::Cubic => (0..=last).fold(T::zero(), |sum, k| {
                    let b = row(&self.b, k, x);
                    sum - T::of(self.b[(k, i)]) * b * b * b
                }),
                Kind::Trigonometric => b.sin() + row(&self.c, i, x).cos(),
                Kind::Square => b * b,
            };
            *dx = T::of(self.bend).mul_add(far, row(&self.a, i, x));
        }
    }
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        let q = self.g.ncols();
        g.iter_mut().enumerate().for_each(|(at, g)| *g = T::of(self.g[(at / q, at % q)]));
    }
    fn diffusion_varies(&self) -> Varies {
        Varies::Never
    }
}

/// A model, a sensor, a prior at time 0, and measurements.
#[derive(Clone, Debug)]
pub struct Problem {
    pub model: Drift,
    pub sensor: Sensor,
    pub mean: Vec<f64>,
    pub cov: DMatrix<f64>,
    pub times: Vec<f64>,
    pub z: Vec<Vec<f64>>,
}

impl Problem {
    /// n states, q noises and `rows` rows of one measure 0.3 to 0.7 apart.
    pub fn random(kind: Kind, seed: u64, n: usize, q: usize, rows: usize) -> Self {
        let mut normals = Normals::new(seed);
        let scale = (n as f64).sqrt();
        let mut square = || normals.matrix(n, n) / scale;
        let (a, b, c) = (square() * 0.5 - DMatrix::identity(n, n) * 0.5, square(), square());
        let model = Drift { kind, a, b, c, g: normals.matrix(n, q) * 0.3, bend: 0.4 };
        let sensor = Sensor {
            h: normals.matrix(1, n),
            g: normals.matrix(1, n),
            bend: 0.0,
            r: DMatrix::from_element(1, 1, 0.1),
        };
        let mean: Vec<f64> = normals.vector(n).iter().map(|x| 0.5 * x).collect();
        let cov = normals.covariance(n, n) * 0.2;
        let times = (1..=rows).map(|k| 0.5 * k as f64 - if k % 2 == 0 { 0.1 } else { 0.2 }).collect();
        let z = (0..rows).map(|_| vec![0.5 * normals.vector(1)[0]]).collect();
        Self { model, sensor, mean, cov, times, z }
    }

    /// The whole run of a filter.
    pub fn run(&self, choice: &Choice) -> Estimates {
        let prior = Gaussian::from_cov(&self.mean, self.cov.as_slice()).unwrap();
        let rows = self.times.iter().zip(&self.z).map(|(&time, z)| Row { time, z, u: &[] });
        choice
            .run_continuous(&self.model, &self.sensor, rows, 0.0, &prior, Goal::Filter, &[])
            .into_result()
            .unwrap_or_else(|failure| panic!("{choice:?}: {failure}"))
    }

    /// The mean and covariance predicted for time `t`, without a measurement.
    pub fn predicted(&self, choice: &Choice, t: f64) -> (Vec<f64>, Vec<f64>) {
        let est = Self { times: vec![t], z: vec![vec![f64::NAN]], ..self.clone() }.run(choice);
        (est.mean(0).to_vec(), est.cov(0).to_vec())
    }
}

/// A method of the registry with these settings.
pub fn with(method: &str, settings: &[(&str, &str)]) -> Choice {
    let setting = |&(key, word): &(&str, &str)| Setting { key: key.into(), value: word.into() };
    resolve(method, &settings.iter().map(setting).collect::<Vec<_>>()).unwrap()
}

/// How far apart two beliefs are, in standard deviations of the second.
pub fn apart(a: &(Vec<f64>, Vec<f64>), b: &(Vec<f64>, Vec<f64>)) -> f64 {
    mean_error(&a.0, &b.0, &b.1).max(cov_error(&a.1, &b.1, b.0.len()))
}

/// How far apart the filtered beliefs of two runs are at the times of the first, in standard deviations.
pub fn runs_apart(a: &Estimates, b: &Estimates) -> f64 {
    let row = |k: usize| {
        let at = b.time.iter().position(|&t| t == a.time[k]).unwrap();
        let belief = |est: &Estimates, k: usize| (est.mean(k).to_vec(), est.cov(k).to_vec());
        apart(&belief(b, at), &belief(a, k))
    };
    worst((0..a.len()).map(row))
}

//! Random models and data: linear ones, whose answers are known, and mildly nonlinear ones.

use givens::filter::Gaussian;
use givens::model::{At, Noise, Observation, Transition};
use givens::scalar::Real;
use givens::simulate::{Stream, simulate};
use givens::{Data, Row};
use nalgebra::DMatrix;

/// x' = F x + bend sin(B x) + w, the sine taken of every component.
#[derive(Clone, Debug)]
pub struct Motion {
    /// F.
    pub f: DMatrix<f64>,
    /// B.
    pub b: DMatrix<f64>,
    /// How far from linear; 0 is linear.
    pub bend: f64,
    /// Q.
    pub q: DMatrix<f64>,
}

/// z = H x + bend (G x)² + v, the square taken of every component.
#[derive(Clone, Debug)]
pub struct Sensor {
    /// H.
    pub h: DMatrix<f64>,
    /// G.
    pub g: DMatrix<f64>,
    /// How far from linear; 0 is linear.
    pub bend: f64,
    /// R.
    pub r: DMatrix<f64>,
}

pub(crate) fn row<T: Real>(matrix: &DMatrix<f64>, i: usize, x: &[T]) -> T {
    x.iter().enumerate().fold(T::zero(), |sum, (j, &x)| T::of(matrix[(i, j)]).mul_add(x, sum))
}

/// A symmetric matrix as a model states it.
fn write<T: Real>(matrix: &DMatrix<f64>, out: &mut [T]) {
    out.iter_mut().zip(matrix.iter()).for_each(|(to, &x)| *to = T::of(x));
}

impl Transition for Motion {
    fn states(&self) -> usize {
        self.f.nrows()
    }
    fn transition<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        for (i, out) in out.iter_mut().enumerate() {
            *out = row(&self.f, i, x);
            if self.bend != 0.0 {
                *out += T::of(self.bend) * row(&self.b, i, x).sin();
            }
        }
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn process_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        write(&self.q, out);
    }
}

impl Observation for Sensor {
    fn states(&self) -> usize {
        self.h.ncols()
    }
    fn measures(&self) -> usize {
        self.h.nrows()
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        for (i, out) in out.iter_mut().enumerate() {
            let g = row(&self.g, i, x);
            *out = row(&self.h, i, x) + T::of(self.bend) * g * g;
        }
    }
    fn noise(&self) -> Noise {
        Noise::Covariance
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) {
        write(&self.r, out);
    }
}

impl Sensor {
    /// The sensor of these components alone.
    #[must_use]
    pub fn only(&self, rows: &[usize]) -> Self {
        let pick = |matrix: &DMatrix<f64>| matrix.select_rows(rows);
        Self {
            h: pick(&self.h),
            g: pick(&self.g),
            bend: self.bend,
            r: self.r.select_rows(rows).select_columns(rows),
        }
    }
}

/// A model, a sensor, a prior at time 0, and measurements at times 1, 2, … drawn from them.
#[derive(Clone, Debug)]
pub struct Problem {
    /// How the state moves.
    pub model: Motion,
    /// What is measured.
    pub sensor: Sensor,
    /// The initial mean.
    pub mean: Vec<f64>,
    /// The initial covariance.
    pub cov: DMatrix<f64>,
    /// The measurements, NaN where one is missing.
    pub z: Vec<Vec<f64>>,
}

/// Standard normal numbers.
pub struct Normals(Stream);

impl Normals {
    /// The numbers of a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(Stream::new(seed, 0, 0))
    }
    /// A matrix of them.
    pub fn matrix(&mut self, rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |_, _| self.0.normal())
    }
    /// A covariance of scale about 1, of the given rank; well conditioned if that is full.
    pub fn covariance(&mut self, n: usize, rank: usize) -> DMatrix<f64> {
        let root = self.matrix(n, rank) / (n as f64).sqrt();
        let floor = if rank == n { 0.3 } else { 0.0 };
        let cov = &root * root.transpose() + DMatrix::identity(n, n) * floor;
        (&cov + cov.transpose()) / 2.0
    }
    /// A vector of them.
    pub fn vector(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| self.0.normal()).collect()
    }
}

impl Problem {
    /// A random problem of n states, d measures and `rows` rows; with `bend` 0 it is linear. About every fifth component
    /// is missing.
    #[must_use]
    pub fn random(seed: u64, n: usize, d: usize, rows: usize, bend: f64) -> Self {
        let mut normals = Normals::new(seed);
        // 0.95 times a rotation, in other coordinates: stable, and nothing is forgotten at once
        let turn = normals.matrix(n, n).qr().q();
        let model = Motion {
            f: turn * 0.95,
            b: normals.matrix(n, n) / (n as f64).sqrt(),
            bend,
            q: normals.covariance(n, n) * 0.1,
        };
        let sensor = Sensor {
            h: normals.matrix(d, n),
            g: normals.matrix(d, n) / (n as f64).sqrt(),
            bend,
            r: normals.covariance(d, d) * 0.2,
        };
        let (mean, cov) = (normals.vector(n), normals.covariance(n, n));
        let mut problem = Self { model, sensor, mean, cov, z: Vec::new() };
        problem.draw(seed, rows);
        problem
    }

    /// Draws the measurements anew, after the model has been changed.
    pub fn draw(&mut self, seed: u64, rows: usize) {
        let (d, mut normals) = (self.sensor.measures(), Normals::new(!seed));
        let mut times = Data::new(d);
        for k in 0..rows {
            let there = |x: &f64| if x.abs() > 1.3 { f64::NAN } else { 0.0 };
            let row: Vec<f64> = normals.vector(d).iter().map(there).collect();
            times.push(k as f64 + 1.0, &row).unwrap();
        }
        let stream = &mut Stream::new(seed, 1, 0);
        let drawn = simulate(&self.model, &self.sensor, times.rows(), 0.0, &self.prior(), stream).unwrap();
        self.z = drawn.z.chunks_exact(d).map(<[f64]>::to_vec).collect();
    }

    /// The initial belief.
    #[must_use]
    pub fn prior(&self) -> Gaussian {
        Gaussian::from_cov(&self.mean, self.cov.as_slice()).unwrap()
    }

    /// The rows at times 1, 2, …
    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> + Clone {
        self.z.iter().enumerate().map(|(k, z)| Row { time: k as f64 + 1.0, z, u: &[] })
    }
}

//! Random continuous models and data at irregular times: linear ones, whose answers follow from a matrix exponential, and
//! mildly nonlinear ones.

use crate::exact::{Answer, Moments, kalman_over};
use crate::models::{Normals, Sensor, row};
use givens::filter::Gaussian;
use givens::model::{At, Sde, Varies};
use givens::registry::Choice;
use givens::scalar::Real;
use givens::simulate::{Paths, Stream, simulate_continuous};
use givens::{Data, Goal, Outcome, Row};
use nalgebra::{DMatrix, DVector};

/// dx = (A x + bend sin(B x)) dt + G dβ, the sine taken of every component.
#[derive(Clone, Debug)]
pub struct Flow {
    /// A.
    pub a: DMatrix<f64>,
    /// B.
    pub b: DMatrix<f64>,
    /// How far from linear; 0 is linear.
    pub bend: f64,
    /// G.
    pub g: DMatrix<f64>,
}

impl Sde for Flow {
    fn states(&self) -> usize {
        self.a.nrows()
    }
    fn noises(&self) -> usize {
        self.g.ncols()
    }
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        for (i, dx) in dx.iter_mut().enumerate() {
            *dx = row(&self.a, i, x);
            if self.bend != 0.0 {
                *dx += T::of(self.bend) * row(&self.b, i, x).sin();
            }
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

/// A continuous model, a sensor, a prior at time 0, and measurements drawn from them.
#[derive(Clone, Debug)]
pub struct Continuous {
    /// How the state moves.
    pub model: Flow,
    /// What is measured.
    pub sensor: Sensor,
    /// The initial mean.
    pub mean: Vec<f64>,
    /// The initial covariance.
    pub cov: DMatrix<f64>,
    /// When; the first row stands at the time of the prior.
    pub times: Vec<f64>,
    /// The measurements, NaN where one is missing.
    pub z: Vec<Vec<f64>>,
}

impl Continuous {
    /// A random problem of n states, q noises, d measures and `rows` rows; with `bend` 0 it is linear.
    #[must_use]
    pub fn random(seed: u64, [n, q, d]: [usize; 3], rows: usize, bend: f64) -> Self {
        let mut normals = Normals::new(seed);
        let scale = (n as f64).sqrt();
        // decays slowly, and turns
        let model = Flow {
            a: normals.matrix(n, n) / scale - DMatrix::identity(n, n) * 0.4,
            b: normals.matrix(n, n) / scale,
            bend,
            g: normals.matrix(n, q) * 0.4,
        };
        let sensor = Sensor {
            h: normals.matrix(d, n),
            g: normals.matrix(d, n) / scale,
            bend,
            r: normals.covariance(d, d) * 0.2,
        };
        let (mean, cov) = (normals.vector(n), normals.covariance(n, n));
        let gaps = normals.vector(rows);
        let times = gaps.iter().scan(0.0, |t, gap| {
            let now = *t;
            *t += 0.1 + 0.3 * gap.abs().min(2.0);
            Some(now)
        });
        let times: Vec<f64> = times.collect();
        let mut data = Data::new(d);
        for &time in &times {
            let there = |x: &f64| if x.abs() > 1.3 { f64::NAN } else { 0.0 };
            let row: Vec<f64> = normals.vector(d).iter().map(there).collect();
            data.push(time, &row).unwrap();
        }
        let prior = Gaussian::from_cov(&mean, cov.as_slice()).unwrap();
        let stream = &mut Stream::new(seed, 1, 0);
        let drawn = simulate_continuous(&model, &sensor, data.rows(), 0.0, &prior, &Paths::default(), stream)
            .unwrap();
        let z = drawn.z.chunks_exact(d).map(<[f64]>::to_vec).collect();
        Self { model, sensor, mean, cov, times, z }
    }

    /// The initial belief.
    #[must_use]
    pub fn prior(&self) -> Gaussian {
        Gaussian::from_cov(&self.mean, self.cov.as_slice()).unwrap()
    }

    /// The rows.
    pub fn rows(&self) -> impl Iterator<Item = Row<'_>> + Clone {
        self.times.iter().zip(&self.z).map(|(&time, z)| Row { time, z, u: &[] })
    }

    /// A method over all rows.
    #[must_use]
    pub fn run(&self, choice: &Choice, goal: Goal) -> Outcome {
        choice.run_continuous(&self.model, &self.sensor, self.rows(), 0.0, &self.prior(), goal, &[])
    }

    /// What the linear problem's filter and smoother should find.
    #[must_use]
    pub fn exact(&self) -> Answer {
        kalman_over(self.moments(), &self.steps(), &self.sensor, &self.z)
    }

    /// The initial belief as moments.
    #[must_use]
    pub fn moments(&self) -> Moments {
        (DVector::from_vec(self.mean.clone()), self.cov.clone())
    }

    /// F and Q of the linear problem over the gap before each row.
    #[must_use]
    pub fn steps(&self) -> Vec<(DMatrix<f64>, DMatrix<f64>)> {
        assert_eq!(self.model.bend, 0.0);
        let before = [0.0].iter().chain(&self.times);
        let gaps = self.times.iter().zip(before).map(|(t, before)| t - before);
        gaps.map(|gap| discretised(&self.model.a, &self.model.g, gap)).collect()
    }
}

/// Φ = exp(A t) and Q = ∫ exp(A s) G Gᵀ exp(A s)ᵀ ds over [0, t], by one matrix exponential (Van Loan's).
#[must_use]
pub fn discretised(a: &DMatrix<f64>, g: &DMatrix<f64>, t: f64) -> (DMatrix<f64>, DMatrix<f64>) {
    let n = a.nrows();
    let mut block = DMatrix::zeros(2 * n, 2 * n);
    block.view_mut((0, 0), (n, n)).copy_from(&(-a));
    block.view_mut((0, n), (n, n)).copy_from(&(g * g.transpose()));
    block.view_mut((n, n), (n, n)).copy_from(&a.transpose());
    let exp = (block * t).exp();
    let phi = exp.view((n, n), (n, n)).transpose();
    let q = &phi * exp.view((0, n), (n, n));
    (phi, (&q + q.transpose()) / 2.0)
}

//! The answers of linear problems, by plain matrix algebra and by three roads that have nothing in common: the Kalman
//! filter with the Rauch–Tung–Striebel smoother, stacked least squares, and conditioning of one large Gaussian.

use crate::models::{Problem, Sensor};
use nalgebra::{DMatrix, DVector};

/// A mean and a covariance.
pub type Moments = (DVector<f64>, DMatrix<f64>);

/// What a filter and a smoother should find, row by row.
pub struct Answer {
    /// Before each row's measurement.
    pub predicted: Vec<Moments>,
    /// After it.
    pub filtered: Vec<Moments>,
    /// Given all rows.
    pub smoothed: Vec<Moments>,
    /// Of each row.
    pub log_likelihood: Vec<f64>,
}

/// H, R and z of the components of a row that are there.
fn measured(sensor: &Sensor, z: &[f64]) -> (DMatrix<f64>, DMatrix<f64>, DVector<f64>) {
    let there: Vec<usize> = (0..z.len()).filter(|&i| !z[i].is_nan()).collect();
    let sensor = sensor.only(&there);
    (sensor.h, sensor.r, DVector::from_iterator(there.len(), there.iter().map(|&i| z[i])))
}

/// Of a positive definite matrix.
fn inverse(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    matrix.clone().cholesky().unwrap().inverse()
}

/// What makes noise of this covariance white.
fn white(cov: &DMatrix<f64>) -> DMatrix<f64> {
    let eye = DMatrix::identity(cov.nrows(), cov.nrows());
    cov.clone().cholesky().unwrap().l().solve_lower_triangular(&eye).unwrap()
}

/// ln N(ν; 0, S).
fn log_density(nu: &DVector<f64>, s: &DMatrix<f64>) -> f64 {
    let ln_det = s.clone().symmetric_eigenvalues().iter().map(|x| x.ln()).sum::<f64>();
    -0.5 * ((nu.transpose() * inverse(s) * nu)[(0, 0)]
        + ln_det
        + nu.len() as f64 * std::f64::consts::TAU.ln())
}

/// The Kalman filter and the Rauch–Tung–Striebel smoother.
#[must_use]
pub fn kalman(problem: &Problem) -> Answer {
    let step = (problem.model.f.clone(), problem.model.q.clone());
    let prior = (DVector::from_vec(problem.mean.clone()), problem.cov.clone());
    kalman_over(prior, &vec![step; problem.z.len()], &problem.sensor, &problem.z)
}

impl Problem {
    /// Of a linear problem, the rows whose νᵀ S⁻¹ ν is beyond the quantile of as many degrees of freedom as components are
    /// there, when such rows are not taken in; and how near the nearest of all comes to its quantile, relatively.
    #[must_use]
    pub fn beyond(&self, quantiles: &[f64]) -> (Vec<bool>, f64) {
        let (f, q) = (&self.model.f, &self.model.q);
        let (mut mean, mut cov) = (DVector::from_vec(self.mean.clone()), self.cov.clone());
        let (mut rows, mut margin) = (Vec::new(), f64::INFINITY);
        for z in &self.z {
            (mean, cov) = (f * &mean, f * &cov * f.transpose() + q);
            let (h, r, z) = measured(&self.sensor, z);
            if z.is_empty() {
                rows.push(false);
                continue;
            }
            let (quantile, nu) = (quantiles[z.len() - 1], z - &h * &mean);
            let s = &h * &cov * h.transpose() + r;
            let nis = (nu.transpose() * inverse(&s) * &nu)[(0, 0)];
            margin = margin.min((nis / quantile - 1.0).abs());
            rows.push(nis > quantile);
            if nis <= quantile {
                let gain = &cov * h.transpose() * inverse(&s);
                (mean, cov) = (mean + &gain * nu, &cov - &gain * s * gain.transpose());
            }
        }
        (rows, margin)
    }
}

/// The same over the transition matrix F and the noise covariance Q of each step, after which a row of `z` is measured.
#[must_use]
pub fn kalman_over(
    prior: Moments,
    steps: &[(DMatrix<f64>, DMatrix<f64>)],
    sensor: &Sensor,
    z: &[Vec<f64>],
) -> Answer {
    let (mut predicted, mut filtered, mut log_likelihood) = (Vec::new(), Vec::new(), Vec::new());
    let mut belief = prior;
    for ((f, q), z) in steps.iter().zip(z) {
        let (mean, cov) = (f * &belief.0, f * &belief.1 * f.transpose() + q);
        predicted.push((mean.clone(), cov.clone()));
        let (h, r, z) = measured(sensor, z);
        belief = if z.is_empty() {
            log_likelihood.push(0.0);
            (mean, cov)
        } else {
            let (nu, s) = (z - &h * &mean, &h * &cov * h.transpose() + r);
            let gain = &cov * h.transpose() * inverse(&s);
            log_likelihood.push(log_density(&nu, &s));
            (mean + &gain * nu, &cov - &gain * s * gain.transpose())
        };
        filtered.push(belief.clone());
    }
    let mut smoothed = vec![belief];
    for k in (0..filtered.len() - 1).rev() {
        let ((mean, cov), (m, p), f) = (&filtered[k], &predicted[k + 1], &steps[k + 1].0);
        let gain = cov * f.transpose() * p.clone().pseudo_inverse(1e-12).unwrap();
        let (next_mean, next_cov) = &smoothed[smoothed.len() - 1];
        smoothed.push((mean + &gain * (next_mean - m), cov + &gain * (next_cov - p) * gain.transpose()));
    }
    smoothed.reverse();
    Answer { predicted, filtered, smoothed, log_likelihood }
}

/// All states at once by least squares: the residuals of prior, transitions and measurements, each divided by the root of
/// its covariance, which must have an inverse. The states at times 1, 2, …
#[must_use]
pub fn least_squares(problem: &Problem) -> Vec<Moments> {
    let (n, count) = (problem.mean.len(), problem.z.len());
    let size = n * (count + 1);
    let (mut information, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
    let mut add = |jacobian: DMatrix<f64>, target: DVector<f64>, cov: &DMatrix<f64>| {
        let (jacobian, target) = (white(cov) * jacobian, white(cov) * target);
        information += jacobian.transpose() * &jacobian;
        right += jacobian.transpose() * target;
    };
    let place = |k: usize, block: &DMatrix<f64>| {
        let mut wide = DMatrix::zeros(block.nrows(), size);
        wide.columns_mut(n * k, n).copy_from(block);
        wide
    };
    let eye = DMatrix::identity(n, n);
    add(place(0, &eye), DVector::from_vec(problem.mean.clone()), &problem.cov);
    for k in 0..count {
        add(place(k + 1, &eye) - place(k, &problem.model.f), DVector::zeros(n), &problem.model.q);
        let (h, r, z) = measured(&problem.sensor, &problem.z[k]);
        if !z.is_empty() {
            add(place(k + 1, &h), z, &r);
        }
    }
    let cov = inverse(&information);
    let mean = &cov * right;
    (1..=count).map(|k| pick(&mean, &cov, k, n)).collect()
}

/// The states at times 0, 1, … given the first `until` rows; any covariance may be singular but that of the measurements.
#[must_use]
pub fn conditioned(problem: &Problem, until: usize) -> Vec<Moments> {
    let step = (problem.model.f.clone(), problem.model.q.clone());
    let (n, prior) = (problem.mean.len(), (DVector::from_vec(problem.mean.clone()), problem.cov.clone()));
    let (mean, cov) = jointly(&prior, &vec![step; problem.z.len()], &problem.sensor, &problem.z[..until]);
    (0..=problem.z.len()).map(|k| pick(&mean, &cov, k, n)).collect()
}

/// All states at once, the initial one and that after each of the `steps`, as a linear map A of white noise ξ, which the
/// measurements `z` after the first of them then tell about: least squares of [B; I] ξ = [whitened z; 0] by QR.
#[must_use]
pub fn jointly(
    prior: &Moments,
    steps: &[(DMatrix<f64>, DMatrix<f64>)],
    sensor: &Sensor,
    z: &[Vec<f64>],
) -> Moments {
    let (n, count) = (prior.0.len(), steps.len());
    let size = n * (count + 1);
    let (mut mean, mut a) = (DVector::zeros(size), DMatrix::zeros(size, size));
    mean.rows_mut(0, n).copy_from(&prior.0);
    a.view_mut((0, 0), (n, n)).copy_from(&root(&prior.1));
    for (k, (f, q)) in (1..).zip(steps) {
        let next = f * mean.rows(n * (k - 1), n);
        mean.rows_mut(n * k, n).copy_from(&next);
        let next = f * a.rows(n * (k - 1), n);
        a.rows_mut(n * k, n).copy_from(&next);
        a.view_mut((n * k, n * k), (n, n)).copy_from(&root(q));
    }
    let (mut rows, mut target) = (DMatrix::zeros(0, size), DVector::zeros(0));
    for (k, z) in (1..).zip(z) {
        let (h, r, z) = measured(sensor, z);
        let at = rows.nrows();
        rows = rows.insert_rows(at, z.len(), 0.0);
        target = target.insert_rows(at, z.len(), 0.0);
        let white = white(&r);
        rows.rows_mut(at, z.len()).copy_from(&(&white * &h * a.rows(n * k, n)));
        target.rows_mut(at, z.len()).copy_from(&(white * (z - h * mean.rows(n * k, n))));
    }
    let at = rows.nrows();
    rows = rows.insert_rows(at, size, 0.0);
    rows.view_mut((at, 0), (size, size)).fill_with_identity();
    let qr = rows.qr();
    let x = qr.q().rows(0, at).transpose() * target;
    let upper = qr.r();
    mean += &a * upper.solve_upper_triangular(&x).unwrap();
    let factor = a * upper.solve_upper_triangular(&DMatrix::identity(size, size)).unwrap();
    let cov = &factor * factor.transpose();
    (mean, cov)
}

/// Any root of a covariance that may be singular.
fn root(cov: &DMatrix<f64>) -> DMatrix<f64> {
    let eigen = cov.clone().symmetric_eigen();
    let scales = eigen.eigenvalues.map(|x| x.max(0.0).sqrt());
    eigen.eigenvectors * DMatrix::from_diagonal(&scales)
}

/// State `k` of the stack.
fn pick(mean: &DVector<f64>, cov: &DMatrix<f64>, k: usize, n: usize) -> Moments {
    (mean.rows(n * k, n).into_owned(), cov.view((n * k, n * k), (n, n)).into_owned())
}

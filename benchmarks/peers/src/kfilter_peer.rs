//! kfilter: its unscented filter, with α = 1, β = 0, κ = 0.

use crate::model::Model;
use crate::race::Peer;
use givens_contest::Failure;
use kfilter::measurement::Measurement;
use kfilter::system::{NoInputSystem, System};
use kfilter::ukf::{UKFParameters, UnscentedKalman};
use kfilter::{KalmanFilter, KalmanPredict, KalmanUpdate};
use nalgebra34::{SMatrix, SVector};

pub const VERSION: &str = "kfilter 0.5.1";

/// The transition, and the state that kfilter keeps in it.
pub struct Moving<M, const N: usize> {
    model: M,
    x: SVector<f64, N>,
    q: SMatrix<f64, N, N>,
}

impl<M: Model, const N: usize> System<f64, N, 0> for Moving<M, N> {
    fn covariance(&self) -> &SMatrix<f64, N, N> {
        &self.q
    }
    fn state(&self) -> &SVector<f64, N> {
        &self.x
    }
    fn state_mut(&mut self) -> &mut SVector<f64, N> {
        &mut self.x
    }
}

impl<M: Model, const N: usize> NoInputSystem<f64, N> for Moving<M, N> {
    #[inline]
    fn predict(&self, x: &SVector<f64, N>) -> SVector<f64, N> {
        let mut out = SVector::<f64, N>::zeros();
        self.model.transition(x.as_slice(), out.as_mut_slice());
        out
    }
}

/// A measurement, and what is expected of it.
pub struct Seen<M, const D: usize> {
    model: M,
    z: SVector<f64, D>,
    r: SMatrix<f64, D, D>,
}

impl<M: Model, const N: usize, const D: usize> Measurement<f64, N, D> for Seen<M, D> {
    fn covariance(&self) -> &SMatrix<f64, D, D> {
        &self.r
    }
    fn measurement(&self) -> &SVector<f64, D> {
        &self.z
    }
    fn set_measurement(&mut self, z: SVector<f64, D>) {
        self.z = z;
    }
    #[inline]
    fn predict(&self, x: &SVector<f64, N>) -> SVector<f64, D> {
        let mut out = SVector::<f64, D>::zeros();
        self.model.observe(x.as_slice(), out.as_mut_slice());
        out
    }
}

pub struct Filter<M: Model, const N: usize, const X: usize, const D: usize> {
    filter: UnscentedKalman<f64, N, 0, X, Moving<M, N>>,
    seen: Seen<M, D>,
}

pub fn new<M: Model, const N: usize, const X: usize, const D: usize>(model: M) -> Filter<M, N, X, D> {
    let x = SVector::from_column_slice(&model.mean());
    let system = Moving { model, x, q: SMatrix::from_column_slice(&model.process()) };
    let cov = SMatrix::from_diagonal(&SVector::from_column_slice(&model.variances()));
    let parameters = UKFParameters { alpha: 1.0, beta: 0.0, kappa: 0.0 };
    let r = SMatrix::from_diagonal(&SVector::from_column_slice(&model.measurement()));
    Filter {
        filter: UnscentedKalman::new_custom_with_params(system, cov, parameters),
        seen: Seen { model, z: SVector::zeros(), r },
    }
}

impl<M: Model, const N: usize, const X: usize, const D: usize> Peer for Filter<M, N, X, D> {
    #[inline]
    fn step(&mut self, z: &[f64]) -> Result<(), Failure> {
        self.filter.predict().map_err(|error| format!("{error:?}"))?;
        self.seen.z = SVector::from_column_slice(z);
        self.filter.update(&self.seen).map_err(|error| format!("{error:?}"))?;
        Ok(())
    }

    fn belief(&self) -> (Vec<f64>, Vec<f64>) {
        let (x, p) = (self.filter.state(), self.filter.covariance());
        (x.as_slice().to_vec(), p.diagonal().as_slice().to_vec())
    }

    fn first(&self) -> f64 {
        self.filter.state()[0]
    }
}

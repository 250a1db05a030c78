//! smelly: its unscented filter, of sizes known when it is compiled and when it runs, with α = 1, β = 0, κ = 0.

use crate::model::Model;
use crate::race::Peer;
use givens_contest::Failure;
use nalgebra35::{Const, DMatrix, DVector, DimMin, SMatrix, SVector};
use smelly::{MerweScaledSigmaPoints, SUnscentedKalmanFilter, UnscentedKalmanFilter};

pub const VERSION: &str = "smelly 0.2.0";

fn points() -> MerweScaledSigmaPoints<f64> {
    MerweScaledSigmaPoints::new(1.0, 0.0, 0.0)
}

/// A filter and its model.
pub struct Of<M, F> {
    model: M,
    filter: F,
}

pub fn fixed<M: Model, const N: usize, const D: usize>(model: M) -> Of<M, SUnscentedKalmanFilter<f64, N, D>> {
    let mut filter = SUnscentedKalmanFilter::new(points());
    let diagonal = |of: Vec<f64>| SMatrix::from_diagonal(&SVector::from_column_slice(&of));
    let r = SMatrix::from_diagonal(&SVector::from_column_slice(&model.measurement()));
    let set = filter
        .set_state(SVector::from_column_slice(&model.mean()))
        .and_then(|()| filter.set_covariance(diagonal(model.variances())))
        .and_then(|()| filter.set_process_noise(SMatrix::from_column_slice(&model.process())))
        .and_then(|()| filter.set_measurement_noise(r));
    set.expect("matching sizes");
    Of { model, filter }
}

impl<M: Model, const N: usize, const D: usize> Peer for Of<M, SUnscentedKalmanFilter<f64, N, D>>
where
    Const<D>: DimMin<Const<D>, Output = Const<D>>,
{
    #[inline]
    fn step(&mut self, z: &[f64]) -> Result<(), Failure> {
        let model = self.model;
        self.filter.predict(|x| {
            let mut out = SVector::<f64, N>::zeros();
            model.transition(x.as_slice(), out.as_mut_slice());
            out
        })?;
        self.filter.update(&SVector::from_column_slice(z), |x| {
            let mut out = SVector::<f64, D>::zeros();
            model.observe(x.as_slice(), out.as_mut_slice());
            out
        })?;
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

pub fn dynamic<M: Model>(model: M) -> Of<M, UnscentedKalmanFilter<f64>> {
    let n = model.states();
    let mut filter = UnscentedKalmanFilter::new(n, model.measures(), points());
    let diagonal = |of: Vec<f64>| DMatrix::from_diagonal(&DVector::from_vec(of));
    let set = filter
        .set_state(DVector::from_vec(model.mean()))
        .and_then(|()| filter.set_covariance(diagonal(model.variances())))
        .and_then(|()| filter.set_process_noise(DMatrix::from_vec(n, n, model.process())))
        .and_then(|()| filter.set_measurement_noise(diagonal(model.measurement())));
    set.expect("matching sizes");
    Of { model, filter }
}

impl<M: Model> Peer for Of<M, UnscentedKalmanFilter<f64>> {
    fn step(&mut self, z: &[f64]) -> Result<(), Failure> {
        let model = self.model;
        self.filter.predict(|x| {
            let mut out = DVector::zeros(model.states());
            model.transition(x.as_slice(), out.as_mut_slice());
            out
        })?;
        self.filter.update(&DVector::from_column_slice(z), |x| {
            let mut out = DVector::zeros(model.measures());
            model.observe(x.as_slice(), out.as_mut_slice());
            out
        })?;
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

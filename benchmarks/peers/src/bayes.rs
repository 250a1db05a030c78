//! bayes_estimate: its unscented filter and its square-root one, with α = 1, β = 0.

use crate::model::Model;
use crate::race::Peer;
use bayes_estimate::estimators::unscented::UnscentedState;
use bayes_estimate::estimators::unscented_root::UnscentedRootState;
use bayes_estimate::models::{FunctionalObserver, FunctionalPredictor, KalmanEstimator, KalmanState};
use bayes_estimate::noise::CorrelatedNoise;
use givens_contest::Failure;
use nalgebra35::{Const, DMatrix, DVector, Dyn, SMatrix, SVector};

pub const VERSION: &str = "bayes_estimate 0.20.0";

/// Sizes known when it is compiled.
pub struct Fixed<M, S, const N: usize, const D: usize> {
    model: M,
    state: S,
    process: CorrelatedNoise<f64, Const<N>>,
    measurement: CorrelatedNoise<f64, Const<D>>,
}

fn begun<M: Model, const N: usize>(model: &M) -> KalmanState<f64, Const<N>> {
    KalmanState {
        x: SVector::from_column_slice(&model.mean()),
        X: SMatrix::from_diagonal(&SVector::from_column_slice(&model.variances())),
    }
}

fn with<M: Model, S, const N: usize, const D: usize>(model: M, state: S) -> Fixed<M, S, N, D> {
    let diagonal = SVector::from_column_slice(&model.measurement());
    Fixed {
        model,
        state,
        process: CorrelatedNoise { Q: SMatrix::from_column_slice(&model.process()) },
        measurement: CorrelatedNoise { Q: SMatrix::from_diagonal(&diagonal) },
    }
}

type Plain<M, const N: usize, const D: usize> = Fixed<M, UnscentedState<f64, Const<N>>, N, D>;
type Root<M, const N: usize, const D: usize> = Fixed<M, UnscentedRootState<f64, Const<N>>, N, D>;

pub fn fixed<M: Model, const N: usize, const D: usize>(model: M) -> Plain<M, N, D> {
    let state = UnscentedState::from_kalman_state(begun(&model), 1.0, 0.0);
    with(model, state.expect("a valid prior"))
}

pub fn root<M: Model, const N: usize, const D: usize>(model: M) -> Root<M, N, D> {
    let state = UnscentedRootState::from_kalman_state(begun(&model), 1.0, 0.0);
    with(model, state.expect("a valid prior"))
}

impl<M: Model, S, const N: usize, const D: usize> Peer for Fixed<M, S, N, D>
where
    S: FunctionalPredictor<f64, Const<N>>
        + FunctionalObserver<f64, Const<N>, Const<D>>
        + KalmanEstimator<f64, Const<N>>,
{
    #[inline]
    fn step(&mut self, z: &[f64]) -> Result<(), Failure> {
        let model = self.model;
        let f = |x: &SVector<f64, N>| {
            let mut out = SVector::<f64, N>::zeros();
            model.transition(x.as_slice(), out.as_mut_slice());
            out
        };
        let h = |x: &SVector<f64, N>| {
            let mut out = SVector::<f64, D>::zeros();
            model.observe(x.as_slice(), out.as_mut_slice());
            out
        };
        self.state.predict(f, &self.process)?;
        Ok(self.state.observe(&SVector::from_column_slice(z), h, &self.measurement)?)
    }

    fn belief(&self) -> (Vec<f64>, Vec<f64>) {
        let belief = self.state.kalman_state().expect("a belief");
        (belief.x.as_slice().to_vec(), belief.X.diagonal().as_slice().to_vec())
    }

    fn first(&self) -> f64 {
        self.belief().0[0]
    }
}

/// Sizes known when it runs.
pub struct Dynamic<M> {
    model: M,
    state: UnscentedState<f64, Dyn>,
    process: CorrelatedNoise<f64, Dyn>,
    measurement: CorrelatedNoise<f64, Dyn>,
}

pub fn dynamic<M: Model>(model: M) -> Dynamic<M> {
    let n = model.states();
    let begun = KalmanState {
        x: DVector::from_vec(model.mean()),
        X: DMatrix::from_diagonal(&DVector::from_vec(model.variances())),
    };
    Dynamic {
        model,
        state: UnscentedState::from_kalman_state(begun, 1.0, 0.0).expect("a valid prior"),
        process: CorrelatedNoise { Q: DMatrix::from_vec(n, n, model.process()) },
        measurement: CorrelatedNoise { Q: DMatrix::from_diagonal(&DVector::from_vec(model.measurement())) },
    }
}

impl<M: Model> Peer for Dynamic<M> {
    fn step(&mut self, z: &[f64]) -> Result<(), Failure> {
        let model = self.model;
        let f = |x: &DVector<f64>| {
            let mut out = DVector::zeros(model.states());
            model.transition(x.as_slice(), out.as_mut_slice());
            out
        };
        let h = |x: &DVector<f64>| {
            let mut out = DVector::zeros(model.measures());
            model.observe(x.as_slice(), out.as_mut_slice());
            out
        };
        self.state.predict(f, &self.process)?;
        Ok(self.state.observe(&DVector::from_column_slice(z), h, &self.measurement)?)
    }

    fn belief(&self) -> (Vec<f64>, Vec<f64>) {
        let belief = &self.state.kalman;
        (belief.x.as_slice().to_vec(), belief.X.diagonal().as_slice().to_vec())
    }

    fn first(&self) -> f64 {
        self.state.kalman.x[0]
    }
}

//! numeris: its cubature filter, and its square-root unscented one with α = 1, β = 0, κ = 0.

use crate::model::Model;
use crate::race::Peer;
use givens_contest::Failure;
use numeris::estimate::{Ckf, SrUkf};
use numeris::{Matrix, Vector};

pub const VERSION: &str = "numeris 0.6.0";

fn vector<const N: usize>(of: &[f64]) -> Vector<f64, N> {
    Vector::from_array(core::array::from_fn(|i| of[i]))
}

fn square<const N: usize>(of: &[f64]) -> Matrix<f64, N, N> {
    Matrix::new(core::array::from_fn(|i| core::array::from_fn(|j| of[i * N + j])))
}

fn diagonal<const N: usize>(of: &[f64]) -> Matrix<f64, N, N> {
    Matrix::new(core::array::from_fn(|i| core::array::from_fn(|j| if i == j { of[i] } else { 0.0 })))
}

pub struct Of<M, F, const N: usize, const D: usize> {
    model: M,
    filter: F,
    q: Matrix<f64, N, N>,
    r: Matrix<f64, D, D>,
}

pub fn ckf<M: Model, const N: usize, const D: usize>(model: M) -> Of<M, Ckf<f64, N, D>, N, D> {
    let filter = Ckf::new(vector(&model.mean()), diagonal(&model.variances()));
    Of { model, filter, q: square(&model.process()), r: diagonal(&model.measurement()) }
}

pub fn srukf<M: Model, const N: usize, const D: usize>(model: M) -> Of<M, SrUkf<f64, N, D>, N, D> {
    let roots: Vec<f64> = model.variances().iter().map(|v| v.sqrt()).collect();
    let filter = SrUkf::with_params(vector(&model.mean()), diagonal(&roots), 1.0, 0.0, 0.0);
    Of { model, filter, q: square(&model.process()), r: diagonal(&model.measurement()) }
}

impl<M: Model, F, const N: usize, const D: usize> Of<M, F, N, D> {
    #[inline]
    fn transition(model: M) -> impl Fn(&Vector<f64, N>) -> Vector<f64, N> {
        move |x| {
            let (at, mut out): ([f64; N], _) = (core::array::from_fn(|i| x[i]), [0.0; N]);
            model.transition(&at, &mut out);
            Vector::from_array(out)
        }
    }

    #[inline]
    fn observation(model: M) -> impl Fn(&Vector<f64, N>) -> Vector<f64, D> {
        move |x| {
            let (at, mut out): ([f64; N], _) = (core::array::from_fn(|i| x[i]), [0.0; D]);
            model.observe(&at, &mut out);
            Vector::from_array(out)
        }
    }
}

macro_rules! peer {
    ($filter:ident, |$of:ident, $i:ident| $variance:expr) => {
        impl<M: Model, const N: usize, const D: usize> Peer for Of<M, $filter<f64, N, D>, N, D> {
            #[inline]
            fn step(&mut self, z: &[f64]) -> Result<(), Failure> {
                let told = |error| format!("{error:?}");
                self.filter.predict(Self::transition(self.model), Some(&self.q)).map_err(told)?;
                self.filter.update(&vector(z), Self::observation(self.model), &self.r).map_err(told)?;
                Ok(())
            }

            fn belief(&self) -> (Vec<f64>, Vec<f64>) {
                let $of = &self.filter;
                ((0..N).map(|i| $of.x[i]).collect(), (0..N).map(|$i| $variance).collect())
            }

            fn first(&self) -> f64 {
                self.filter.x[0]
            }
        }
    };
}

peer!(Ckf, |of, i| of.p[(i, i)]);
peer!(SrUkf, |of, i| (0..N).map(|j| of.s[(i, j)] * of.s[(i, j)]).sum());

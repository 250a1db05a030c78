//! ukf: with α = 1, β = 0, κ = 0. One call predicts and updates; model and points are behind pointers.

#![allow(deprecated, reason = "the crate's own interface is of generic-array 0.14")]

use crate::model::Model;
use crate::race::{Peer, entry};
use generic_array::GenericArray;
use generic_array::typenum::{Sum, U1, U5, U7};
use givens_contest::{Entry, Failure, Table};
use nalgebra21::{MatrixN, U2, U3, VectorN};
use ukf::filter::Filter;
use ukf::sigma_points::van_der_merwe;

pub const VERSION: &str = "ukf 0.1.2";

/// The points of n states.
type Points<N> = Sum<Sum<U1, N>, N>;

macro_rules! peer {
    ($name:ident, $n:ident, $dim:ty, $d:ident) => {
        struct $name {
            filter: Filter<$d, $dim, Points<$n>, f64>,
            belief: (VectorN<f64, $dim>, MatrixN<f64, $dim>),
        }

        impl $name {
            fn start<M: Model>(model: M) -> Self {
                let n = model.states();
                let (points, mean_weights, weights): (_, GenericArray<f64, Points<$n>>, _) =
                    van_der_merwe::<$n, $dim, $d>(1.0, 0.0, 0.0, n as f64);
                let f = Box::new(move |x: &VectorN<f64, $dim>| {
                    let mut out = VectorN::<f64, $dim>::zeros();
                    model.transition(x.as_slice(), out.as_mut_slice());
                    out
                });
                let h = Box::new(move |x: &VectorN<f64, $dim>| {
                    let mut out = VectorN::<f64, $d>::zeros();
                    model.observe(x.as_slice(), out.as_mut_slice());
                    out
                });
                let x = VectorN::<f64, $dim>::from_column_slice(&model.mean());
                let variances = VectorN::<f64, $dim>::from_column_slice(&model.variances());
                let p = MatrixN::<f64, $dim>::from_diagonal(&variances);
                let r = VectorN::<f64, $d>::from_column_slice(&model.measurement());
                let r = MatrixN::<f64, $d>::from_diagonal(&r);
                let q = MatrixN::<f64, $dim>::from_column_slice(&model.process());
                let filter = Filter::new(x, p, f, points, mean_weights, weights, r, h, q);
                Self { filter, belief: (x, p) }
            }
        }

        impl Peer for $name {
            #[inline]
            fn step(&mut self, z: &[f64]) -> Result<(), Failure> {
                self.belief = self.filter.run(VectorN::<f64, $d>::from_column_slice(z))?;
                Ok(())
            }

            fn belief(&self) -> (Vec<f64>, Vec<f64>) {
                let (x, p) = &self.belief;
                (x.as_slice().to_vec(), (0..x.len()).map(|i| p[(i, i)]).collect())
            }

            fn first(&self) -> f64 {
                self.belief.0[0]
            }
        }
    };
}

peer!(Five, U5, nalgebra21::U5, U2);
peer!(Seven, U7, nalgebra21::U7, U3);

pub fn of<M: Model>(
    model: M,
    rows: Table,
    steps: usize,
    every: usize,
) -> Result<Option<Entry<'static>>, Failure> {
    match model.states() {
        5 => entry(VERSION, move || Five::start(model), rows, steps, every).map(Some),
        7 => entry(VERSION, move || Seven::start(model), rows, steps, every).map(Some),
        _ => Ok(None),
    }
}

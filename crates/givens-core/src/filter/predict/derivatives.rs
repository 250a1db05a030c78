//! The derivatives of mean and covariance as the three systems state them: a covariance, its triangular root, a free root.

use super::front::Front;
use super::image::{ByRule, Image};
use super::moments::Moments;
use super::packed::{pack, unpack, unpack_symmetric};
use super::velocity::{ByVelocity, Velocity};
use crate::filter::error::Fault;
use crate::kernels::square;
use crate::model::{At, Sde};
use crate::ode::System;
use crate::rule::Cubature3;
use crate::scalar::Real;
use proptest::prelude::*;

/// f_i = a_i · x + far_i, far_i = sin(b_i · x), or (b_i · x)(a_i · x) where it is to be quadratic; G lower triangular.
struct Bent<'a> {
    n: usize,
    numbers: &'a [f64],
    quadratic: bool,
}

impl Bent<'_> {
    fn row<T: Real>(&self, from: usize, x: &[T]) -> T {
        x.iter().zip(&self.numbers[from..]).fold(T::zero(), |sum, (&x, &a)| T::of(a).mul_add(x, sum))
    }
}

impl Sde for Bent<'_> {
    fn states(&self) -> usize {
        self.n
    }
    fn noises(&self) -> usize {
        self.n
    }
    fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
        for (i, dx) in dx.iter_mut().enumerate() {
            let (a, b) = (self.row(4 * i, x), self.row(16 + 4 * i, x));
            *dx = a + if self.quadratic { a * b } else { b.sin() };
        }
    }
    fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
        for i in 0..self.n {
            for j in 0..self.n {
                g[i * self.n + j] = if j > i { T::zero() } else { T::of(self.numbers[32 + 4 * i + j]) };
            }
        }
    }
}

/// y' at y.
fn slope<S: System<Fault = Fault>>(system: &S, y: &[f64]) -> Vec<f64> {
    let mut dy = vec![f64::NAN; system.len()];
    let mut scratch = vec![f64::NAN; system.scratch()];
    let at = At { t: 0.0, dt: 0.0, u: &[], p: &[] };
    system.derivative(&at, &[], y, &mut dy, &mut scratch).unwrap();
    dy
}

/// R' Sᵀ + S R'ᵀ of a root S and its derivative R'.
fn product_rule(n: usize, root: &[f64], rate: &[f64]) -> Vec<f64> {
    let one = |i: usize, j: usize| -> f64 { (0..n).map(|k| rate[i * n + k] * root[j * n + k]).sum() };
    (0..n * n).map(|at| one(at / n, at % n) + one(at % n, at / n)).collect()
}

/// m' and P' by a lower triangular root.
fn by_triangle<I: Image>(image: I, mean: &[f64], s: &[f64]) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let n = mean.len();
    let system = Moments { image, square_root: true, carried: false };
    let mut y = mean.to_vec();
    y.resize(system.len(), 0.0);
    pack(n, s, &mut y[n..]);
    let dy = slope(&system, &y);
    let mut rate = vec![0.0; n * n];
    unpack(n, &dy[n..], &mut rate);
    (dy[..n].to_vec(), product_rule(n, s, &rate), rate)
}

/// m' and P' by the covariance itself.
fn by_covariance<I: Image>(image: I, mean: &[f64], s: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let n = mean.len();
    let system = Moments { image, square_root: false, carried: false };
    let mut cov = vec![0.0; n * n];
    square(&mut cov, n, s, n, n);
    let mut y = mean.to_vec();
    y.resize(system.len(), 0.0);
    pack(n, &cov, &mut y[n..]);
    let dy = slope(&system, &y);
    let mut rate = vec![0.0; n * n];
    unpack_symmetric(n, &dy[n..], &mut rate);
    (dy[..n].to_vec(), rate)
}

/// m' and P' by a root of any shape.
fn by_front<I: Image>(image: I, mean: &[f64], m: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let n = mean.len();
    let dy = slope(&Front { image, carried: false }, &[mean, m].concat());
    (dy[..n].to_vec(), product_rule(n, m, &dy[n..]))
}

fn near(found: &[f64], expected: &[f64]) -> bool {
    let scale = expected.iter().fold(1.0_f64, |scale, x| scale.max(x.abs()));
    found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12 * scale)
}

/// S (c −s; s c) in the first two columns: another root of the same covariance.
fn turned(n: usize, s: &[f64], angle: f64) -> Vec<f64> {
    let (sin, cos) = angle.sin_cos();
    let mut m = s.to_vec();
    for row in m.chunks_exact_mut(n) {
        (row[0], row[1]) = (cos * row[0] + sin * row[1], cos * row[1] - sin * row[0]);
    }
    m
}

fn root(n: usize, numbers: &[f64]) -> Vec<f64> {
    let entry = |(i, j): (usize, usize)| match i.cmp(&j) {
        core::cmp::Ordering::Less => 0.0,
        core::cmp::Ordering::Equal => 0.7 + 0.3 * numbers[48 + i],
        core::cmp::Ordering::Greater => 0.5 * numbers[52 + i + 3 * j],
    };
    (0..n * n).map(|at| entry((at / n, at % n))).collect()
}

proptest! {
    #[test]
    fn the_moment_equations_of_both_forms_and_the_cubature_level_set_are_one_differential_equation(
        n in 1usize..=4, quadratic: bool, numbers in prop::collection::vec(-1.0..1.0, 68),
    ) {
        let model = Bent { n, numbers: &numbers, quadratic };
        let (mean, s) = (&numbers[64..64 + n], root(n, &numbers));
        let rule = ByRule { model: &model, rule: &Cubature3 };
        let velocity = ByVelocity { model: &model, velocity: Velocity::Cubature };
        let (dm, dp, ds) = by_triangle(rule, mean, &s);
        let held = by_triangle(velocity, mean, &s);
        prop_assert!(near(&held.0, &dm) && near(&held.1, &dp) && near(&held.2, &ds), "held triangular");
        // where it starts, M = S, the free root moves the covariance as well, for every drift
        for (found, what) in
            [(by_covariance(rule, mean, &s), "covariance"), (by_front(velocity, mean, &s), "free")]
        {
            prop_assert!(near(&found.0, &dm) && near(&found.1, &dp), "{what}: {found:?}, {dm:?} {dp:?}");
        }
    }

    #[test]
    fn a_turned_root_moves_the_covariance_alike_up_to_quadratic_drifts(
        n in 2usize..=4, angle in 0.3..1.2, numbers in prop::collection::vec(-1.0..1.0, 68),
    ) {
        let model = Bent { n, numbers: &numbers, quadratic: true };
        let (mean, s) = (&numbers[64..64 + n], root(n, &numbers));
        let velocity = ByVelocity { model: &model, velocity: Velocity::Cubature };
        let (dm, dp) = by_front(velocity, mean, &s);
        let (turned_dm, turned_dp) = by_front(velocity, mean, &turned(n, &s, angle));
        prop_assert!(near(&turned_dm, &dm) && near(&turned_dp, &dp));
    }
}

#[test]
fn a_turned_root_moves_the_covariance_otherwise_beyond_them() {
    let numbers: Vec<f64> = (0..68).map(|k| (f64::from(k) * 1.7).sin()).collect();
    let model = Bent { n: 3, numbers: &numbers, quadratic: false };
    let (mean, s) = (&numbers[64..67], root(3, &numbers));
    let velocity = ByVelocity { model: &model, velocity: Velocity::Cubature };
    let (_, dp) = by_front(velocity, mean, &s);
    let (_, turned_dp) = by_front(velocity, mean, &turned(3, &s, 0.7));
    assert!(turned_dp.iter().zip(&dp).any(|(a, b)| (a - b).abs() > 1e-3));
}

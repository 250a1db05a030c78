//! Rules integrate polynomials of a Gaussian to their degree.

use givens::model::{At, AtPoint, Linear, Map, linear_by_duals, linear_scratch};
use givens::rule::{
    CentralDifference, Cubature3, Cubature5, GaussHermite, Rule, Spread, Taylor, Unscented, spread_scratch,
};
use givens::scalar::Real;
use givens_tests::cases;
use givens_tests::models::Normals;
use proptest::prelude::*;

/// Π x_i^e_i, or (c·x)^power where there are coefficients.
enum Polynomial {
    Monomial(Vec<i32>),
    Ridge(Vec<f64>, i32),
}

impl Polynomial {
    fn at<T: Real>(&self, x: &[T]) -> T {
        match self {
            Self::Monomial(exponents) => x.iter().zip(exponents).fold(T::one(), |y, (x, &e)| y * x.powi(e)),
            Self::Ridge(c, power) => {
                x.iter().zip(c).fold(T::zero(), |sum, (&x, &c)| T::of(c).mul_add(x, sum)).powi(*power)
            }
        }
    }
}

impl Map for Polynomial {
    fn outputs(&self) -> usize {
        1
    }
    fn scratch(&self, _: usize) -> usize {
        linear_scratch(8, 1, 0)
    }
    fn points<T: Real>(&self, _: &At<T>, points: usize, x: &[T], out: &mut [T], _: &mut [T]) {
        for (j, image) in out[..points].iter_mut().enumerate() {
            let point: Vec<T> = x.iter().skip(j).step_by(points).copied().collect();
            *image = self.at(&point);
        }
    }
    fn linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        linear_by_duals(1, at, x, s, out, scratch, self);
    }
}

impl AtPoint for Polynomial {
    fn at_point<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        out[0] = self.at(x);
    }
}

/// Mean, variance and covariance with x of a polynomial.
fn moments<R: Rule>(rule: &R, g: &Polynomial, mean: &[f64], factor: &[f64]) -> (f64, f64, Vec<f64>) {
    let n = mean.len();
    rule.check(n).unwrap();
    let shape = rule.shape(n);
    let (mut table, stride) = (vec![0.0; shape.table], n + shape.plus);
    rule.tabulate(n, &mut table);
    let (mut of, mut dev, mut minus) = ([0.0], vec![0.0; stride], vec![0.0; shape.minus]);
    let mut scratch = vec![0.0; spread_scratch(shape, n, 1, g.scratch(shape.points))];
    let mut spread = Spread { mean: &mut of, dev: &mut dev, stride, minus: &mut minus };
    let at = At { t: 0.0, dt: 1.0, u: &[], p: &[] };
    rule.spread(&table, g, &at, mean, factor, &mut spread, &mut scratch);
    let squares = |of: &[f64]| of.iter().map(|x| x * x).sum::<f64>();
    let cross = factor.chunks_exact(n).map(|s| s.iter().zip(&dev).map(|(s, d)| s * d).sum()).collect();
    (of[0], squares(&dev) - squares(&minus), cross)
}

/// E[ξ^e], ξ standard normal.
fn moment(e: i32) -> f64 {
    if e % 2 == 1 { 0.0 } else { (1..e).step_by(2).map(f64::from).product() }
}

/// All exponents of n variables with this sum at most.
fn exponents(n: usize, degree: i32) -> Vec<Vec<i32>> {
    if n == 0 {
        return vec![vec![]];
    }
    let with = |e: i32| exponents(n - 1, degree - e).into_iter().map(move |mut rest| (rest.push(e), rest).1);
    (0..=degree).flat_map(with).collect()
}

fn integrates<R: Rule>(rule: &R, n: usize, exponents: Vec<i32>) -> Result<(), String> {
    let mut eye = vec![0.0; n * n];
    (0..n).for_each(|i| eye[i * (n + 1)] = 1.0);
    let exact: f64 = exponents.iter().map(|&e| moment(e)).product();
    // the terms of the sum are as large as the root mean square
    let size: f64 = exponents.iter().map(|&e| moment(2 * e).sqrt()).product();
    let what = format!("{exponents:?}");
    let (found, ..) = moments(rule, &Polynomial::Monomial(exponents), &vec![0.0; n], &eye);
    if (found - exact).abs() <= 2e-13 * size { Ok(()) } else { Err(format!("{what}: {found} for {exact}")) }
}

fn integrates_degree<R: Rule + std::fmt::Debug>(rule: R, degree: i32) {
    for n in 1..=6 {
        for of in exponents(n, degree) {
            integrates(&rule, n, of).unwrap_or_else(|error| panic!("{rule:?}, n = {n}, {error}"));
        }
    }
}

#[test]
fn every_rule_integrates_the_monomials_of_its_degree() {
    integrates_degree(Taylor, 1);
    integrates_degree(Cubature3, 3);
    integrates_degree(Unscented::default(), 3);
    integrates_degree(Unscented { alpha: 0.5, beta: 2.0, kappa: Some(0.0) }, 3);
    integrates_degree(CentralDifference { eta: 1.0 }, 3);
    integrates_degree(CentralDifference::default(), 3);
    integrates_degree(Cubature5, 5);
}

#[test]
fn gauss_hermite_integrates_degree_two_p_less_one_along_every_axis() {
    let mut normals = Normals::new(1);
    for points in [2usize, 3, 4, 5, 8] {
        for n in (1..=6).filter(|&n| points.pow(n as u32) <= 1100) {
            for _ in 0..40 {
                let draw = |x: f64| (x.abs() * 1e6) as i32 % (2 * points as i32);
                let of = normals.vector(n).into_iter().map(draw).collect();
                let rule = GaussHermite { points };
                integrates(&rule, n, of).unwrap_or_else(|error| panic!("{points} points, n = {n}, {error}"));
            }
        }
    }
}

#[test]
fn an_axis_more_than_the_degree_is_not_claimed() {
    for n in 2..=6 {
        let mut mixed = vec![2, 2];
        mixed.resize(n, 0);
        assert!(integrates(&Cubature3, n, mixed.clone()).is_err(), "n = {n}: x²y² of cubature");
        assert!(integrates(&Cubature5, n, mixed).is_ok());
        let mut fourth = vec![4];
        fourth.resize(n, 0);
        let plain = Unscented::default();
        assert!(integrates(&plain, n, fourth.clone()).is_ok(), "n = {n}: κ = 3 − n is made for x⁴");
        assert!(integrates(&CentralDifference::default(), n, fourth).is_ok(), "n = {n}: so is η = √3");
    }
}

/// Whether a rule is right about (c·x)^power, x ~ N(m, S Sᵀ): its mean, and its covariance with x and variance.
fn ridge<R: Rule>(rule: &R, seed: u64, n: usize, power: i32) -> [bool; 3] {
    let mut normals = Normals::new(seed);
    let (c, mean, factor) =
        (normals.vector(n), normals.vector(n), normals.covariance(n, n).cholesky().unwrap().l());
    let rows: Vec<f64> = factor.transpose().iter().copied().collect();
    let along = factor.transpose() * nalgebra::DVector::from_vec(c.clone());
    let (mu, sigma) = (c.iter().zip(&mean).map(|(c, m)| c * m).sum::<f64>(), along.norm());
    // E[(μ + σξ)^k]
    let raw = |k: i32| {
        let choose = |j: i32| (1..=j).map(|i| f64::from(k - j + i) / f64::from(i)).product::<f64>();
        (0..=k).map(|j| choose(j) * mu.powi(k - j) * sigma.powi(j) * moment(j)).sum::<f64>()
    };
    let size = (mu.abs() + 3.0 * sigma).powi(power);
    let (found, variance, cross) = moments(rule, &Polynomial::Ridge(c, power), &mean, &rows);
    // Stein: cov(x, g) = P E[∇g]
    let expected = &factor * along * (f64::from(power) * raw(power - 1));
    let off = cross.iter().zip(expected.iter()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    let spread = raw(2 * power) - raw(power) * raw(power);
    [
        (found - raw(power)).abs() < 1e-12 * size,
        off < 1e-12 * size * (1.0 + sigma),
        (variance - spread).abs() < 1e-12 * size * size,
    ]
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn rules_are_exact_for_any_gaussian_and_any_direction(seed: u64, n in 1usize..=6) {
        for power in 1..=3 {
            let cubic: [bool; 4] = [
                ridge(&Cubature3, seed, n, power)[0],
                ridge(&Unscented { alpha: 0.7, beta: 1.0, kappa: Some(1.0) }, seed, n, power)[0],
                ridge(&CentralDifference { eta: 1.4 }, seed, n, power)[0],
                ridge(&GaussHermite { points: 2 }, seed, n, power)[0],
            ];
            prop_assert_eq!(cubic, [true; 4], "mean of the power {}", power);
        }
        for power in 1..=2 {
            let cross = [
                ridge(&Cubature3, seed, n, power)[1],
                ridge(&Unscented::default(), seed, n, power)[1],
                ridge(&CentralDifference::default(), seed, n, power)[1],
            ];
            prop_assert_eq!(cross, [true; 3], "covariance with x of the power {}", power);
        }
        for power in 1..=5 {
            let exact = [
                (power <= 5, power <= 4, power <= 2),
                (power <= 5, power <= 4, power <= 2),
            ];
            let found = [ridge(&Cubature5, seed, n, power), ridge(&GaussHermite { points: 3 }, seed, n, power)];
            for ((mean, cross, variance), found) in exact.into_iter().zip(found) {
                prop_assert!(found[0] || !mean, "mean of the power {}", power);
                prop_assert!(found[1] || !cross, "covariance with x of the power {}", power);
                prop_assert!(found[2] || !variance, "variance of the power {}", power);
            }
        }
        for exact in [Taylor, Taylor].map(|rule| ridge(&rule, seed, n, 1)) {
            prop_assert_eq!(exact, [true; 3]);
        }
    }
}

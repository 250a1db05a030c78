//! What is predicted: models of the zoo, from beliefs that are drawn.

use crate::predict::Problem;
use core::f64::consts::PI;
use givens::filter::Gaussian;
use givens::model::zoo::{Lorenz63, Turn3d, VanDerPol};
use givens_tests::models::Normals;

/// A belief with these standard deviations and drawn correlations, its mean drawn about `centre` by them.
fn drawn(seed: u64, centre: &[f64], std: &[f64]) -> Gaussian {
    let (n, mut normals) = (centre.len(), Normals::new(seed));
    let correlated = normals.covariance(n, n);
    let scale = |i: usize| std[i] / correlated[(i, i)].sqrt();
    let cov: Vec<f64> =
        (0..n * n).map(|k| correlated[(k / n, k % n)] * scale(k / n) * scale(k % n)).collect();
    let at = normals.vector(n);
    let mean: Vec<f64> = (0..n).map(|i| std[i].mul_add(at[i], centre[i])).collect();
    Gaussian::from_cov(&mean, &cov).unwrap()
}

/// An aircraft that turns by about 36 degrees.
pub fn turn() -> Problem<Turn3d> {
    let centre = [1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 6.0 * PI / 180.0];
    let std = [100.0, 10.0, 100.0, 10.0, 100.0, 5.0, PI / 180.0];
    Problem {
        name: "turn",
        title: "Coordinated turn, 7 states, 6 s",
        model: Turn3d::default(),
        prior: drawn(1, &centre, &std),
        span: 6.0,
        most: 256,
    }
}

/// About a seventh of a cycle.
pub fn van_der_pol() -> Problem<VanDerPol> {
    Problem {
        name: "van-der-pol",
        title: "Van der Pol, μ = 1, over 1",
        model: VanDerPol { stiffness: 1.0, noise: 0.3 },
        prior: drawn(2, &[2.0, 0.0], &[0.3, 0.3]),
        span: 1.0,
        most: 256,
    }
}

/// On the slow part of the cycle, where v follows x at a rate of about 3 μ.
pub fn stiff(stiffness: f64) -> Problem<VanDerPol> {
    Problem {
        name: "stiff",
        title: "Van der Pol, μ = 1000, over 1",
        model: VanDerPol { stiffness, noise: 0.3 },
        prior: drawn(3, &[2.0, 0.0], &[0.1, 0.1]),
        span: 1.0,
        most: 1 << 14,
    }
}

/// A quarter of the unit of time.
pub fn lorenz() -> Problem<Lorenz63> {
    Problem {
        name: "lorenz",
        title: "Lorenz 1963, over 0.25",
        model: Lorenz63::default(),
        prior: drawn(4, &[1.508_870, -1.531_271, 25.460_91], &[1.0, 1.0, 1.0]),
        span: 0.25,
        most: 256,
    }
}

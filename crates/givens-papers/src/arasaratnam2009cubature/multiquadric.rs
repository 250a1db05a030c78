//! The multi-quadric (1 + xᵀx)^(p/2) of a Gaussian x with mean zero: its moments by sampling and by a rule.

use crate::Trouble;
use givens::kernels::cholesky;
use givens::model::{At, Map, Noise, Observation, Sensed};
use givens::rule::{Rule, Spread, spread_scratch};
use givens::scalar::Real;
use givens::simulate::Stream;

/// The powers p, in the order of all arrays below.
pub(super) const POWERS: [i32; 4] = [1, -1, -3, -5];
/// Samples that the true moments are taken from.
const SAMPLES: usize = 10_000;
/// Samples that are drawn side by side.
const LANES: usize = 8;

/// All four powers of one state, a component each.
struct MultiQuadric {
    states: usize,
}

impl Observation for MultiQuadric {
    fn states(&self) -> usize {
        self.states
    }
    fn measures(&self) -> usize {
        POWERS.len()
    }
    #[inline(always)]
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        let root = x.iter().fold(T::one(), |sum, &x| x.mul_add(x, sum)).sqrt();
        for (out, power) in out.iter_mut().zip(POWERS) {
            *out = root.powi(power);
        }
    }
    fn noise(&self) -> Noise {
        Noise::Root(0)
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, _: &mut [T]) {}
}

/// Mean and variance of y.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Moments {
    pub mean: f64,
    pub variance: f64,
}

impl Moments {
    /// The Kullback–Leibler divergence of the Gaussian with the estimated moments from that with these.
    pub fn divergence(&self, estimate: &Self) -> f64 {
        let ratio = self.variance / estimate.variance;
        let apart = (self.mean - estimate.mean).powi(2) / estimate.variance;
        0.5 * (ratio + apart - 1.0 - ratio.ln())
    }
}

/// The lower Cholesky factor of a random covariance, n × n: the correlation matrix of A Aᵀ, A of standard normal numbers,
/// times `variance`.
pub(super) fn random_root(n: usize, variance: f64, stream: &mut Stream) -> Result<Vec<f64>, Trouble> {
    let a: Vec<f64> = (0..n * n).map(|_| stream.normal()).collect();
    let rows: Vec<&[f64]> = a.chunks_exact(n).collect();
    let dot = |i: usize, j: usize| rows[i].iter().zip(rows[j]).map(|(x, y)| x * y).sum::<f64>();
    let lengths: Vec<f64> = (0..n).map(|i| dot(i, i).sqrt()).collect();
    let mut root = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            let correlation = if i == j { 1.0 } else { dot(i, j) / (lengths[i] * lengths[j]) };
            root[i * n + j] = variance * correlation;
        }
    }
    match cholesky(&mut root, n).failed() {
        None => Ok(root),
        Some(pivot) => {
            Err(format!("a random covariance of {n} dimensions has no root (pivot {})", pivot + 1).into())
        }
    }
}

/// The moments of each power from samples of x = S u.
pub(super) fn sampled(root: &[f64], n: usize, stream: &mut Stream) -> [Moments; 4] {
    let mut u = vec![[0.0; LANES]; n];
    let mut sizes = Vec::with_capacity(SAMPLES);
    for _ in 0..SAMPLES / LANES {
        u.iter_mut().flatten().for_each(|u| *u = stream.normal());
        let mut squares = [1.0; LANES];
        for (i, row) in root.chunks_exact(n).enumerate() {
            let mut x = [0.0; LANES];
            for (s, u) in row[..=i].iter().zip(&u) {
                (0..LANES).for_each(|l| x[l] += s * u[l]);
            }
            (0..LANES).for_each(|l| squares[l] += x[l] * x[l]);
        }
        sizes.extend(squares.map(f64::sqrt));
    }
    POWERS.map(|power| {
        let y = || sizes.iter().map(|size| size.powi(power));
        let mean = y().sum::<f64>() / SAMPLES as f64;
        let variance = y().map(|y| (y - mean).powi(2)).sum::<f64>() / (SAMPLES - 1) as f64;
        Moments { mean, variance }
    })
}

/// The moments of each power by a rule, from N(0, S Sᵀ).
pub(super) fn by_rule<R: Rule>(rule: R, root: &[f64], n: usize) -> [Moments; 4] {
    let (function, shape) = (MultiQuadric { states: n }, rule.shape(n));
    let map = Sensed(&function);
    let (outputs, stride) = (POWERS.len(), n + shape.plus);
    let mut table = vec![0.0; shape.table];
    rule.tabulate(n, &mut table);
    let (mut mean, mut dev, mut minus) =
        (vec![0.0; outputs], vec![0.0; outputs * stride], vec![0.0; outputs * shape.minus]);
    let mut scratch = vec![0.0; spread_scratch(shape, n, outputs, map.scratch(shape.points))];
    let mut out = Spread { mean: &mut mean, dev: &mut dev, stride, minus: &mut minus };
    let at = At { t: 0.0, dt: 0.0, u: &[], p: &[] };
    rule.spread(&table, &map, &at, &vec![0.0; n], root, &mut out, &mut scratch);
    let squares = |row: &[f64]| row.iter().map(|x| x * x).sum::<f64>();
    core::array::from_fn(|i| {
        let taken = squares(&minus[i * shape.minus..(i + 1) * shape.minus]);
        Moments { mean: mean[i], variance: squares(&dev[i * stride..(i + 1) * stride]) - taken }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use givens::rule::{CentralDifference, Cubature3, Taylor, Unscented};

    fn root(n: usize) -> Vec<f64> {
        random_root(n, 1.0, &mut Stream::new(1, 0, 0)).unwrap()
    }

    #[test]
    fn every_diagonal_entry_of_the_covariance_is_the_variance() {
        let (n, root) = (7, random_root(7, 0.3, &mut Stream::new(1, 0, 0)).unwrap());
        for row in root.chunks_exact(n) {
            assert!((row.iter().map(|x| x * x).sum::<f64>() - 0.3).abs() < 1e-14);
        }
    }

    #[test]
    fn in_one_dimension_the_samples_have_the_moments_of_the_chi_distribution() {
        // E √(1 + u²), u standard normal; its square has the mean 2
        let found = sampled(&[1.0], 1, &mut Stream::new(1, 0, 0))[0];
        let exact = quadrature(|u: f64| (1.0 + u * u).sqrt());
        let deviation = (2.0 - exact * exact).sqrt() / 100.0;
        assert!((found.mean - exact).abs() < 4.0 * deviation, "{found:?}, {exact}");
        assert!((found.variance / (2.0 - exact * exact) - 1.0).abs() < 0.1, "{found:?}");
    }

    /// E g(u) by the trapezoidal rule, which is as good as exact here.
    fn quadrature(g: impl Fn(f64) -> f64) -> f64 {
        let density = |u: f64| (-0.5 * u * u).exp() / core::f64::consts::TAU.sqrt();
        (-1000..=1000).map(|k| f64::from(k) * 0.01).map(|u| 0.01 * density(u) * g(u)).sum()
    }

    #[test]
    fn a_taylor_expansion_at_the_summit_finds_no_variance() {
        assert!(by_rule(Taylor, &root(10), 10).iter().all(|m| m.variance == 0.0 && m.mean == 1.0));
    }

    #[test]
    fn the_unscented_transform_finds_a_negative_variance_from_ten_dimensions_on() {
        for n in [10, 30] {
            let moments = by_rule(Unscented::default(), &root(n), n);
            assert!(moments.iter().all(|m| m.variance < 0.0), "{moments:?}");
        }
    }

    #[test]
    fn points_on_one_sphere_see_no_variance() {
        let diagonal = [2.0, 0.0, 0.0, 2.0];
        let moments = by_rule(Cubature3, &diagonal, 2);
        assert!(moments.iter().all(|m| m.variance < 1e-30), "{moments:?}");
        assert!((moments[0].mean - 3.0).abs() < 1e-15);
    }

    #[test]
    fn the_divergence_is_zero_at_the_truth_and_grows_with_the_error() {
        let truth = Moments { mean: 1.0, variance: 2.0 };
        assert_eq!(truth.divergence(&truth), 0.0);
        // ½ (½ + ¼ − 1 + ln 2)
        let wide = Moments { mean: 2.0, variance: 4.0 };
        assert!((truth.divergence(&wide) - 0.5 * (2f64.ln() - 0.25)).abs() < 1e-15);
    }

    #[test]
    fn central_differences_weigh_the_curvature_alone() {
        // one dimension: y₀ = 1, y± = 2 at η = √3: mean 1 + 2/6, variance 2 (2/6)² at standard deviation 1
        let moments = by_rule(CentralDifference::default(), &[1.0], 1)[0];
        assert!((moments.mean - 4.0 / 3.0).abs() < 1e-15, "{moments:?}");
        assert!((moments.variance - 2.0 / 9.0).abs() < 1e-15, "{moments:?}");
    }
}

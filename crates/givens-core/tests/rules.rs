//! What a rule promises beside its degree: its sizes, the range of its options, how far it reaches, and what a rule of one's own
//! may be. Moments are compared with the sums that define them.
#![allow(clippy::unwrap_used, reason = "a test may stop at what it did not expect")]

use core::f64::consts::TAU;
use givens_core::model::{At, Map, Noise, Observation, Sensed};
use givens_core::rule::{
    CentralDifference, Cubature3, Cubature5, GaussHermite, Pairs, PointRule, Rule, Shape, Spread, Taylor,
    Unscented, spread_scratch,
};
use givens_core::scalar::Real;

/// Three components: a cubic, an angle that turns once within the spread, and a constant.
struct Mixed(usize);

impl Observation for Mixed {
    fn states(&self) -> usize {
        self.0
    }
    fn measures(&self) -> usize {
        3
    }
    fn angle(&self, i: usize) -> Option<f64> {
        (i == 1).then_some(TAU)
    }
    fn observe<T: Real>(&self, _: &At<T>, x: &[T], out: &mut [T]) {
        let sum = x.iter().fold(T::zero(), |sum, &x| sum + x);
        out.copy_from_slice(&[sum * sum * sum - x[0], sum.wrap(T::of(TAU)), T::of(7.0)]);
    }
    fn noise(&self) -> Noise {
        Noise::Root(0)
    }
    fn measurement_noise<T: Real>(&self, _: &At<T>, _: &mut [T]) {}
}

/// A rule of one's own: pairs of points on one axis, the last of negative weight, and a centre.
#[derive(Clone, Copy)]
struct Own {
    /// Node and weight of each pair.
    pairs: [(f64, f64); 3],
    centre: f64,
}

/// The weights sum to one, those of ξ² too.
const SIGNED: Own = Own { pairs: [(1.0, 0.5), (2.0, 0.25), (3.0, -1.0 / 9.0)], centre: -5.0 / 18.0 };

impl PointRule for Own {
    fn centre(&self, _: usize) -> Option<f64> {
        Some(self.centre)
    }
    fn pairs(&self, _: usize) -> Pairs {
        Pairs::Table { count: 3, negative: 1 }
    }
    fn pair(&self, l: usize, xi: &mut [f64]) -> f64 {
        xi[0] = self.pairs[l].0;
        self.pairs[l].1
    }
}

/// What a rule answers, and columns of the caller's own behind.
struct Answer {
    mean: Vec<f64>,
    dev: Vec<f64>,
    minus: Vec<f64>,
    stride: usize,
}

const BEYOND: usize = 2;

fn answer<R: Rule>(rule: &R, mean: &[f64], factor: &[f64]) -> Answer {
    let (n, g) = (mean.len(), Mixed(mean.len()));
    let (shape, d) = (rule.shape(n), 3);
    let stride = n + shape.plus + BEYOND;
    let mut table = vec![f64::NAN; shape.table];
    rule.tabulate(n, &mut table);
    let (mut of, mut dev, mut minus) =
        (vec![f64::NAN; d], vec![-1.0; d * stride], vec![f64::NAN; d * shape.minus]);
    let mut scratch = vec![f64::NAN; spread_scratch(shape, n, d, Sensed(&g).scratch(shape.points))];
    let mut spread = Spread { mean: &mut of, dev: &mut dev, stride, minus: &mut minus };
    let at = At { t: 0.0, dt: 1.0, u: &[], p: &[] };
    rule.spread(&table, &Sensed(&g), &at, mean, factor, &mut spread, &mut scratch);
    Answer { mean: of, dev, minus, stride }
}

impl Answer {
    /// The covariance of two components, D Dᵀ + E J Eᵀ.
    fn cov(&self, i: usize, j: usize) -> f64 {
        let dot = |of: &[f64], width: usize, used: usize| -> f64 {
            (0..used).map(|k| of[i * width + k] * of[j * width + k]).sum()
        };
        let lost = self.minus.len() / self.mean.len();
        dot(&self.dev, self.stride, self.stride - BEYOND) - dot(&self.minus, lost, lost)
    }
}

/// Mean and covariance by points, with one weight in the mean and one in the covariance; of the angle about its image of the mean.
fn by_definition(points: &[(Vec<f64>, f64, f64)], mean: &[f64], factor: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (n, at) = (mean.len(), At { t: 0.0, dt: 1.0, u: &[], p: &[] });
    let image = |x: &[f64]| {
        let mut y = [0.0; 3];
        Mixed(n).observe(&at, x, &mut y);
        y
    };
    let near = image(mean)[1];
    let images: Vec<[f64; 3]> = points
        .iter()
        .map(|(xi, ..)| {
            let x: Vec<f64> =
                (0..n).map(|i| mean[i] + (0..n).map(|k| factor[i * n + k] * xi[k]).sum::<f64>()).collect();
            let mut y = image(&x);
            y[1] = near + (y[1] - near) - TAU * ((y[1] - near) / TAU).round();
            y
        })
        .collect();
    let sum = |of: &dyn Fn(usize) -> f64| (0..points.len()).map(of).sum::<f64>();
    let ybar: Vec<f64> = (0..3).map(|i| sum(&|l| points[l].1 * images[l][i])).collect();
    let cov =
        |i: usize, j: usize| sum(&|l| points[l].2 * (images[l][i] - ybar[i]) * (images[l][j] - ybar[j]));
    let cov = (0..9).map(|k| cov(k / 3, k % 3)).collect();
    (ybar, cov)
}

fn is_as_defined(what: &str, found: &Answer, points: &[(Vec<f64>, f64, f64)], mean: &[f64], factor: &[f64]) {
    let (ybar, cov) = by_definition(points, mean, factor);
    for i in 0..3 {
        assert!(
            (found.mean[i] - ybar[i]).abs() < 1e-12 * (1.0 + ybar[i].abs()),
            "{what}: {:?}, {ybar:?}",
            found.mean
        );
        for j in 0..3 {
            let (one, other) = (found.cov(i, j), cov[i * 3 + j]);
            assert!((one - other).abs() < 1e-11 * (1.0 + other.abs()), "{what} {i} {j}: {one}, {other}");
        }
    }
    // a component that does not move has no spread, and what is the caller's stays his
    let constant = &found.dev[2 * found.stride..];
    assert!(constant[..found.stride - BEYOND].iter().all(|&x| x == 0.0), "{what}: {constant:?}");
    for row in found.dev.chunks_exact(found.stride) {
        assert_eq!(row[found.stride - BEYOND..], [-1.0; BEYOND], "{what}");
    }
}

#[test]
fn a_rule_of_ones_own_may_have_pairs_and_a_centre_of_negative_weight() {
    // a centre that weighs nothing counts among the positive ones
    let none = Own { pairs: [(1.0, 19.0 / 48.0), (2.0, 1.0 / 6.0), (3.0, -1.0 / 16.0)], centre: 0.0 };
    assert_eq!(SIGNED.shape(1), Shape { table: 9, points: 7, plus: 4, minus: 3 });
    assert_eq!(none.shape(1), Shape { table: 9, points: 7, plus: 5, minus: 2 });
    let (mean, factor) = ([0.6], [0.7]);
    for (what, rule) in [("signed", SIGNED), ("without a weight at the centre", none)] {
        let mut points = vec![(vec![0.0], rule.centre, rule.centre)];
        for (xi, weight) in rule.pairs {
            points.extend([xi, -xi].map(|xi| (vec![xi], weight, weight)));
        }
        is_as_defined(what, &answer(&rule, &mean, &factor), &points, &mean, &factor);
    }
}

#[test]
fn an_unscented_rule_has_the_weights_of_its_definition() {
    let (mean, factor) = ([1.0, 1.9], [0.4, 0.0, -0.2, 0.3]);
    for (alpha, beta, kappa) in [(1.0, 0.0, 1.0), (0.5, 2.0, 0.7), (0.8, -0.3, 0.5), (1.3, 0.0, -0.6)] {
        let n = 2.0;
        let lambda = alpha * alpha * (n + kappa) - n;
        let (centre, other) = (lambda / (n + lambda), 0.5 / (n + lambda));
        let mut points = vec![(vec![0.0, 0.0], centre, centre + 1.0 - alpha * alpha + beta)];
        let far = (n + lambda).sqrt();
        for xi in [[far, 0.0], [-far, 0.0], [0.0, far], [0.0, -far]] {
            points.push((xi.to_vec(), other, other));
        }
        let found = answer(&Unscented { alpha, beta, kappa: Some(kappa) }, &mean, &factor);
        is_as_defined(&format!("{alpha} {beta} {kappa}"), &found, &points, &mean, &factor);
    }
}

#[test]
fn a_grid_has_the_points_of_its_definition() {
    let (mean, factor) = ([1.0, 1.9], [0.4, 0.0, -0.2, 0.3]);
    let axis = [(-3f64.sqrt(), 1.0 / 6.0), (0.0, 2.0 / 3.0), (3f64.sqrt(), 1.0 / 6.0)];
    let points: Vec<_> =
        axis.iter().flat_map(|(x, v)| axis.iter().map(move |(y, w)| (vec![*x, *y], v * w, v * w))).collect();
    is_as_defined("3 × 3", &answer(&GaussHermite::default(), &mean, &factor), &points, &mean, &factor);
    // 2009 §V, for two states
    let mut points = vec![(vec![0.0, 0.0], 0.5, 0.5)];
    for (x, y) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        points.push((vec![2f64.sqrt() * x, 2f64.sqrt() * y], 1.0 / 16.0, 1.0 / 16.0));
    }
    for far in [2.0, -2.0] {
        points.extend([[far, 0.0], [0.0, far]].map(|xi| (xi.to_vec(), 1.0 / 16.0, 1.0 / 16.0)));
    }
    is_as_defined("degree five", &answer(&Cubature5, &mean, &factor), &points, &mean, &factor);
}

#[test]
fn options_are_refused_beyond_their_range_and_not_before() {
    let told =
        |rule: &dyn Fn() -> Result<(), givens_core::rule::RuleError>| rule().err().map(|error| error.option);
    for (points, n, wrong) in [
        (1, 1, true),
        (2, 1, false),
        (64, 1, false),
        (65, 1, true),
        (2, 21, false),
        (2, 22, true),
        (3, 13, false),
        (3, 14, true),
        (2, 64, true),
        (2, 65, true),
    ] {
        let found = told(&|| Rule::check(&GaussHermite { points }, n));
        assert_eq!(found, wrong.then_some("points"), "{points} points, {n} states");
    }
    for (n, wrong) in [(1, false), (64, false), (65, true)] {
        assert_eq!(told(&|| Rule::check(&Cubature5, n)), wrong.then_some("rule"), "{n} states");
    }
    for (eta, wrong) in
        [(0.999, true), (1.0, false), (1e9, false), (1.001e9, true), (f64::NAN, true), (-2.0, true)]
    {
        assert_eq!(told(&|| CentralDifference { eta }.check(3)), wrong.then_some("eta"), "{eta}");
    }
    for n in [1, 3, 1000] {
        assert_eq!(told(&|| Rule::check(&Unscented::default(), n)), None, "{n} states");
    }
}

#[test]
fn sizes_are_constants_and_count_the_points() {
    for n in 1..=12 {
        assert_eq!(Rule::shape(&Cubature3, n), Cubature3.shape_for(n));
        assert_eq!(Rule::shape(&Cubature5, n), Cubature5.shape_for(n));
        assert_eq!(CentralDifference::default().shape(n), CentralDifference::default().shape_for(n));
        assert_eq!(Taylor.shape(n), Taylor.shape_for(n));
        for kappa in [None, Some(0.0), Some(-0.5), Some(2.0)] {
            let rule = Unscented { kappa, ..Unscented::default() };
            assert_eq!(Rule::shape(&rule, n), rule.shape_for(n));
        }
        for points in 2..=5 {
            let rule = GaussHermite { points };
            assert_eq!(Rule::shape(&rule, n), rule.shape_for(n));
            let pairs = points.pow(n as u32) / 2;
            let shape = Shape {
                table: pairs * (n + 2),
                points: 2 * pairs + 1,
                plus: 2 * pairs + points % 2,
                minus: 0,
            };
            assert_eq!(shape, rule.shape_for(n), "{points}, {n}");
        }
        // 2 n² + 1, but for those of weight zero
        let (between, along) = (n * (n - 1), if n == 4 { 0 } else { n });
        assert_eq!(Cubature5.shape_for(n).points, 2 * (between + along) + 1);
        assert_eq!(Cubature5.shape_for(n).minus, if n > 4 { 2 * n } else { 0 });
    }
}

#[test]
fn points_reach_as_far_as_they_stand() {
    let n = 5;
    assert_eq!(Rule::reach(&Cubature3, n), 5f64.sqrt());
    assert_eq!(Rule::reach(&Unscented { alpha: 0.5, beta: 2.0, kappa: Some(3.0) }, n), 2f64.sqrt());
    assert_eq!(CentralDifference { eta: 2.5 }.reach(n), 2.5);
    assert_eq!(Taylor.reach(n), f64::INFINITY);
    assert_eq!((Rule::reach(&Cubature5, n), Rule::reach(&GaussHermite::default(), n)), (1.0, 1.0));
}

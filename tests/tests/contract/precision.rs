//! Single precision agrees with double, to single precision.

use givens::filter::{
    Block, Cdkf, Ckf, Ckf5, Ekf, Filter, Over, Prior, Qkf, Sizes, SrCdkf, SrCkf, SrCkf5, SrEkf, SrQkf, SrUkf,
    Ukf,
};
use givens::rule::Rule;
use givens::scalar::Real;
use givens_tests::cases;
use givens_tests::models::{Motion, Problem};
use givens_tests::{cov_error, mean_error};
use proptest::prelude::*;

/// Filters the problem in a scalar: the means, covariances and log-likelihoods of all rows, as `f64`.
fn filtered<T: Real, X: Over<Motion>>(method: X, problem: &Problem) -> Vec<(Vec<f64>, Vec<f64>, f64)> {
    let shape = method.rule().shape(problem.mean.len());
    let sizes = Sizes::of_model(&problem.model, shape).with_sensor(&problem.sensor, shape);
    let memory = vec![T::zero(); Filter::<X, Motion, T, Vec<T>>::memory_len(&method, sizes, false)];
    let prior = problem.prior();
    let prior = Prior { time: 0.0, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
    let mut filter = Filter::start_in(method, &problem.model, sizes, false, prior, memory).unwrap();
    let mut out = Vec::new();
    for row in problem.rows() {
        let present: Vec<bool> = row.z.iter().map(|z| !z.is_nan()).collect();
        filter.predict(row.time).unwrap();
        filter.update_present(&problem.sensor, row.z, &present).unwrap();
        let doubles = |of: &[T]| of.iter().map(|x| x.first()).collect::<Vec<_>>();
        let log_likelihood = filter.innovation().log_likelihood.first();
        out.push((doubles(filter.mean()), doubles(&filter.cov()), log_likelihood));
    }
    out
}

fn agrees<X: Over<Motion>>(name: &str, method: X, problem: &Problem) -> Result<(), TestCaseError> {
    let (single, double) = (filtered::<f32, _>(method, problem), filtered::<f64, _>(method, problem));
    let n = problem.mean.len();
    for (k, (a, b)) in single.iter().zip(&double).enumerate() {
        let error = mean_error(&a.0, &b.0, &b.1).max(cov_error(&a.1, &b.1, n));
        prop_assert!(error < 3e-4, "{name}, row {k}: {error:e}");
        let scores = (a.2 - b.2).abs() / b.2.abs().max(1.0);
        prop_assert!(scores < 3e-4, "{name}, row {k}: {scores:e}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(16))]

    #[test]
    fn single_precision_agrees_with_double(seed: u64, n in 1usize..=5, d in 1usize..=4) {
        let problem = Problem::random(seed, n, d, 6, 0.05);
        macro_rules! methods {
            ($($name:literal $cov:ident $sr:ident;)*) => {$(
                agrees($name, $cov::default(), &problem)?;
                for update in [Block::Joint, Block::Separate] {
                    agrees($name, $sr { update, ..Default::default() }, &problem)?;
                }
            )*};
        }
        methods! { "ekf" Ekf SrEkf; "ukf" Ukf SrUkf; "cdkf" Cdkf SrCdkf; "qkf" Qkf SrQkf; "ckf" Ckf SrCkf; "ckf5" Ckf5 SrCkf5; }
    }
}

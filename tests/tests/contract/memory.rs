//! The memory of a filter: exactly the length that its type states, and no step beyond it.

use givens::filter::{
    Cdkf, Ckf, Ckf5, Ekf, Fault, Filter, Over, Prior, Qkf, Sizes, SrCdkf, SrCkf, SrCkf5, SrEkf, SrQkf, SrUkf,
    StepError, Ukf,
};
use givens::registry::{ENTRIES, Kind};
use givens::rule::{CentralDifference, Cubature3, Cubature5, GaussHermite, Rule, Shape, Taylor, Unscented};
use givens::scalar::Real;
use givens_tests::models::{Motion, Problem};

/// Starts, and goes through all rows, in a slice of `len` scalars that cannot grow.
fn steps<T: Real, X: Over<Motion>>(
    method: X,
    problem: &Problem,
    sizes: Sizes,
    smoothing: bool,
    len: usize,
) -> Result<(), StepError> {
    let mut memory = vec![T::of(f64::NAN); len];
    let prior = problem.prior();
    let prior = Prior { time: 0.0, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
    let mut filter = Filter::<X, Motion, T, &mut [T]>::start_in(
        method,
        &problem.model,
        sizes,
        smoothing,
        prior,
        &mut memory,
    )?;
    for row in problem.rows() {
        filter.predict(row.time)?;
        let present: Vec<bool> = row.z.iter().map(|z| !z.is_nan()).collect();
        filter.update_present(&problem.sensor, row.z, &present)?;
    }
    assert!(filter.mean().iter().all(|x| x.first().is_finite()));
    Ok(())
}

fn suffices<X: Over<Motion>>(name: &str, method: X, memory: impl Fn(Sizes, bool) -> usize) {
    for (n, d) in [(1, 1), (2, 4), (4, 2), (5, 5)] {
        let problem = Problem::random(3, n, d, 4, 0.05);
        let shape = method.rule().shape(n);
        let exact = Sizes::of_model(&problem.model, shape).with_sensor(&problem.sensor, shape);
        for (sizes, smoothing) in
            [(exact, false), (exact, true), (Sizes::new(n, d), false), (Sizes::new(n, d), true)]
        {
            let len = memory(sizes, smoothing);
            let what = format!("{name}, n = {n}, d = {d}, smoothing: {smoothing}");
            assert_eq!(
                len,
                Filter::<X, Motion, f64, Vec<f64>>::memory_len(&method, sizes, smoothing),
                "{what}"
            );
            steps::<f64, X>(method, &problem, sizes, smoothing, len)
                .unwrap_or_else(|error| panic!("{what}: {error}"));
            steps::<f32, X>(method, &problem, sizes, smoothing, len)
                .unwrap_or_else(|error| panic!("{what}: {error}"));
            for less in [len - 1, len / 2, 0] {
                let refused = [
                    steps::<f64, X>(method, &problem, sizes, smoothing, less),
                    steps::<f32, X>(method, &problem, sizes, smoothing, less),
                ];
                let expected = Fault::Length { of: "the filter's memory", expected: len, found: less };
                assert_eq!(refused.map(|of| of.unwrap_err().fault), [expected; 2], "{what}");
            }
        }
    }
}

#[test]
fn the_stated_length_of_every_type_suffices_and_one_less_is_refused() {
    let mut types = 0;
    macro_rules! check {
        ($($name:literal $method:expr;)*) => {$(
            let method = $method;
            suffices($name, method, |sizes, smoothing| {
                if smoothing { method.smoothing_memory(sizes) } else { method.memory(sizes) }
            });
            types += usize::from(!$name.contains(' '));
        )*};
    }
    check! {
        "ekf" Ekf::DEFAULT; "ukf" Ukf::DEFAULT; "cdkf" Cdkf::DEFAULT; "qkf" Qkf::DEFAULT; "ckf" Ckf::DEFAULT;
        "ckf5" Ckf5::DEFAULT; "sr-ekf" SrEkf::DEFAULT; "sr-ukf" SrUkf::DEFAULT; "sr-cdkf" SrCdkf::DEFAULT;
        "sr-qkf" SrQkf::DEFAULT; "sr-ckf" SrCkf::DEFAULT; "sr-ckf5" SrCkf5::DEFAULT;
        "ukf with beta" Ukf { beta: 2.0, ..Ukf::DEFAULT };
        "sr-ukf with alpha" SrUkf { alpha: 0.1, kappa: Some(1.0), ..SrUkf::DEFAULT };
        "qkf of four points" Qkf { points: 4 };
    }
    assert_eq!(
        types,
        ENTRIES.iter().filter(|entry| entry.kind() == Kind::Discrete).count(),
        "a method of the registry has no type here"
    );
}

/// Memory as an array, without an allocator.
const SIZES: Sizes = Sizes::new(4, 2);
const LEN: usize = SrUkf::DEFAULT.smoothing_memory(SIZES);

#[test]
fn an_array_of_the_constant_length_serves() {
    let problem = Problem::random(8, 4, 2, 3, 0.05);
    let prior = problem.prior();
    // square-root form does not read the covariance
    let prior = Prior { time: 0.0, mean: prior.mean(), factor: prior.factor(), cov: &[] };
    let mut filter =
        Filter::start_in(SrUkf::DEFAULT, &problem.model, SIZES, true, prior, [0.0; LEN]).unwrap();
    filter.predict(1.0).unwrap();
    filter.update(&problem.sensor, &[0.1, 0.2]).unwrap();
    let too_long = Problem::random(8, 4, 3, 3, 0.05).sensor;
    let fault = filter.update(&too_long, &[0.1, 0.2, 0.3]).unwrap_err().fault;
    assert!(matches!(fault, Fault::Length { of: "the filter's memory", found: LEN, .. }), "{fault}");
}

#[test]
fn the_shapes_of_the_rules_as_constants_are_those_that_the_filters_use() {
    let same = |n: usize, constant: Shape, found: Shape| assert_eq!(constant, found, "n = {n}");
    for n in 1..=12 {
        same(n, Cubature3.shape_for(n), Cubature3.shape(n));
        same(n, Cubature5.shape_for(n), Cubature5.shape(n));
        same(n, Taylor.shape_for(n), Taylor.shape(n));
        same(n, CentralDifference::default().shape_for(n), CentralDifference::default().shape(n));
        for (alpha, beta, kappa) in [(1.0, 0.0, None), (0.1, 2.0, Some(0.0)), (1.0, -1.0, Some(1.0))] {
            let rule = Unscented { alpha, beta, kappa };
            same(n, rule.shape_for(n), rule.shape(n));
        }
        for points in 2..=5 {
            same(n, GaussHermite { points }.shape_for(n), GaussHermite { points }.shape(n));
        }
    }
}

#[test]
fn sizes_that_do_not_hold_the_model_are_refused() {
    let problem = Problem::random(5, 3, 2, 3, 0.05);
    let whole = Sizes::new(3, 2);
    let fault = |sizes| {
        let memory = SrCkf::DEFAULT.memory(sizes).min(1 << 20);
        steps::<f64, _>(SrCkf::DEFAULT, &problem, sizes, false, memory).unwrap_err().fault
    };
    for sizes in [
        Sizes { process_noise: 2, ..whole },
        Sizes { model: 1, ..whole },
        Sizes { states: 2, ..whole },
        Sizes { states: 0, ..whole },
        Sizes { measures: 1, ..whole },
        // no memory is that long
        Sizes { measures: usize::MAX, ..whole },
        Sizes { model: usize::MAX, ..whole },
        Sizes { states: usize::MAX, ..whole },
        Sizes::new(usize::MAX, usize::MAX),
    ] {
        assert!(matches!(fault(sizes), Fault::Length { .. }), "{sizes:?}: {}", fault(sizes));
    }
}

#[test]
fn options_out_of_range_have_a_length_too() {
    for n in [0, 1, 7, 65, 10_000, usize::MAX] {
        for points in [0, 1, 3, usize::MAX] {
            let _ = Qkf { points }.smoothing_memory(Sizes::new(n, n));
        }
        let _ = Ckf5::DEFAULT.smoothing_memory(Sizes::new(n, 1));
        let _ = Ukf { alpha: f64::NAN, ..Ukf::DEFAULT }.memory(Sizes::new(n, 1));
    }
}

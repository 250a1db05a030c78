//! The types of the methods for continuous models: each is its registry name, and agrees with itself in single precision.

use givens::filter::predict::{ItoTaylor, LevelSet, MomentOde};
use givens::filter::{
    AcdEkf, CdCkf, CdCkf1, CdCkf2, CdEkf, CdGhkf1, CdGhkf2, CdUkf, CdUkf1, Filter, Form, Lskf, Method, Over,
    Prior, SrAcdEkf, SrCdCkf, SrCdCkf1, SrCdCkf2, SrCdEkf, SrCdGhkf1, SrCdGhkf2, SrCdUkf, SrCdUkf1,
};
use givens::registry::{ENTRIES, FormName, Kind, RuleName, TimeName, resolve};
use givens::rule::Rule;
use givens::scalar::Real;
use givens::{Estimates, Goal};
use givens_tests::sde::{Continuous, Flow};
use givens_tests::{cov_error, mean_error};
use std::fmt::Debug;

/// Filters the problem by hand in a scalar: the means and covariances of all rows, and the log-likelihoods, as `f64`.
fn filtered<T: Real, X: Over<Flow>>(method: X, problem: &Continuous) -> Vec<(Vec<f64>, Vec<f64>, f64)> {
    let sizes = method.sizes(&problem.model).unwrap();
    let sizes = sizes.with_sensor(&problem.sensor, method.rule().shape(sizes.states));
    let memory = vec![T::zero(); Filter::<X, Flow, T, Vec<T>>::memory_len(&method, sizes, false)];
    let prior = problem.prior();
    let prior = Prior { time: 0.0, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
    let mut filter = Filter::start_in(method, &problem.model, sizes, false, prior, memory).unwrap();
    let row = |row: givens::Row| {
        let present: Vec<bool> = row.z.iter().map(|z| !z.is_nan()).collect();
        filter.predict(row.time).unwrap();
        filter.update_present(&problem.sensor, row.z, &present).unwrap();
        let doubles = |of: &[T]| of.iter().map(|x| x.first()).collect::<Vec<_>>();
        (doubles(filter.mean()), doubles(&filter.cov()), filter.innovation().log_likelihood.first())
    };
    problem.rows().map(row).collect()
}

/// By its name in the registry.
fn named(name: &str, problem: &Continuous) -> Estimates {
    problem.run(&resolve(name, &[]).unwrap(), Goal::Filter).into_result().unwrap()
}

fn is_its_name<X: Over<Flow>>(name: &str, method: X) {
    let problem = Continuous::random(11, [3, 2, 2], 5, 0.1);
    let est = named(name, &problem);
    let (double, single) = (filtered::<f64, _>(method, &problem), filtered::<f32, _>(method, &problem));
    for (k, (a, b)) in double.iter().zip(&single).enumerate() {
        assert_eq!(
            (&a.0[..], &a.1[..], a.2),
            (est.mean(k), est.cov(k), est.log_likelihood[k]),
            "{name}, row {k}"
        );
        let error = mean_error(&b.0, &a.0, &a.1).max(cov_error(&b.1, &a.1, 3));
        assert!(error < 1e-4, "{name}, row {k}: {error:e}");
        assert!((a.2 - b.2).abs() < 1e-4 * a.2.abs().max(1.0), "{name}, row {k}");
    }
}

#[test]
fn a_type_by_hand_is_a_run_of_its_name_and_serves_single_precision() {
    // one of each time update: the others are other parts of the same
    is_its_name("cd-ekf", CdEkf::default());
    is_its_name("cd-ckf1", CdCkf1::default());
    is_its_name("sr-cd-ckf", SrCdCkf::default());
    is_its_name("sr-cd-ckf2", SrCdCkf2::default());
    is_its_name("lskf", Lskf::default());
}

/// The parts of a type are those of its name.
fn has_the_parts_of_its_name<X: Method>(name: &str, method: X)
where
    X::Rule: Debug,
    X::Time: Debug,
{
    let choice = resolve(name, &[]).unwrap();
    let (steps, integrator) = (choice.integrator.steps, choice.integrator);
    let time = match choice.time_update {
        TimeName::ItoTaylor => format!("{:?}", ItoTaylor { variant: choice.variant, steps }),
        TimeName::MomentOde => format!("{:?}", MomentOde { integrator }),
        _ => format!("{:?}", LevelSet::default()),
    };
    assert_eq!(format!("{:?}", method.time_update()), time, "{name}");
    let rule = match choice.rule {
        RuleName::Taylor => "Taylor".to_owned(),
        RuleName::Unscented => format!("{:?}", choice.unscented),
        RuleName::GaussHermite => format!("{:?}", choice.gauss_hermite),
        _ => "Cubature3".to_owned(),
    };
    assert_eq!(format!("{:?}", method.rule()), rule, "{name}");
    assert_eq!((X::Form::SQUARE_ROOT, method.block()), (choice.form == FormName::SquareRoot, choice.block));
}

#[test]
fn every_continuous_type_has_the_parts_of_its_registry_name() {
    macro_rules! types {
        ($($name:literal $type:ident)*) => {
            let continuous = ENTRIES.iter().filter(|entry| entry.kind() == Kind::Continuous);
            assert_eq!(continuous.count(), [$($name),*].len(), "a method of the registry has no type here");
            $(has_the_parts_of_its_name($name, $type::default());)*
        };
    }
    types! {
        "cd-ekf" CdEkf "acd-ekf" AcdEkf "cd-ukf" CdUkf "cd-ukf1" CdUkf1 "cd-ckf" CdCkf "cd-ckf1" CdCkf1
        "cd-ckf2" CdCkf2 "cd-ghkf1" CdGhkf1 "cd-ghkf2" CdGhkf2
        "sr-cd-ekf" SrCdEkf "sr-acd-ekf" SrAcdEkf "sr-cd-ukf" SrCdUkf "sr-cd-ukf1" SrCdUkf1 "sr-cd-ckf" SrCdCkf
        "sr-cd-ckf1" SrCdCkf1 "sr-cd-ckf2" SrCdCkf2 "sr-cd-ghkf1" SrCdGhkf1 "sr-cd-ghkf2" SrCdGhkf2
        "lskf" Lskf
    }
}

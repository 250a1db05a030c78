//! A prediction and an update of each rule, five states: `cargo bench -p givens-core --bench rules`.
#![allow(missing_docs, reason = "criterion's macros")]
#![allow(clippy::expect_used, reason = "a benchmark that cannot begin has nothing to say")]

use core::hint::black_box;
use criterion::{Criterion, criterion_group, criterion_main};
use givens_core::filter::{
    Ckf, Filter, Gaussian, Over, SrCdkf, SrCkf, SrCkf5, SrEkf, SrQkf, SrUkf, StepError,
};
use givens_core::model::zoo::{CoordinatedTurn, RangeBearing};

/// Each repetition goes on from the same belief.
fn rule<X: Over<CoordinatedTurn>>(c: &mut Criterion, name: &str, method: X) {
    let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
    let begin = || -> Result<Filter<'_, X, _, f64, Vec<f64>>, StepError> {
        let (mean, std) = ([1000.0, 300.0, 1000.0, 0.0, -0.05], [10.0, 3.2, 10.0, 3.2, 0.01]);
        let prior = Gaussian::from_std(&mean, &std).expect("a valid prior");
        let mut f = method.start(&turn, 0.0, &prior)?;
        f.predict(1.0)?;
        f.update(&radar, &[1640.0, 0.65])?;
        Ok(f)
    };
    let begun = begin().expect("a first step");
    let mut group = c.benchmark_group(name);
    group.bench_function("predict", |b| {
        b.iter_batched_ref(|| begun.clone(), |f| black_box(f.predict(2.0)), criterion::BatchSize::SmallInput);
    });
    group.bench_function("update", |b| {
        b.iter_batched_ref(
            || begun.clone(),
            |f| black_box(f.update(&radar, &[1640.0, 0.65])),
            criterion::BatchSize::SmallInput,
        );
    });
}

fn rules(c: &mut Criterion) {
    rule(c, "ckf", Ckf::default());
    rule(c, "sr-ckf", SrCkf::default());
    rule(c, "sr-ckf5", SrCkf5::default());
    rule(c, "sr-ukf", SrUkf::default());
    rule(c, "sr-qkf", SrQkf::default());
    rule(c, "sr-cdkf", SrCdkf::default());
    rule(c, "sr-ekf", SrEkf::default());
}

criterion_group!(all, rules);
criterion_main!(all);

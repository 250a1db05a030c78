//! Every public constructor, with any sizes and numbers: what is made, or a refusal in words.

use crate::bytes::Bytes;
use crate::promise;
use crate::world::refused;
use givens::filter::{
    Carried, CdEkf, Ckf, Ekf, Filter, Gaussian, Over, Prior, Sizes, SrCdCkf, SrCkf, SrQkf, SrUkf,
    factor_of_covariance,
};
use givens::metrics::{
    Accuracy, AccuracySums, Consistency, ConsistencySums, chi_squared_band, chi_squared_cdf,
    chi_squared_quantile, nees,
};
use givens::model::zoo::{CoordinatedTurn, RangeBearing, Turn3d};
use givens::ode::{Integrator, Solver, Steps, Tolerance};
use givens::rule::{
    CentralDifference, Cubature3, Cubature5, GaussHermite, PointRule, Rule, RuleError, Unscented,
};
use givens::simulate::{Path, Paths, Scheme};
use givens::smoother::{FixedPoint, History};
use givens::{Data, Estimates, Gated, Goal, Stream, filter};

pub(crate) fn body(data: &[u8]) {
    let bytes = &mut Bytes(data);
    for _ in 0..8 {
        if bytes.is_empty() {
            return;
        }
        match bytes.below(12) {
            0 => rows(bytes),
            1 => beliefs(bytes),
            2 => rules(bytes),
            3 => integrations(bytes),
            4 => scores(bytes),
            5 => sizes(bytes),
            6 => histories(bytes),
            7 => paths(bytes),
            8 => gated(bytes),
            9 => lent(&SrCkf::default(), &CoordinatedTurn::default(), bytes),
            10 => match bytes.below(4) {
                0 => lent(&Ekf::default(), &CoordinatedTurn::default(), bytes),
                1 => lent(
                    &SrUkf { alpha: bytes.number(), ..SrUkf::default() },
                    &CoordinatedTurn::default(),
                    bytes,
                ),
                2 => lent(
                    &SrQkf { points: bytes.length(), ..SrQkf::default() },
                    &CoordinatedTurn::default(),
                    bytes,
                ),
                _ => lent(&Ckf::default(), &CoordinatedTurn::default(), bytes),
            },
            _ => match bytes.below(2) {
                0 => lent(&SrCdCkf::default(), &Turn3d::default(), bytes),
                _ => {
                    // over gaps of any length a solver that chooses its steps takes all that it may, a second of them
                    let solver = if bytes.byte() == 255 { Solver::Dp5 } else { Solver::Rk4 };
                    lent(&CdEkf { solver, ..CdEkf::default() }, &Turn3d::default(), bytes);
                }
            },
        }
    }
}

fn rows(bytes: &mut Bytes) {
    let (d, controls) = (bytes.below(4), bytes.below(3));
    let mut data = Data::with_controls(d, controls);
    if bytes.flag() {
        data = data.starting_at(bytes.number());
    }
    for _ in 0..bytes.below(5) {
        let (time, odd) = (bytes.number(), bytes.below(8) == 7);
        let (z, u) = (bytes.numbers(d + usize::from(odd)), bytes.numbers(controls));
        refused(data.push_controlled(time, &z, &u));
    }
    assert_eq!(data.rows().count(), data.len());
    for k in [0, 1, data.len(), bytes.length()] {
        assert_eq!(data.row(k).is_some(), k < data.len());
    }
    assert!(data.rows().zip(data.rows().skip(1)).all(|(a, b)| a.time <= b.time));
    assert!(data.rows().all(|row| row.z.iter().all(|z| !z.is_infinite())));
}

fn beliefs(bytes: &mut Bytes) {
    let n = bytes.below(4);
    let odd = usize::from(bytes.below(8) == 7);
    let (mean, cov) = (bytes.numbers(n), bytes.numbers(n * n + odd));
    if let Some(belief) = refused(Gaussian::from_cov(&mean, &cov)) {
        assert_eq!(belief.mean().len().pow(2), belief.cov().len());
        promise::lower(belief.factor(), n);
        assert!(belief.factor().iter().chain(belief.mean()).all(|x| x.is_finite()), "{belief:?}");
    }
    let std = bytes.numbers(n + odd);
    if let Some(belief) = refused(Gaussian::from_std(&mean, &std)) {
        promise::lower(belief.factor(), n);
        assert!(belief.factor().iter().chain(belief.cov()).all(|x| x.is_finite()), "{belief:?}");
    }
    let mut factor = vec![0.0; bytes.below(17)];
    refused(factor_of_covariance(&cov, bytes.length(), &mut factor));
    let mut single = vec![0.0_f32; cov.len()];
    refused(factor_of_covariance(&cov.iter().map(|&x| x as f32).collect::<Vec<_>>(), n, &mut single));
}

/// A rule's sizes for any state; its points where they are few.
fn rules(bytes: &mut Bytes) {
    let n = bytes.length();
    let unscented = Unscented {
        alpha: bytes.number(),
        beta: bytes.number(),
        kappa: bytes.flag().then(|| bytes.number()),
    };
    pairs(unscented, n);
    pairs(GaussHermite { points: bytes.length() }, n);
    pairs(Cubature5, n);
    pairs(Cubature3, n);
    let central = CentralDifference { eta: bytes.number() };
    if Rule::check(&central, n).is_ok() {
        let _ = central.shape(n);
    }
}

fn pairs<R: PointRule + Rule>(rule: R, n: usize) {
    match PointRule::check(&rule, n) {
        Err(RuleError { option, must, .. }) => assert!(!option.is_empty() && !must.is_empty()),
        Ok(()) if n <= 4 => {
            let shape = rule.shape(n);
            if shape.points < 3000 {
                let (mut xi, mut weights) = (vec![0.0; n], 0.0);
                rule.every_pair(n, &mut xi, &mut |_, xi, weight| {
                    assert!(xi.iter().all(|x| x.is_finite()) && weight.is_finite());
                    weights += 2.0 * weight;
                });
                assert!(weights.is_finite() && rule.centre(n).is_none_or(f64::is_finite));
            }
        }
        Ok(()) => drop(rule.shape(n)),
    }
}

fn integrations(bytes: &mut Bytes) {
    let solver = [Solver::Euler, Solver::Rk4, Solver::Dp5, Solver::Rodas4][bytes.below(4)];
    let steps = if bytes.flag() { Steps::Count(bytes.length()) } else { Steps::Longest(bytes.number()) };
    let tolerance = Tolerance { rtol: bytes.number(), atol: bytes.number() };
    let integrator = Integrator { solver, steps, tolerance, limit: bytes.length() };
    refused(integrator.check());
    refused(integrator.resolves(f64::from(f32::EPSILON)));
    let _ = (integrator.lockstep(), tolerance.of(bytes.number()));
    let _ = integrator.scratch(bytes.length(), bytes.length(), bytes.length(), bytes.length());
}

fn scores(bytes: &mut Bytes) {
    let (dof, p) = (bytes.number(), bytes.number());
    let dof = if seldom(dof, bytes) { dof } else { 100.0 };
    let _ = (chi_squared_quantile(dof, p), chi_squared_cdf(dof, p), chi_squared_band(dof));
    let n = bytes.below(4);
    let len = if bytes.below(8) == 7 { bytes.below(20) } else { n * n };
    let (mean, cov, truth) = (bytes.numbers(n), bytes.numbers(len), bytes.numbers(n));
    if let Some((value, dof)) = nees(&mean, &cov) {
        assert!(dof <= n && (value.is_nan() || value >= 0.0));
    }
    let mut sums = AccuracySums::new(n);
    sums.add(&mean, &cov, &truth);
    let of_rows = Accuracy::of_rows(bytes.below(4), &mean, &cov, &truth);
    let _ = (sums.accuracy(), Accuracy::pooled([of_rows]));
    let (sum, dof) = (bytes.number(), bytes.length());
    let consistency = Consistency::of_sum(sum, if seldom(dof as f64, bytes) { dof } else { 100 });
    let _ = (consistency.verdict(), ConsistencySums::default().consistency());
    let mut rows = Estimates::default();
    assert!(!rows.push(&Estimates::default(), bytes.length()) && rows.is_empty());
}

/// Whether a quantile of so many degrees of freedom is asked for: that of a million takes a hundredth of a second, that of
/// 4 · 10⁹ one, and few inputs may spend it.
fn seldom(dof: f64, bytes: &mut Bytes) -> bool {
    !(100.0..1e10).contains(&dof) || bytes.byte() > if dof < 1e7 { 240 } else { 254 }
}

/// Lengths of memory for any sizes: the largest where there is no such memory.
fn sizes(bytes: &mut Bytes) {
    let (n, d) = (bytes.length(), bytes.length());
    let sizes = Sizes { controls: bytes.length(), parameters: bytes.length(), ..Sizes::new(n, d) };
    let len =
        Filter::<SrCkf, CoordinatedTurn, f64, Vec<f64>>::memory_len(&SrCkf::default(), sizes, bytes.flag());
    assert!(len >= n && len >= d);
    let row = Stream::bytes_per_row(if bytes.flag() { Goal::Interval } else { Goal::Filter }, n, d);
    let record = History::<f64, Vec<f64>>::record_len(n);
    let history = History::<f64, Vec<f64>>::memory_len(n, bytes.length());
    let point = FixedPoint::<f64, Vec<f64>>::memory_len(n);
    for len in [row, record, history, point, Estimates::row_bytes(n, d, true)] {
        assert!(len >= n, "{len} for {n} states");
    }
}

fn histories(bytes: &mut Bytes) {
    let (n, square_root, room) = (bytes.length(), bytes.flag(), usize::from(bytes.byte()) * 4);
    let mut history = History::<f64, Vec<f64>>::new(n, square_root, vec![0.0; room]);
    assert!(history.is_empty());
    let turn = CoordinatedTurn::default();
    let Some(prior) = refused(Gaussian::from_std(&[1.0; 5], &[1.0; 5])) else { return };
    let sizes = Sizes::new(5, 2);
    let memory =
        vec![
            0.0;
            Filter::<SrCkf, CoordinatedTurn, f64, Vec<f64>>::memory_len(&SrCkf::default(), sizes, true)
        ];
    let begin = Prior { time: 0.0, mean: prior.mean(), factor: prior.factor(), cov: &[] };
    let started = Filter::start_in(SrCkf::default(), &turn, sizes, bytes.below(8) < 7, begin, memory);
    let Some(mut filter) = refused(started) else { return };
    for _ in 0..bytes.below(4) {
        let to = filter.time() + bytes.number();
        refused(history.predict(&mut filter, to));
        refused(filter.update(&RangeBearing::published(), &bytes.plains(2)));
    }
    let time = filter.time();
    if let Some(mut point) = refused(FixedPoint::begin(&mut filter, vec![0.0; room * 2])) {
        refused(point.predict(&mut filter, time + bytes.number()));
        assert!(point.mean().iter().chain(point.cov()).all(|x| x.is_finite()));
    }
}

fn paths(bytes: &mut Bytes) {
    let steps = if bytes.flag() { Steps::Count(bytes.length()) } else { Steps::Longest(bytes.number()) };
    let scheme = if bytes.flag() { Scheme::EulerMaruyama } else { Scheme::ItoTaylor };
    let turn = Turn3d::default();
    let Some(mut path) = refused(Path::new(&turn, Paths { scheme, steps })) else { return };
    let n = if bytes.below(8) == 7 { bytes.below(9) } else { 7 };
    let mut x = bytes.numbers(n);
    let at = givens::model::At { t: bytes.number(), dt: bytes.number(), u: &[], p: &[] };
    let (u1, u2) = (bytes.numbers(4), bytes.numbers(4));
    if refused(path.step(&at, &mut x, &u1, &u2)).is_some() {
        assert!(x.iter().all(|x| x.is_finite()), "{x:?}");
    }
}

fn gated(bytes: &mut Bytes) {
    let method = Gated { method: SrCkf::default(), gate: bytes.flag().then(|| bytes.number()) };
    let mut data = Data::new(2);
    for k in 0..3 {
        refused(data.push(f64::from(k), &bytes.numbers(2)));
    }
    let Some(prior) = refused(Gaussian::from_std(&bytes.plains(5), &[1.0; 5])) else { return };
    match filter(&method, &CoordinatedTurn::default(), &RangeBearing::published(), &data, &prior) {
        Ok(est) => promise::finite(&est),
        Err(failure) => promise::finite(&failure.finished),
    }
}

/// A filter in memory that is lent, begun from slices of any lengths and from a snapshot of them.
fn lent<X: Over<M>, M>(method: &X, model: &M, bytes: &mut Bytes) {
    let Some(fit) = refused(method.sizes(model)) else { return };
    let n = if bytes.below(4) == 3 { bytes.length() } else { fit.states };
    let mut sizes = Sizes { states: n, ..fit };
    if bytes.below(4) == 3 {
        sizes.measures = bytes.length();
        sizes.process_noise = bytes.length();
        sizes.model = bytes.length();
    }
    let need = Filter::<X, M, f64, Vec<f64>>::memory_len(method, sizes, false);
    let short = if bytes.below(4) == 3 { bytes.below(100) } else { 0 };
    let memory = || vec![f64::NAN; need.min(100_000).saturating_sub(short)];
    let length = |bytes: &mut Bytes, own: usize| if bytes.below(8) == 7 { bytes.below(30) } else { own };
    let (few, square) = (n.min(9), n.min(9).pow(2));
    let (m, s, c) = (length(bytes, few), length(bytes, square), length(bytes, square));
    let mean = bytes.plains(m);
    let mut factor = vec![0.0; s];
    factor.iter_mut().step_by(few + 1).for_each(|x| *x = bytes.plain().abs());
    if bytes.below(4) == 3 && s > 0 {
        factor[bytes.below(s)] = bytes.number();
    }
    let cov = vec![1.0; c];
    let time = bytes.number();
    let prior = Prior { time, mean: &mean, factor: &factor, cov: &cov };
    if let Some(mut filter) = refused(Filter::start_in(*method, model, sizes, bytes.flag(), prior, memory()))
    {
        refused(filter.predict(time + bytes.number()));
    }
    let floor = vec![0.0; length(bytes, few)];
    let controls = bytes.flag().then_some(&mean[..m.min(bytes.below(3))]);
    let carried = Carried {
        time,
        step: bytes.length(),
        mean: &mean,
        factor: &factor,
        cov: &cov,
        moved: if bytes.flag() { &factor } else { &[] },
        floor: &floor,
        controls,
        parameters: &mean[..m.min(bytes.below(3))],
        work: givens::ode::Work::default(),
    };
    if let Some(mut filter) = refused(Filter::resume_in(*method, model, sizes, false, carried, memory())) {
        refused(filter.predict(time + bytes.number()));
    }
}

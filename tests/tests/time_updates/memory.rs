//! The memory of a filter of a continuous model: exactly the length that its type states as a constant.

use givens::filter::predict::{Gauge, Root, Velocity};
use givens::filter::{
    AcdEkf, CdCkf, CdCkf1, CdCkf2, CdEkf, CdGhkf1, CdGhkf2, CdUkf, CdUkf1, Fault, Filter, Lskf, Over, Prior,
    Sizes, SrAcdEkf, SrCdCkf, SrCdCkf1, SrCdCkf2, SrCdEkf, SrCdGhkf1, SrCdGhkf2, SrCdUkf, SrCdUkf1,
    StepError,
};
use givens::model::zoo::{Components, VanDerPol};
use givens::model::{At, Sde, Varies};
use givens::ode::{AdaptiveSolver, Solver};
use givens::registry::{ENTRIES, Kind};
use givens::rule::Rule;
use givens::scalar::Real;
use givens_tests::sde::{Continuous, Flow};

/// The lengths that a type states as constants.
trait Stated {
    fn sizes_for(&self, sizes: Sizes) -> Sizes;
    fn len(&self, sizes: Sizes, smoothing: bool) -> usize;
}

macro_rules! stated {
    ($($type:ident)*) => {$(
        impl Stated for $type {
            fn sizes_for(&self, sizes: Sizes) -> Sizes {
                self.sizes_for(sizes)
            }
            fn len(&self, sizes: Sizes, smoothing: bool) -> usize {
                if smoothing { self.smoothing_memory(sizes) } else { self.memory(sizes) }
            }
        }
    )*};
}

stated! {
    AcdEkf CdCkf CdCkf1 CdCkf2 CdEkf CdGhkf1 CdGhkf2 CdUkf CdUkf1 Lskf
    SrAcdEkf SrCdCkf SrCdCkf1 SrCdCkf2 SrCdEkf SrCdGhkf1 SrCdGhkf2 SrCdUkf SrCdUkf1
}

/// Starts, and goes through all rows, in a slice of `len` scalars that cannot grow.
fn steps<T: Real, X: Over<Flow>>(
    method: X,
    problem: &Continuous,
    sizes: Sizes,
    smoothing: bool,
    len: usize,
) -> Result<(), StepError> {
    let mut memory = vec![T::of(f64::NAN); len];
    let prior = problem.prior();
    let prior = Prior { time: 0.0, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
    let model = &problem.model;
    let mut filter =
        Filter::<X, Flow, T, &mut [T]>::start_in(method, model, sizes, smoothing, prior, &mut memory)?;
    for row in problem.rows() {
        filter.predict(row.time)?;
        let present: Vec<bool> = row.z.iter().map(|z| !z.is_nan()).collect();
        filter.update_present(&problem.sensor, row.z, &present)?;
    }
    assert!(filter.mean().iter().all(|x| x.first().is_finite()));
    Ok(())
}

/// In `f64` for every size; in `f32` too where `single`, for one of each time update.
fn suffices<X: Over<Flow> + Stated>(name: &str, method: X, single: bool) {
    for [n, q, d] in [[1, 1, 1], [2, 1, 4], [3, 2, 2], [4, 4, 1]] {
        let problem = Continuous::random(3, [n, q, d], 3, 0.05);
        let shape = method.rule().shape(n);
        let exact = Over::sizes(&method, &problem.model).unwrap().with_sensor(&problem.sensor, shape);
        let stated = method.sizes_for(Sizes { process_noise: q, ..Sizes::new(n, d) });
        assert!(stated.hold(&exact) && stated.process_noise == q, "{name}: {stated:?}, {exact:?}");
        for (sizes, smoothing) in [(exact, false), (exact, true), (stated, false), (stated, true)] {
            let what = format!("{name}, n = {n}, q = {q}, d = {d}, smoothing: {smoothing}");
            let len = method.len(sizes, smoothing);
            let needed = Filter::<X, Flow, f64, Vec<f64>>::memory_len(&method, sizes, smoothing);
            assert_eq!(len, needed, "{what}");
            let refusal = |less| Fault::Length { of: "the filter's memory", expected: len, found: less };
            let run = |len| steps::<f64, X>(method, &problem, sizes, smoothing, len);
            run(len).unwrap_or_else(|error| panic!("{what}: {error}"));
            for less in [len - 1, len / 2, 0] {
                assert_eq!(run(less).unwrap_err().fault, refusal(less), "{what}");
            }
            if single {
                let run = |len| steps::<f32, X>(method, &problem, sizes, smoothing, len);
                run(len).unwrap_or_else(|error| panic!("{what}, f32: {error}"));
                assert_eq!(run(len - 1).unwrap_err().fault, refusal(len - 1), "{what}, f32");
            }
        }
    }
}

#[test]
fn the_stated_length_of_every_continuous_type_suffices_and_one_less_is_refused() {
    let mut types = 0;
    macro_rules! check {
        ($($name:literal $method:expr $(, $single:ident)?;)*) => {$(
            let single: &[&str] = &[$(stringify!($single))?];
            suffices($name, $method, !single.is_empty());
            types += usize::from(!$name.contains(' '));
        )*};
    }
    check! {
        "cd-ekf" CdEkf::DEFAULT, single; "acd-ekf" AcdEkf::DEFAULT; "cd-ukf" CdUkf::DEFAULT; "cd-ukf1" CdUkf1::DEFAULT;
        "cd-ckf" CdCkf::DEFAULT, single; "cd-ckf1" CdCkf1::DEFAULT; "cd-ckf2" CdCkf2::DEFAULT;
        "cd-ghkf1" CdGhkf1::DEFAULT; "cd-ghkf2" CdGhkf2::DEFAULT; "sr-cd-ekf" SrCdEkf::DEFAULT;
        "sr-acd-ekf" SrAcdEkf::DEFAULT; "sr-cd-ukf" SrCdUkf::DEFAULT; "sr-cd-ukf1" SrCdUkf1::DEFAULT;
        "sr-cd-ckf" SrCdCkf::DEFAULT, single; "sr-cd-ckf1" SrCdCkf1::DEFAULT, single;
        "sr-cd-ckf2" SrCdCkf2::DEFAULT, single; "sr-cd-ghkf1" SrCdGhkf1::DEFAULT; "sr-cd-ghkf2" SrCdGhkf2::DEFAULT;
        "lskf" Lskf::DEFAULT, single;
        "acd-ekf by rodas4" AcdEkf { solver: AdaptiveSolver::Rodas4, ..AcdEkf::DEFAULT };
        "sr-cd-ckf2 by rodas4" SrCdCkf2 { solver: Solver::Rodas4, ..SrCdCkf2::DEFAULT };
        "sr-cd-ckf2 by rk2" SrCdCkf2 { solver: Solver::Rk2, ..SrCdCkf2::DEFAULT };
        "sr-cd-ukf with beta" SrCdUkf { alpha: 0.5, beta: 2.0, ..SrCdUkf::DEFAULT };
        "sr-cd-ghkf1 of four points" SrCdGhkf1 { points: 4, ..SrCdGhkf1::DEFAULT };
        "lskf held triangular" Lskf { gauge: Gauge::Triangular, ..Lskf::DEFAULT };
        "lskf by its moved root" Lskf { root: Root::Moved, velocity: Velocity::Standard, ..Lskf::DEFAULT };
        "lskf by rodas4" Lskf { solver: Solver::Rodas4, ..Lskf::DEFAULT };
    }
    let continuous = ENTRIES.iter().filter(|entry| entry.kind() == Kind::Continuous).count();
    assert_eq!(types, continuous, "a method of the registry has no type here");
}

/// Memory as an array, without an allocator.
const METHOD: SrCdCkf2 = SrCdCkf2::DEFAULT;
const SIZES: Sizes = METHOD.sizes_for(Sizes { process_noise: 1, ..Sizes::new(2, 1) });
const LEN: usize = METHOD.smoothing_memory(SIZES);

#[test]
fn an_array_of_the_constant_length_serves_a_continuous_filter() {
    let factor = [0.2, 0.0, 0.0, 0.2];
    let prior = Prior { time: 0.0, mean: &[2.0, 0.0], factor: &factor, cov: &[] };
    let model = VanDerPol::default();
    let mut filter = Filter::start_in(METHOD, &model, SIZES, true, prior, [0.0_f64; LEN]).unwrap();
    filter.predict(0.5).unwrap();
    filter.update(&Components { states: 2, which: [0], std: [0.1] }, &[1.9]).unwrap();
    assert!((filter.mean()[0] - 1.9).abs() < 0.1);
}

/// dx = (u − p x) dt + p x dβ: a diffusion that depends on the state, with a control and a parameter.
struct Proportional;

impl Sde for Proportional {
    fn states(&self) -> usize {
        2
    }
    fn noises(&self) -> usize {
        2
    }
    fn controls(&self) -> usize {
        1
    }
    fn parameters(&self) -> &[f64] {
        &[0.5]
    }
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        for (dx, &x) in dx.iter_mut().zip(x) {
            *dx = at.u[0] - at.p[0] * x;
        }
    }
    fn diffusion<T: Real>(&self, at: &At<T>, x: &[T], g: &mut [T]) {
        g.copy_from_slice(&[at.p[0] * x[0], T::zero(), T::of(0.1), at.p[0] * x[1]]);
    }
    fn diffusion_varies(&self) -> Varies {
        Varies::WithState
    }
}

#[test]
fn the_sizes_of_a_diffusion_that_depends_on_the_state_are_constants_too() {
    macro_rules! check {
        ($($method:expr),*) => {$(
            let method = $method;
            let sizes = Sizes { controls: 1, parameters: 1, ..Sizes::new(2, 1) };
            let (stated, exact) = (method.sizes_with_state(sizes), Over::sizes(&method, &Proportional).unwrap());
            assert_eq!(stated, Sizes { measures: 1, measurement_noise: 1, ..exact }, "{method:?}");
            for smoothing in [false, true] {
                let mut memory = vec![f64::NAN; method.len(stated, smoothing)];
                let cov = [1.0, 0.0, 0.0, 1.0];
                let prior = Prior { time: 0.0, mean: &[1.0, 2.0], factor: &cov, cov: &cov };
                let memory = &mut memory[..];
                let mut filter =
                    Filter::start_in(method, &Proportional, stated, smoothing, prior, memory).unwrap();
                filter.set_controls(&[1.0]).unwrap();
                filter.predict(0.5).unwrap();
            }
        )*};
    }
    let rodas4 = Solver::Rodas4;
    check!(
        CdEkf::DEFAULT,
        SrCdEkf::DEFAULT,
        SrCdCkf2::DEFAULT,
        CdGhkf2::DEFAULT,
        SrCdUkf { solver: rodas4, ..SrCdUkf::DEFAULT }
    );
}

#[test]
fn sizes_and_options_out_of_range_have_a_length_too() {
    for n in [0, 1, 7, 10_000, 1 << 24, usize::MAX] {
        for q in [0, 3, 1 << 24, usize::MAX] {
            let sizes = Sizes { process_noise: q, ..Sizes::new(n, 1) };
            let _ = SrCdCkf1::DEFAULT.smoothing_memory(SrCdCkf1::DEFAULT.sizes_for(sizes));
            let _ = Lskf::DEFAULT.smoothing_memory(Lskf::DEFAULT.sizes_for(sizes));
            for points in [0, 1, 3, usize::MAX] {
                let method = SrCdGhkf2 { points, solver: Solver::Rodas4, ..SrCdGhkf2::DEFAULT };
                let _ = method.smoothing_memory(method.sizes_for(sizes));
                let _ = method.smoothing_memory(method.sizes_with_state(sizes));
            }
        }
    }
}

//! A step of a filter or a smoother allocates nothing.

use givens::filter::{
    CdCkf2, CdEkf, Cdkf, Ckf, Ckf5, Ekf, Filter, Form, Gaussian, Lskf, Over, Prior, Qkf, Sizes, SrCdCkf,
    SrCdCkf2, SrCdkf, SrCkf, SrCkf5, SrEkf, SrQkf, SrUkf, Ukf,
};
use givens::model::zoo::{Components, CoordinatedTurn, RangeBearing, VanDerPol};
use givens::smoother::{FixedPoint, History};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

/// The system's allocator, counting the calls of each thread.
struct Counting;

// SAFETY: every call goes to the system's allocator as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { System.dealloc(memory, layout) }
    }
    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        unsafe { System.realloc(memory, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// Allocations of twenty steps, after one that may make room for the sensor.
fn allocations<X: Over<CoordinatedTurn>>(method: X) -> usize {
    let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
    let prior =
        Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01]).unwrap();
    let mut filter = method.start(&turn, 0.0, &prior).unwrap();
    let mut before = 0;
    for k in 0..21 {
        if k == 1 {
            before = ALLOCATIONS.get();
        }
        let t = f64::from(k) + 1.0;
        filter.predict(t).unwrap();
        let (x, y) = (filter.mean()[0] + 3.0, filter.mean()[2] - 2.0);
        filter.update_present(&radar, &[x.hypot(y), y.atan2(x)], &[true, k % 3 != 0]).unwrap();
        // a range that is far off is looked at, and not taken in
        assert!(!filter.update_gated(&radar, &[x.hypot(y) + 1e4, y.atan2(x)], &[true; 2], 18.42).unwrap());
    }
    ALLOCATIONS.get() - before
}

#[test]
fn no_method_allocates_in_a_step() {
    assert_eq!(allocations(Ekf::default()), 0, "ekf");
    assert_eq!(allocations(Ukf::default()), 0, "ukf");
    assert_eq!(allocations(Cdkf::default()), 0, "cdkf");
    assert_eq!(allocations(Qkf::default()), 0, "qkf");
    assert_eq!(allocations(Ckf::default()), 0, "ckf");
    assert_eq!(allocations(Ckf5::default()), 0, "ckf5");
    assert_eq!(allocations(SrEkf::default()), 0, "sr-ekf");
    assert_eq!(allocations(SrUkf::default()), 0, "sr-ukf");
    assert_eq!(allocations(SrCdkf::default()), 0, "sr-cdkf");
    assert_eq!(allocations(SrQkf::default()), 0, "sr-qkf");
    assert_eq!(allocations(SrCkf::default()), 0, "sr-ckf");
    assert_eq!(allocations(SrCkf5::default()), 0, "sr-ckf5");
}

/// Allocations of a fixed-lag smoother over more rows than its ring holds, and of a fixed-point smoother beside it.
fn smoothing_allocations<X: Over<CoordinatedTurn>>(method: X) -> usize {
    let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
    let prior =
        Gaussian::from_std(&[1000.0, 300.0, 1000.0, 0.0, -0.05], &[10.0, 3.2, 10.0, 3.2, 0.01]).unwrap();
    let prior = Prior { time: 0.0, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
    let sizes = Sizes::new(5, 2);
    let memory =
        || vec![0.0_f64; Filter::<X, CoordinatedTurn, f64, Vec<f64>>::memory_len(&method, sizes, true)];
    let mut filter = Filter::start_in(method, &turn, sizes, true, prior, memory()).unwrap();
    let mut other = Filter::start_in(method, &turn, sizes, true, prior, memory()).unwrap();
    let lag = vec![0.0; History::<f64, Vec<f64>>::memory_len(5, 3)];
    let mut lag = History::new(5, X::Form::SQUARE_ROOT, lag);
    let point = vec![0.0; FixedPoint::<f64, Vec<f64>>::memory_len(5)];

    let before = ALLOCATIONS.get();
    let mut point = FixedPoint::begin(&mut other, point).unwrap();
    for k in 1..=8 {
        lag.predict(&mut filter, f64::from(k)).unwrap();
        point.predict(&mut other, f64::from(k)).unwrap();
        let (x, y) = (filter.mean()[0] + 3.0, filter.mean()[2] - 2.0);
        filter.update(&radar, &[x.hypot(y), y.atan2(x)]).unwrap();
        other.update(&radar, &[x.hypot(y), y.atan2(x)]).unwrap();
        point.update(&other).unwrap();
        let mut visits = 0;
        lag.smooth(&filter, 3, |_, now| visits += usize::from(now.belief.mean[0].is_finite())).unwrap();
        assert_eq!(visits, 1 + lag.len());
        lag.smooth_means(&filter, 3, |_, mean| assert!(mean[0].is_finite())).unwrap();
    }
    assert!(lag.len() == 3 && point.mean()[0].is_finite() && point.cov()[0] > 0.0);
    ALLOCATIONS.get() - before
}

#[test]
fn no_smoother_allocates_in_a_step() {
    assert_eq!(smoothing_allocations(Ekf::default()), 0, "ekf");
    assert_eq!(smoothing_allocations(Ukf::default()), 0, "ukf");
    assert_eq!(smoothing_allocations(Qkf::default()), 0, "qkf");
    assert_eq!(smoothing_allocations(SrEkf::default()), 0, "sr-ekf");
    assert_eq!(smoothing_allocations(SrUkf::default()), 0, "sr-ukf");
    assert_eq!(smoothing_allocations(SrCdkf::default()), 0, "sr-cdkf");
    assert_eq!(smoothing_allocations(SrCkf::default()), 0, "sr-ckf");
    assert_eq!(smoothing_allocations(SrCkf5::default()), 0, "sr-ckf5");
}

#[test]
fn allocations_are_counted() {
    let before = ALLOCATIONS.get();
    let held = vec![1.0; 64];
    assert!(ALLOCATIONS.get() > before, "{}", held.len());
}

/// The same in continuous time, over gaps of many steps of a solver.
fn continuous<X: Over<VanDerPol>>(method: X) -> usize {
    let model = VanDerPol::default();
    let sensor = Components { states: 2, which: [0], std: [0.1] };
    let prior = Gaussian::from_std(&[1.0, 0.0], &[0.3, 0.3]).unwrap();
    let mut filter = method.start(&model, 0.0, &prior).unwrap();
    let mut before = 0;
    for k in 0..11 {
        if k == 1 {
            before = ALLOCATIONS.get();
        }
        filter.predict(0.4 * (f64::from(k) + 1.0)).unwrap();
        let z = [filter.mean()[0] + 0.05];
        filter.update(&sensor, &z).unwrap();
    }
    ALLOCATIONS.get() - before
}

#[test]
fn no_solver_allocates_in_a_step() {
    use givens::ode::Solver;
    assert_eq!(continuous(SrCdCkf::default()), 0, "sr-cd-ckf");
    assert_eq!(continuous(CdEkf::default()), 0, "cd-ekf");
    for solver in Solver::ALL {
        assert_eq!(continuous(CdCkf2 { solver, ..CdCkf2::default() }), 0, "cd-ckf2, {solver:?}");
        assert_eq!(continuous(SrCdCkf2 { solver, ..SrCdCkf2::default() }), 0, "sr-cd-ckf2, {solver:?}");
        assert_eq!(continuous(Lskf { solver, ..Lskf::default() }), 0, "lskf, {solver:?}");
    }
}

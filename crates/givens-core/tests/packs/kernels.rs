//! The kernels on packs, lane by lane as on floats.

use super::every_set::{Check, every_pack};
use givens_core::kernels::{Health, cholesky, solve_lower, sweep, sweep_scratch, tria};
use givens_core::scalar::{InstructionSet, Mask, Pack, Real};

/// Reproducible numbers in (−1, 1), others for every lane and element. (Squares: multiples alone would make rows that
/// depend on each other.)
fn noise(lane: usize, i: usize) -> f64 {
    let k = (lane * 97 + i * 13 + 17) as f64;
    (k * k * 0.618_033_988_749_895).fract() * 2.0 - 1.0
}

/// Runs `kernel` over packs and over each lane alone; `fill` gives element i of a lane.
fn alike<P: Pack>(
    length: usize,
    fill: impl Fn(usize, usize) -> f64,
    packed: impl Fn(&mut [P]) -> bool,
    alone: impl Fn(&mut [P::Element]) -> bool,
) {
    let lanes: Vec<Vec<P::Element>> =
        (0..P::WIDTH).map(|l| (0..length).map(|i| P::Element::of(fill(l, i))).collect()).collect();
    let mut packs: Vec<P> =
        (0..length).map(|i| P::load(&lanes.iter().map(|lane| lane[i]).collect::<Vec<_>>())).collect();
    assert!(packed(&mut packs));
    for (l, mut lane) in lanes.into_iter().enumerate() {
        assert!(alone(&mut lane));
        for (i, x) in lane.iter().enumerate() {
            let (found, expected) = (packs[i].lane(l).first(), x.first());
            // rounding alone, which a fused product changes
            assert!(
                (found - expected).abs() <= 200.0 * P::EPSILON,
                "element {i} of lane {l}: {found} {expected}"
            );
        }
    }
}

struct Kernels;
impl Check for Kernels {
    fn holds<P: Pack>(_: InstructionSet) {
        let well = |health: P::Mask| !health.any();
        // rows of whole packs too, of which one matrix of floats would be several side by side
        for (n, k) in [(7, 22), (7, 24), (3, 4)] {
            alike::<P>(n * k, noise, |a| well(tria(a, n, k, k).sick), |a| !tria(a, n, k, k).sick);
        }
        // a lower factor with a good diagonal
        let factor = |l: usize, i: usize, n: usize| match (i / n, i % n) {
            (row, column) if row == column => 1.5 + 0.5 * noise(l, i),
            (row, column) if row > column => 0.4 * noise(l, i),
            _ => 0.0,
        };
        for (d, n) in [(3, 5), (3, 13)] {
            let size = d + n;
            let block = move |l: usize, i: usize| {
                let (row, column) = (i / size, i % size);
                match (row < d, column < d) {
                    (true, false) => noise(l, i),
                    (false, true) => 0.0,
                    _ => factor(l, i, size),
                }
            };
            alike::<P>(
                size * size,
                block,
                |a| well(sweep(a, d, n, &mut vec![P::zero(); sweep_scratch(d, n)]).sick),
                |a| !sweep(a, d, n, &mut vec![P::Element::zero(); sweep_scratch(d, n)]).sick,
            );
        }
        let n = 5;
        let covariance = move |l: usize, i: usize| -> f64 {
            let (row, column) = (i / n, i % n);
            (0..n).map(|j| factor(l, row * n + j, n) * factor(l, column * n + j, n)).sum()
        };
        alike::<P>(n * n, covariance, |a| well(cholesky(a, n).sick), |a| !cholesky(a, n).sick);
        let system = move |l: usize, i: usize| if i < n * n { factor(l, i, n) } else { noise(l, i) };
        alike::<P>(
            n * n + n,
            system,
            |a| {
                let (factor, b) = a.split_at_mut(n * n);
                solve_lower(factor, n, b);
                true
            },
            |a| {
                let (factor, b) = a.split_at_mut(n * n);
                solve_lower(factor, n, b);
                true
            },
        );
    }
}

#[test]
fn the_kernels_run_on_packs_as_on_floats() {
    every_pack::<Kernels>();
}

struct Faint;
impl Check for Faint {
    fn holds<P: Pack>(_: InstructionSet) {
        // rows whose squares have lost digits in some lanes, by a power of two: the others do not notice, and theirs is that of
        // the rows without it
        let (d, n) = (2, 3);
        let size = d + n;
        let unit = |l: usize, row: usize| {
            if (l + row).is_multiple_of(3) && row < d { P::FAINT.powf(1.5) } else { 1.0 }
        };
        let of = |l: usize, i: usize| match (i / size, i % size) {
            (row, column) if row == column => 2.0,
            (row, column) if column < row || column >= d => noise(l, i),
            _ => 0.0,
        };
        let turned = |a: &mut [P]| {
            let health = sweep(a, d, n, &mut vec![P::zero(); sweep_scratch(d, n)]);
            assert!(!health.sick.any());
        };
        for kernel in [&turned as &dyn Fn(&mut [P]), &|a| assert!(!tria(a, size, size, size).sick.any())] {
            let made = |unit: &dyn Fn(usize, usize) -> f64| -> Vec<P> {
                let pack = |i| {
                    (0..P::WIDTH).map(|l| P::Element::of(unit(l, i / size) * of(l, i))).collect::<Vec<_>>()
                };
                let mut packs: Vec<P> = (0..size * size).map(|i| P::load(&pack(i))).collect();
                kernel(&mut packs);
                packs
            };
            for (i, (x, plain)) in made(&unit).iter().zip(made(&|_, _| 1.0)).enumerate() {
                for l in 0..P::WIDTH {
                    let (found, expected) = (x.lane(l).first() / unit(l, i / size), plain.lane(l).first());
                    assert!(
                        (found - expected).abs() <= 40.0 * P::EPSILON,
                        "{i} of lane {l}: {found} {expected}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_lane_whose_squares_have_lost_digits_keeps_its_own() {
    every_pack::<Faint>();
}

struct OneSick;
impl Check for OneSick {
    fn holds<P: Pack>(_: InstructionSet) {
        // [4 2; 2 3] in every lane, but in one without a root, and in one with a NaN
        for sick in 0..P::WIDTH {
            let mut a = [4.0, 2.0, 2.0, 3.0].map(P::of);
            a[3] = a[3].with_lane(sick, P::Element::of(if sick % 2 == 0 { -1.0 } else { f64::NAN }));
            let health = cholesky(&mut a, 2);
            for l in 0..P::WIDTH {
                let expected = if l == sick { 0.0 } else { 1.0 };
                assert_eq!(P::select(health.sick, P::zero(), P::one()).lane(l).first(), expected);
                if l != sick {
                    assert!((a[3].lane(l).first() - 2f64.sqrt()).abs() < 4.0 * P::EPSILON);
                }
            }
        }
    }
}

#[test]
fn a_lane_that_fails_leaves_its_neighbours_alone() {
    every_pack::<OneSick>();
}

struct Told;
impl Check for Told {
    fn holds<P: Pack>(_: InstructionSet) {
        // of every four lanes one failed at pivot 2 and later at 5, one at 2, one at 5, and one not at all
        let lanes = |failed: [f64; 4]| {
            let of: Vec<P::Element> = (0..P::WIDTH).map(|l| P::Element::of(failed[l % 4])).collect();
            P::zero().lt(P::load(&of))
        };
        let (mut first, mut later) = (Health::<P>::good(), Health::<P>::good());
        first.note(lanes([1.0, 1.0, 0.0, 0.0]), 2);
        later.note(lanes([1.0, 0.0, 1.0, 0.0]), 5);
        for (health, pivots) in [
            (first, [Some(2.0), Some(2.0), None, None]),
            (first.and(later), [Some(2.0), Some(2.0), Some(5.0), None]),
            (later.and(first), [Some(5.0), Some(2.0), Some(5.0), None]),
            (first.and(later).shifted(3), [Some(5.0), Some(5.0), Some(8.0), None]),
            (first.and(later).shifted(3).shifted(4), [Some(9.0), Some(9.0), Some(12.0), None]),
        ] {
            let sick = P::select(health.sick, P::one(), P::zero());
            for (l, pivot) in (0..P::WIDTH).map(|l| (l, pivots[l % 4])) {
                assert_eq!(sick.lane(l).first() == 1.0, pivot.is_some(), "lane {l}");
                assert!(pivot.is_none_or(|pivot| health.pivot.lane(l).first() == pivot), "lane {l}");
            }
            assert_eq!(
                health.failed(),
                if P::WIDTH == 1 { pivots[0].map(|pivot| pivot as usize) } else { None }
            );
        }
    }
}

#[test]
fn lanes_are_told_with_the_pivot_at_which_they_failed_first() {
    every_pack::<Told>();
}

struct ItsOwnRounding;
impl Check for ItsOwnRounding {
    fn holds<P: Pack>(_: InstructionSet) {
        // [1 1; 1 1 + δ]: a pivot of nothing, of too little and of less than nothing, in other units in every lane
        let bound = 64.0 * 2.0 * P::EPSILON * 4.0;
        let kinds = [0.5, 2.0, -0.5, -2.0];
        let made = |of: &dyn Fn(f64, f64) -> f64| {
            let lane = |l: usize| P::Element::of(of(kinds[l % 4] * bound, 2_f64.powi([-20, 0, 20][l % 3])));
            P::load(&(0..P::WIDTH).map(lane).collect::<Vec<_>>())
        };
        let unit = made(&|_, unit| unit);
        let mut a = [unit, unit, unit, made(&|rest, unit| unit * (1.0 + rest))];
        let health = cholesky(&mut a, 2);
        for l in 0..P::WIDTH {
            let sick = P::select(health.sick, P::one(), P::zero()).lane(l).first() == 1.0;
            assert_eq!(sick, l % 4 == 3, "lane {l}");
            if !sick {
                assert_eq!(a[3].lane(l).first() > 0.0, l % 4 == 1, "lane {l}: {:?}", a[3]);
            }
        }
    }
}

#[test]
fn each_lane_is_judged_by_its_own_rounding() {
    every_pack::<ItsOwnRounding>();
}

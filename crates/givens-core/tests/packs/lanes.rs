//! Filling packs and reading them.

use super::every_set::{Check, every_pack, identical};
use givens_core::scalar::{InstructionSet, Mask, Pack, Real, gather, scatter};

fn count<P: Pack>(n: usize) -> Vec<P::Element> {
    (0..n).map(|i| P::Element::of(i as f64 + 0.5)).collect()
}

struct Slices;
impl Check for Slices {
    fn holds<P: Pack>(_: InstructionSet) {
        for n in 0..2 * P::WIDTH {
            let numbers = count::<P>(n);
            let pack = P::load(&numbers);
            for i in 0..P::WIDTH {
                let expected = numbers.get(i).or(numbers.last()).copied().unwrap_or(P::Element::of(f64::NAN));
                assert!(identical(pack.lane(i), expected), "lane {i} of {n}: {pack:?}");
            }
            assert!(pack.lane(P::WIDTH).first().is_nan() && pack.lane(usize::MAX).first().is_nan());
            let mut out = vec![P::Element::of(-1.0); n];
            pack.store(&mut out);
            for i in 0..n {
                assert!(identical(out[i], if i < P::WIDTH { pack.lane(i) } else { P::Element::of(-1.0) }));
            }
        }
    }
}

#[test]
fn short_slices_repeat_their_last_number_and_take_what_fits() {
    every_pack::<Slices>();
}

struct OneLane;
impl Check for OneLane {
    fn holds<P: Pack>(_: InstructionSet) {
        let pack = P::load(&count::<P>(P::WIDTH));
        assert_eq!(pack.first(), 0.5);
        for i in 0..P::WIDTH {
            let changed = pack.with_lane(i, P::Element::of(f64::NAN));
            for j in 0..P::WIDTH {
                assert_eq!(changed.lane(j).first().is_nan(), i == j);
            }
        }
        assert!(pack.with_lane(P::WIDTH, P::Element::one()).same(pack).all());
        assert!(P::splat(P::Element::of(3.0)).same(P::of(3.0)).all());
        assert_eq!(format!("{:?}", P::of(3.0)).matches("3.0").count(), P::WIDTH);
    }
}

#[test]
fn one_lane_is_set_and_read_without_the_others() {
    every_pack::<OneLane>();
}

struct Tracks;
impl Check for Tracks {
    fn holds<P: Pack>(_: InstructionSet) {
        let n = 5;
        for present in 1..=P::WIDTH {
            let states: Vec<Vec<P::Element>> =
                (0..present).map(|l| (0..n).map(|i| P::Element::of((10 * l + i) as f64)).collect()).collect();
            let borrowed: Vec<&[P::Element]> = states.iter().map(Vec::as_slice).collect();
            let mut packs = vec![P::zero(); n];
            gather(&borrowed, &mut packs);
            for (i, l) in (0..n).flat_map(|i| (0..P::WIDTH).map(move |l| (i, l))) {
                assert_eq!(packs[i].lane(l).first(), (10 * l.min(present - 1) + i) as f64);
            }
            let mut back = vec![vec![P::Element::zero(); n]; present];
            scatter(&packs, &mut back.iter_mut().map(Vec::as_mut_slice).collect::<Vec<_>>());
            assert!(back.iter().flatten().zip(states.iter().flatten()).all(|(&a, &b)| identical(a, b)));
        }
        // what is missing is none, and nothing is written outside
        let mut packs = [P::zero(); 2];
        gather(&[], &mut packs);
        assert!(!packs[0].finite().any());
        gather(&[&[P::Element::one()][..]], &mut packs);
        assert!(packs[0].same(P::one()).all() && !packs[1].finite().any());
        let mut short = [P::Element::zero(); 1];
        scatter(&packs, &mut [&mut short[..]]);
        assert_eq!(short[0].first(), 1.0);
    }
}

#[test]
fn tracks_go_into_packs_and_come_back() {
    every_pack::<Tracks>();
}

#[test]
fn what_the_machine_lacks_does_not_run() {
    use givens_core::scalar::{Element, Job};
    struct Never;
    impl<E: Element> Job<E> for Never {
        type Output = ();
        fn run<P: Pack<Element = E>>(self) {}
    }
    for set in InstructionSet::ALL {
        assert_eq!(set.run::<f64, _>(Never).is_some(), set.available());
        assert_eq!(set.run::<f32, _>(Never).is_some(), set.available());
    }
    assert!(InstructionSet::best().available() && InstructionSet::Portable.available());
}

//! A batch whose tracks are not all fit to begin.
#![allow(clippy::unwrap_used, missing_docs)]

use givens::batch::{Batch, Track};
use givens::filter::{Gaussian, SrCkf};
use givens::model::zoo::{CoordinatedTurn, RangeBearing};
use givens::{Data, Goal};

#[test]
fn a_prior_of_another_length_fails_its_own_track_only() {
    let (turn, radar) = (CoordinatedTurn::default(), RangeBearing::published());
    let mean = [1000.0, 300.0, 1000.0, 0.0, -0.05, 7.0];
    let prior = Gaussian::from_std(&mean[..5], &[10.0, 3.2, 10.0, 3.2, 0.01]).unwrap();
    let data = |rows: u32| {
        let mut data = Data::new(2).starting_at(0.0);
        for k in 1..=rows {
            data.push(f64::from(k), &[1640.0 + 9.0 * f64::from(k), 0.65]).unwrap();
        }
        data
    };
    let (longer, usual) = (data(4), data(3));
    for goal in [Goal::Filter, Goal::Interval] {
        for n in [4, 6] {
            let strange = Gaussian::from_std(&mean[..n], &[10.0; 6][..n]).unwrap();
            // the longest is the first of its pack
            let first = Track::new(&turn, &radar, &longer, &strange);
            let others = [Track::new(&turn, &radar, &usual, &prior); 3];
            let batch = Batch { goal, ..Batch::default() };
            let expected = batch.run(SrCkf::default(), &others);
            let found = batch.run(SrCkf::default(), &[&[first], &others[..]].concat());
            assert!(found[0].as_ref().unwrap().failure.is_some(), "{goal:?}, {n}");
            for (found, expected) in found[1..].iter().flatten().zip(expected.iter().flatten()) {
                assert!(found.failure.is_none() && expected.failure.is_none(), "{goal:?}, {n}");
                assert_eq!(found.estimates.mean, expected.estimates.mean, "{goal:?}, {n}");
                assert_eq!(found.estimates.cov, expected.estimates.cov, "{goal:?}, {n}");
            }
        }
    }
}

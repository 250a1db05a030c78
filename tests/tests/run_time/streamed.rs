//! A stream against a run, to the bit: with few and many rows at once, and from where it was broken off.

use core::num::NonZeroUsize;
use core::ops::{ControlFlow, Range};
use core::sync::atomic::{AtomicUsize, Ordering};
use givens::{Data, Ended, Estimates, Finished, Goal, Mark, Outcome, Row, Sink, Source, Stream, Stretch};

/// All numbers of some estimates, array by array, as bits.
#[derive(Clone, Debug, Default, PartialEq)]
struct Bits([Vec<u64>; 14]);

impl Bits {
    fn add(&mut self, est: &Estimates) {
        let dof: Vec<f64> = est.nis_dof.iter().map(|&dof| dof as f64).collect();
        let gated: Vec<f64> = est.gated.iter().map(|&gated| f64::from(u8::from(gated))).collect();
        let arrays = [
            &est.time,
            &est.mean,
            &est.cov,
            &est.factor,
            &est.filtered_mean,
            &est.filtered_cov,
            &est.predicted_mean,
            &est.predicted_cov,
            &est.innovation,
            &est.innovation_cov,
            &est.nis,
            &est.log_likelihood,
            &dof,
            &gated,
        ];
        for (to, from) in self.0.iter_mut().zip(arrays) {
            to.extend(from.iter().map(|x| x.to_bits()));
        }
    }

    fn of(est: &Estimates) -> Self {
        let mut bits = Self::default();
        bits.add(est);
        bits
    }
}

pub fn data<'a>(rows: impl Iterator<Item = Row<'a>>, measures: usize, controls: usize) -> Data {
    let mut data = Data::with_controls(measures, controls).starting_at(0.0);
    rows.for_each(|row| data.push_controlled(row.time, row.z, row.u).unwrap());
    data
}

/// Rows that are read from elsewhere: none but those asked for, and none from row `end` on.
pub struct Apart<'d> {
    pub of: &'d Data,
    pub end: usize,
}

impl Source for Apart<'_> {
    fn start(&self) -> f64 {
        self.of.start()
    }

    fn len(&self) -> usize {
        self.of.len()
    }

    fn read(&self, rows: Range<usize>) -> Option<Stretch<'_>> {
        let mut data = Data::with_controls(self.of.measures(), self.of.controls());
        for row in self.of.rows().take(rows.end).skip(rows.start) {
            data.push_controlled(row.time, row.z, row.u).unwrap();
        }
        (rows.end <= self.end).then(|| Stretch::new(data, rows.start))
    }
}

/// What was handed over, and for each mark what had been before it.
#[derive(Clone, Default)]
struct Taken {
    rows: Bits,
    at: Bits,
    count: usize,
    marks: Vec<(Mark, Bits, Bits, usize)>,
}

impl Sink for Taken {
    fn take(&mut self, finished: Finished) -> ControlFlow<()> {
        // where the first row that has an estimate is not that of the data
        if self.count > 0 && !finished.estimates.is_empty() {
            assert_eq!(finished.first, self.count);
        }
        self.count = finished.first + finished.estimates.len();
        self.rows.add(finished.estimates);
        self.at.add(finished.at);
        ControlFlow::Continue(())
    }

    fn mark(&mut self, mark: Mark) {
        self.marks.push((mark, self.rows.clone(), self.at.clone(), self.count));
    }
}

/// Streams with few and many rows at once, and compares with a run; then again from where it was broken off.
pub fn agrees(
    name: &str,
    goal: Goal,
    all: usize,
    whole: &Outcome,
    stream: impl Fn(&Stream, &mut dyn Sink) -> Ended,
) {
    for (hold, threads) in [(1, 1), (9, 2), (30, 3)] {
        let from_to_end = |from: &[Mark], mut taken: Taken, threads| {
            let place = format!("{name}, {goal:?}, {hold} rows at once, from mark {}", from.len());
            let (counter, threads) = (AtomicUsize::new(0), NonZeroUsize::new(threads));
            let by = Stream { goal, hold, threads, rows: Some(&counter), cancel: None, from };
            let ended = stream(&by, &mut taken);
            assert_eq!(ended.failure, whole.failure, "{place}");
            assert_eq!(ended.failed_at, whole.failed_at, "{place}");
            assert_eq!(ended.log_likelihood.to_bits(), whole.log_likelihood.to_bits(), "{place}");
            assert!(taken.rows == Bits::of(&whole.estimates), "{place}: other rows");
            assert!(taken.at == Bits::of(&whole.at), "{place}: other states between the rows");
            if whole.failure.is_none() {
                assert_eq!(counter.load(Ordering::Relaxed), all, "{place}");
            }
            taken.marks
        };
        let marks = from_to_end(&[], Taken::default(), threads);
        let can = !matches!(goal, Goal::Point(_)) && hold < all && whole.estimates.len() > hold;
        assert!(!can || !marks.is_empty(), "{name}, {goal:?}, {hold}: no mark");
        let kept: Vec<Mark> = marks.iter().map(|(mark, ..)| mark.clone()).collect();
        // broken off at some of them: the first, the last, and between
        let mut ends: Vec<usize> = (0..4).map(|i| (marks.len().saturating_sub(1) * i).div_ceil(3)).collect();
        ends.dedup();
        for end in ends.into_iter().take(marks.len()) {
            let (_, rows, at, count) = marks[end].clone();
            let taken = Taken { rows, at, count, marks: Vec::new() };
            from_to_end(&kept[..=end], taken, 3 - threads.min(2));
        }
    }
}

/// A stream whose rows cannot be read from row `end` on hands over rows of the run, up to there at most.
pub fn ends(whole: &Outcome, end: usize, stream: impl Fn(&mut dyn Sink) -> Ended) {
    let mut taken = Taken::default();
    let ended = stream(&mut taken);
    assert!(ended.failure.is_none() && taken.count <= end, "{} rows of {end}", taken.count);
    let mut rows = Bits::of(&whole.estimates);
    rows.0.iter_mut().zip(&taken.rows.0).for_each(|(all, some)| all.truncate(some.len()));
    assert!(taken.rows == rows, "other rows");
}

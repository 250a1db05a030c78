//! What may be wrong about answers that are no errors.

mod digits;
mod gap;
mod watch;

use crate::Estimates;
use crate::filter::Gaussian;
use crate::registry::Choice;
use digits::Digits;
pub use gap::Gap;
use gap::Stand;
use watch::Watch;

/// Why an answer may be wrong, though each step of the filter had an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Doubt {
    /// Steps of equal length are too long: with twice as many the prediction to the row moves by more than a thousandth of
    /// its standard deviations.
    Steps {
        /// By how many standard deviations, in the mean of a state or in the covariance of a pair.
        moved: f64,
    },
    /// A measurement has made the standard deviation of a state so many times smaller that what is left of it may be the
    /// rounding of what it was.
    Shrunk {
        /// The state, from zero.
        component: usize,
    },
    /// How well a state is known given those before it is less than the rounding of its variance: a root of it may hold
    /// that, a covariance does not.
    Bound {
        /// The state, from zero.
        component: usize,
    },
}

impl Doubt {
    /// Whether it matters to most users: of steps, whether the prediction moves by more than a twentieth of a standard deviation.
    #[must_use]
    pub fn is_grave(&self) -> bool {
        !matches!(self, Doubt::Steps { moved } if *moved <= 0.05)
    }

    /// Its kind.
    fn kind(&self) -> usize {
        match self {
            Doubt::Steps { .. } => 0,
            Doubt::Shrunk { .. } => 1,
            Doubt::Bound { .. } => 2,
        }
    }
}

/// A doubt, and where it arose: of the steps' the worst, of the others' the first.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Doubtful {
    /// The track, as it was counted by who asked.
    pub track: usize,
    /// Its row, from zero.
    pub row: usize,
    /// The time of the row.
    pub time: f64,
    /// Why.
    pub doubt: Doubt,
    /// How many rows are doubtful for a reason of this kind, of those that were looked at.
    pub rows: usize,
}

/// What is doubtful about the rows of a run, or of several: a second look at answers that no step of the filter has refused.
///
/// Digits are looked at in every row. Steps of equal length are halved in few gaps, whatever the number of rows: in the 1st, 2nd,
/// 4th, 8th and so on; in the first of each of the first 64 tracks; and wherever a gap is longer than any before by half, or a
/// prediction widens a standard deviation, or moves a mean by more of them, twice as much as any before.
///
/// ```
/// use givens::filter::Gaussian;
/// use givens::model::zoo::{Radar3d, Turn3d};
/// use givens::registry::resolve;
/// use givens::{Data, Doubt, Doubts, Goal};
///
/// let mut data = Data::new(3).starting_at(0.0);
/// data.push(60.0, &[2800.0, 1.2, 0.08])?;
/// let prior = Gaussian::from_std(&[1000.0, 0.0, 2000.0, 100.0, 200.0, 0.0, 0.3], &[200.0, 10.0, 200.0, 10.0, 200.0, 10.0, 0.01])?;
/// let (turn, radar, choice) = (Turn3d::default(), Radar3d::default(), resolve("sr-cd-ckf", &[])?);
/// let outcome = choice.run_continuous(&turn, &radar, data.rows(), data.start(), &prior, Goal::Filter, &[]);
/// let mut doubts = Doubts::new(&choice);
/// doubts.begin(0, data.start(), &prior);
/// doubts.add(0, 0, &outcome.estimates, &mut |gap| choice.halved(&turn, &radar, &[], &[], gap));
/// // eighteen radians of a turn, in sixteen steps
/// assert!(doubts.found().any(|found| matches!(found.doubt, Doubt::Steps { moved } if moved > 0.1)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Doubts {
    digits: Digits,
    /// Whether the steps are of equal length.
    equal: bool,
    found: [Option<Doubtful>; 3],
    watch: Watch,
    /// Behind the last row, and of which track it is.
    last: Option<(usize, Gap)>,
}

/// A prediction that moves by less is right.
const MOVED: f64 = 1e-3;

impl Doubts {
    /// About answers of this method.
    #[must_use]
    pub fn new(choice: &Choice) -> Self {
        Self { digits: Digits::of(choice), equal: choice.steps_are_equal(), ..Self::default() }
    }

    /// A track begins, with this belief at `time`.
    pub fn begin(&mut self, track: usize, time: f64, prior: &Gaussian) {
        let stand = Stand { from: time, mean: prior.mean(), cov: prior.cov() };
        self.last = self.equal.then(|| (track, stand.until(0, time)));
    }

    /// Looks at rows of a track, the first of which is its row `first`; those of one track follow each other. `halved` is asked how far a prediction
    /// moves by halved steps: see [`Choice::halved`].
    pub fn add(
        &mut self,
        track: usize,
        first: usize,
        est: &Estimates,
        halved: &mut dyn FnMut(&Gap) -> Option<f64>,
    ) {
        let begun = self.last.take().filter(|(of, _)| *of == track);
        for k in 0..est.len() {
            let (row, time) = (first + k, est.time[k]);
            let at = |doubt| Doubtful { track, row, time, doubt, rows: 1 };
            let stand = match k.checked_sub(1) {
                Some(before) => self.equal.then(|| behind(est, before)),
                None => begun.as_ref().map(|(_, gap)| gap.stand()),
            };
            if let Some(stand) = stand {
                let reach = stand.reach(est.predicted_mean(k), est.predicted_cov(k));
                if self.watch.notes(track, time - stand.from, reach)
                    && let Some(moved) = halved(&stand.until(row, time))
                    && moved > MOVED
                {
                    self.note(at(Doubt::Steps { moved }));
                }
            }
            for doubt in self.digits.lost(est.predicted_cov(k), est.filtered_cov(k)) {
                self.note(at(doubt));
            }
        }
        self.last = match est.len().checked_sub(1) {
            Some(end) => self.equal.then(|| (track, behind(est, end).until(first + end, est.time[end]))),
            None => begun,
        };
    }

    /// Looks at the last of the times that were asked for besides, if it is behind the rows of the track that were added last.
    pub fn ahead(&mut self, at: &Estimates, halved: &mut dyn FnMut(&Gap) -> Option<f64>) {
        let Some(&time) = at.time.last() else { return };
        let Some((track, gap)) = self.last.as_ref().filter(|(_, gap)| gap.from < time) else { return };
        let (track, row) = (*track, gap.row + 1);
        if let Some(moved) = halved(&gap.stand().until(row, time)).filter(|moved| *moved > MOVED) {
            self.note(Doubtful { track, row, time, doubt: Doubt::Steps { moved }, rows: 1 });
        }
    }

    /// What was found: no more than one of each kind.
    pub fn found(&self) -> impl Iterator<Item = &Doubtful> {
        self.found.iter().flatten()
    }

    fn note(&mut self, new: Doubtful) {
        let of = &mut self.found[new.doubt.kind()];
        let rows = of.map_or(0, |old| old.rows) + 1;
        let worse = match (*of, new.doubt) {
            (Some(Doubtful { doubt: Doubt::Steps { moved: old }, .. }), Doubt::Steps { moved }) => {
                moved > old
            }
            (old, _) => old.is_none(),
        };
        match of {
            Some(old) if !worse => old.rows = rows,
            _ => *of = Some(Doubtful { rows, ..new }),
        }
    }
}

/// What is believed behind a row.
fn behind(est: &Estimates, row: usize) -> Stand<'_> {
    Stand { from: est.time[row], mean: est.filtered_mean(row), cov: est.filtered_cov(row) }
}

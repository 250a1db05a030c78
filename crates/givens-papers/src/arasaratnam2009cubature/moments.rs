//! The rules of four filters on the multi-quadric, over many random covariances.

use super::multiquadric::{Moments, POWERS, by_rule, random_root, sampled};
use crate::drawing::{COLOURS, line};
use crate::estimate::{MANY, all as judged};
use crate::page::Table;
use crate::statistics::mean_of;
use crate::{Estimate, Failures, Plan, Trouble, Verdict};
use core::fmt::Write as _;
use givens::rule::{CentralDifference, Cubature3, Taylor, Unscented};
use givens::simulate::Stream;
use givens_io::figure::{Axis, Mark, Panel, Shape};

/// Random covariances of each setting.
pub(super) const OWN: usize = 50;

/// The filters whose rules are compared.
pub(super) const RULES: [&str; 4] = ["EKF", "UKF", "CDKF", "CKF"];
pub(super) const CDKF: usize = 2;
pub(super) const CKF: usize = 3;

/// One point of a curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setting {
    /// Of its random numbers.
    pub track: u32,
    /// The number of dimensions.
    pub states: usize,
    /// Every variance of the prior.
    pub variance: f64,
}

/// What became of one setting: for each power and each rule, the divergences over the covariances.
pub(super) struct Scores {
    pub setting: Setting,
    /// The number of covariances.
    pub runs: usize,
    /// By power, then by rule; `None` for a covariance that gave no variance.
    divergences: [[Vec<Option<f64>>; 4]; 4],
    /// The variances that are no variance, by rule.
    failures: [Failures; 4],
}

impl Scores {
    /// The mean divergence of a rule over the covariances that gave one.
    pub fn mean(&self, power: usize, rule: usize) -> Estimate {
        mean_of(self.divergences[power][rule].iter().flatten().copied())
    }

    /// By how much the mean divergence of the CDKF exceeds that of the CKF, on the same covariances.
    pub fn gap(&self, power: usize) -> Estimate {
        self.more([power, CDKF], [power, CKF])
    }

    /// By how much the mean divergence of one power and rule exceeds that of another, on the same covariances.
    pub fn more(&self, of: [usize; 2], than: [usize; 2]) -> Estimate {
        let [of, than] = [of, than].map(|[power, rule]| &self.divergences[power][rule]);
        mean_of(of.iter().zip(than).filter_map(|(a, b)| Some((*a)? - (*b)?)))
    }

    /// Covariances of which a rule gives no variance at any power.
    pub fn never(&self, rule: usize) -> usize {
        let none = |run: &usize| self.divergences.iter().all(|of| of[rule][*run].is_none());
        (0..self.runs).filter(none).count()
    }
}

/// All settings, `plan.runs` covariances each.
pub(super) fn scores(plan: &Plan, settings: &[Setting]) -> Result<Vec<Scores>, Trouble> {
    let runs = plan.runs(OWN);
    let answers = plan.each(settings.len() * runs, |unit| {
        let unit = unit as usize;
        one(settings[unit / runs], plan.seed, (unit % runs) as u32)
    });
    let mut all: Vec<Scores> = settings
        .iter()
        .map(|&setting| Scores {
            setting,
            runs,
            divergences: Default::default(),
            failures: Default::default(),
        })
        .collect();
    for (unit, answer) in answers.into_iter().enumerate() {
        let [truth, estimates @ ..] = answer?;
        let scores = &mut all[unit / runs];
        for (rule, estimates) in estimates.iter().enumerate() {
            for power in 0..POWERS.len() {
                let (failures, divergence) =
                    (&mut scores.failures[rule], truth[power].divergence(&estimates[power]));
                let wrong = match estimates[power].variance {
                    0.0 => Some("of zero"),
                    negative if negative < 0.0 => Some("negative"),
                    _ if !divergence.is_finite() => Some("not a number"),
                    _ => None,
                };
                if let Some(kind) = wrong {
                    failures.note_kind(kind);
                }
                scores.divergences[power][rule].push(wrong.is_none().then_some(divergence));
            }
        }
    }
    Ok(all)
}

/// The moments of one covariance: true, and by each rule.
fn one(setting: Setting, seed: u64, run: u32) -> Result<[[Moments; 4]; 5], Trouble> {
    let (n, mut stream) = (setting.states, Stream::new(seed, setting.track, run));
    let root = random_root(n, setting.variance, &mut stream)?;
    Ok([
        sampled(&root, n, &mut stream),
        by_rule(Taylor, &root, n),
        by_rule(Unscented::default(), &root, n),
        by_rule(CentralDifference::default(), &root, n),
        by_rule(Cubature3, &root, n),
    ])
}

/// Every mean divergence.
pub(super) fn table(all: &[Scores]) -> Table {
    let columns = ["n", "variance", "p", "filter", "divergence", "spread", "covariances", "failed"];
    let mut table = Table::new("divergence", &columns);
    for scores in all {
        for (power, p) in POWERS.iter().enumerate() {
            for (rule, name) in RULES.iter().enumerate() {
                let given = scores.divergences[power][rule].iter().flatten().count();
                let mean = scores.mean(power, rule);
                table.rows.push(vec![
                    scores.setting.states.into(),
                    scores.setting.variance.into(),
                    f64::from(*p).into(),
                    (*name).into(),
                    mean.value.into(),
                    mean.error.into(),
                    scores.runs.into(),
                    (scores.runs - given).into(),
                ]);
            }
        }
    }
    table
}

/// What [`failures`] counts.
pub(super) const FAILING: &str = "Variances that are none, of all covariances at all settings and powers";

/// The rules' failures over all settings. The form makes no difference: each rule is applied to a given root.
pub(super) fn failures(all: &[Scores]) -> Vec<(String, Failures)> {
    let tried = POWERS.len() * all.iter().map(|scores| scores.runs).sum::<usize>();
    let mut sums: Vec<(String, Failures)> = RULES
        .iter()
        .map(|name| (format!("rule of the {name} ({tried} tried)"), Failures::default()))
        .collect();
    for scores in all {
        for (sum, failures) in sums.iter_mut().zip(&scores.failures) {
            sum.1.add(failures);
        }
    }
    sums
}

/// Whether the gap between CDKF and CKF is wider at the last setting than at the first, for every power.
pub(super) fn widens(all: &[Scores]) -> (String, Verdict) {
    let (Some(first), Some(last)) = (all.first(), all.last()) else {
        return (String::new(), Verdict::Undecided(crate::estimate::NOTHING));
    };
    let of = |power: usize| (first.gap(power), last.gap(power));
    let word = |power: usize| {
        let (first, last) = of(power);
        format!("{first:.2} to {last:.2} (p = {})", POWERS[power])
    };
    let words: Vec<String> = (0..POWERS.len()).map(word).collect();
    let verdict = (0..POWERS.len()).map(of).map(|(first, last)| last.less(first).above(0.0, MANY));
    (format!("its excess: {}", words.join(", ")), judged(verdict))
}

/// Whether the divergence of the cubature rule is below that of the central difference at every setting and power.
pub(super) fn inferior(all: &[Scores], name: impl Fn(&Setting) -> String) -> (String, Verdict) {
    let (mut verdicts, mut above, mut open) = (Vec::new(), Vec::new(), Vec::new());
    for scores in all {
        for (power, p) in POWERS.iter().enumerate() {
            let gap = scores.gap(power);
            let verdict = gap.above(0.0, MANY);
            let word = format!("{} p = {p} ({gap:.2})", name(&scores.setting));
            match verdict {
                Verdict::Holds => {}
                Verdict::Fails => above.push(word),
                _ => open.push(word),
            }
            verdicts.push(verdict);
        }
    }
    let below = verdicts.len() - above.len() - open.len();
    let mut ours = format!("the CDKF's divergence is the higher at {below} of {} settings", verdicts.len());
    // where runs are few, all are undecided, and no list says more
    for (word, list) in [("the lower", above), ("undecided", open)] {
        if !list.is_empty() && list.len() < 10 {
            let _ = write!(ours, "; {word} at {}", list.join(", "));
        }
    }
    (ours, judged(verdicts))
}

/// The divergences of one rule over `x`, one line a power, and the published values as rings.
pub(super) fn panel(
    all: &[Scores],
    rule: usize,
    heading: &str,
    axes: [Axis; 2],
    x: impl Fn(&Setting) -> f64,
    published: impl Fn(usize) -> Vec<[f64; 2]>,
) -> Panel {
    let mut marks = Vec::new();
    for (power, p) in POWERS.iter().enumerate() {
        let points = all.iter().map(|scores| [x(&scores.setting), scores.mean(power, rule).value]).collect();
        let sign = if *p < 0 { "−" } else { "" };
        marks.push(line(&format!("p = {sign}{}", p.abs()), COLOURS[power], points));
    }
    for power in 0..POWERS.len() {
        let points = published(power);
        let name = if power == 0 && !points.is_empty() { "in print, by eye" } else { "" };
        marks.push(Mark::new(name, COLOURS[power], Shape::Dots { points, radius: 4.5, hollow: true }));
    }
    let [x, y] = axes;
    Panel { heading: heading.to_owned(), x, y, marks, ..Panel::default() }
}

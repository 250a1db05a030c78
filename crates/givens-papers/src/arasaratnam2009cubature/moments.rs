//! The rules of four filters on the multi-quadric, over many random covariances.

use super::multiquadric::{Moments, POWERS, by_rule, random_root, sampled};
use crate::drawing::{COLOURS, line};
use crate::page::Table;
use crate::statistics::spread;
use crate::{Failures, Plan, Trouble};
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

/// What became of one setting: for each power and each rule, the divergences of the covariances that gave one.
pub(super) struct Scores {
    pub setting: Setting,
    /// The number of covariances.
    pub runs: usize,
    divergences: [[Vec<f64>; 4]; 4],
    /// The variances that are no variance, by rule.
    failures: [Failures; 4],
}

impl Scores {
    /// The mean divergence of a rule; NaN if it never gave one.
    pub fn mean(&self, power: usize, rule: usize) -> f64 {
        mean(&mut self.divergences[power][rule].iter().copied())
    }

    /// By how much the mean divergence of the CDKF exceeds that of the CKF.
    pub fn gap(&self, power: usize) -> f64 {
        self.mean(power, CDKF) - self.mean(power, CKF)
    }

    /// The standard deviation of a rule's mean over replications.
    pub fn spread(&self, power: usize, rule: usize) -> f64 {
        spread(&self.divergences[power][rule], mean)
    }
}

fn mean(sample: &mut dyn Iterator<Item = f64>) -> f64 {
    let (sum, count) = sample.fold((0.0, 0.0), |(sum, count), x| (sum + x, count + 1.0));
    sum / count
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
                match estimates[power].variance {
                    0.0 => failures.note_kind("variance of zero"),
                    negative if negative < 0.0 => failures.note_kind("negative variance"),
                    _ if !divergence.is_finite() => failures.note_kind("not a number"),
                    _ => scores.divergences[power][rule].push(divergence),
                }
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
                let given = scores.divergences[power][rule].len();
                table.rows.push(vec![
                    scores.setting.states.into(),
                    scores.setting.variance.into(),
                    f64::from(*p).into(),
                    (*name).into(),
                    scores.mean(power, rule).into(),
                    scores.spread(power, rule).into(),
                    scores.runs.into(),
                    (scores.runs - given).into(),
                ]);
            }
        }
    }
    table
}

/// The rules' failures over all settings.
pub(super) fn failures(all: &[Scores]) -> Vec<(String, Failures)> {
    let mut sums: Vec<(String, Failures)> =
        RULES.iter().map(|name| ((*name).to_owned(), Failures::default())).collect();
    for scores in all {
        for (sum, failures) in sums.iter_mut().zip(&scores.failures) {
            sum.1.add(failures);
        }
    }
    sums
}

/// Whether the gap between CDKF and CKF is wider at the last setting than at the first, for every power, and in words.
pub(super) fn widens(all: &[Scores]) -> (bool, String) {
    let (Some(first), Some(last)) = (all.first(), all.last()) else { return (false, String::new()) };
    let powers = 0..POWERS.len();
    let gaps = powers
        .clone()
        .map(|power| format!("{:.2} to {:.2} (p = {})", first.gap(power), last.gap(power), POWERS[power]));
    let words = gaps.collect::<Vec<_>>().join(", ");
    (powers.clone().all(|power| last.gap(power) > first.gap(power)), words)
}

/// Where the divergence of the cubature rule is not below that of the central difference: how many settings, and which.
pub(super) fn not_below(all: &[Scores]) -> Vec<(Setting, i32)> {
    let worse = |scores: &Scores, power: usize| scores.mean(power, CKF) >= scores.mean(power, CDKF);
    let of = |scores: &Scores| {
        let setting = scores.setting;
        let powers = (0..POWERS.len()).filter(|&power| worse(scores, power));
        powers.map(|power| (setting, POWERS[power])).collect::<Vec<_>>()
    };
    all.iter().flat_map(of).collect()
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
        let points = all.iter().map(|scores| [x(&scores.setting), scores.mean(power, rule)]).collect();
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

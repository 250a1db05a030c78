//! Figure 5: the divergence over the number of dimensions.

use super::moments::{self, CDKF, CKF, OWN, RULES, Scores, Setting, inferior, scores, widens};
use super::multiquadric::POWERS;
use crate::drawing::{axis, figure};
use crate::estimate::{MANY, ONE, all as judged, exactly, more_than};
use crate::{Claim, Expected, Page, Plan, Trouble, Verdict};
use givens_io::figure::{Axis, Scale};

const EXPECTED: &str = include_str!("expected/figure-5.toml");
/// The last number of dimensions, and the step to it.
const LAST: usize = 100;
const STEP: usize = 5;

pub(super) fn run(plan: &Plan) -> Result<Page, Trouble> {
    let setting = |i: usize| Setting { track: 2_009_500 + i as u32, states: STEP * i, variance: 1.0 };
    let all = scores(plan, &(1..=LAST / STEP).map(setting).collect::<Vec<_>>())?;
    let expected = Expected::read(EXPECTED)?;
    let mut claims = Vec::new();
    for (rule, key) in [(CDKF, "cdkf"), (CKF, "ckf")] {
        for (power, p) in POWERS.iter().enumerate() {
            for scores in &all {
                let n = scores.setting.states;
                let Some(published) = expected.number(&[key, &p.to_string(), &n.to_string()]) else {
                    continue;
                };
                let (theirs, runs) = (OWN as f64, plan.runs(OWN) as f64);
                let what = format!("{}, p = {p}, n = {n} (read by eye)", RULES[rule]);
                let claim = Claim::number(what, published, scores.mean(power, rule), theirs, runs);
                claims.push(claim.explained(BY_EYE));
            }
        }
    }
    claims.extend(statements(&all));
    let panel = |rule: usize, heading: &str| {
        let published = |power: usize| {
            let at = |n: usize| {
                let path = [["", "", "cdkf", "ckf"][rule], &POWERS[power].to_string(), &n.to_string()];
                Some([n as f64, expected.number(&path)?])
            };
            (0..=LAST).filter_map(at).collect()
        };
        let x = Axis { range: Some([0.0, 102.0]), ..axis("dimensions n", Scale::Linear) };
        let y = Axis { range: Some([0.0, 12.0]), ..axis("KL divergence", Scale::Linear) };
        moments::panel(&all, rule, heading, [x, y], |setting| setting.states as f64, published)
    };
    let shown = figure(
        "Moments of a multi-quadric: divergence over dimensions, variance 1",
        true,
        vec![panel(CDKF, "(a) CDKF"), panel(CKF, "(b) CKF")],
    );
    Ok(Page {
        about: format!(
            "{} random covariances of each size, drawn as the correlation matrices of A Aᵀ with A standard normal; true \
             moments from 10,000 samples, the same for all powers and filters; lower Cholesky factors. Rings: read off the \
             paper's figure by eye. Above 12 the lines leave the axes; the table has all.",
            plan.runs(OWN)
        ),
        claims,
        tables: vec![moments::table(&all)],
        figures: vec![("divergence", shown)],
        failures: moments::failures(&all),
        failing: moments::FAILING,
    })
}

const BY_EYE: &str = "print does not say how the covariances were drawn, on which the level depends: the CDKF's at \
                      p = 1, n = 100 is 1.3 with A uniform on (0, 1), 14.1 with a uniform spectrum";

fn statements(all: &[Scores]) -> Vec<Claim> {
    let covariances: usize = all.iter().map(|scores| scores.runs).sum();
    let never = |rule: usize| all.iter().map(|scores| scores.never(rule)).sum::<usize>();
    let (ekf, ukf) = (never(0), never(1));
    let of = |count: usize| format!("no variance at any p of {count} of {covariances} covariances");
    let powers = 0..POWERS.len();
    let both = || powers.clone().flat_map(|power| [CDKF, CKF].map(|rule| (power, rule)));
    let mut growth = Vec::new();
    if let (Some(first), Some(last)) = (all.first(), all.last()) {
        growth.extend(both().map(|(power, rule)| (first.mean(power, rule), last.mean(power, rule))));
    }
    let least = growth.iter().map(|(first, last)| last.value / first.value).fold(f64::INFINITY, f64::min);
    let falls = |pair: &[Scores]| {
        let fell = |(power, rule): (usize, usize)| pair[0].mean(power, rule).less(pair[1].mean(power, rule));
        both().map(fell).filter(|fall| fall.above(0.0, MANY) == Verdict::Holds).count()
    };
    let falls: usize = all.windows(2).map(falls).sum();
    let grows = growth.iter().map(|(first, last)| last.less(*first).above(0.0, MANY));
    let grows = judged(grows.chain([exactly(falls == 0)]));
    let step = |scores: &Scores, rule: usize| {
        let more = |p: usize| scores.more([p, rule], [p - 1, rule]).above(0.0, MANY);
        judged((1..POWERS.len()).map(more))
    };
    let steps = |rule: usize| all.iter().map(move |scores| step(scores, rule));
    let ordered = |rule: usize| steps(rule).filter(|verdict| *verdict == Verdict::Holds).count();
    let (worse, inferior) = inferior(all, |setting| format!("n = {}", setting.states));
    let (gaps, widens) = widens(all);
    vec![
        Claim::statement("the EKF computes a variance of zero", of(ekf), exactly(ekf == covariances)),
        Claim::statement(
            "the unscented transform often fails to give a variance (judged: for more than one in ten)",
            of(ukf),
            more_than(ukf, covariances, 0.1, ONE),
        ),
        Claim::statement(
            "the CDKF and the CKF degrade as n grows, for every p",
            format!(
                "from n = 5 to 100 the divergence grows at least {least:.1}-fold; between neighbouring sizes it falls by more \
                 than 3 σ {falls} times"
            ),
            grows,
        ),
        Claim::statement(
            "they degrade as p goes from 1 to −5",
            format!(
                "at every step of p by more than 3 σ: CDKF at {} of {} sizes, CKF at {}",
                ordered(CDKF),
                all.len(),
                ordered(CKF)
            ),
            judged(steps(CDKF).chain(steps(CKF))),
        ),
        Claim::statement("for all p the CDKF is inferior to the CKF", worse, inferior),
        Claim::statement("the CDKF deviates the more from the CKF, the higher the dimension", gaps, widens),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_read_off_the_figure_belongs_to_a_setting() {
        let expected = Expected::read(EXPECTED).unwrap();
        assert!(expected.source.contains("read by eye"));
        let of = |key: &str, p: i32| {
            let at = |n: usize| expected.number(&[key, &p.to_string(), &n.to_string()]);
            (1..=LAST / STEP).filter_map(|i| at(STEP * i)).collect::<Vec<_>>()
        };
        assert_eq!(
            (of("cdkf", 1), of("ckf", 1), of("ckf", -5)),
            (vec![4.0, 10.4], vec![0.6, 0.82], vec![10.3])
        );
    }
}

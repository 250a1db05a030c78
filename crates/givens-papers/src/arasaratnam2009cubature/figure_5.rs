//! Figure 5: the divergence over the number of dimensions.

use super::moments::{self, CDKF, CKF, OWN, RULES, Scores, Setting, not_below, scores, widens};
use super::multiquadric::POWERS;
use crate::drawing::{axis, figure};
use crate::{Claim, Expected, Page, Plan, Trouble};
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
                let (ours, spread) = (scores.mean(power, rule), scores.spread(power, rule));
                let (theirs, runs) = (OWN as f64, plan.runs(OWN) as f64);
                let what = format!("{}, p = {p}, n = {n}", RULES[rule]);
                let claim = Claim::number(what, published, ours, spread, theirs, runs);
                claims.push(claim.remark(BY_EYE));
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
    })
}

const BY_EYE: &str = "read by eye; print does not say how the covariances were drawn, on which the level depends: the CDKF's at \
                      p = 1, n = 100 is 1.3 with A uniform on (0, 1), 14.1 with a uniform spectrum";

fn statements(all: &[Scores]) -> Vec<Claim> {
    let never = |rule: usize| {
        let none = |scores: &&Scores| (0..POWERS.len()).all(|power| scores.mean(power, rule).is_nan());
        all.iter().filter(none).count()
    };
    let (ekf, ukf) = (never(0), never(1));
    let of = |count: usize| format!("no covariance gives one at {count} of {} sizes", all.len());
    let worse = not_below(all);
    let last = |power: usize, rule: usize| all.last().map_or(f64::NAN, |scores| scores.mean(power, rule));
    let first = |power: usize, rule: usize| all.first().map_or(f64::NAN, |scores| scores.mean(power, rule));
    let grows = |rule: usize| {
        (0..POWERS.len())
            .map(move |power| last(power, rule) / first(power, rule))
            .fold(f64::INFINITY, f64::min)
    };
    let ordered = |rule: usize| {
        let falls =
            |scores: &&Scores| (1..POWERS.len()).all(|p| scores.mean(p, rule) > scores.mean(p - 1, rule));
        all.iter().filter(falls).count()
    };
    let falls = |rule: usize| {
        let pairs = all.windows(2).flat_map(|pair| (0..POWERS.len()).map(move |power| (pair, power)));
        let fall = |(pair, power): &(&[Scores], usize)| {
            let noise = pair[0].spread(*power, rule).hypot(pair[1].spread(*power, rule));
            pair[1].mean(*power, rule) < pair[0].mean(*power, rule) - 3.0 * noise
        };
        pairs.filter(fall).count()
    };
    let (gap, gaps) = widens(all);
    let (least, harder) = (grows(CDKF).min(grows(CKF)), [ordered(CDKF), ordered(CKF)]);
    vec![
        Claim::statement("the EKF computes a variance of zero", of(ekf), ekf == all.len()),
        Claim::statement("the unscented transform often fails to give a variance", of(ukf), ukf > 0),
        Claim::statement(
            "the CDKF and the CKF degrade as n grows, for every p",
            format!(
                "from n = 5 to 100 the divergence grows at least {least:.1}-fold; between neighbouring sizes it falls by more \
                 than 3 σ {} times (CDKF), {} times (CKF)",
                falls(CDKF),
                falls(CKF)
            ),
            least > 1.0,
        ),
        Claim::statement(
            "they degrade as p goes from 1 to −5",
            format!("at every step of p: CDKF at {} of {} sizes, CKF at {}", harder[0], all.len(), harder[1]),
            harder == [all.len(); 2],
        ),
        Claim::statement(
            "for all p the CDKF is inferior to the CKF",
            if worse.is_empty() { "at every n".to_owned() } else { listed(&worse) },
            worse.is_empty(),
        ),
        Claim::statement(
            "the CDKF deviates the more from the CKF, the higher the dimension",
            format!("its excess: {gaps}"),
            gap,
        ),
    ]
}

fn listed(worse: &[(Setting, i32)]) -> String {
    let words: Vec<String> =
        worse.iter().map(|(setting, p)| format!("n = {} p = {p}", setting.states)).collect();
    format!("but at {}", words.join(", "))
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

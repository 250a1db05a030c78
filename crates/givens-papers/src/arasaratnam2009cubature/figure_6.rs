//! Figure 6: the divergence over the variance of the prior.

use super::moments::{self, CDKF, CKF, OWN, RULES, Scores, Setting, inferior, scores, widens};
use super::multiquadric::POWERS;
use crate::drawing::{axis, figure};
use crate::estimate::{MANY, all as judged};
use crate::{Claim, Estimate, Page, Plan, Trouble};
use givens_io::figure::{Axis, Scale};

const STATES: usize = 50;
/// Points of a decade, and decades.
const A_DECADE: i32 = 4;
const DECADES: i32 = 4;

pub(super) fn run(plan: &Plan) -> Result<Page, Trouble> {
    let setting = |i: i32| {
        let power = f64::from(i) / f64::from(A_DECADE) - 2.0;
        Setting { track: 2_009_600 + i as u32, states: STATES, variance: 10f64.powf(power) }
    };
    let all = scores(plan, &(0..=A_DECADE * DECADES).map(setting).collect::<Vec<_>>())?;
    let panel = |rule: usize, heading: &str| {
        let x = Axis { range: Some([1e-2, 1e2]), ..axis("prior variance", Scale::Log) };
        let y = axis("KL divergence", Scale::Log);
        moments::panel(&all, rule, heading, [x, y], |setting| setting.variance, |_| Vec::new())
    };
    let shown = figure(
        "Moments of a multi-quadric: divergence over the prior variance, n = 50",
        true,
        vec![panel(CDKF, "(a) CDKF"), panel(CKF, "(b) CKF")],
    );
    Ok(Page {
        about: format!(
            "{} random covariances of each width, otherwise as for figure 5. The divergence spans decades: its axis is \
             logarithmic.",
            plan.runs(OWN)
        ),
        claims: statements(&all),
        tables: vec![moments::table(&all)],
        figures: vec![("divergence", shown)],
        failures: moments::failures(&all),
        failing: moments::FAILING,
    })
}

fn statements(all: &[Scores]) -> Vec<Claim> {
    let ends = |power: usize, rule: usize| {
        let (first, last) = (all.first()?, all.last()?);
        Some((first.mean(power, rule), last.mean(power, rule)))
    };
    let grows = |rule: usize| {
        let ends: Vec<_> =
            (0..POWERS.len()).filter_map(|power| ends(power, rule).zip(POWERS.get(power))).collect();
        let word =
            |((first, last), p): &((Estimate, Estimate), &i32)| format!("{first:.2} to {last:.2} (p = {p})");
        let words: Vec<String> = ends.iter().map(word).collect();
        let verdicts = ends.iter().map(|((first, last), _)| last.less(*first).above(0.0, MANY));
        let what = format!("the {} degrades as the prior variance grows", RULES[rule]);
        Claim::statement(what, format!("from 0.01 to 100: {}", words.join(", ")), judged(verdicts))
    };
    let (worse, inferior) = inferior(all, |setting| format!("variance {:.3}", setting.variance));
    let (gaps, widens) = widens(all);
    vec![
        grows(CDKF),
        grows(CKF),
        Claim::statement("for all variances the CKF is superior to the CDKF", worse, inferior)
            .explained("the paper's own Fig. 6 gives p = 1 at a variance of 0.01 to the CDKF"),
        Claim::statement("the CDKF deviates the more from the CKF, the wider the prior", gaps, widens),
    ]
}

//! Figure 6: the divergence over the variance of the prior.

use super::moments::{self, CDKF, CKF, OWN, RULES, Scores, Setting, not_below, scores, widens};
use super::multiquadric::POWERS;
use crate::drawing::{axis, figure};
use crate::{Claim, Page, Plan, Trouble};
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
    })
}

fn statements(all: &[Scores]) -> Vec<Claim> {
    let ratio = |power: usize, rule: usize| match (all.first(), all.last()) {
        (Some(first), Some(last)) => last.mean(power, rule) / first.mean(power, rule),
        _ => f64::NAN,
    };
    let all_powers = || 0..POWERS.len();
    let grows = |rule: usize| {
        let ratios: Vec<String> =
            all_powers().map(|power| format!("{:.2} (p = {})", ratio(power, rule), POWERS[power])).collect();
        let holds = all_powers().all(|power| ratio(power, rule) > 1.0);
        let what = format!("the {} degrades as the prior variance grows", RULES[rule]);
        Claim::statement(what, format!("from 0.01 to 100 by the factor {}", ratios.join(", ")), holds)
    };
    let worse = not_below(all);
    let words: Vec<String> =
        worse.iter().map(|(setting, p)| format!("variance {:.3} p = {p}", setting.variance)).collect();
    let where_not =
        if words.is_empty() { "everywhere".to_owned() } else { format!("but at {}", words.join(", ")) };
    let (gap, gaps) = widens(all);
    vec![
        grows(CDKF),
        grows(CKF),
        Claim::statement("for all variances the CKF is superior to the CDKF", where_not, worse.is_empty())
            .remark("the paper's own Fig. 6 gives p = 1 at a variance of 0.01 to the CDKF"),
        Claim::statement(
            "the CDKF deviates the more from the CKF, the wider the prior",
            format!("its excess: {gaps}"),
            gap,
        ),
    ]
}

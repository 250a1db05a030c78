//! Figure 8: scenario 1, Gaussian noise.

use super::curves;
use super::levels::{CDKF, CKF, ESTIMATED, Levels, NAMES, QUANTITIES, TRUE};
use super::turn::{OWN, Scenario};
use crate::estimate::{ONE, all as judged};
use crate::{Claim, Page, Plan, Trouble};

pub(super) fn run(plan: &Plan) -> Result<Page, Trouble> {
    let levels = Levels::new(plan, Scenario::Gaussian)?;
    let lost = |i: usize| {
        let of = |filter: usize| format!("{} {:.3}", NAMES[filter], levels.level(filter, TRUE, i));
        Claim::lost(
            format!("RMSE in {}, from 50 to 100 s", QUANTITIES[i]),
            "curves",
            [CDKF, CKF].map(of).join(", "),
            "the figure's values stand nowhere in the text",
        )
    };
    let (ratio, [ckf, cdkf]) =
        (levels.ratio((CDKF, TRUE), (CKF, TRUE), 0), [CKF, CDKF].map(|f| levels.level(f, TRUE, 0)));
    let mut claims: Vec<Claim> = (0..3).map(lost).collect();
    claims.push(Claim::statement(
        "the CKF marginally outperforms the CDKF",
        format!("in position {ckf:.1} m against {cdkf:.1} m; on the same runs CDKF over CKF {ratio:.4}"),
        ratio.between([1.0, 1.1], ONE),
    ));
    for filter in [CDKF, CKF] {
        let ratios = [0, 1, 2].map(|i| levels.ratio((filter, TRUE), (filter, ESTIMATED), i));
        claims.push(Claim::statement(
            format!(
                "the {}'s true errors closely follow those it estimates (judged: within 15 %)",
                NAMES[filter]
            ),
            format!(
                "true over estimated: position {:.3}, velocity {:.3}, turn rate {:.3}",
                ratios[0], ratios[1], ratios[2]
            ),
            judged(ratios.iter().map(|ratio| ratio.between([0.85, 1.15], ONE))),
        ));
    }
    Ok(Page {
        about: format!(
            "{} runs, a new path in each, square-root forms. Levels are roots of the mean square over all runs and over the \
             scans from 50 to 100 s. The paper shows neither the EKF nor the UKF; both stand in the tables, and what became of \
             them on the page of what halts.",
            plan.runs(OWN)
        ),
        claims,
        tables: vec![levels.table(), curves::table(&levels)],
        figures: vec![(
            "rmse",
            curves::shown("Turning aircraft, Gaussian noise: root-mean-square errors", &levels),
        )],
        failures: levels.failures(),
        ..Page::default()
    })
}

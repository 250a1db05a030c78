//! Figure 10: scenario 2, noise of two Gaussians.

use super::curves;
use super::levels::{CDKF, CKF, ESTIMATED, Levels, NAMES, TRUE};
use super::turn::{OWN, Scenario};
use crate::estimate::ONE;
use crate::{Claim, Expected, Page, Plan, Trouble};

const EXPECTED: &str = include_str!("expected/figure-10.toml");

pub(super) fn run(plan: &Plan) -> Result<Page, Trouble> {
    let levels = Levels::new(plan, Scenario::Mixture)?;
    let expected = Expected::read(EXPECTED)?;
    let peak = expected.number(&["peak", "ckf"]).unwrap_or(f64::NAN);
    let (runs, lost) = (plan.runs(OWN), levels.lost(CKF));
    let mut claims = vec![Claim::lost(
        "the peak of the CKF's RMSE in position (by eye)",
        format!("{peak:.0} m"),
        format!("{:.0} m, with {lost} of {runs} tracks lost", levels.peak(CKF)),
        "one track in 250 makes the peak: how high it is depends on which is lost, and many replications lose none",
    )];
    for filter in [CDKF, CKF] {
        let (actual, estimated) = (levels.level(filter, TRUE, 0), levels.level(filter, ESTIMATED, 0));
        let ratio = levels.ratio((filter, TRUE), (filter, ESTIMATED), 0);
        let statement = Claim::statement(
            format!("the {}'s true errors exceed those it estimates", NAMES[filter]),
            format!("in position {actual:.1} m against {estimated:.1} m, a factor {ratio:.2}"),
            ratio.above(1.0, ONE),
        );
        let (lost, kept) = (levels.lost(filter), levels.kept(filter, 0));
        claims.push(statement.remark(format!("{lost} of {runs} tracks lost; without them {kept:.1} m")));
    }
    let ratio = levels.ratio((CKF, ESTIMATED), (CDKF, ESTIMATED), 0);
    claims.push(Claim::statement(
        "the two filters' covariances differ little (judged: within 10 %)",
        format!("estimated errors in position, CKF over CDKF: {ratio:.3}"),
        ratio.between([0.9, 1.1], ONE),
    ));
    Ok(Page {
        about: format!(
            "{runs} runs; the noise is drawn from either Gaussian with probability one half, the filters are told the \
             covariance of the mixture. Otherwise as for figure 8."
        ),
        claims,
        tables: vec![levels.table(), curves::table(&levels)],
        figures: vec![(
            "rmse",
            curves::shown("Turning aircraft, noise of two Gaussians: root-mean-square errors", &levels),
        )],
        failures: levels.failures(),
        ..Page::default()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_peak_of_the_figure_is_there_with_its_source() {
        let expected = Expected::read(EXPECTED).unwrap();
        assert!(expected.source.contains("read by eye"));
        assert_eq!(expected.number(&["peak", "ckf"]), Some(350.0));
    }
}

//! §VIII-B in words: which filters halt, and which lose the aircraft, in either form.

use super::turn::{SCANS, Scenario, first_lost, off, runs};
use crate::page::Table;
use crate::statistics::{fisher, z_of};
use crate::{Claim, Failures, Page, Plan, Trouble};
use givens::Outcome;

/// Ten of the paper's replications: a track in a hundred is lost, or fewer.
pub(super) const RUNS: usize = 2500;
const METHODS: [&str; 8] = ["ekf", "sr-ekf", "ukf", "sr-ukf", "cdkf", "sr-cdkf", "ckf", "sr-ckf"];
/// The UKFs among them.
const UKFS: core::ops::Range<usize> = 2..4;
const SR_CDKF: usize = 5;
const SR_CKF: usize = 7;
/// A lost track is found again that ends nearer than this, m.
const FOUND_M: f64 = 100.0;

/// What became of a run that came to its end.
struct Fate {
    /// The first second at which the track was lost.
    lost: Option<usize>,
    /// Whether it was found again.
    found: bool,
}

/// What became of all runs of one method.
struct Fates {
    halted: Failures,
    /// When tracks were lost, s, in order.
    lost: Vec<usize>,
    found: usize,
    runs: usize,
}

pub(super) fn run(plan: &Plan) -> Result<Page, Trouble> {
    let first = fates(plan, Scenario::Gaussian, &METHODS)?;
    let second = fates(plan, Scenario::Mixture, &METHODS)?;
    let unwrapped = fates(plan, Scenario::Unwrapped, &METHODS[UKFS])?;
    let mut table = Table::new(
        "fates",
        &["scenario", "method", "runs", "halted", "lost", "first at, s", "half by, s", "found"],
    );
    let mut failures = Vec::new();
    let blocks: [(&str, &[&str], &[Fates]); 3] =
        [("1", &METHODS, &first), ("2", &METHODS, &second), ("1, not wrapped", &METHODS[UKFS], &unwrapped)];
    for (scenario, methods, fates) in blocks {
        for (method, fates) in methods.iter().zip(fates) {
            table.rows.push(vec![
                scenario.into(),
                (*method).into(),
                fates.runs.into(),
                fates.halted.count().into(),
                fates.lost.len().into(),
                fates.lost.first().map_or(f64::NAN, |&k| k as f64).into(),
                fates.lost.get(fates.lost.len() / 2).map_or(f64::NAN, |&k| k as f64).into(),
                fates.found.into(),
            ]);
            let mut all = fates.halted.clone();
            fates.lost.iter().for_each(|_| all.note_kind("further off than 500 m"));
            failures.push((format!("scenario {scenario}, {method}"), all));
        }
    }
    Ok(Page {
        about: format!(
            "{} runs of each scenario, of which the first 250 are those of figures 8 and 10; every filter in covariance and in \
             square-root form. A filter halts if a step cannot be done, such as a root of a matrix that is not positive \
             definite; a track is lost if its position is ever off by more than 500 m, and found again if it ends nearer than \
             100 m. The last block of the table is scenario 1 once more for the UKF, with bearings that are not wrapped where they jump by \
             2π.",
            plan.runs(RUNS)
        ),
        claims: claims(&first, &second, &unwrapped),
        tables: vec![table],
        figures: vec![],
        failures,
    })
}

fn fates(plan: &Plan, scenario: Scenario, methods: &[&str]) -> Result<Vec<Fates>, Trouble> {
    let all = runs(plan, scenario, plan.runs(RUNS), methods, |outcome: &Outcome, truth| {
        let est = &outcome.estimates;
        let lost = first_lost(est, truth).map(|k| k + 1);
        let end = off(est.mean(SCANS - 1), &truth[SCANS - 1]);
        Fate { lost, found: lost.is_some() && end < FOUND_M * FOUND_M }
    })?;
    let of = |runs: super::turn::Runs<Fate>| {
        let mut lost: Vec<usize> = runs.ended().filter_map(|fate| fate.lost).collect();
        lost.sort_unstable();
        let found = runs.ended().filter(|fate| fate.found).count();
        Fates { lost, found, runs: runs.each.len(), halted: runs.halted }
    };
    Ok(all.into_iter().map(of).collect())
}

fn claims(first: &[Fates], second: &[Fates], unwrapped: &[Fates]) -> Vec<Claim> {
    let halted = |form: usize| first[UKFS.start + form].halted.count();
    let runs = first[UKFS.start].runs;
    let ekf = &first[1];
    let when = match (ekf.lost.first(), ekf.lost.get(ekf.lost.len() / 2)) {
        (Some(start), Some(half)) => format!(", the first at {start} s, half of them by {half} s"),
        _ => String::new(),
    };
    let fate =
        |of: &Fates| format!("{} of {} lost, {} of these found again", of.lost.len(), of.runs, of.found);
    let (cdkf, ckf) = (&second[SR_CDKF], &second[SR_CKF]);
    let apart = z_of(fisher(
        [cdkf.lost.len(), cdkf.runs - cdkf.lost.len()],
        [ckf.lost.len(), ckf.runs - ckf.lost.len()],
    ));
    vec![
        Claim::statement(
            "the UKF with κ = −2 was often found to halt",
            format!("{} of {runs} in covariance form, {} of {runs} in square-root form", halted(0), halted(1)),
            20 * (halted(0) + halted(1)) > 2 * runs,
        )
        .remark(format!(
            "open; where bearings are not wrapped, {} and {} of {runs} halt",
            unwrapped[0].halted.count(),
            unwrapped[1].halted.count()
        )),
        Claim::statement(
            "the EKF diverges abruptly after 70–80 s",
            format!("{} of {} tracks lost{when}", ekf.lost.len(), ekf.runs),
            !ekf.lost.is_empty(),
        )
        .remark("it does diverge, in few runs and over a wider span of time; one lost track in 250 makes the whole curve rise"),
        Claim::lost(
            "scenario 2: unlike the CDKF, the CKF recovers from its divergence",
            "one replication",
            format!("CDKF {}; CKF {}; the losses are {apart:.1} σ apart", fate(cdkf), fate(ckf)),
            "250 runs lose about one track: its fate decides how both curves look",
        ),
    ]
}

//! §VIII-B in words: which filters halt, and which lose the aircraft, in either form.

use super::turn::{SCANS, Scenario, first_lost, off, runs};
use crate::drawing::{COLOURS, axis, figure, line, panel};
use crate::estimate::{ONE, any, counted, more_than};
use crate::page::Table;
use crate::statistics::{fisher, z_of};
use crate::{Claim, Failures, Page, Plan, Trouble};
use givens::Outcome;
use givens_io::figure::{Figure, Scale};

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
            let form = if method.starts_with("sr-") { "square-root" } else { "covariance" };
            failures.push((format!("scenario {scenario}, {method} ({form} form)"), all));
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
        figures: vec![("lost", drawn(&first, &second))],
        failures,
        ..Page::default()
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

/// Tracks lost until each second, in both scenarios, in covariance form.
fn drawn(first: &[Fates], second: &[Fates]) -> Figure {
    let of = |heading: &str, fates: &[Fates]| {
        let curve = |(k, fates): (usize, &Fates)| {
            let until = |t: usize| fates.lost.iter().filter(|&&lost| lost <= t).count();
            let points = (0..=SCANS).map(|t| [t as f64, until(t) as f64]).collect();
            line(&METHODS[2 * k].to_uppercase(), COLOURS[k], points)
        };
        let marks = fates.iter().step_by(2).enumerate().map(curve).collect();
        panel(heading, axis("time, s", Scale::Linear), axis("tracks lost", Scale::Linear), marks)
    };
    let panels = vec![of("scenario 1", first), of("scenario 2", second)];
    figure("Tracks lost until each second, covariance form", true, panels)
}

/// How many are lost before 70 s, from there to 80 s, and later.
fn when(lost: &[usize]) -> [usize; 3] {
    let early = lost.iter().filter(|&&t| t < 70).count();
    let late = lost.iter().filter(|&&t| t > 80).count();
    [early, lost.len() - early - late, late]
}

fn claims(first: &[Fates], second: &[Fates], unwrapped: &[Fates]) -> Vec<Claim> {
    let halted = |form: usize| first[UKFS.start + form].halted.count();
    let runs = first[UKFS.start].runs;
    let ekf = &first[1];
    let [early, amid, late] = when(&ekf.lost);
    let fate =
        |of: &Fates| format!("{} lost, {} of these found again", counted(of.lost.len(), of.runs), of.found);
    let (cdkf, ckf) = (&second[SR_CDKF], &second[SR_CKF]);
    let apart = z_of(fisher(
        [cdkf.lost.len(), cdkf.runs - cdkf.lost.len()],
        [ckf.lost.len(), ckf.runs - ckf.lost.len()],
    ));
    vec![
        Claim::statement(
            "the UKF with κ = −2 was often found to halt (judged: in more than one run of ten)",
            format!(
                "{} in covariance form, {} in square-root form; where bearings are not wrapped, {} and {}",
                counted(halted(0), runs),
                counted(halted(1), runs),
                unwrapped[0].halted.count(),
                unwrapped[1].halted.count()
            ),
            // the paper does not say in which form
            any([0, 1].map(|form| more_than(halted(form), runs, 0.1, ONE))),
        )
        .explained("open"),
        Claim::statement(
            "the EKF diverges abruptly after 70–80 s (judged: more than half of its losses begin there)",
            format!(
                "{} tracks lost: {early} before 70 s, {amid} from 70 to 80 s, {late} later",
                counted(ekf.lost.len(), ekf.runs)
            ),
            more_than(amid, ekf.lost.len(), 0.5, ONE),
        )
        .remark("one lost track in 250 makes the whole curve rise"),
        Claim::lost(
            "scenario 2: unlike the CDKF, the CKF recovers from its divergence",
            "one replication",
            format!("CDKF {}; CKF {}; the losses are {apart:.1} σ apart", fate(cdkf), fate(ckf)),
            "250 runs lose about one track: its fate decides how both curves look",
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Verdict;

    #[test]
    fn the_time_of_divergence_is_judged_by_its_distribution() {
        assert_eq!(when(&[61, 70, 75, 80, 81, 99]), [1, 3, 2]);
        let fates =
            |lost: &[usize]| Fates { halted: Failures::default(), lost: lost.to_vec(), found: 0, runs: 2500 };
        let verdict = |lost: &[usize]| {
            let all: Vec<Fates> = METHODS.iter().map(|_| fates(lost)).collect();
            claims(&all, &all, &all)[1].verdict
        };
        assert_eq!(verdict(&[72, 74, 75, 76, 77, 79]), Verdict::Holds);
        assert_eq!(verdict(&[61, 62, 90, 91, 92, 99]), Verdict::Fails);
        assert!(matches!(verdict(&[61, 71, 75, 99]), Verdict::Undecided(_)));
        assert!(matches!(verdict(&[]), Verdict::Undecided(_)));
    }
}

//! Table 4: accumulated root-mean-square errors.

use super::runs::{ESTIMATORS, OWN, ROWS, Track, tracks};
use crate::page::Table;
use crate::statistics::{root_mean, spread};
use crate::{Claim, Expected, Page, Plan, Trouble};

const EXPECTED: &str = include_str!("expected/table-4.toml");
const STATES: [&str; 3] = ["position, m", "velocity, m/s", "ballistic coefficient"];

pub(super) fn run(plan: &Plan) -> Result<Page, Trouble> {
    let (tracks, failures) = tracks(plan, &ESTIMATORS)?;
    let expected = Expected::read(EXPECTED)?;
    let runs = plan.runs(OWN);
    let mut page = Page {
        about: format!(
            "{runs} runs of 60 measurements. The error of an estimator is the root of the mean, over all rows and all runs, \
             of its squared errors."
        ),
        failures,
        ..Page::default()
    };
    let mut table = Table::new("armse", &["estimator", "state", "published", "ours", "spread"]);
    let mut found = Vec::new();
    for ((name, ..), tracks) in ESTIMATORS.iter().zip(&tracks) {
        for (i, state) in STATES.iter().enumerate() {
            let (ours, spread) = accumulated(tracks, i);
            let published = expected.numbers(&["armse", name]).get(i).copied().unwrap_or(f64::NAN);
            table.rows.push(vec![
                (*name).into(),
                (*state).into(),
                published.into(),
                ours.into(),
                spread.into(),
            ]);
            let claim = Claim::number(
                format!("{} {state}", name.to_uppercase()),
                published,
                ours,
                spread,
                OWN as f64,
                runs as f64,
            );
            page.claims.push(claim.remark(remark(name, i)));
            found.push(ours);
        }
    }
    page.tables.push(table);
    let (filter, smoother) = (found[1], found[13]);
    let times = filter / smoother;
    page.claims.push(Claim::statement(
        "the smoother beats the filter many times in velocity",
        format!("{times:.0} times"),
        times > 20.0,
    ));
    let constant = tracks[4].iter().map(|track| track.constant.abs()).fold(0.0, f64::max);
    let what = "a constant is not smoothed: its smoothed value is the last filtered one, at every row";
    page.claims.push(Claim::statement(what, format!("apart by {constant:.0e} σ at most"), constant < 1e-6));
    Ok(page)
}

/// The accumulated error of a state, and the standard deviation of one such replication.
fn accumulated(tracks: &[Track], state: usize) -> (f64, f64) {
    let per_run = |track: &Track| track.squares.iter().map(|row| row[state]).sum::<f64>() / ROWS as f64;
    let runs: Vec<f64> = tracks.iter().map(per_run).collect();
    (root_mean(runs.iter().copied()), spread(&runs, |sample| root_mean(sample)))
}

fn remark(name: &str, state: usize) -> &'static str {
    match (name, state) {
        ("ckf", 0) => "no window of rows reaches it; 25.15 would be reached: likely a misprint",
        ("eks", 1) => "open: no reading of the Jacobian that we tried gives it",
        _ => "",
    }
}

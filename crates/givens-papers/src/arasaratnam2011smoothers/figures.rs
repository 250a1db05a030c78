//! Figures 1–3: errors over time.

use super::runs::{ESTIMATORS, OWN, ROWS, Track, tracks};
use crate::drawing::{COLOURS, axis, figure, line};
use crate::estimate::{ONE, all};
use crate::page::Table;
use crate::paired::ratio;
use crate::statistics::root_mean;
use crate::{Claim, Page, Plan, Trouble};
use givens_io::figure::{Panel, Scale};

const NAMES: [&str; 3] = ["CKF", "FI-EKS", "FI-CKS"];
const STATES: [&str; 3] = ["position, m", "velocity, m/s", "ballistic coefficient, 1/m"];

pub(super) fn run(plan: &Plan) -> Result<Page, Trouble> {
    let wanted = [ESTIMATORS[0], ESTIMATORS[1], ESTIMATORS[4]];
    let (tracks, failures) = tracks(plan, &wanted)?;
    let error = |method: usize, k: usize, i: usize| {
        root_mean(tracks[method].iter().flatten().map(|track: &Track| track.squares[k][i]))
    };
    let mut columns = vec!["time".to_owned()];
    columns.extend(NAMES.iter().flat_map(|name| STATES.map(|state| format!("{name} {state}"))));
    let mut table = Table { name: "rmse", columns, rows: Vec::new() };
    for k in 0..ROWS {
        let mut row = vec![(0.5 * (k + 1) as f64).into()];
        row.extend((0..3).flat_map(|m| [0, 1, 2].map(|i| error(m, k, i).into())));
        table.rows.push(row);
    }
    let panel = |i: usize| {
        let points = |m: usize| (0..ROWS).map(|k| [0.5 * (k + 1) as f64, error(m, k, i)]).collect();
        let marks = (0..3).map(|m| line(NAMES[m], COLOURS[m], points(m))).collect();
        Panel { x: axis("time, s", Scale::Linear), y: axis(STATES[i], Scale::Log), marks, ..Panel::default() }
    };
    let shown = figure("RMSE of the re-entering target", false, vec![panel(0), panel(1), panel(2)]);
    let squares = |m: usize, i: usize| -> Vec<Option<f64>> {
        tracks[m].iter().map(|track| Some(track.as_ref()?.mean_square(i))).collect()
    };
    let claim = |what: &str, m: usize, most: f64| {
        let ratios = [0, 1, 2].map(|i| ratio(&squares(2, i), &squares(m, i)));
        let shown = format!(
            "of its error, on the same runs: position {:.3}, velocity {:.3}, coefficient {:.4}",
            ratios[0], ratios[1], ratios[2]
        );
        Claim::statement(what, shown, all(ratios.iter().map(|ratio| ratio.below(most, ONE))))
    };
    Ok(Page {
        about: format!(
            "{} runs, square-root forms. Root-mean-square errors over the runs at each row.",
            plan.runs(OWN)
        ),
        claims: vec![
            claim("the FI-CKS is superior to the FI-EKS", 1, 1.0),
            claim("the FI-CKS markedly outperforms the CKF (judged: by a fifth of the error)", 0, 0.8),
        ],
        tables: vec![table],
        figures: vec![("rmse", shown)],
        failures,
        ..Page::default()
    })
}

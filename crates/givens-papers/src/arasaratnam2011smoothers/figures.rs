//! Figures 1–3: errors over time.

use super::runs::{ESTIMATORS, OWN, ROWS, Track, tracks};
use crate::drawing::{COLOURS, axis, figure, line};
use crate::page::Table;
use crate::statistics::root_mean;
use crate::{Claim, Page, Plan, Trouble};
use givens_io::figure::{Panel, Scale};

const NAMES: [&str; 3] = ["CKF", "FI-EKS", "FI-CKS"];
const STATES: [&str; 3] = ["position, m", "velocity, m/s", "ballistic coefficient, 1/m"];

pub(super) fn run(plan: &Plan) -> Result<Page, Trouble> {
    let wanted = [ESTIMATORS[0], ESTIMATORS[1], ESTIMATORS[4]];
    let (tracks, failures) = tracks(plan, &wanted)?;
    let error = |method: usize, k: usize, i: usize| {
        root_mean(tracks[method].iter().map(|track: &Track| track.squares[k][i]))
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
    let accumulated = |m: usize, i: usize| root_mean((0..ROWS).map(|k| error(m, k, i).powi(2)));
    let below = |m: usize| {
        let ratios = [0, 1, 2].map(|i| accumulated(2, i) / accumulated(m, i));
        let shown =
            format!("position {:.2}, velocity {:.2}, coefficient {:.2e}", ratios[0], ratios[1], ratios[2]);
        (format!("of its error: {shown}"), ratios.iter().all(|&ratio| ratio < 1.0))
    };
    let claim = |what: &str, m: usize| {
        let (ours, holds) = below(m);
        Claim::statement(what, ours, holds)
    };
    Ok(Page {
        about: format!("{} runs. Root-mean-square errors over the runs at each row.", plan.runs(OWN)),
        claims: vec![
            claim("the FI-CKS is superior to the FI-EKS", 1),
            claim("the FI-CKS markedly outperforms the CKF", 0),
        ],
        tables: vec![table],
        figures: vec![("rmse", shown)],
        failures,
    })
}

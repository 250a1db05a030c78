//! Tables 1 and 2 with Figures 1 and 2: runs lost, and errors in position of the others.

use super::runs::{Cells, METHODS, Method, OWN, STEPS, cells};
use crate::drawing::{COLOURS, axis, figure, line};
use crate::page::Table;
use crate::statistics::{root_mean, spread};
use crate::{Claim, Expected, Page, Plan, Trouble};
use givens_io::figure::{Panel, Scale};

const TABLE_1: &str = include_str!("expected/table-1.toml");
const TABLE_2: &str = include_str!("expected/table-2.toml");

pub(super) fn one(plan: &Plan) -> Result<Page, Trouble> {
    let (cells, mut page) = page(plan, 4.0, &Expected::read(TABLE_1)?)?;
    page.claims.extend(super::figures::one(&cells));
    Ok(page)
}

pub(super) fn two(plan: &Plan) -> Result<Page, Trouble> {
    let (cells, mut page) = page(plan, 8.0, &Expected::read(TABLE_2)?)?;
    page.claims.extend(super::figures::two(&cells));
    Ok(page)
}

fn page(plan: &Plan, interval: f64, expected: &Expected) -> Result<(Cells, Page), Trouble> {
    let (cells, runs) = (cells(plan, interval)?, plan.runs(OWN));
    let mut page = Page {
        about: format!(
            "{runs} runs of 210 s, a measurement every {interval} s, ω = 6°/s. A run is lost when its filter fails or errs \
             by more than 1000 m in position; the CD-EKF's runs only when it fails, as in print (`strayed` counts those that \
             erred and went on), and it is run without any test of its covariance. All filters are in covariance form. \
             The error is the root of the mean, over the scans and the runs that were not lost, of the squared error in \
             position; `spread` is the standard deviation of one such replication."
        ),
        ..Page::default()
    };
    let mut table =
        Table::new("divergences", &["filter", "M", "published", "lost", "strayed", "rmse_m", "spread_m"]);
    for (method, cells) in METHODS.iter().zip(&cells) {
        let published = expected.numbers(&["divergences", method.key]);
        for ((cell, steps), &published) in cells.iter().zip(STEPS).zip(&published) {
            let what = format!("{}, M = {steps}: runs lost", method.name);
            let lost = cell.lost.count();
            let claim = Claim::count(what, published as usize, OWN, lost, runs);
            page.claims.push(claim.remark(remark(method, interval, steps)));
            let rmse = |squares: &mut dyn Iterator<Item = f64>| root_mean(squares);
            table.rows.push(vec![
                method.name.into(),
                steps.into(),
                published.into(),
                lost.into(),
                cell.strayed.into(),
                rmse(&mut cell.squares.iter().copied()).into(),
                spread(&cell.squares, rmse).into(),
            ]);
            if lost > 0 {
                page.failures
                    .push((format!("{}, M = {steps} (covariance form)", method.name), cell.lost.clone()));
            }
        }
    }
    page.tables.push(table);
    page.figures.push(("errors", errors(&cells, interval)));
    Ok((cells, page))
}

/// Root-mean-square error in position against the number of steps, on the paper's axes.
fn errors(cells: &Cells, interval: f64) -> givens_io::figure::Figure {
    let curve = |at: usize| {
        let points = STEPS.iter().zip(&cells[at]);
        let points = points.map(|(&steps, cell)| [steps as f64, root_mean(cell.squares.iter().copied())]);
        line(METHODS[at].name, COLOURS[at], points.collect())
    };
    let panel = Panel {
        x: axis("steps of an interval, M", Scale::Log),
        y: axis("error in position, m", Scale::Log),
        marks: (0..METHODS.len()).map(curve).collect(),
        ..Panel::default()
    };
    figure(&format!("Position errors, T = {interval} s"), true, vec![panel])
}

fn remark(method: &Method, interval: f64, steps: usize) -> &'static str {
    match (method.key, interval > 4.0, steps) {
        ("ekf", true, 1) => "known: an independent program counts 59; open",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_filter_has_its_seven_published_counts() {
        for text in [TABLE_1, TABLE_2] {
            let expected = Expected::read(text).unwrap();
            assert_eq!(expected.numbers(&["steps"]), STEPS.map(|m| m as f64));
            for method in &METHODS {
                let counts = expected.numbers(&["divergences", method.key]);
                assert_eq!(counts.len(), STEPS.len(), "{}", method.name);
                assert!(counts.iter().all(|count| (0.0..=100.0).contains(count)));
            }
        }
    }
}

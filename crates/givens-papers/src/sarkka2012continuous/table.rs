//! Tables 1 and 2 with Figures 1 and 2: runs lost, and errors in position of the others.

use super::runs::{Cell, Cells, METHODS, Method, OWN, STEPS, cells};
use crate::drawing::{COLOURS, axis, figure, marked, panel, steps};
use crate::page::Table;
use crate::statistics::{root_mean, root_of, share_error};
use crate::{Claim, Expected, Page, Plan, Trouble};
use givens_io::figure::{Mark, Scale, Shape};

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
             `rmse_m` is the root of the mean squared error in position over the scans and the runs that neither failed nor \
             strayed, alike for all filters; `with_strayed_m` has in it all that did not fail; `_error` is the standard error. Where \
             a filter lost every run it has no point."
        ),
        ..Page::default()
    };
    let columns = [
        "filter",
        "M",
        "published",
        "lost",
        "lost_percent",
        "lost_percent_error",
        "strayed",
        "rmse_m",
        "rmse_m_error",
        "with_strayed_m",
        "with_strayed_m_error",
    ];
    let mut table = Table::new("divergences", &columns);
    for (method, cells) in METHODS.iter().zip(&cells) {
        let published = expected.numbers(&["divergences", method.key]);
        for ((cell, steps), &published) in cells.iter().zip(STEPS).zip(&published) {
            let what = format!("{}, M = {steps}: runs lost", method.name);
            let lost = cell.lost.count();
            let claim = Claim::count(what, published as usize, OWN, lost, runs);
            page.claims.push(claim.explained(remark(method, interval, steps)));
            let [kept, ended] = [&cell.kept, &cell.ended].map(|of| root_of(of.iter().flatten().copied()));
            table.rows.push(vec![
                method.name.into(),
                steps.into(),
                published.into(),
                lost.into(),
                (100.0 * lost as f64 / runs as f64).into(),
                (100.0 * share_error(lost, runs)).into(),
                cell.strayed.into(),
                kept.value.into(),
                kept.error.into(),
                ended.value.into(),
                ended.error.into(),
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
    let points = |at: usize, of: fn(&Cell) -> &[Option<f64>]| {
        let point =
            |(&steps, cell): (&usize, &Cell)| [steps as f64, root_mean(of(cell).iter().flatten().copied())];
        STEPS.iter().zip(&cells[at]).map(point).collect::<Vec<_>>()
    };
    let curve = |at: usize| marked(METHODS[at].name, COLOURS[at], points(at, |cell| &cell.kept));
    let mut marks: Vec<Mark> = (0..METHODS.len()).flat_map(curve).collect();
    let strayed = Shape::Line { points: points(0, |cell| &cell.ended), width: 1.6, dashed: true };
    marks.push(Mark::new("CD-EKF, strayed runs too", COLOURS[0], strayed));
    let (x, y) = (steps("steps of an interval, M", &STEPS), axis("error in position, m", Scale::Log));
    figure(&format!("Position errors, T = {interval} s"), true, vec![panel("", x, y, marks)])
}

fn remark(method: &Method, interval: f64, steps: usize) -> &'static str {
    match (method.key, interval > 4.0, steps) {
        ("ekf", true, 1) => "an independent program counts 59; open",
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

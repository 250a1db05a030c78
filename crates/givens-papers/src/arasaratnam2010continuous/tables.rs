//! Tables I–IV: runs lost of 100, by turn rate and number of steps, each at one sampling interval.

use super::claims::claims;
use super::figures::{NO_POINT, draw, error};
use super::runs::{Cells, METHODS, OMEGAS, OWN, READINGS, cells, form};
use crate::page::Table;
use crate::statistics::share_error;
use crate::{Page, Plan, Trouble};

pub(super) fn two(plan: &Plan) -> Result<Page, Trouble> {
    page(plan, 1, 2.0)
}

pub(super) fn four(plan: &Plan) -> Result<Page, Trouble> {
    page(plan, 2, 4.0)
}

pub(super) fn six(plan: &Plan) -> Result<Page, Trouble> {
    page(plan, 3, 6.0)
}

pub(super) fn eight(plan: &Plan) -> Result<Page, Trouble> {
    page(plan, 4, 8.0)
}

fn page(plan: &Plan, number: usize, interval: f64) -> Result<Page, Trouble> {
    let cells = cells(plan, interval)?;
    let runs = plan.runs(OWN);
    Ok(Page {
        about: format!(
            "{runs} runs of 210 s for each turn rate, a measurement every {interval} s; errors are scored from 60 s on. A run \
             is lost when its filter fails or errs by more than 500 m in position. Every filter starts by two-point \
             differencing. The paper leaves open how the turn rate was started, and prints σ₂ = 7·10⁻³ where the authors' \
             program has 7·10⁻⁴: the four readings stand side by side, and the figure shows the first. The CD-UKF is run by \
             both its readings, the unscented Euler–Maruyama step and Euler's method on the moment equations. CD-EKF and \
             CD-UKF are in covariance form, the CD-CKF in square-root form. {NO_POINT}"
        ),
        claims: claims(&cells, number, interval)?,
        tables: vec![lost(&cells), errors(&cells)],
        figures: vec![("errors", draw(&cells, number + 1, interval))],
        failures: failures(&cells),
        ..Page::default()
    })
}

/// Each filter with each number of steps, in each reading.
fn rows() -> impl Iterator<Item = (usize, usize, usize, usize)> {
    READINGS.into_iter().enumerate().flat_map(|(r, reading)| {
        (0..METHODS.len()).flat_map(move |method| {
            reading.steps().iter().enumerate().map(move |(s, &steps)| (r, method, s, steps))
        })
    })
}

fn lost(cells: &Cells) -> Table {
    let columns = [
        "reading",
        "filter",
        "m",
        "runs",
        "lost_omega_3",
        "lost_omega_3_error",
        "lost_omega_4.5",
        "lost_omega_4.5_error",
        "lost_omega_6",
        "lost_omega_6_error",
    ];
    let mut table = Table::new("lost", &columns);
    for (r, method, s, steps) in rows() {
        let runs = cells.get(r, 0, method, s).squares.len();
        let mut row = vec![READINGS[r].name().into(), METHODS[method].0.into(), steps.into(), runs.into()];
        for omega in 0..OMEGAS.len() {
            let lost = cells.get(r, omega, method, s).lost.count();
            row.extend([lost.into(), (runs as f64 * share_error(lost, runs)).into()]);
        }
        table.rows.push(row);
    }
    table
}

fn errors(cells: &Cells) -> Table {
    let columns = [
        "reading",
        "filter",
        "m",
        "omega",
        "position_m",
        "position_m_error",
        "velocity_m_s",
        "velocity_m_s_error",
        "rate_deg_s",
        "rate_deg_s_error",
    ];
    let mut table = Table::new("errors", &columns);
    for (r, method, s, steps) in rows() {
        for (i, omega) in OMEGAS.into_iter().enumerate() {
            let mut row =
                vec![READINGS[r].name().into(), METHODS[method].0.into(), steps.into(), omega.into()];
            for (which, unit) in [1.0, 1.0, 1f64.to_degrees()].into_iter().enumerate() {
                let found = error(cells, [r, i, method, s], which);
                row.extend([(unit * found.value).into(), (unit * found.error).into()]);
            }
            table.rows.push(row);
        }
    }
    table
}

/// By reading and filter, over all turn rates and numbers of steps.
fn failures(cells: &Cells) -> Vec<(String, crate::Failures)> {
    let mut all = Vec::new();
    for (r, reading) in READINGS.into_iter().enumerate() {
        for (method, (name, ..)) in METHODS.iter().enumerate() {
            let mut sum = crate::Failures::default();
            let settings = (0..OMEGAS.len()).flat_map(|i| (0..reading.steps().len()).map(move |s| (i, s)));
            settings.for_each(|(i, s)| sum.add(&cells.get(r, i, method, s).lost));
            let what = format!("{name} ({}), {}, all turn rates and m", form(method), reading.name());
            all.push((what, sum));
        }
    }
    all
}

//! Figure 1: a linear drift, where the level set is exact but for the solver's error.

use super::convergence::{Linear, Stepping, claim, distance, order, panel};
use crate::drawing::{COLOURS, figure};
use crate::page::Table;
use crate::{Expected, Page, Plan, Trouble};
use givens::filter::Gaussian;
use givens::ode::Solver;

const EXPECTED: &str = include_str!("expected/figure-1.toml");
const END: f64 = 10.0;
const STEPS: [usize; 6] = [10, 20, 40, 80, 160, 320];
const SOLVERS: [(&str, &str, Solver); 3] =
    [("euler", "RK1", Solver::Euler), ("rk2", "RK2", Solver::Rk2), ("rk4", "RK4", Solver::Rk4)];

pub(super) fn run(_: &Plan) -> Result<Page, Trouble> {
    let expected = Expected::read(EXPECTED)?;
    // the diffusion K of eq 3, as its Cholesky root
    let (k11, k21, k22) = (0.5f64, 0.25, 1.5);
    let g11 = k11.sqrt();
    let g21 = k21 / g11;
    let noise = vec![g11, 0.0, g21, (k22 - g21 * g21).sqrt()];
    let model = Linear { drift: vec![0.0, 0.1, 0.0, 0.0], noise, states: 2 };
    let prior = Gaussian::from_cov(&[0.0, 0.0], &[2.0, 1.0, 1.0, 2.0])?;
    let (_, exact) = model.exact(&prior, END);
    let mut page = Page {
        about: "A prediction over 10 s by the level set, which is the same for all its velocities as the drift is linear. \
                The exact covariance is that of the matrix exponential. The paper prints the diffusion without its ½ in eq \
                45; its equations for the root solve eq 3, and so do ours."
            .to_owned(),
        ..Page::default()
    };
    let mut table = Table::new("errors", &["solver", "steps", "density", "covariance"]);
    let (mut densities, mut covariances) = (Vec::new(), Vec::new());
    for ((name, shown, solver), colour) in SOLVERS.into_iter().zip(COLOURS) {
        let (mut of_density, mut of_cov) = (Vec::new(), Vec::new());
        for steps in STEPS {
            let (_, cov) = Stepping::LevelSet(solver).predicted(&model, &prior, END, steps)?;
            let errors = [density_error(&exact, &cov), distance(&exact, &cov)];
            table.rows.push(vec![shown.into(), steps.into(), errors[0].into(), errors[1].into()]);
            of_density.push([steps as f64, errors[0]]);
            of_cov.push([steps as f64, errors[1]]);
        }
        let floor = 1e3 * f64::EPSILON;
        let peak = 1.0 / (core::f64::consts::TAU * determinant(&exact).sqrt());
        let found = order(&of_density, floor * peak);
        page.claims.push(claim(format!("order of the density's error, {shown}"), &expected, name, found));
        let found = order(&of_cov, floor * distance(&exact, &[0.0; 4]));
        page.claims.push(claim(format!("order of the covariance's error, {shown}"), &expected, name, found));
        densities.push((shown, colour, of_density));
        covariances.push((shown, colour, of_cov));
    }
    page.tables.push(table);
    let panels = vec![
        panel("largest error of the density", "density at t = 10", &densities),
        panel("error, Frobenius norm", "covariance at t = 10", &covariances),
    ];
    page.figures.push(("errors", figure("The level set with a linear drift", true, panels)));
    Ok(page)
}

fn determinant(cov: &[f64]) -> f64 {
    cov[0] * cov[3] - cov[1] * cov[2]
}

/// The largest difference of two Gaussian densities of mean zero: over directions and radii in standard deviations of
/// the first.
fn density_error(exact: &[f64], other: &[f64]) -> f64 {
    let root = [exact[0].sqrt(), exact[2] / exact[0].sqrt(), (determinant(exact) / exact[0]).sqrt()];
    let (of_exact, of_other) = (determinant(exact), determinant(other));
    let shift = -0.5 * (of_other / of_exact).ln();
    let mut largest = 0.0f64;
    for direction in 0..180 {
        let (sin, cos) = (core::f64::consts::PI * f64::from(direction) / 180.0).sin_cos();
        let (x, y) = (root[0] * cos, root[1] * cos + root[2] * sin);
        // what a unit of the squared radius weighs in the other
        let weight = (other[3] * x * x - 2.0 * other[1] * x * y + other[0] * y * y) / of_other;
        for radius in 0..=100 {
            let square = (0.05 * f64::from(radius)).powi(2);
            let ratio = 0.5 * square * (1.0 - weight) + shift;
            largest = largest.max((-0.5 * square).exp() * ratio.exp_m1().abs());
        }
    }
    largest / (core::f64::consts::TAU * of_exact.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn densities_of_circles_differ_most_at_the_centre() {
        // N(0, I) and N(0, 2 I) at 0: 1/2π − 1/4π
        let found = density_error(&[1.0, 0.0, 0.0, 1.0], &[2.0, 0.0, 0.0, 2.0]);
        assert!((found - 0.25 / core::f64::consts::PI).abs() < 1e-15);
    }
}

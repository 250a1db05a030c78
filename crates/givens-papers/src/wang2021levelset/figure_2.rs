//! Figure 2: the time updates on an oscillator of three states.

use super::convergence::{Linear, Moments, Stepping, claim, distance, order, panel};
use crate::drawing::figure;
use crate::estimate::exactly;
use crate::page::Table;
use crate::{Claim, Expected, Page, Plan, Trouble};
use givens::filter::Gaussian;
use givens::filter::predict::Variant;
use givens::ode::Solver;
use givens_io::figure::Colour;

const EXPECTED: &str = include_str!("expected/figure-2.toml");
const END: f64 = 0.2;
const STEPS: [usize; 6] = [1, 2, 4, 8, 16, 32];
/// Key, name, colour in the paper, time update.
const METHODS: [(&str, &str, Colour, Stepping); 4] = [
    ("once", "CD-CKF (noise once)", Colour::BLUE, Stepping::ItoTaylor(Variant::NoiseOnce)),
    ("proper", "IT-1.5 (noise at every step)", Colour::VERMILION, Stepping::ItoTaylor(Variant::Simplified)),
    ("rk2", "LSKF-RK2", Colour::ORANGE, Stepping::LevelSet(Solver::Rk2)),
    ("rk4", "LSKF-RK4", Colour::PURPLE, Stepping::LevelSet(Solver::Rk4)),
];

pub(super) fn run(_: &Plan) -> Result<Page, Trouble> {
    let expected = Expected::read(EXPECTED)?;
    // eq 53 taken literally: the third derivative is −ε
    let drift = vec![0.0, 1.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0];
    let noise = vec![0.01, 0.0, 0.0, 0.0, 0.01, 0.0, 0.0, 0.0, 0.02];
    let model = Linear { drift, noise, states: 3 };
    let prior = Gaussian::from_std(&[1.0, 0.0, 0.0], &[0.01, 0.01, 0.03])?;
    let (mean, cov) = model.exact(&prior, END);
    let sizes = [distance(&mean, &[0.0; 3]), distance(&cov, &[0.0; 9])];
    let mut page = Page {
        about: format!(
            "A prediction over 0.2 s. The drift is eq 53 as printed, [ε̇, ε̈, −ε], although a harmonic oscillator's would be \
             another. The exact covariance, by the Taylor series of the moments, has Frobenius' norm {:.3e}.",
            sizes[1]
        ),
        ..Page::default()
    };
    let mut table = Table::new("errors", &["method", "steps", "mean", "covariance"]);
    let (mut means, mut covariances) = (Vec::new(), Vec::new());
    let mut last: Vec<Moments> = Vec::new();
    for (key, name, colour, stepping) in METHODS {
        let (mut of_mean, mut of_cov) = (Vec::new(), Vec::new());
        for steps in STEPS {
            let found = stepping.predicted(&model, &prior, END, steps)?;
            let errors = [distance(&mean, &found.0), distance(&cov, &found.1)];
            table.rows.push(vec![name.into(), steps.into(), errors[0].into(), errors[1].into()]);
            of_mean.push([steps as f64, errors[0]]);
            of_cov.push([steps as f64, errors[1]]);
            if steps == STEPS[STEPS.len() - 1] {
                last.push(found);
            }
        }
        for (of, points, size) in [("mean", &of_mean, sizes[0]), ("covariance", &of_cov, sizes[1])] {
            let found = order(points, 1e3 * f64::EPSILON * size);
            if key != "once" {
                page.claims.push(claim(format!("order of the {of}'s error, {name}"), &expected, key, found));
            }
        }
        means.push((name, colour, of_mean));
        covariances.push((name, colour, of_cov));
    }
    page.tables.push(table);
    page.claims.extend(statements(&covariances, &last));
    let panels = vec![
        panel("error of the mean, L2 norm", "mean at t = 0.2", &means),
        panel("error of the covariance, Frobenius norm", "covariance at t = 0.2", &covariances),
    ];
    page.figures.push(("errors", figure("Time updates on an oscillator", true, panels)));
    Ok(page)
}

/// What the paper says of the curves, `errors` of the covariance by method, `last` at the most steps.
fn statements(errors: &[(&str, Colour, Vec<[f64; 2]>)], last: &[Moments]) -> Vec<Claim> {
    let error = |method: usize, k: usize| errors[method].2[k][1];
    let finest = STEPS.len() - 1;
    let (stalled, before) = (error(0, finest), error(0, finest - 1));
    let apart = distance(&last[1].1, &last[2].1);
    // the fewest steps of the fourth-order solver that beat the most of the Itô–Taylor step
    let fewest = (0..=finest).find(|&k| error(3, k) <= error(1, finest)).map_or(0, |k| STEPS[k]);
    vec![
        Claim::statement(
            "the CD-CKF as its authors run it (noise once) does not converge to the limit of the others",
            format!(
                "its covariance stalls {stalled:.2e} away (the last doubling changes that by {:.1e})",
                stalled - before
            ),
            exactly((stalled / before - 1.0).abs() < 0.05 && stalled > 10.0 * error(1, finest)),
        ),
        Claim::statement(
            "the proper Itô–Taylor step and the LSKF-RK2 converge to the same covariance",
            format!("{apart:.1e} apart at {} steps", STEPS[finest]),
            exactly(
                apart <= error(1, finest) + error(2, finest) && error(1, finest) < 1e-2 * stalled.max(1e-300),
            ),
        ),
        Claim::statement(
            "the LSKF-RK4 reaches the error of the proper Itô–Taylor step with much fewer steps",
            format!("{fewest} in place of {}", STEPS[finest]),
            exactly((1..=4).contains(&fewest)),
        ),
    ]
}

//! Simulation-based calibration of the smoothers: where the prior draws the truth, its rank among draws of the posterior is
//! uniform (Talts, Betancourt, Simpson, Vehtari and Gelman, Validating Bayesian inference algorithms).

use super::simulated::{Drawn, continuous, discrete};
use givens::Samples;
use givens::metrics::chi_squared_quantile;
use givens::registry::Choice;
use givens_tests::choices::{choices, continuous_choices};

/// Runs, of discrete and of continuous models, draws of each posterior, and classes of ranks.
const RUNS: usize = 400;
const FEWER: usize = 120;
const COUNT: u32 = 15;
const CLASSES: usize = 8;
/// One seed of a million has a larger χ².
const LEVEL: f64 = 1.0 - 1e-6;

/// What is ranked: a state at the first row, another at the last, and what depends on how all rows go together.
fn quantities(rows: usize, state: impl Fn(usize) -> Vec<f64>) -> [f64; 3] {
    let (first, last) = (state(0), state(rows - 1));
    let way: f64 = (1..rows).map(|row| (state(row)[0] - state(row - 1)[0]).powi(2)).sum();
    [first[0], last[1], way]
}

/// χ² of the ranks of each quantity, against uniform ones.
fn unevenness(drawn: &Drawn, choice: &Choice) -> [f64; 3] {
    let mut classes = [[0_usize; CLASSES]; 3];
    let rows = drawn.rows();
    for run in 0..drawn.runs() {
        let samples: Samples = drawn.sample(choice, run, COUNT);
        let truth = quantities(rows, |row| drawn.truth(run, row).to_vec());
        let mut ranks = [0; 3];
        for i in 0..samples.len() {
            let of = quantities(rows, |row| samples.state(i, row).to_vec());
            ranks
                .iter_mut()
                .zip(of.iter().zip(&truth))
                .for_each(|(rank, (x, truth))| *rank += usize::from(x < truth));
        }
        for (classes, rank) in classes.iter_mut().zip(ranks) {
            classes[rank * CLASSES / (COUNT as usize + 1)] += 1;
        }
    }
    let expected = drawn.runs() as f64 / CLASSES as f64;
    classes.map(|classes| classes.iter().map(|&n| (n as f64 - expected).powi(2) / expected).sum())
}

fn even(name: &str, drawn: &Drawn, choice: &Choice) {
    let limit = chi_squared_quantile((CLASSES - 1) as f64, LEVEL);
    for (k, found) in unevenness(drawn, choice).into_iter().enumerate() {
        assert!(found < limit, "{name}, quantity {k}: χ² = {found}, at most {limit}");
    }
}

#[test]
fn the_smoother_of_every_discrete_method_on_linear_models_and_on_some_that_bend() {
    for (seed, bend) in [(71, 0.0), (72, 0.02)] {
        let drawn = discrete(seed, RUNS, bend);
        choices(2).iter().for_each(|(name, choice)| even(&format!("{name} {bend}"), &drawn, choice));
    }
}

#[test]
fn the_smoother_of_every_continuous_method_on_linear_models_and_on_some_that_bend() {
    for (seed, bend) in [(73, 0.0), (74, 0.02)] {
        let drawn = continuous(seed, FEWER, bend);
        continuous_choices(2)
            .iter()
            .for_each(|(name, choice)| even(&format!("{name} {bend}"), &drawn, choice));
    }
}

#[test]
fn a_noise_that_is_told_too_large_is_found() {
    let mut drawn = discrete(71, RUNS, 0.0);
    drawn.shrink_noise(2.0);
    let (_, choice) = choices(2).remove(0);
    let limit = chi_squared_quantile((CLASSES - 1) as f64, LEVEL);
    assert!(unevenness(&drawn, &choice).into_iter().any(|found| found > limit));
}

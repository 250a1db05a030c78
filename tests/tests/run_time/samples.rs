//! Trajectories drawn jointly: on linear models they are distributed as the exact joint posterior of all states.

use givens::filter::{Fault, Gaussian};
use givens::registry::{FormName, resolve};
use givens::{Draws, Row, Samples};
use givens_tests::choices::{choices, continuous_choices};
use givens_tests::exact::{Moments, jointly};
use givens_tests::models::Problem;
use givens_tests::sde::Continuous;
use nalgebra::{DMatrix, DVector};

const COUNT: u32 = 4000;
const DRAWS: Draws = Draws { count: COUNT, seed: 5, track: 0 };

/// How far the draws' mean and covariance are from those of the stacked states, in standard deviations of what so many
/// draws give: P_aa / N for a mean, (P_aa P_bb + P_ab²) / N for a covariance, of the same row or of two.
fn deviation(drawn: &Samples, (mean, cov): &Moments) -> f64 {
    let (size, count) = (mean.len(), drawn.len() as f64);
    assert_eq!((drawn.len(), drawn.rows() * drawn.states()), (COUNT as usize, size));
    let all = DMatrix::from_column_slice(size, drawn.len(), &drawn.x);
    let found = all.column_mean();
    let centred = DMatrix::from_fn(size, drawn.len(), |i, j| all[(i, j)] - mean[i]);
    let spread = &centred * centred.transpose() / count;
    let mut worst = 0.0_f64;
    for a in 0..size {
        worst = worst.max((found[a] - mean[a]).abs() / (cov[(a, a)] / count).sqrt());
        for b in 0..=a {
            let of = (cov[(a, a)] * cov[(b, b)] + cov[(a, b)].powi(2)) / count;
            worst = worst.max((spread[(a, b)] - cov[(a, b)]).abs() / of.sqrt());
        }
    }
    worst
}

/// The stacked states of the rows alone.
fn of_rows((mean, cov): Moments, n: usize) -> Moments {
    let rest = mean.len() - n;
    (mean.rows(n, rest).into_owned(), cov.view((n, n), (rest, rest)).into_owned())
}

// 5 standard deviations: of 105 numbers, one in 2e4 seeds is beyond
#[test]
fn draws_of_every_discrete_method_are_of_the_joint_posterior() {
    let problem = Problem::random(41, 3, 2, 4, 0.0);
    let steps = vec![(problem.model.f.clone(), problem.model.q.clone()); 4];
    let prior = (DVector::from_vec(problem.mean.clone()), problem.cov.clone());
    let exact = of_rows(jointly(&prior, &steps, &problem.sensor, &problem.z), 3);
    for (name, choice) in choices(3) {
        let (model, sensor, prior) = (&problem.model, &problem.sensor, problem.prior());
        let drawn = choice.sample(model, sensor, problem.rows(), 0.0, &prior, DRAWS).unwrap();
        let found = deviation(&drawn, &exact);
        assert!(found < 5.0, "{name}: {found}");
    }
}

// the solvers' own error, below a thousandth of a standard deviation, is nothing beside the band
#[test]
fn draws_of_every_continuous_method_are_of_the_joint_posterior() {
    let problem = Continuous::random(42, [2, 2, 1], 4, 0.0);
    let exact = of_rows(jointly(&problem.moments(), &problem.steps(), &problem.sensor, &problem.z), 2);
    for (name, choice) in continuous_choices(2) {
        let (model, sensor, prior) = (&problem.model, &problem.sensor, problem.prior());
        let drawn = choice.sample_continuous(model, sensor, problem.rows(), 0.0, &prior, DRAWS).unwrap();
        // the first row stands at the time of the prior
        let found = deviation(&drawn, &exact);
        assert!(found < 5.0, "{name}: {found}");
    }
}

#[test]
fn without_noise_a_draw_obeys_the_dynamics() {
    let mut problem = Problem::random(43, 3, 1, 5, 0.0);
    problem.model.q.fill(0.0);
    problem.draw(43, 5);
    for (name, choice) in choices(3) {
        let (model, sensor, prior) = (&problem.model, &problem.sensor, problem.prior());
        let draws = Draws { count: 20, ..DRAWS };
        let drawn = choice.sample(model, sensor, problem.rows(), 0.0, &prior, draws).unwrap();
        let worst = (0..20).flat_map(|i| (1..5).map(move |row| (i, row))).fold(0.0_f64, |worst, (i, row)| {
            let next = &problem.model.f * DVector::from_column_slice(drawn.state(i, row - 1));
            worst.max((next - DVector::from_column_slice(drawn.state(i, row))).amax())
        });
        let bound = if choice.form == FormName::SquareRoot { 1e-12 } else { 1e-6 };
        assert!(worst < bound, "{name}: {worst:e}");
    }
}

#[test]
fn rows_at_one_time_have_one_state_and_fewer_draws_are_the_first_ones() {
    let problem = Problem::random(44, 2, 1, 4, 0.1);
    let times = [1.0, 1.0, 2.0, 2.0];
    let rows = || problem.z.iter().zip(times).map(|(z, time)| Row { time, z, u: &[] });
    let (model, sensor, prior) = (&problem.model, &problem.sensor, problem.prior());
    for (name, choice) in choices(2) {
        let draw = |count, track| {
            let draws = Draws { count, seed: 9, track };
            choice.sample(model, sensor, rows(), 0.0, &prior, draws).unwrap()
        };
        let (many, few) = (draw(7, 0), draw(3, 0));
        assert_eq!((many.len(), few.len(), few.time.as_slice()), (7, 3, times.as_slice()));
        assert_eq!(few.x, many.x[..few.x.len()], "{name}");
        assert_ne!(draw(3, 1).x, few.x, "{name}");
        assert_ne!(many.trajectory(0), many.trajectory(1), "{name}");
        for (i, pair) in (0..7).flat_map(|i| [(i, 0), (i, 2)]) {
            let (one, other) = (many.state(i, pair), many.state(i, pair + 1));
            let apart = one.iter().zip(other).fold(0.0_f64, |worst, (x, y)| worst.max((x - y).abs()));
            assert!(apart < 1e-12, "{name}, draw {i}: {apart:e}");
        }
    }
}

#[test]
fn a_row_that_fails_ends_the_draws_with_what_was_finished() {
    let mut problem = Problem::random(45, 2, 1, 4, 0.0);
    let (choice, prior) = (resolve("sr-ckf", &[]).unwrap(), problem.prior());
    let none = Draws { count: 0, ..DRAWS };
    let of = |problem: &Problem, rows: usize, prior: &Gaussian, draws| {
        choice.sample(&problem.model, &problem.sensor, problem.rows().take(rows), 0.0, prior, draws)
    };
    assert!(of(&problem, 0, &prior, DRAWS).unwrap().is_empty());
    assert!(of(&problem, 4, &prior, none).unwrap().is_empty());
    problem.z[2] = vec![f64::INFINITY];
    let failure = of(&problem, 4, &prior, DRAWS).unwrap_err();
    assert_eq!((failure.row, failure.finished.len(), failure.mean.len()), (2, 2, 2));
    let other = Gaussian::from_std(&[0.0], &[1.0]).unwrap();
    assert_eq!(
        of(&problem, 4, &other, DRAWS).unwrap_err().error.fault,
        Fault::Length { of: "mean", expected: 2, found: 1 }
    );
    let continuous = resolve("cd-ckf", &[]).unwrap();
    let refused = continuous.sample(&problem.model, &problem.sensor, problem.rows(), 0.0, &prior, DRAWS);
    assert!(refused.unwrap_err().to_string().contains("continuous-time one"));
}

//! The drifts of the zoo have the rests and the cycles that are known of them.
#![allow(clippy::unwrap_used)]

use givens_core::model::zoo::{Circadian, Lorenz63, Lorenz96, VanDerPol};
use givens_core::model::{At, Sde};

fn drift<M: Sde>(model: &M, t: f64, x: &[f64]) -> Vec<f64> {
    let mut dx = vec![f64::NAN; x.len()];
    model.drift(&At { t, dt: 0.0, u: &[], p: &[] }, x, &mut dx);
    dx
}

/// The path without noise by the classical method of fourth order, in steps of `dt`: time and state after each.
fn path<M: Sde>(model: &M, start: &[f64], dt: f64, until: f64) -> Vec<(f64, Vec<f64>)> {
    let moved =
        |x: &[f64], by: f64, k: &[f64]| -> Vec<f64> { x.iter().zip(k).map(|(x, k)| x + by * k).collect() };
    let mut x = start.to_vec();
    (1..=(until / dt) as usize)
        .map(|step| {
            let t = (step - 1) as f64 * dt;
            let k1 = drift(model, t, &x);
            let k2 = drift(model, t + dt / 2.0, &moved(&x, dt / 2.0, &k1));
            let k3 = drift(model, t + dt / 2.0, &moved(&x, dt / 2.0, &k2));
            let k4 = drift(model, t + dt, &moved(&x, dt, &k3));
            for (weight, k) in [(1.0, k1), (2.0, k2), (2.0, k3), (1.0, k4)] {
                x = moved(&x, weight * dt / 6.0, &k);
            }
            (t + dt, x.clone())
        })
        .collect()
}

/// When the first state falls through zero, interpolated.
fn falls(path: &[(f64, Vec<f64>)]) -> Vec<f64> {
    let fall = |pair: &[(f64, Vec<f64>)]| {
        let ((t0, a), (t1, b)) = (&pair[0], &pair[1]);
        (a[0] > 0.0 && b[0] <= 0.0).then(|| t0 + (t1 - t0) * a[0] / (a[0] - b[0]))
    };
    path.windows(2).filter_map(fall).collect()
}

#[test]
fn van_der_pol_has_the_amplitude_and_the_period_known_of_it() {
    // of the cycle at μ = 1 and 2, to the digits tabled
    for (stiffness, amplitude, period) in [(1.0, 2.0086, 6.6633), (2.0, 2.0199, 7.6299)] {
        let model = VanDerPol { stiffness, noise: 0.0 };
        let path = path(&model, &[2.0, 0.0], 0.005, 100.0);
        let late = &path[path.len() / 2..];
        let highest = late.iter().map(|(_, x)| x[0]).fold(0.0, f64::max);
        let falls = falls(late);
        let found = (falls[falls.len() - 1] - falls[0]) / (falls.len() - 1) as f64;
        assert!((highest - amplitude).abs() < 1e-4 && (found - period).abs() < 1e-4, "{highest} {found}");
    }
}

#[test]
fn lorenz_63_rests_where_it_is_known_to() {
    let away = (8.0 / 3.0 * 27.0_f64).sqrt();
    for x in [[0.0; 3], [away, away, 27.0], [-away, -away, 27.0]] {
        let dx = drift(&Lorenz63::default(), 0.0, &x);
        assert!(dx.iter().all(|dx| dx.abs() < 1e-13), "{dx:?}");
    }
}

#[test]
fn lorenz_96_rests_at_its_forcing_and_conserves_energy_but_for_forcing_and_friction() {
    for states in 0..7 {
        let model = Lorenz96 { states, ..Default::default() };
        assert_eq!(drift(&model, 0.0, &vec![8.0; states]), vec![0.0; states]);
    }
    // Σ x dx = Σ x (F − x): the quadratic terms move energy, and make none
    let x = [1.0, -2.0, 3.5, 0.5, 7.0];
    let dx = drift(&Lorenz96 { states: 5, ..Default::default() }, 0.0, &x);
    let gained: f64 = x.iter().zip(&dx).map(|(x, dx)| x * dx).sum();
    let expected: f64 = x.iter().map(|x| x * (8.0 - x)).sum();
    assert!((gained - expected).abs() < 1e-12);
}

#[test]
fn the_clock_goes_by_itself_in_the_dark_and_with_the_day_in_light() {
    let start = [0.0, -1.0, 0.4];
    let period = |light: f64| {
        let path = path(&Circadian { light, ..Default::default() }, &start, 0.02, 24.0 * 60.0);
        let falls = falls(&path[path.len() / 2..]);
        (falls[falls.len() - 1] - falls[0]) / (falls.len() - 1) as f64
    };
    let (dark, lit) = (period(0.0), period(500.0));
    assert!((dark - 24.2).abs() < 0.02, "{dark}");
    assert!((lit - 24.0).abs() < 0.005, "{lit}");
}

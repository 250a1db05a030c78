//! A drift and a diffusion that depend on the time are taken at every time between two rows, on the way back too.

use givens::filter::Gaussian;
use givens::filter::predict::Variant;
use givens::model::zoo::Components;
use givens::model::{At, Sde, Varies};
use givens::ode::Tolerance;
use givens::registry::TimeName;
use givens::scalar::Real;
use givens::{Goal, Row};
use givens_tests::choices::continuous_choices;

/// dx = cos t dt + (0.2 + a t + b t²) dβ.
struct Varying {
    a: f64,
    b: f64,
}

impl Sde for Varying {
    fn states(&self) -> usize {
        1
    }
    fn noises(&self) -> usize {
        1
    }
    fn drift<T: Real>(&self, at: &At<T>, _: &[T], dx: &mut [T]) {
        dx[0] = at.t.cos();
    }
    fn diffusion<T: Real>(&self, at: &At<T>, _: &[T], g: &mut [T]) {
        g[0] = at.t.mul_add(at.t.mul_add(T::of(self.b), T::of(self.a)), T::of(0.2));
    }
    fn diffusion_varies(&self) -> Varies {
        Varies::WithTime
    }
}

/// With variance 0.3.
fn sensor() -> Components<1> {
    Components { states: 1, which: [0], std: [0.3_f64.sqrt()] }
}

/// ∫ (0.2 + t²)² dt from zero.
fn spread(t: f64) -> f64 {
    0.04 * t + 0.4 * t.powi(3) / 3.0 + t.powi(5) / 5.0
}

#[test]
fn what_depends_on_the_time_is_integrated_over_it() {
    let (rows, model) = ([(0.5, 1.1), (1.6, 2.4)], Varying { a: 0.0, b: 1.0 });
    // the scalar filter and its way back: nothing but sums
    let (mut mean, mut var, mut time) = (0.7, 0.25, 0.0_f64);
    let mut filtered = Vec::new();
    let mut predicted = Vec::new();
    for (t, z) in rows {
        (mean, var) = (mean + t.sin() - time.sin(), var + spread(t) - spread(time));
        predicted.push((mean, var));
        let gain = var / (var + 0.3);
        (mean, var, time) = (mean + gain * (z - mean), (1.0 - gain) * var, t);
        filtered.push((mean, var));
    }
    let back = filtered[0].1 / predicted[1].1;
    let first = (
        filtered[0].0 + back * (filtered[1].0 - predicted[1].0),
        filtered[0].1 + back * back * (filtered[1].1 - predicted[1].1),
    );
    let prior = Gaussian::from_std(&[0.7], &[0.5]).unwrap();
    let mut followed = 0;
    for (name, mut choice) in continuous_choices(1) {
        // steps of first order and expansions hold the diffusion of their beginning
        if !matches!(choice.time_update, TimeName::MomentOde | TimeName::LevelSet) {
            continue;
        }
        choice.integrator.tolerance = Tolerance { rtol: 1e-10, atol: 0.0 };
        let data = rows.each_ref().map(|(time, z)| Row { time: *time, z: core::slice::from_ref(z), u: &[] });
        let outcome =
            choice.run_continuous(&model, &sensor(), data.into_iter(), 0.0, &prior, Goal::Interval, &[]);
        let found = outcome.into_result().unwrap();
        followed += 1;
        for (k, (m, p)) in [first, filtered[1]].into_iter().enumerate() {
            let (mean, var) = (found.mean(k)[0], found.cov(k)[0]);
            assert!((mean - m).abs() < 1e-7 && (var - p).abs() < 1e-7, "{name}, {k}: {mean} {var}, {m} {p}");
        }
    }
    assert!(followed > 5, "{followed}");
}

#[test]
fn an_ito_taylor_step_follows_a_diffusion_that_is_linear_in_time() {
    let (model, prior) = (Varying { a: 0.8, b: 0.0 }, Gaussian::from_std(&[0.7], &[0.5]).unwrap());
    // ∫ (0.2 + 0.8 t)² dt
    let spread = |t: f64| (0.2 + 0.8 * t).powi(3) / 2.4;
    let mut followed = 0;
    for (name, choice) in continuous_choices(1) {
        if choice.time_update != TimeName::ItoTaylor || choice.variant != Variant::Full {
            continue;
        }
        let sensor = sensor();
        let mut f = choice.start_continuous(&model, &sensor, 0.3, &prior).unwrap();
        f.predict(1.1).unwrap();
        let expected = 0.25 + spread(1.1) - spread(0.3);
        assert!((f.cov()[0] - expected).abs() < 1e-14, "{name}: {:?} for {expected}", f.cov());
        followed += 1;
    }
    assert!(followed > 5, "{followed}");
}

//! Filters predict alike with a model of expressions and with the same model written by hand.

use givens_core::filter::{CdCkf1, CdEkf, Gaussian, Lskf, Method, Over, SrCdCkf};
use givens_core::model::zoo::Turn3d;
use givens_core::model::{At, Sde};
use givens_core::scalar::Real;
use givens_expr::ModelSde;

use super::model;

/// Van der Pol's oscillator with a force and a noise that vary with time.
struct Forced;

impl Sde for Forced {
    fn states(&self) -> usize {
        2
    }
    fn noises(&self) -> usize {
        1
    }
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        dx[0] = x[1];
        dx[1] = T::of(2.0) * (T::one() - x[0] * x[0]) * x[1] - x[0] + (T::of(3.0) * at.t).cos();
    }
    fn diffusion<T: Real>(&self, at: &At<T>, _: &[T], g: &mut [T]) {
        g[0] = T::of(0.1);
        g[1] = T::of(0.3) * at.t;
    }
}

const TURN: [&str; 7] = ["x1", "-x6*x3", "x3", "x6*x1", "x5", "0", "0"];

fn turn() -> ModelSde {
    let turn = Turn3d::default();
    let mut diffusion = vec!["0".to_string(); 49];
    for i in [1, 3, 5] {
        diffusion[i * 8] = turn.velocity.to_string();
    }
    diffusion[48] = turn.rate.to_string();
    model(&TURN.map(String::from), &diffusion).unwrap()
}

/// Mean and covariance after two gaps.
fn predicted<X: Method + Over<M>, M: Sde>(method: &X, model: &M, mean: &[f64], std: &[f64]) -> Vec<f64> {
    let mut filter = method.start(model, 0.5, Gaussian::from_std(mean, std).unwrap()).unwrap();
    filter.set_controls(&vec![0.0; model.controls()]).unwrap();
    filter.predict(0.9).unwrap();
    filter.predict(1.6).unwrap();
    filter.mean().iter().copied().chain(filter.cov()).collect()
}

/// Of one method: expressions against the model by hand.
fn alike<X: Method + Over<M> + Over<ModelSde>, M: Sde>(
    name: &str,
    method: &X,
    models: (&ModelSde, &M),
    [mean, std]: [&[f64]; 2],
) {
    let found = predicted(method, models.0, mean, std);
    let expected = predicted(method, models.1, mean, std);
    let size = |i: usize| expected[mean.len() + i * (mean.len() + 1)].abs().sqrt();
    for (k, (a, b)) in found.iter().zip(&expected).enumerate() {
        let (i, j) = (k.saturating_sub(mean.len()) / mean.len(), k.saturating_sub(mean.len()) % mean.len());
        let scale = if k < mean.len() { size(k) + b.abs() } else { size(i) * size(j) };
        assert!((a - b).abs() <= 1e-11 * scale, "{name}, entry {k}: {a} by expressions, {b} by hand");
    }
}

#[test]
fn every_time_update_takes_a_model_of_expressions() {
    let forced = model(&["x1", "2*(1 - x0^2)*x1 - x0 + cos(3*t)"], &["0.1", "0.3*t"]).unwrap();
    let turn = turn();
    let mean = [1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 0.1];
    let std = [30.0, 5.0, 30.0, 5.0, 30.0, 5.0, 0.02];
    macro_rules! all {
        ($($method:ident),*) => {$(
            let method = $method::default();
            alike(stringify!($method), &method, (&turn, &Turn3d::default()), [&mean, &std]);
            alike(stringify!($method), &method, (&forced, &Forced), [&[0.4, -0.2], &[0.2, 0.1]]);
        )*};
    }
    all!(SrCdCkf, CdCkf1, CdEkf, Lskf);
}

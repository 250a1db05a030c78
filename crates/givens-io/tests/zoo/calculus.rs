//! What a filter asks of a drift: values, Jacobian and Itô derivatives, as a model has them and by finite differences.

use givens_core::model::{At, Linear, Sde};

/// f, G, J, L₀f and Lf, each row by row under its name.
pub type Calculus = [(&'static str, Vec<f64>); 5];

/// The same with states counted in `scale` and each noise in its largest push, so that no entry is small for its unit.
pub fn in_units_of(scale: &[f64], calculus: Calculus) -> Calculus {
    let n = scale.len();
    let (_, g) = &calculus[1];
    let q = g.len() / n;
    let push = |j: usize| (0..n).map(|i| (g[i * q + j] / scale[i]).abs()).fold(1e-300, f64::max);
    let noises: Vec<f64> = (0..q).map(|j| push(j).recip()).collect();
    calculus.map(|(what, mut entries)| {
        let columns: &[f64] = match what {
            "J" => scale,
            "G" | "Lf" => &noises,
            _ => &[1.0],
        };
        for (row, scale) in entries.chunks_mut(columns.len().max(1)).zip(scale) {
            row.iter_mut().zip(columns).for_each(|(entry, column)| *entry *= column / scale);
        }
        (what, entries)
    })
}

/// As the model has them.
pub fn of<M: Sde>(model: &M, t: f64, x: &[f64]) -> Calculus {
    let (n, q) = (model.states(), model.noises());
    let p = model.parameters().to_vec();
    let at = At { t, dt: 0.0, u: &[], p: &p };
    let (mut g, mut f, mut l0, mut lf) = (vec![0.0; n * q], vec![0.0; n], vec![0.0; n], vec![0.0; n * q]);
    model.diffusion(&at, x, &mut g);
    let mut scratch = vec![f64::NAN; model.expansion_scratch(1)];
    model.expansion_points(&at, 1, x, &mut f, &mut l0, &mut lf, &mut scratch);
    let unit: Vec<f64> = (0..n * n).map(|k| f64::from(u8::from(k % (n + 1) == 0))).collect();
    let (mut value, mut jacobian) = (vec![0.0; n], vec![0.0; n * n]);
    let mut scratch = vec![f64::NAN; model.drift_scratch(2 * n)];
    let out = Linear { value: &mut value, image: &mut jacobian, stride: n };
    model.drift_linear(&at, x, &unit, out, &mut scratch);
    assert_eq!(value, f);
    [("f", f), ("G", g), ("J", jacobian), ("L₀f", l0), ("Lf", lf)]
}

/// The same by central differences over small parts of `scale`, a length for each component. Where the noise is small
/// against the scale its second derivative drowns, so it is taken over the scale and multiplied.
pub fn by_differences<M: Sde>(model: &M, t: f64, x: &[f64], scale: &[f64]) -> Calculus {
    let (n, q) = (model.states(), model.noises());
    let p = model.parameters().to_vec();
    let f = |t: f64, x: &[f64]| {
        let mut dx = vec![0.0; n];
        model.drift(&At { t, dt: 0.0, u: &[], p: &p }, x, &mut dx);
        dx
    };
    // x + h along, and along time with it
    let moved = |by: f64, along: &[f64], time: f64| {
        let there: Vec<f64> = x.iter().zip(along).map(|(x, a)| x + by * a).collect();
        f(t + by * time, &there)
    };
    let first = |h: f64, along: &[f64], time: f64| -> Vec<f64> {
        let (up, down) = (moved(h, along, time), moved(-h, along, time));
        up.iter().zip(&down).map(|(up, down)| (up - down) / (2.0 * h)).collect()
    };
    let here = f(t, x);
    let second = |h: f64, along: &[f64]| -> Vec<f64> {
        let (up, down) = (moved(h, along, 0.0), moved(-h, along, 0.0));
        (0..n).map(|i| (up[i] - 2.0 * here[i] + down[i]) / (h * h)).collect()
    };
    // the step that goes a fraction of the scale in the component that goes farthest
    let step = |fraction: f64, along: &[f64]| {
        let farthest = along.iter().zip(scale).map(|(a, s)| a.abs() / s).fold(1e-300, f64::max);
        fraction / farthest
    };
    let mut g = vec![0.0; n * q];
    model.diffusion(&At { t, dt: 0.0, u: &[], p: &p }, x, &mut g);
    let mut jacobian = vec![0.0; n * n];
    for j in 0..n {
        let mut along = vec![0.0; n];
        along[j] = 1.0;
        let column = first(step(1e-5, &along), &along, 0.0);
        (0..n).for_each(|i| jacobian[i * n + j] = column[i]);
    }
    let mut l0 = first(step(1e-5, &here), &here, 1.0);
    let mut lf = vec![0.0; n * q];
    for j in 0..q {
        let along: Vec<f64> = (0..n).map(|i| g[i * q + j]).collect();
        let (slope, bend) = (first(step(1e-5, &along), &along, 0.0), second(step(1e-3, &along), &along));
        for i in 0..n {
            lf[i * q + j] = slope[i];
            l0[i] += 0.5 * bend[i];
        }
    }
    [("f", here), ("G", g), ("J", jacobian), ("L₀f", l0), ("Lf", lf)]
}

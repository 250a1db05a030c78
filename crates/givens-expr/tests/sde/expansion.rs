//! The Itô derivatives by symbol.

use givens_core::model::{At, Expanded, Linear, Map, Sde, Varies};
use givens_core::scalar::{Dual2, Real};

use super::{ByDuals, diagonal, full, lorenz96, model, models, near, states};

/// f, L₀f and Lf of a model at all points.
fn expansion<T: Real, M: Sde>(model: &M, t: T, points: usize, x: &[T]) -> [Vec<T>; 3] {
    let (n, q) = (model.states(), model.noises());
    let nan = T::of(f64::NAN);
    let mut out = [n, n, n * q].map(|rows| vec![nan; rows * points]);
    let mut scratch = vec![nan; model.expansion_scratch(points)];
    let p: Vec<T> = model.parameters().iter().map(|&p| T::of(p)).collect();
    let u = [T::of(0.9)];
    let at = At { t, dt: nan, u: &u, p: &p };
    let [f, l0, lf] = &mut out;
    model.expansion_points(&at, points, x, f, l0, lf, &mut scratch);
    out
}

#[test]
fn the_expansion_by_symbol_is_that_by_duals() {
    for (drift, diffusion) in models() {
        let model = model(&drift, &diffusion).unwrap();
        let x = states(model.states());
        let (symbol, duals) = (expansion(&model, 1.3, 3, &x), expansion(&ByDuals(&model), 1.3, 3, &x));
        for (k, name) in ["f", "L0f", "Lf"].into_iter().enumerate() {
            near(&symbol[k], &duals[k], 1e-13, &format!("{name} of {drift:?}"));
        }
    }
}

#[test]
fn the_expansion_is_that_by_differences() {
    let h = 1e-4;
    for (drift, diffusion) in models() {
        let model = model(&drift, &diffusion).unwrap();
        let (n, q) = (model.states(), model.noises());
        let all = states(n);
        let x: Vec<f64> = all.iter().step_by(3).copied().collect();
        let [f, l0, lf] = expansion(&model, 1.3, 1, &x);
        let p = model.parameters().to_vec();
        let mut g = vec![0.0; n * q];
        model.diffusion(&At { t: 1.3, dt: 0.0, u: &[0.9], p: &p }, &x, &mut g);
        let moved = |by: f64, later: f64, along: &dyn Fn(usize) -> f64| {
            let mut dx = vec![0.0; n];
            let x: Vec<f64> = x.iter().enumerate().map(|(i, x)| x + by * along(i)).collect();
            model.drift(&At { t: 1.3 + later, dt: 0.0, u: &[0.9], p: &p }, &x, &mut dx);
            dx
        };
        let (up, down) = (moved(h, h, &|i| f[i]), moved(-h, -h, &|i| f[i]));
        let mut expected: Vec<f64> = (0..n).map(|i| (up[i] - down[i]) / (2.0 * h)).collect();
        for j in 0..q {
            let (up, down) = (moved(h, 0.0, &|i| g[i * q + j]), moved(-h, 0.0, &|i| g[i * q + j]));
            let column: Vec<f64> = (0..n).map(|i| (up[i] - down[i]) / (2.0 * h)).collect();
            let found: Vec<f64> = (0..n).map(|i| lf[i * q + j]).collect();
            near(&found, &column, 1e-6, &format!("Lf of {drift:?}"));
            for i in 0..n {
                expected[i] += 0.5 * (up[i] + down[i] - 2.0 * f[i]) / (h * h);
            }
        }
        near(&l0, &expected, 1e-5, &format!("L0f of {drift:?}"));
    }
}

#[test]
fn the_expansion_is_of_any_scalar() {
    for (drift, diffusion) in models() {
        let model = model(&drift, &diffusion).unwrap();
        let x = states(model.states());
        let double = expansion(&model, 1.3, 3, &x);
        let single: Vec<f32> = x.iter().map(|&x| x as f32).collect();
        let single = expansion(&model, 1.3_f32, 3, &single);
        // a derivative within a derivative: time and state both move
        let nested: Vec<Dual2<Dual2<f64>>> =
            x.iter().map(|&x| Dual2::along(Dual2::along(x, 0.2), Dual2::constant(-0.5))).collect();
        let t = Dual2::along(Dual2::variable(1.3), Dual2::constant(2.0));
        let (symbol, duals) = (expansion(&model, t, 3, &nested), expansion(&ByDuals(&model), t, 3, &nested));
        for k in 0..3 {
            let wide: Vec<f64> = single[k].iter().map(|&x| f64::from(x)).collect();
            near(&wide, &double[k], 1e-4, "f32");
            let part = |of: fn(&Dual2<Dual2<f64>>) -> f64, from: &[Vec<Dual2<Dual2<f64>>>; 3]| -> Vec<f64> {
                from[k].iter().map(of).collect()
            };
            for of in [|x| x.v.v, |x| x.d.v, |x| x.v.dd, |x| x.dd.d] as [fn(&Dual2<Dual2<f64>>) -> f64; 4] {
                near(&part(of, &symbol), &part(of, &duals), 1e-11, "nested duals");
            }
        }
    }
}

#[test]
fn steps_of_the_expansion_are_those_by_duals() {
    for (drift, diffusion) in models() {
        let model = model(&drift, &diffusion).unwrap();
        let (n, x) = (model.states(), states(drift.len()));
        let p = model.parameters().to_vec();
        let at = At { t: 1.3, dt: 0.05, u: &[0.9], p: &p };
        let root: Vec<f64> = (0..n * n).map(|k| (1.1 * k as f64).cos()).collect();
        let (by_symbol, by_duals) = (
            Expanded { model: &model, times: 3, noise: true },
            Expanded { model: &ByDuals(&model), times: 3, noise: true },
        );
        let (symbol, duals) = (images(&by_symbol, &at, &x, &root), images(&by_duals, &at, &x, &root));
        near(&symbol.0, &duals.0, 1e-12, "points");
        near(&symbol.1, &duals.1, 1e-12, "first order");
    }
}

/// What a map makes of three points, and the image of a root at the first.
fn images(map: &impl Map, at: &At<f64>, x: &[f64], root: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (n, d) = (x.len() / 3, map.outputs());
    let mut scratch = vec![f64::NAN; map.scratch(3)];
    let (mut points, mut value, mut image) = (vec![0.0; 3 * d], vec![0.0; d], vec![0.0; d * n]);
    map.points(at, 3, x, &mut points, &mut scratch);
    let first: Vec<f64> = x.iter().step_by(3).copied().collect();
    map.linear(at, &first, root, Linear { value: &mut value, image: &mut image, stride: n }, &mut scratch);
    (points, image)
}

#[test]
fn a_diffusion_of_the_state_keeps_its_derivatives_by_duals() {
    let model = model(&["-x0*x1", "sin(x0)"], &["0.1*x0", "0", "0", "sqrt(1 + x1^2)"]).unwrap();
    assert_eq!(model.diffusion_varies(), Varies::WithState);
    let x = states(2);
    assert_eq!(expansion(&model, 0.0, 3, &x), expansion(&ByDuals(&model), 0.0, 3, &x));
}

#[test]
fn derivatives_that_no_graph_holds_are_worked_out_by_duals() {
    // every state moves with every other, and every noise with all
    let n = 50;
    let pull = |i: usize| (0..n).map(|j| format!("sin(x{j} - x{i})")).collect::<Vec<_>>().join(" + ");
    let model = model(&(0..n).map(pull).collect::<Vec<_>>(), &full(n)).unwrap();
    let x = states(n);
    assert_eq!(expansion(&model, 0.0, 1, &x[..n]), expansion(&ByDuals(&model), 0.0, 1, &x[..n]));
}

#[test]
fn a_model_of_a_thousand_states_is_made_in_short_time() {
    let begin = std::time::Instant::now();
    let model = model(&lorenz96(1000), &diagonal(1000)).unwrap();
    let [f, l0, lf] = expansion(&model, 0.0, 1, &states(1000)[..1000]);
    assert!(f.iter().chain(&l0).chain(&lf).all(|x| x.is_finite()));
    assert!(begin.elapsed().as_secs() < 30, "{:?}", begin.elapsed());
}

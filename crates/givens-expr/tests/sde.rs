//! Continuous models of expressions: their derivatives by symbol against those by duals and by differences.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use givens_core::model::{At, Expanded, Linear, Map, Sde, Varies};
use givens_core::scalar::{Dual2, Real};
use givens_expr::{Graph, GraphError, Input, Meaning, ModelError, ModelSde, Node, Scope, SdeParts, parse};

/// Two parameters `a`, `b` and a control `u_f` beside the states x0, x1, …
fn scope(graph: &mut Graph, states: usize) -> Scope {
    let mut scope = Scope::new();
    let states = (0..states).map(|i| (format!("x{i}"), Input::State(i as u32)));
    let others = [
        ("t", Input::Time),
        ("dt", Input::Step),
        ("u_f", Input::Control(0)),
        ("a", Input::Parameter(0)),
        ("b", Input::Parameter(1)),
    ];
    for (name, input) in states.chain(others.map(|(name, input)| (name.to_string(), input))) {
        scope.insert(name, Meaning::Is(graph.input(input)));
    }
    scope
}

fn model<S: AsRef<str>>(drift: &[S], diffusion: &[S]) -> Result<ModelSde, ModelError> {
    let mut graph = Graph::new();
    let scope = scope(&mut graph, drift.len());
    let mut read = |texts: &[S]| -> Vec<Node> {
        texts.iter().map(|text| parse(&mut graph, &scope, text.as_ref()).unwrap()).collect()
    };
    let parts = SdeParts {
        states: drift.len(),
        controls: 1,
        parameters: vec![0.7, -0.4],
        drift: read(drift),
        diffusion: read(diffusion),
        noises: diffusion.len() / drift.len(),
    };
    ModelSde::new(&mut graph, parts)
}

/// The same model with nothing but its two required bodies.
struct ByDuals<'m>(&'m ModelSde);

impl Sde for ByDuals<'_> {
    fn states(&self) -> usize {
        self.0.states()
    }
    fn noises(&self) -> usize {
        self.0.noises()
    }
    fn controls(&self) -> usize {
        self.0.controls()
    }
    fn parameters(&self) -> &[f64] {
        self.0.parameters()
    }
    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        self.0.drift(at, x, dx);
    }
    fn diffusion<T: Real>(&self, at: &At<T>, x: &[T], g: &mut [T]) {
        self.0.diffusion(at, x, g);
    }
}

/// Texts of drift and diffusion.
type Texts = (Vec<String>, Vec<String>);

fn texts(drift: &[&str], diffusion: &[&str]) -> Texts {
    let owned = |texts: &[&str]| texts.iter().map(|text| (*text).to_string()).collect();
    (owned(drift), owned(diffusion))
}

/// Models whose derivatives take every turn: time, parameters, controls, choices, full and missing columns of G.
fn models() -> Vec<Texts> {
    vec![
        texts(&["x1", "a*(1 - x0^2)*x1 - x0 + u_f*cos(b*t)"], &["0", "0.2", "exp(-t)", "a"]),
        texts(
            &["where(x0 > 0.1, sin(x0*x1)*t, x0^3*x1)", "x2*x1 - t^2", "atan2(x0, 1 + x1^2) + u_f*x2"],
            &["0.5", "0", "u_f", "a*b", "0", "1 + t"],
        ),
        texts(&["-x1*x2", "x0*x2", "0"], &["0.3", "0", "0", "0", "0.3", "0", "0", "0", "0.02"]),
        texts(&["hypot(x0, x1)*exp(-x1)", "sqrt(1 + x0^2)/x1"], &["0", "0"]),
        (lorenz96(9), diagonal(9)),
        (lorenz96(5), full(5)),
    ]
}

fn lorenz96(n: usize) -> Vec<String> {
    let x = |i: usize| format!("x{}", i % n);
    (0..n).map(|i| format!("({} - {})*{} - {} + 8", x(i + 1), x(i + n - 2), x(i + n - 1), x(i))).collect()
}

fn diagonal(n: usize) -> Vec<String> {
    (0..n * n).map(|k| if k % (n + 1) == 0 { "0.1 + a".into() } else { "0".into() }).collect()
}

fn full(n: usize) -> Vec<String> {
    (0..n * n).map(|k| format!("a*{}", 0.1 + (0.7 * k as f64).sin())).collect()
}

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

/// States near one, those of three points side by side.
fn states(n: usize) -> Vec<f64> {
    (0..3 * n).map(|k| 0.3 + (2.7 * k as f64).sin()).collect()
}

fn near(found: &[f64], expected: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), expected.len());
    for (k, (a, b)) in found.iter().zip(expected).enumerate() {
        assert!((a - b).abs() <= tolerance * (1.0 + b.abs()), "{what}, entry {k}: {a} for {b}");
    }
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
fn drift_and_jacobian_of_many_points_are_those_of_one() {
    for (drift, diffusion) in models() {
        let model = model(&drift, &diffusion).unwrap();
        let (n, x) = (model.states(), states(drift.len()));
        let p = model.parameters().to_vec();
        let at = At { t: 1.3, dt: 0.0, u: &[0.9], p: &p };
        let mut scratch = vec![f64::NAN; model.drift_scratch(3)];
        let mut many = vec![0.0; 3 * n];
        model.drift_points(&at, 3, &x, &mut many, &mut scratch);
        let root: Vec<f64> = (0..n * n).map(|k| (1.1 * k as f64).cos()).collect();
        for point in 0..3 {
            let x: Vec<f64> = x.iter().skip(point).step_by(3).copied().collect();
            let mut one = vec![0.0; n];
            model.drift(&at, &x, &mut one);
            let of_many: Vec<f64> = many.iter().skip(point).step_by(3).copied().collect();
            assert_eq!(of_many, one);
            let by = |model: &dyn Fn(Linear<f64>, &mut [f64])| {
                let (mut value, mut image) = (vec![0.0; n], vec![0.0; n * n]);
                let mut scratch = vec![f64::NAN; 1000];
                model(Linear { value: &mut value, image: &mut image, stride: n }, &mut scratch);
                (value, image)
            };
            let symbol = by(&|out, scratch| model.drift_linear(&at, &x, &root, out, scratch));
            let duals = by(&|out, scratch| ByDuals(&model).drift_linear(&at, &x, &root, out, scratch));
            near(&symbol.0, &duals.0, 1e-14, "f");
            near(&symbol.1, &duals.1, 1e-13, "J S");
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
fn what_the_diffusion_depends_on_is_read_from_its_expressions() {
    let varies = |diffusion: &str| model(&["x1", "x0"], &["0", diffusion]).unwrap().diffusion_varies();
    assert_eq!(varies("a*2"), Varies::Never);
    assert_eq!(varies("u_f"), Varies::Never);
    assert_eq!(varies("0"), Varies::Never);
    assert_eq!(varies("u_f*t"), Varies::WithTime);
    assert_eq!(varies("t*x1"), Varies::WithState);
    // what cancels is not there
    assert_eq!(varies("a + x0^0"), Varies::Never);
}

#[test]
fn zero_columns_of_the_diffusion_are_left_out() {
    let model = model(&["x1", "x0"], &["0", "0", "3", "0", "0", "0*2", "a", "t - t + b"]).unwrap();
    assert_eq!(model.noises(), 2);
    let mut g = [0.0; 4];
    model.diffusion(&At { t: 1.5, dt: 0.0, u: &[0.0], p: &[0.7, -0.4] }, &[0.0, 0.0], &mut g);
    assert_eq!(g, [3.0, 0.0, 0.7, -0.4]);
}

#[test]
fn a_diffusion_of_the_state_keeps_its_derivatives_by_duals() {
    let model = model(&["-x0*x1", "sin(x0)"], &["0.1*x0", "0", "0", "sqrt(1 + x1^2)"]).unwrap();
    assert_eq!(model.diffusion_varies(), Varies::WithState);
    let x = states(2);
    assert_eq!(expansion(&model, 0.0, 3, &x), expansion(&ByDuals(&model), 0.0, 3, &x));
}

#[test]
fn what_a_continuous_model_may_not_name_is_refused() {
    let refused = |drift: &str, diffusion: &str| model(&[drift], &[diffusion]).unwrap_err();
    let step = |what| ModelError::Input { what, index: 0, input: Input::Step };
    assert_eq!(refused("dt*x0", "1"), step("the drift"));
    assert_eq!(refused("x0", "sqrt(dt)"), step("the diffusion"));
    let parts = SdeParts { states: 2, noises: 1, ..Default::default() };
    let wrong = ModelSde::new(&mut Graph::new(), parts).unwrap_err();
    assert_eq!(wrong, ModelError::Length { what: "the drift", expected: 2, found: 0 });
    let mut graph = Graph::new();
    let drift = vec![graph.constant(0.0)];
    let parts =
        SdeParts { states: 1, noises: 2, drift: drift.clone(), diffusion: drift, ..Default::default() };
    let wrong = ModelSde::new(&mut graph, parts).unwrap_err();
    assert_eq!(wrong, ModelError::Length { what: "the diffusion", expected: 2, found: 1 });
    assert_ne!(wrong, ModelError::Graph(GraphError::TooLarge));
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

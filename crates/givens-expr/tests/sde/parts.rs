//! Drift and diffusion, and what may stand in them.

use givens_core::model::{At, Linear, Sde, Varies};
use givens_expr::{Graph, Input, ModelError, ModelSde, SdeParts};

use super::{ByDuals, model, models, near, states};

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
}

//! Right model files of continuous models.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use givens_core::model::{At, Sde, Varies};
use givens_expr::ModelSde;
use givens_io::Model;

/// The model of the design page.
const TURN: &str = r#"
[state]
names = ["x", "vx", "y", "vy", "w"]
time  = 0.0
mean  = [1000, 300, 1000, 0, -0.05]
std   = [10, 3.2, 10, 3.2, 0.01]
[parameters]
q1 = 0.16
[let]
a = "w*vx"
per_step = "q1*dt"
[dynamics]
drift     = { x = "vx", vx = "-w*vy", y = "vy", vy = "a", w = 0 }
diffusion = { w = "7e-4", vx = "sqrt(q1)", vy = "sqrt(q1)" }
[[sensor]]
name = "radar"
measures = { range = "sqrt(x^2 + y^2)", bearing = "atan2(y, x)" }
std      = { range = 10, bearing = 0.00316 }
angles   = ["bearing"]
"#;

fn read(text: &str) -> Model {
    Model::parse(text, "m.toml").unwrap_or_else(|errors| panic!("{errors}"))
}

/// [`TURN`] with other lines in [dynamics].
fn with(dynamics: &str) -> Model {
    let (head, tail) = TURN.split_once("drift ").unwrap();
    let sensor = tail.split_once("[[sensor]]").unwrap().1;
    read(&format!("{head}{dynamics}\n[[sensor]]{sensor}"))
}

fn sde(model: &Model) -> &ModelSde {
    model.dynamics.continuous().unwrap()
}

/// Drift and diffusion at a state that tells all components apart.
fn at(model: &Model, t: f64, u: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let sde = sde(model);
    let (mut dx, mut g) = (vec![0.0; 5], vec![0.0; 5 * sde.noises()]);
    let at = At { t, dt: f64::NAN, u, p: sde.parameters() };
    sde.drift(&at, &[1.0, 2.0, 3.0, 4.0, 0.5], &mut dx);
    sde.diffusion(&at, &[1.0, 2.0, 3.0, 4.0, 0.5], &mut g);
    (dx, g)
}

const DRIFT: &str = "drift = [\"vx\", \"-w*vy\", \"vy\", \"a\", 0]";

#[test]
fn the_design_page_is_understood() {
    let model = read(TURN);
    assert!(model.dynamics.discrete().is_none());
    assert_eq!(model.step(), None);
    assert_eq!((sde(&model).noises(), sde(&model).diffusion_varies()), (3, Varies::Never));
    let (dx, g) = at(&model, 0.0, &[]);
    assert_eq!(dx, [2.0, -2.0, 4.0, 1.0, 0.0]);
    let noise = [0.0, 0.0, 0.0, 0.4, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.4, 0.0, 0.0, 0.0, 7e-4];
    assert_eq!(g, noise);
}

#[test]
fn drift_and_diffusion_in_order_are_those_by_name() {
    let (named, listed) =
        (read(TURN), with(&format!("{DRIFT}\ndiffusion = [0, \"sqrt(q1)\", 0, \"sqrt(q1)\", \"7e-4\"]")));
    assert_eq!(at(&named, 0.0, &[]), at(&listed, 0.0, &[]));
}

#[test]
fn all_of_the_diffusion_is_rows_of_any_length() {
    let one = with(&format!("{DRIFT}\ndiffusion = [[0], [\"q1\"], [\"-q1\"], [0], [1]]"));
    assert_eq!(at(&one, 0.0, &[]).1, [0.0, 0.16, -0.16, 0.0, 1.0]);
    let rows = "diffusion = [[0, 0, 0], [1, 0, 2], [0, 0, 0], [0, 0, 3], [0, 0, 0]]";
    let three = with(&format!("{DRIFT}\n{rows}"));
    // the column of zeros is no noise
    assert_eq!((sde(&three).noises(), at(&three, 0.0, &[]).1[2..4].to_vec()), (2, vec![1.0, 2.0]));
    let none = with(&format!("{DRIFT}\ndiffusion = [[], [], [], [], []]"));
    assert_eq!(sde(&none).noises(), 0);
}

#[test]
fn a_diffusion_left_out_is_none() {
    for text in ["", "diffusion = {}", "diffusion = { x = 0 }"] {
        assert_eq!(sde(&with(&format!("{DRIFT}\n{text}"))).noises(), 0, "{text}");
    }
}

#[test]
fn the_diffusion_may_depend_on_time_controls_and_the_state() {
    for (text, varies) in [
        ("u_gust*q1", Varies::Never),
        ("1 + sin(t)^2", Varies::WithTime),
        ("0.1*hypot(vx, vy)", Varies::WithState),
        ("where(x > 0, 1, 2)", Varies::WithState),
    ] {
        let model = with(&format!("{DRIFT}\ndiffusion = {{ vx = \"{text}\" }}"));
        assert_eq!(sde(&model).diffusion_varies(), varies, "{text}");
    }
    let model = with(&format!("{DRIFT}\ndiffusion = {{ vx = \"u_gust*t + w\" }}"));
    assert_eq!(model.controls, ["u_gust"]);
    assert_eq!(at(&model, 3.0, &[2.0]).1, [0.0, 6.5, 0.0, 0.0, 0.0]);
}

#[test]
fn an_overridden_parameter_reaches_drift_and_diffusion() {
    let model = Model::parse_with(TURN, "m.toml", &[("q1", 4.0)]).unwrap();
    assert_eq!(at(&model, 0.0, &[]).1[3], 2.0);
}

//! Right model files of every form.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use givens_core::model::{At, Observation, Transition};
use givens_expr::ModelTransition;
use givens_io::{Model, SettingValue};

/// The turn of the design page, in discrete time.
const TURN: &str = r#"
[state]
names = ["x", "vx", "y", "vy", "w"]
time  = 0.0
mean  = [1000, 300, 1000, 0, -0.05]
std   = [10, 3.2, 10, 3.2, 0.01]
[parameters]
q1 = 0.1
q2 = "q1^2"
[let]
speed = "hypot(vx, vy)"
a = "dt*w"
[dynamics]
transition = { y = "y + dt*vy", vy = "vy + a*vx", x = "x + dt*vx", vx = "vx - a*vy", w = "w" }
noise_cov = [
  ["q1*dt^3/3", "q1*dt^2/2", 0, 0, 0],
  ["dt^2*q1/2", "q1*dt", 0, 0, 0],
  [0, 0, "q1*dt^3/3", "q1*dt^2/2", 0],
  [0, 0, "q1*dt^2/2", "q1*dt", 0],
  [0, 0, 0, 0, "q2*dt"],
]
step = "1/2"
[[sensor]]
name = "radar"
measures = { range = "sqrt(x^2 + y^2)", bearing = "atan2(y, x)" }
std      = { bearing = 0.00316, range = 10 }
angles   = ["bearing"]
[[sensor]]
name = "gps"
measures.x = "x + u_dx"
measures.y = "y"
cov = [[4, "u_s"], ["u_s", 4]]
[plot]
plane = ["y", "x"]
[filter]
method = "sr-ckf"
kappa = -2
rule = "unscented"
fast = true
"#;

fn transition(model: &Model) -> &ModelTransition {
    model.dynamics.discrete().unwrap()
}

#[test]
fn the_design_page_is_understood() {
    let model = Model::parse(TURN, "turn.toml").unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(model.states, ["x", "vx", "y", "vy", "w"]);
    assert_eq!(model.time, Some(0.0));
    assert_eq!(model.prior.mean, [1000.0, 300.0, 1000.0, 0.0, -0.05].map(Some));
    assert!((model.prior.cov[6] - 10.24).abs() < 1e-12);
    assert_eq!(model.parameters[1].0, "q2");
    assert!((model.parameters[1].1 - 0.01).abs() < 1e-15);
    assert_eq!(model.controls, ["u_dx", "u_s"]);
    assert_eq!(model.step(), Some(0.5));
    assert_eq!(model.plane, Some([2, 0]));
    assert_eq!(model.measures(), 4);
    assert_eq!(model.sensors[0].measures, 0..2);
    assert_eq!(model.sensors[1].measures, 2..4);
    assert_eq!(model.sensors[0].columns, ["range", "bearing"]);
    assert_eq!(model.sensors[0].angles, [None, Some(core::f64::consts::TAU)]);
    let (method, place) = model.filter.method.unwrap();
    assert_eq!((method.as_str(), place.place.unwrap().line), ("sr-ckf", 36));
    assert_eq!(model.filter.options[0].value, SettingValue::Number(-2.0));
    assert_eq!(model.filter.options[1].value, SettingValue::Text("unscented".into()));
    assert_eq!(model.filter.options[2].value, SettingValue::Truth(true));
}

#[test]
fn a_transition_by_name_is_put_in_the_order_of_the_states() {
    let model = Model::parse(TURN, "turn.toml").unwrap();
    let p: Vec<f64> = transition(&model).parameters().to_vec();
    let at = At { t: 0.0, dt: 0.5, u: &[0.0, 0.0], p: &p };
    let mut next = [0.0; 5];
    transition(&model).transition(&at, &[1.0, 2.0, 3.0, 4.0, 0.1], &mut next);
    assert_eq!(next, [2.0, 2.0 - 0.2, 5.0, 4.0 + 0.1, 0.1]);
}

#[test]
fn measures_stack_in_file_order_and_controls_reach_them() {
    let model = Model::parse(TURN, "turn.toml").unwrap();
    let p: Vec<f64> = transition(&model).parameters().to_vec();
    let at = At { t: 0.0, dt: 0.0, u: &[7.0, 0.0], p: &p };
    let mut z = [0.0; 4];
    model.observation.observe(&at, &[3.0, 0.0, 4.0, 0.0, 0.0], &mut z);
    assert_eq!(z, [5.0, 4f64.atan2(3.0), 10.0, 4.0]);
}

#[test]
fn an_overridden_parameter_reaches_all_that_depends_on_it() {
    let text = r#"
[state]
names = ["x"]
mean = ["2*m"]
cov = [["s"]]
[parameters]
m = 1
s = "m^2"
[dynamics]
transition = ["x"]
[[sensor]]
name = "a"
measures = { z = "x" }
std = ["s"]
"#;
    let model = Model::parse_with(text, "m.toml", &[("m", 3.0)]).unwrap();
    assert_eq!(model.prior.mean, [Some(6.0)]);
    assert_eq!(model.prior.cov, [9.0]);
    assert_eq!(model.parameters, [("m".to_string(), 3.0), ("s".to_string(), 9.0)]);
    assert_eq!(transition(&model).parameters(), [3.0, 9.0]);
    let wrong = Model::parse_with(text, "m.toml", &[("n", 3.0)]).unwrap_err();
    assert_eq!(
        wrong.to_string(),
        "m.toml: the parameter `n` was set, but the model has none of this name\n  help: it has `m`, `s`"
    );
}

/// A file with `start`, whose tail the tests vary.
fn started(state: &str) -> String {
    format!(
        r#"
[state]
names = ["x", "vx", "y"]
{state}
[let]
range = "hypot(x, y)"
[dynamics]
transition = ["x + dt*vx", "vx", "y"]
[[sensor]]
name = "radar"
measures = {{ range = "range", bearing = "atan2(y, x)" }}
std = [1, 0.1]
angles = {{ bearing = "2*pi" }}
[plot]
plane = ["y", "x"]
"#
    )
}

#[test]
fn start_finds_some_states_and_the_rest_keep_mean_and_std() {
    let text = started(
        "start = { y = \"range*sin(bearing)\", x = \"range*cos(bearing)\" }\nmean = { vx = 5 }\nstd = [2]",
    );
    let model = Model::parse(&text, "m.toml").unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(model.prior.mean, [None, Some(5.0), None]);
    assert_eq!(model.prior.cov, [0.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.0]);
    let start = model.start.as_ref().unwrap();
    assert_eq!((start.states.as_slice(), start.measures.as_slice()), (&[0, 2][..], &[0, 1][..]));
    let (mut found, mut slopes) = ([0.0; 2], [0.0; 4]);
    start.function.evaluate(&At { t: 0.0, dt: 0.0, u: &[], p: &[] }, &[2.0, 0.0], &mut found, &mut slopes);
    assert_eq!(found, [2.0, 0.0]);
    assert_eq!(slopes, [1.0, 0.0, 0.0, 2.0]);
}

#[test]
fn a_measurement_is_placed_in_the_plane_where_start_can() {
    let text =
        started("start = { y = \"range*sin(bearing)\", x = \"range*cos(bearing)\" }\nmean = [5]\nstd = [2]");
    let model = Model::parse(&text, "m.toml").unwrap();
    let table = "time,range,bearing\n0,2,0\n1,2,\n";
    let tracks = givens_io::parse_tracks(table, "d.csv", &model).unwrap();
    let rows = tracks.tracks[0].rows.read(0..usize::MAX).unwrap();
    assert_eq!(model.place(&rows[0]), Some([0.0, 2.0]));
    assert_eq!(model.place(&rows[1]), None);
}

#[test]
fn start_as_a_list_needs_no_mean() {
    let text = started("start = [\"range*cos(bearing)\", \"range\", \"range*sin(bearing)\"]");
    let model = Model::parse(&text, "m.toml").unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(model.prior.mean, [None; 3]);
}

#[test]
fn a_time_of_the_calendar_is_the_zero_of_t() {
    for time in ["2026-03-01T12:00:00Z", "\"2026-03-01T13:00:00+01:00\""] {
        let text =
            started(&format!("time = {time}\nmean = [1, 2, 3]\ncov = [[1, 0, 0], [0, 1, 0], [0, 0, 0]]"));
        let model = Model::parse(&text, "m.toml").unwrap_or_else(|errors| panic!("{errors}"));
        assert_eq!(model.time, Some(0.0));
        assert_eq!(model.epoch.unwrap().to_string(), "2026-03-01T12:00:00Z");
    }
}

#[test]
fn definitions_may_use_each_other_in_any_order() {
    let text = TURN.replace(
        "speed = \"hypot(vx, vy)\"",
        "b = \"a + speed\"\nspeed = \"hypot(vx, vy)\"\nfast = \"speed > 3\"",
    );
    let text = text.replace("w = \"w\" }", "w = \"where(fast, b, w)\" }");
    assert!(Model::parse(&text, "m.toml").is_ok());
}

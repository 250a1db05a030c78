//! `start` with `rate`: two-point differencing.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use givens_core::scalar::Dual2;
use givens_io::{BeginError, Beginning, Model, parse_tracks};

/// A radar in space; position and velocity stand in an order of their own, the turn rate is not seen.
const RADAR: &str = r#"
[state]
names = ["vx", "x", "w", "z", "y", "vz", "vy"]
mean  = { w = 0.02 }
std   = { w = 0.1 }
start = { x = "r*cos(az)*cos(el)", y = "r*sin(az)*cos(el)", z = "r*sin(el) - 10",
          vx = "rate(x)", vy = "rate(y)", vz = "rate( z )" }
[dynamics]
drift = { x = "vx", y = "vy", z = "vz", vx = "-w*vy", vy = "w*vx", vz = 0, w = 0 }
[[sensor]]
name     = "radar"
measures = { r = "sqrt(x^2 + y^2 + z^2)", az = "atan2(y, x)", el = "atan2(z, hypot(x, y))" }
cov      = [[2500, "0.01", 0], ["0.01", 4e-6, 0], [0, 0, 4e-6]]
angles   = ["az"]
[[sensor]]
name     = "altimeter"
measures = { height = "z" }
std      = [5]
[plot]
plane = ["x", "y"]
"#;

fn model(text: &str) -> Model {
    Model::parse(text, "m.toml").unwrap_or_else(|errors| panic!("{errors}"))
}

fn begin(model: &Model, table: &str) -> Result<Beginning, BeginError> {
    let tracks = parse_tracks(table, "d.csv", model).unwrap_or_else(|errors| panic!("{errors}"));
    model.begin(&tracks.tracks[0])
}

/// Position of a radar return, and its derivatives along range, azimuth and elevation, 3 × 3.
fn position(z: [f64; 3]) -> ([f64; 3], [[f64; 3]; 3]) {
    let (mut value, mut slopes) = ([0.0; 3], [[0.0; 3]; 3]);
    for j in 0..3 {
        let [r, az, el] = [0, 1, 2].map(|i| Dual2::along(z[i], if i == j { 1.0 } else { 0.0 }));
        let ((s, c), (up, flat)) = (dual_turn(az), dual_turn(el));
        for (i, x) in [r * c * flat, r * s * flat, r * up - Dual2::constant(10.0)].into_iter().enumerate() {
            (value[i], slopes[i][j]) = (x.v, x.d);
        }
    }
    (value, slopes)
}

fn dual_turn(x: Dual2<f64>) -> (Dual2<f64>, Dual2<f64>) {
    use givens_core::scalar::Real;
    (x.sin(), x.cos())
}

/// J R Jᵀ.
fn covariance(slopes: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let r = [[2500.0, 0.01, 0.0], [0.01, 4e-6, 0.0], [0.0, 0.0, 4e-6]];
    let mut out = [[0.0; 3]; 3];
    for (i, row) in out.iter_mut().enumerate() {
        for (j, sum) in row.iter_mut().enumerate() {
            for (a, r) in r.iter().enumerate() {
                for (b, r) in r.iter().enumerate() {
                    *sum += slopes[i][a] * r * slopes[j][b];
                }
            }
        }
    }
    out
}

#[test]
fn position_and_velocity_have_the_covariance_of_two_point_differencing() {
    let model = model(RADAR);
    let start = model.start.as_ref().unwrap();
    assert_eq!((start.two_rows, start.measures.as_slice()), (true, &[0, 1, 2][..]));
    // rows without the radar, before and between, do not count
    let table =
        "time,r,az,el,height\n0,,,,3\n1,5000,0.7,0.1,\n2,5100,,,\n3.5,5200,0.75,0.11,9\n4,5300,0.8,0.12,\n";
    let found = begin(&model, table).unwrap();
    assert_eq!((found.time, found.row, found.started), (3.5, 3, true));
    let (c0, j0) = position([5000.0, 0.7, 0.1]);
    let (c1, j1) = position([5200.0, 0.75, 0.11]);
    let (r0, r1, gap) = (covariance(&j0), covariance(&j1), 2.5);
    let (at, speed, turn) = ([1, 4, 3], [0, 6, 5], 2);
    let cov = |i: usize, j: usize| found.prior.cov()[i * 7 + j];
    let near = |found: f64, expected: f64, what: &str| {
        assert!((found - expected).abs() <= 1e-9 * (1.0 + expected.abs()), "{what}: {found} for {expected}");
    };
    assert_eq!(found.prior.mean()[turn], 0.02);
    near(cov(turn, turn), 0.01, "turn");
    for i in 0..3 {
        near(found.prior.mean()[at[i]], c1[i], "position");
        near(found.prior.mean()[speed[i]], (c1[i] - c0[i]) / gap, "velocity");
        near(cov(turn, at[i]), 0.0, "turn and position");
        near(cov(turn, speed[i]), 0.0, "turn and velocity");
        for j in 0..3 {
            near(cov(at[i], at[j]), r1[i][j], "positions");
            near(cov(at[i], speed[j]), r1[i][j] / gap, "position and velocity");
            near(cov(speed[i], speed[j]), (r0[i][j] + r1[i][j]) / (gap * gap), "velocities");
        }
    }
}

#[test]
fn a_measurement_is_still_placed_from_one_row() {
    let model = model(RADAR);
    let tracks = parse_tracks("time,r,az,el\n0,2,0,0\n", "d.csv", &model).unwrap();
    assert_eq!(model.place(tracks.tracks[0].rows.first().unwrap()), Some([2.0, 0.0]));
    let rates = crate::model(&RADAR.replace("[\"x\", \"y\"]\n", "[\"x\", \"vx\"]\n"));
    assert_eq!(rates.place(tracks.tracks[0].rows.first().unwrap()), None);
}

/// A discrete model on a line whose tail the tests vary.
fn line(start: &str, sensor: &str) -> Model {
    model(&format!(
        "[state]\nnames = [\"x\", \"v\"]\nstart = {start}\n[parameters]\nrate = 2\n[dynamics]\n\
         transition = [\"x + dt*v\", \"v\"]\n[[sensor]]\nname = \"a\"\n{sensor}\n"
    ))
}

#[test]
fn time_controls_and_noise_are_those_of_each_row() {
    let model = line(
        "{ x = \"rate*p + u_a*t\", v = \"rate(x)\" }",
        "measures = { p = \"x\" }\nstd = { p = \"1 + t + u_a\" }",
    );
    let found = begin(&model, "time,p,u_a\n1,10,3\n3,20,5\n").unwrap();
    // c = 2 p + u t: 23 and 55; stds of p: 5 and 9
    assert_eq!(found.prior.mean(), [55.0, 16.0]);
    let [var, _, cross, rate] = *found.prior.cov() else { panic!() };
    assert!((var - 324.0).abs() < 1e-9 && (cross - 162.0).abs() < 1e-9, "{var} {cross}");
    assert!((rate - (100.0 + 324.0) / 4.0).abs() < 1e-9, "{rate}");
}

#[test]
fn a_rate_may_be_part_of_an_expression() {
    let model = line("{ x = \"p\", v = \"rate(x)/3.6 + rate\" }", "measures = { p = \"x\" }\nstd = [1]");
    assert_eq!(begin(&model, "time,p\n1,10\n3,46\n").unwrap().prior.mean(), [46.0, 7.0]);
}

#[test]
fn the_rate_of_an_angle_does_not_see_where_its_period_ends() {
    let angle = |first: f64, second: f64| {
        let sensor = "measures = { p = \"x\" }\nstd = [1]\nangles = { p = 360 }";
        let model = line("{ x = \"p\", v = \"rate(x)\" }", sensor);
        begin(&model, &format!("time,p\n0,{first}\n2,{second}\n")).unwrap().prior.mean().to_vec()
    };
    assert_eq!(angle(358.0, 2.0), [2.0, 2.0]);
    assert_eq!(angle(2.0, 358.0), [358.0, -2.0]);
    assert_eq!(angle(10.0, 180.0), [180.0, 85.0]);
}

#[test]
fn a_track_without_two_rows_is_told() {
    let model = line("{ x = \"p\", v = \"rate(x)\" }", "measures = { p = \"x\", q = \"x\" }\nstd = [1, 1]");
    let told = |table: &str| {
        let error = begin(&model, table).unwrap_err();
        (error.line, error.message)
    };
    let one = "only one row has, where `rate` needs two, all that `start` reads: p";
    assert_eq!(told("time,p,q\n1,,4\n2,3,\n3,,3\n"), (None, one.into()));
    assert_eq!(told("time,p,q\n1,,4\n"), (None, "no row has all that `start` reads: p".into()));
}

#[test]
fn two_rows_at_one_time_are_told() {
    let model = line(
        "{ x = \"p\", v = \"rate(x)\" }",
        "measures = { p = \"x\" }\nstd = [1]\n[[sensor]]\nname = \"b\"\nmeasures = { q = \"x\" }\nstd = [1]",
    );
    let error = begin(&model, "time,sensor,p,q\n1,a,3,\n1,,4,\n2,b,,4\n").unwrap_err();
    assert_eq!(error.line, Some(3));
    assert_eq!(error.message, "`rate` needs two times, but this row and that of line 2 are at one");
}

#[test]
fn a_rate_that_is_no_number_is_told_with_its_row() {
    let model = line("{ x = \"sqrt(p)\", v = \"rate(x)\" }", "measures = { p = \"x\" }\nstd = [1]");
    let error = begin(&model, "time,p\n1,-4\n3,4\n").unwrap_err();
    assert_eq!(
        error.to_string().split(" (").next().unwrap(),
        "line 3: `start` finds no finite `v` from this row and the one before it"
    );
}

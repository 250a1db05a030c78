//! Any method of the registry with any options, its steps few.

use crate::bytes::Bytes;
use givens::ode::Steps;
use givens::registry::{Choice, ENTRIES, Kind, Setting, Value, resolve};

/// Options with some of their values, wrong ones among them.
const SETTINGS: &[(&str, &[&str])] = &[
    ("rule", &["cubature3", "cubature5", "unscented", "gauss-hermite", "central-difference", "taylor"]),
    ("form", &["covariance", "square-root"]),
    ("update", &["joint", "separate"]),
    ("time_update", &["transition", "ito-taylor", "euler-maruyama", "moment-ode", "level-set"]),
    ("variant", &["full", "simplified", "noise-once"]),
    ("gauge", &["free", "triangular"]),
    ("root", &["lower", "moved"]),
    ("velocity", &["standard", "averaged-printed", "averaged", "partial", "partial-printed", "cubature"]),
    ("solver", &["euler", "rk2", "rk4", "dp5", "rodas4"]),
    ("substeps", &["1", "2", "5", "0", "1e9", "1.5"]),
    ("max_step", &["0.5", "0.1", "0", "1e-300", "-1", "1e300"]),
    ("rtol", &["1e-3", "1e-9", "0", "1e-300", "1e300"]),
    ("atol", &["1e-3", "1e300", "0"]),
    ("precision", &["f64", "f32"]),
    ("gate", &["0.9999", "0.5", "1e-300", "0", "1", "0.9999999999999999"]),
    ("alpha", &["0.001", "1", "0", "1e-9", "1e200"]),
    ("beta", &["2", "-5", "1e300", "-1e300"]),
    ("kappa", &["0", "1", "-2.5", "-3", "1e9", "1e300"]),
    ("eta", &["1", "1.7320508075688772", "1e9", "0.5"]),
    ("points", &["2", "3", "4", "5", "1", "64", "2.5"]),
];

/// A method and up to three settings; none where they do not go together. Its gaps take few steps.
pub(crate) fn method(bytes: &mut Bytes, kind: Kind, states: usize) -> Option<Choice> {
    let of_kind: Vec<_> = ENTRIES.iter().filter(|entry| entry.kind() == kind).collect();
    let entry = match bytes.byte() {
        // a method of the other kind is refused where it is used
        255 => &ENTRIES[bytes.below(ENTRIES.len())],
        byte => of_kind[usize::from(byte) % of_kind.len()],
    };
    let settings: Vec<Setting> = (0..bytes.below(4)).map(|_| setting(bytes)).collect();
    let choice = match resolve(entry.name, &settings) {
        Ok(choice) => choice,
        Err(error) => {
            assert!(!error.to_string().is_empty() && error.setting.is_none_or(|at| at < settings.len()));
            // what does not fit is left out, so that few inputs are wasted
            resolve(entry.name, &settings[..error.setting.unwrap_or(0)]).ok()?
        }
    };
    assert!(!choice.title().is_empty());
    few_steps(choice, states)
}

fn setting(bytes: &mut Bytes) -> Setting {
    let (key, values) = SETTINGS[bytes.below(SETTINGS.len())];
    let value = match bytes.byte() {
        255 => Value::Number(bytes.number()),
        byte => Value::from(values[usize::from(byte) % values.len()]),
    };
    Setting { key: key.to_owned(), value }
}

/// The method with gaps of few steps; none where its points are many.
pub(crate) fn few_steps(mut choice: Choice, states: usize) -> Option<Choice> {
    choice.integrator.limit = 60;
    if let Steps::Count(count) = choice.integrator.steps {
        choice.integrator.steps = Steps::Count(count.min(6));
    }
    let points = choice.gauss_hermite.points as f64;
    (points.powi(states as i32) <= 300.0).then_some(choice)
}

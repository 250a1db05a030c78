//! A method's name and settings, as they are typed: a line each, the name first.

use givens::registry::{Kind, Setting, Value, resolve};

/// What they are made of.
pub(crate) const WORDS: &[&str] = &[
    "sr-ckf\n",
    "ckf\n",
    "sr-ukf\n",
    "ukf\n",
    "qkf\n",
    "cdkf\n",
    "ekf\n",
    "cd-ckf\n",
    "sr-cd-ckf\n",
    "cd-ekf\n",
    "lskf\n",
    "acd-ekf\n",
    "rule=",
    "form=",
    "update=",
    "time_update=",
    "variant=",
    "gauge=",
    "root=",
    "velocity=",
    "solver=",
    "substeps=",
    "max_step=",
    "rtol=",
    "atol=",
    "precision=",
    "gate=",
    "alpha=",
    "beta=",
    "kappa=",
    "eta=",
    "points=",
    "cubature3",
    "cubature5",
    "unscented",
    "gauss-hermite",
    "central-difference",
    "taylor",
    "covariance",
    "square-root",
    "joint",
    "separate",
    "transition",
    "ito-taylor",
    "euler-maruyama",
    "moment-ode",
    "level-set",
    "dp5",
    "rodas4",
    "rk4",
    "f32",
    "f64",
    "0",
    "1",
    "-1",
    "0.9999",
    "1e-9",
    "1e9",
    "1e308",
    "nan",
    "inf",
    "64",
    "100000",
    "\n",
    " ",
    "é",
];

pub(crate) fn body(data: &[u8]) {
    let text = &*String::from_utf8_lossy(data);
    let mut lines = text.lines();
    let method = lines.next().unwrap_or("");
    let read = |line: &str| {
        let (key, value) = line.split_once('=').unwrap_or((line, ""));
        Setting { key: key.trim().to_owned(), value: Value::from(value) }
    };
    let settings: Vec<Setting> = lines.map(read).collect();
    let choice = match resolve(method, &settings) {
        Ok(choice) => choice,
        Err(error) => {
            assert!(error.setting.is_none_or(|at| at < settings.len()));
            assert!(!error.message.is_empty() && !error.to_string().is_empty());
            return;
        }
    };
    assert!(choice.title().starts_with(choice.name));
    assert!(choice.serves(choice.kind()).is_ok());
    for kind in [Kind::Discrete, Kind::Continuous] {
        if let Err(error) = choice.serves(kind) {
            assert!(!error.to_string().is_empty());
        }
    }
    for states in [0, 1, 2, 7, 1000, usize::MAX] {
        if let Err(error) = choice.check(states) {
            assert!(!error.option.is_empty() && !error.to_string().is_empty());
        }
    }
    if choice.check(2).is_ok() {
        again(method, &settings, &choice);
    }
}

/// What a choice says of its time update is what it may be told.
fn again(method: &str, settings: &[Setting], choice: &givens::registry::Choice) {
    let told = choice.time_options();
    let keys: Vec<&str> = told.iter().map(|(key, _)| *key).collect();
    let others = settings.iter().filter(|setting| !keys.contains(&setting.key.as_str())).cloned();
    let set = told
        .iter()
        .map(|(key, value)| Setting { key: (*key).to_owned(), value: Value::from(value.as_str()) });
    let again = resolve(method, &others.chain(set).collect::<Vec<_>>());
    assert_eq!(again.as_ref(), Ok(choice));
}

//! The text of a model file: refused with places, or a model that begins and runs.

use crate::{method, promise};
use givens::registry::{Choice, Kind, Setting, Value, default_method, resolve};
use givens::{Data, Goal, Outcome};
use givens_io::{Dynamics, Model, SettingValue, Track, parse_tracks};
use std::fmt::Write;

/// What model files are made of.
pub(crate) const WORDS: &[&str] = &[
    "[state]\n",
    "names = [\"x\", \"vx\"]\n",
    "mean = [0, 1]\n",
    "std = { x = 1, vx = 2 }\n",
    "cov = [[1, 0], [0, 1]]\n",
    "start = { x = \"r\", vx = \"rate(x)\" }\n",
    "time = 0\n",
    "time = 2026-03-01T00:00:00Z\n",
    "[parameters]\n",
    "q = 0.1\n",
    "[let]\n",
    "a = \"x + b\"\n",
    "[dynamics]\n",
    "transition = [\"x + dt*vx\", \"vx\"]\n",
    "noise_cov = [[\"q*dt\", 0], [0, \"q\"]]\n",
    "step = 0.5\n",
    "drift = { x = \"vx\", vx = \"-x\" }\n",
    "diffusion = { vx = \"q\" }\n",
    "diffusion = [[0], [\"q\"]]\n",
    "[[sensor]]\n",
    "name = \"radar\"\n",
    "measures = { r = \"hypot(x, vx)\" }\n",
    "std = [1]\n",
    "cov = [[1]]\n",
    "angles = { r = 360 }\n",
    "angles = [\"r\"]\n",
    "[plot]\n",
    "plane = [\"x\", \"vx\"]\n",
    "[filter]\n",
    "method = \"sr-ckf\"\n",
    "method = \"cd-ckf\"\n",
    "rule = \"unscented\"\n",
    "substeps = 3\n",
    "precision = \"f32\"\n",
    "gate = 0.99\n",
    "rate(x)",
    "u_a",
    "dt",
    "\"",
    "'",
    "[",
    "]",
    "{",
    "}",
    ",",
    "=",
    "\n",
    "\r",
    ".",
    "-",
    "1e999",
    "nan",
    "inf",
    "π",
    "\\",
    "\\u0041",
    "\u{feff}",
    "\"\"\"",
    "((((",
    "[[",
    "]]",
    "# ",
    "0",
    "1e-320",
    "9999999999999999999999",
    "0x1F",
    "where(x > 0, 1, vx)",
    "atan2(vx, x)",
    "sqrt(",
    "x^0.5",
    "true",
    "\t",
    "\u{0}",
];

pub(crate) fn body(data: &[u8]) {
    let text = &*String::from_utf8_lossy(data);
    match Model::parse(text, "m.toml") {
        Err(errors) => promise::well_placed(text, &errors),
        Ok(model) => {
            assert!(model.again_with(&[]).is_ok(), "a model that was read is not read again");
            follow(&model);
        }
    }
}

/// Rows that the model may be given, and what becomes of them.
fn follow(model: &Model) {
    assert!(!model.states.is_empty() && model.measures() > 0);
    let table = table(model);
    let tracks = match parse_tracks(&table, "d.csv", model) {
        Ok(tracks) => tracks,
        Err(errors) => return promise::well_placed(&table, &errors),
    };
    for track in &tracks.tracks {
        for row in track.rows.iter().map(Result::unwrap) {
            assert!(model.place(&row).is_none_or(|place| place.iter().all(|x| x.is_finite())));
        }
        run(model, track, Goal::Interval);
    }
}

/// A table of four rows with all that the model has.
fn table(model: &Model) -> String {
    let mut columns: Vec<&str> =
        model.sensors.iter().flat_map(|sensor| &sensor.columns).map(String::as_str).collect();
    columns.sort_unstable();
    columns.dedup();
    columns.extend(model.controls.iter().map(String::as_str));
    let mut table = format!("time,sensor,{}\n", columns.join(","));
    let start = model.time.unwrap_or(0.0);
    for k in 0..4 {
        let time = start + f64::from(k) * model.step().unwrap_or(0.5);
        let sensor = &model.sensors[k as usize % model.sensors.len()];
        let _ = write!(table, "{time:?},\"{}\"", sensor.name.replace('"', "\"\""));
        for column in &columns {
            let own =
                sensor.columns.iter().any(|own| own == column) || model.controls.iter().any(|u| u == column);
            let _ = if own { write!(table, ",{}", 0.3 * f64::from(k + 1)) } else { write!(table, ",") };
        }
        table.push('\n');
    }
    table
}

/// The track from its beginning, by the method of the file; none where it does not begin, or where that is large.
pub(crate) fn run(model: &Model, track: &Track, goal: Goal) -> Option<(usize, Outcome)> {
    let begin = match model.begin(track) {
        Ok(begin) => begin,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return None;
        }
    };
    let (n, d) = (model.states.len(), model.measures());
    if n > 8 || d > 8 {
        return None;
    }
    let kind =
        if matches!(model.dynamics, Dynamics::Continuous(_)) { Kind::Continuous } else { Kind::Discrete };
    let choice = chosen(model, kind).and_then(|choice| method::few_steps(choice, n))?;
    let mut data = Data::with_controls(d, model.controls.len()).starting_at(begin.time);
    for row in track.rows.iter().skip(begin.row + usize::from(begin.started)).map(Result::unwrap) {
        data.push_controlled(row.time, &row.z, &row.u).expect("a table's rows stand in order");
        if model.step().is_some_and(|step| (row.time - begin.time) / step > 1000.0) {
            return None;
        }
    }
    let (rows, t0, prior) = (data.rows(), data.start(), &begin.prior);
    let outcome = match &model.dynamics {
        Dynamics::Discrete(of) => choice.run(of, &model.observation, rows, t0, prior, goal, &[]),
        Dynamics::Continuous(of) => choice.run_continuous(of, &model.observation, rows, t0, prior, goal, &[]),
    };
    promise::kept(&outcome, data.len(), &choice);
    Some((begin.row, outcome))
}

/// The method that the file names; none where it is refused.
fn chosen(model: &Model, kind: Kind) -> Option<Choice> {
    let named = model.filter.method.as_ref().map_or(default_method(kind), |(name, _)| name);
    let setting = |setting: &givens_io::Setting| Setting {
        key: setting.key.clone(),
        value: match &setting.value {
            SettingValue::Text(text) => Value::Word(text.clone()),
            SettingValue::Number(x) => Value::Number(*x),
            SettingValue::Truth(truth) => Value::Word(truth.to_string()),
        },
    };
    let settings: Vec<Setting> = model.filter.options.iter().map(setting).collect();
    match resolve(named, &settings) {
        Ok(choice) => choice.serves(kind).is_ok().then_some(choice),
        Err(error) => {
            assert!(!error.to_string().is_empty());
            resolve(default_method(kind), &[]).ok()
        }
    }
}

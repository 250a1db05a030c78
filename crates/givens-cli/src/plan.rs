//! From what the user typed to a checked plan: every input is read and judged before anything runs.

use crate::args::{FilterArgs, MethodArgs, ModelArgs};
use crate::message::{Stop, say};
use givens::Goal;
use givens::registry::{Choice, Setting, SettingError, Value, resolve};
use givens_expr::suggest;
use givens_io::{
    Beginning, InputError, Location, Model, SettingValue, Tracks, Truth, read_tracks, read_truth,
};

/// The method where neither the file nor the command line names one: the best of this version, not the oldest.
const DEFAULT: &str = "sr-ckf";

/// Everything that a run over data needs, read and checked.
pub struct Plan {
    pub model: Model,
    pub data: String,
    pub tracks: Tracks,
    /// Where each track begins.
    pub beginnings: Vec<Beginning>,
    pub choice: Choice,
    pub truth: Option<Truth>,
}

impl Plan {
    pub fn new(args: &FilterArgs) -> Result<Self, Stop> {
        let model = model(&args.model)?;
        let choice = choose(&model, args.method.method.as_deref(), &settings(&args.method)?)?;
        Self::with(model, choice, &args.data, args.truth.as_deref())
    }

    pub fn with(model: Model, choice: Choice, data: &str, truth: Option<&str>) -> Result<Self, Stop> {
        let tracks = read_tracks(data, &model)?;
        if !tracks.ignored.is_empty() {
            say(&format!("{data}: columns not used by the model: {}", tracks.ignored.join(", ")));
        }
        let beginnings = tracks.tracks.iter().map(|track| {
            let name = track.id.as_ref().map_or(String::new(), |id| format!(" track {id}:"));
            model.begin(track).map_err(|error| Stop::input(format!("{data}:{name} {error}")))
        });
        let beginnings = beginnings.collect::<Result<_, _>>()?;
        let truth = truth.map(|path| read_truth(path, &model, &tracks)).transpose()?;
        Ok(Self { model, data: data.to_owned(), tracks, beginnings, choice, truth })
    }

    /// The time at which `--point` stands on the axis of each track.
    pub fn points(&self, text: &str) -> Result<Vec<Goal>, Stop> {
        let point = |(track, begin): (&givens_io::Track, &Beginning)| {
            let t = track.parse_time(text).map_err(|error| Stop::input(format!("--point: {error}")))?;
            let rows = &track.rows[begin.row..];
            if t == begin.time || rows.iter().any(|row| row.time == t) {
                return Ok(Goal::Point(t));
            }
            let near = rows.iter().min_by(|a, b| (a.time - t).abs().total_cmp(&(b.time - t).abs()));
            let near = near.map_or(String::new(), |row| format!("; the nearest row is at {}", row.time_text));
            let name = track.id.as_ref().map_or(String::new(), |id| format!(" of track {id}"));
            Err(Stop::input(format!(
                "--point {text}: neither a row{name} nor the initial belief stands at this time{near}"
            )))
        };
        self.tracks.tracks.iter().zip(&self.beginnings).map(point).collect()
    }
}

/// Reads the model file with the parameters of the command line.
pub fn model(args: &ModelArgs) -> Result<Model, Stop> {
    let mut params = Vec::new();
    for text in &args.params {
        let (name, value) = pair("--param", text)?;
        let value: f64 = value
            .parse()
            .ok()
            .filter(|value: &f64| value.is_finite())
            .ok_or_else(|| Stop::input(format!("--param {text}: `{value}` is not a finite number")))?;
        params.push((name, value));
    }
    Ok(Model::read_with(&args.model, &params)?)
}

/// KEY=VALUE.
fn pair<'a>(option: &str, text: &'a str) -> Result<(&'a str, &'a str), Stop> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() && !value.trim().is_empty() => {
            Ok((key.trim(), value.trim()))
        }
        _ => Err(Stop::input(format!("{option} {text}: write it as name=value"))),
    }
}

/// The settings of the command line.
pub fn settings(args: &MethodArgs) -> Result<Vec<Setting>, Stop> {
    args.settings.iter().map(|text| setting(text)).collect()
}

/// One setting of the command line.
pub fn setting(text: &str) -> Result<Setting, Stop> {
    let (key, value) = pair("--set", text)?;
    Ok(Setting { key: key.to_owned(), value: Value::from(value) })
}

/// The method: `named` on the command line, or that of the file; with the settings of both. Of the file's settings,
/// those that do not fit a method named on the command line are dropped, and that is said.
pub fn choose(model: &Model, named: Option<&str>, own: &[Setting]) -> Result<Choice, Stop> {
    let file = &model.filter;
    let method = named.or(file.method.as_ref().map(|(name, _)| name.as_str())).unwrap_or(DEFAULT);
    let mut settings: Vec<(Setting, Option<&Location>)> = Vec::new();
    let part = |key: &str| matches!(key, "rule" | "form" | "time_update");
    for setting in &file.options {
        if named.is_some() && part(&setting.key) {
            say(&dropped(model, &setting.key, method));
            continue;
        }
        let value = match &setting.value {
            SettingValue::Text(text) => Value::Word(text.clone()),
            SettingValue::Number(x) => Value::Number(*x),
            SettingValue::Truth(truth) => Value::Word(truth.to_string()),
        };
        settings.push((Setting { key: setting.key.clone(), value }, Some(&setting.location)));
    }
    settings.extend(own.iter().map(|setting| (setting.clone(), None)));
    loop {
        let plain: Vec<Setting> = settings.iter().map(|(setting, _)| setting.clone()).collect();
        let error = match resolve(method, &plain) {
            Ok(choice) => {
                choice.check(model.states.len()).map_err(|error| Stop::input(error.to_string()))?;
                return Ok(choice);
            }
            Err(error) => error,
        };
        let Some(at) = error.setting else {
            let location = file.method.as_ref().filter(|_| named.is_none()).map(|(_, location)| location);
            return Err(refused(&error, location, named.map(|name| format!("--method {name}"))));
        };
        let (setting, location) = &settings[at];
        if location.is_some() && named.is_some() && error.unread {
            say(&dropped(model, &setting.key, method));
            settings.remove(at);
        } else {
            return Err(refused(&error, *location, Some(format!("--set {}={}", setting.key, setting.value))));
        }
    }
}

fn dropped(model: &Model, key: &str, method: &str) -> String {
    format!("{}: `{key}` of [filter] does not go with {method}: left out", model.file)
}

/// A refusal at its place: in the file, or in an option of the command line.
fn refused(error: &SettingError, location: Option<&Location>, option: Option<String>) -> Stop {
    let nearest = |(word, known): &(String, Vec<&'static str>)| match suggest(word, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("one of: {}", known.join(", ")),
    };
    let help = error.help.clone().or_else(|| error.unknown.as_ref().map(nearest));
    if let Some(location) = location {
        let told = location.error(&error.message);
        return Stop::input(InputError { help, ..told }.to_string());
    }
    let option = option.map_or(String::new(), |option| format!("{option}: "));
    let help = help.map_or(String::new(), |help| format!("\n  help: {help}"));
    Stop::input(format!("{option}{}{help}", error.message))
}

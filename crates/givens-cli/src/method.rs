//! The method of a run: its name and the settings beside it, from the command line and the model file.

use crate::args::MethodArgs;
use crate::message::{Stop, say};
use givens::filter::Fault;
use givens::registry::{
    Choice, FormName, Kind, Precision, RuleName, Setting, SettingError, TimeName, Value, default_method,
    find, resolve,
};
use givens::scalar::Shown;
use givens_expr::suggest;
use givens_io::{Dynamics, Location, Model, SettingValue};

/// A method's name from the command line, and the option that brought it.
#[derive(Clone, Copy)]
pub struct Named<'a> {
    pub option: &'static str,
    pub name: &'a str,
}

/// A setting of the command line, and how it was typed.
#[derive(Clone)]
pub struct Typed {
    pub text: String,
    pub setting: Setting,
}

/// Where a setting came from.
#[derive(Clone)]
enum Source<'a> {
    File(&'a Location),
    Line(String),
}

type Sourced<'a> = (Setting, Source<'a>);

/// The method that the arguments ask for.
pub fn chosen(model: &Model, args: &MethodArgs) -> Result<Choice, Stop> {
    let own = args.settings.iter().map(|text| setting(text)).collect::<Result<Vec<_>, _>>()?;
    let named = args.method.as_deref().map(|name| Named { option: "--method", name });
    choose(model, named, &own)
}

/// KEY=VALUE.
pub fn pair<'a>(option: &str, text: &'a str) -> Result<(&'a str, &'a str), Stop> {
    match text.split_once('=') {
        Some((_, value)) if value.contains('=') => {
            let each: Vec<_> = text.split(',').map(|one| format!("{option} {}", one.trim())).collect();
            Err(Stop::input(format!("{option} {text}: one at a time"))
                .help(format!("write {}", each.join(" "))))
        }
        Some((key, value)) if !key.trim().is_empty() && !value.trim().is_empty() => {
            Ok((key.trim(), value.trim()))
        }
        _ => Err(Stop::input(format!("{option} {text}: write it as name=value"))),
    }
}

/// One setting of the command line.
pub fn setting(text: &str) -> Result<Typed, Stop> {
    let (key, value) = pair("--set", text)?;
    if key == "method" {
        let stop = Stop::input(format!("--set {text}: the method is no option of itself"));
        return Err(stop.help(format!("write --method {value}, or --methods {value},… to compare")));
    }
    Ok(Typed { text: text.to_owned(), setting: Setting { key: key.to_owned(), value: Value::from(value) } })
}

/// The method: `named` on the command line, or that of the file; with the settings of both. Of the file's settings,
/// those that do not fit a method named on the command line are dropped, and that is said.
pub fn choose(model: &Model, named: Option<Named>, own: &[Typed]) -> Result<Choice, Stop> {
    let file = &model.filter;
    let of_file = file.method.as_ref().map(|(name, _)| name.as_str());
    let method = named.map(|named| named.name).or(of_file).unwrap_or(default_method(kind(model)));
    let mut settings = of_the_file(model, named);
    settings.extend(own.iter().map(|own| (own.setting.clone(), Source::Line(format!("--set {}", own.text)))));
    loop {
        let plain: Vec<Setting> = settings.iter().map(|(setting, _)| setting.clone()).collect();
        let error = match resolve(method, &plain) {
            Ok(choice) => match choice.serves(kind(model)) {
                Ok(()) => return in_range(model, choice, &settings),
                Err(error) => error,
            },
            Err(error) => error,
        };
        let Some(at) = error.setting else {
            let source = match (named, &file.method) {
                (None, Some((_, location))) => Source::File(location),
                (None, None) => Source::Line("the default".to_owned()),
                (Some(named), _) => Source::Line(format!("{} {}", named.option, named.name)),
            };
            return Err(refused(&error, &error.message, &source));
        };
        match (&settings[at], named) {
            ((setting, Source::File(location)), Some(_)) if error.unread => {
                say(&dropped(location, &setting.key, method));
                settings.remove(at);
            }
            ((setting, source), _) => {
                // where it was typed, the setting stands before the message already
                let own = format!("{} = {}: ", setting.key, setting.value);
                let message = match source {
                    Source::Line(_) => error.message.strip_prefix(&own).unwrap_or(&error.message),
                    Source::File(_) => &error.message,
                };
                return Err(refused(&error, message, source));
            }
        }
    }
}

/// The settings of `[filter]`. The rule, the form and the time update are those of a method named on the command line.
fn of_the_file<'m>(model: &'m Model, named: Option<Named>) -> Vec<Sourced<'m>> {
    let mut settings = Vec::new();
    for setting in &model.filter.options {
        let value = match &setting.value {
            SettingValue::Text(text) => Value::Word(text.clone()),
            SettingValue::Number(x) => Value::Number(*x),
            SettingValue::Truth(truth) => Value::Word(truth.to_string()),
        };
        if let Some(entry) = named.and_then(|named| find(named.name)) {
            let own = match setting.key.as_str() {
                "rule" => Some(entry.rule.word()),
                "form" => Some(entry.form.word()),
                "time_update" => Some(entry.time_update.word()),
                _ => None,
            };
            if let Some(own) = own {
                if value.to_string() != own {
                    say(&dropped(&setting.location, &setting.key, entry.name));
                }
                continue;
            }
        }
        settings.push((Setting { key: setting.key.clone(), value }, Source::File(&setting.location)));
    }
    settings
}

/// The choice, if its options are in their ranges for this model.
fn in_range(model: &Model, choice: Choice, settings: &[Sourced]) -> Result<Choice, Stop> {
    let Err(error) = choice.check(model.states.len()) else { return for_model(model, choice) };
    let help = error.must.contains("(n:").then(|| format!("the model has n = {}", model.states.len()));
    let found = settings.iter().rev().find(|(setting, _)| setting.key == error.option);
    let stop = match found {
        Some((_, Source::File(location))) => Stop::input(location.error(error.to_string()).to_string()),
        Some((_, Source::Line(typed))) => Stop::input(format!("{typed}: {}", error.must)),
        None => Stop::input(format!("{}: {error}", choice.name)),
    };
    Err(match help {
        Some(help) => stop.help(help),
        None => stop,
    })
}

/// The choice, if its time update serves this model.
fn for_model(model: &Model, choice: Choice) -> Result<Choice, Stop> {
    let Dynamics::Continuous(sde) = &model.dynamics else { return Ok(choice) };
    match choice.check_continuous(sde) {
        Ok(()) => Ok(choice),
        Err(fault) => {
            let stop = Stop::input(format!("{}: {}: {fault}", model.file, choice.name));
            Err(match fault {
                Fault::StateDependentDiffusion => stop.help("write --method sr-cd-ckf2, or set time_update"),
                _ => stop,
            })
        }
    }
}

fn dropped(location: &Location, key: &str, method: &str) -> String {
    let line = location.place.as_ref().map_or(String::new(), |place| format!(":{}", place.line));
    format!("{}{line}: `{key}` of [filter] does not go with {method}: left out", location.file)
}

/// A refusal at its place: in the file, or in an option of the command line.
fn refused(error: &SettingError, message: &str, source: &Source) -> Stop {
    let nearest = |(word, known): &(String, Vec<&'static str>)| match suggest(word, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("one of: {}", known.join(", ")),
    };
    let help = error.help.clone().or_else(|| error.unknown.as_ref().map(nearest));
    let stop = match source {
        Source::File(location) => Stop::input(location.error(message).to_string()),
        Source::Line(typed) => Stop::input(format!("{typed}: {message}")),
    };
    match help {
        Some(help) => stop.help(help),
        None => stop,
    }
}

/// The kind of a model.
pub fn kind(model: &Model) -> Kind {
    match model.dynamics {
        Dynamics::Discrete(_) => Kind::Discrete,
        Dynamics::Continuous(_) => Kind::Continuous,
    }
}

/// The rule of a method, its options with their values for a model of `states` states, the time update with its own,
/// the form.
pub fn parts(choice: &Choice, states: usize) -> Vec<String> {
    let mut parts = vec![format!("rule {}", choice.rule.word())];
    let rule = options(choice, states);
    parts.extend(rule.iter().map(|(key, value)| format!("{key} {}", Shown(*value))));
    parts.push(format!("form {}", form(choice)));
    if choice.precision != Precision::F64 {
        parts.push(format!("precision {}", choice.precision.word()));
    }
    parts.extend(choice.gate.map(|gate| format!("gate {}", Shown(gate))));
    if choice.time_update != TimeName::Transition {
        parts.push(format!("time update {}", choice.time_update.word()));
        parts.extend(
            choice.time_options().iter().map(|(key, value)| format!("{} {value}", key.replace('_', " "))),
        );
    }
    parts
}

fn options(choice: &Choice, states: usize) -> Vec<(&'static str, f64)> {
    match choice.rule {
        RuleName::Unscented => {
            let rule = choice.unscented;
            let kappa = rule.kappa.unwrap_or(3.0 - states as f64);
            vec![("alpha", rule.alpha), ("beta", rule.beta), ("kappa", kappa)]
        }
        RuleName::GaussHermite => vec![("points", choice.gauss_hermite.points as f64)],
        RuleName::CentralDifference => vec![("eta", choice.central_difference.eta)],
        RuleName::Cubature3 | RuleName::Cubature5 | RuleName::Taylor => vec![],
    }
}

/// The form of a method and, in square-root form, its measurement update.
fn form(choice: &Choice) -> String {
    use givens::filter::Block;
    match (choice.form, choice.block) {
        (FormName::Covariance, _) => "covariance".to_owned(),
        (FormName::SquareRoot, Block::Joint) => "square-root, update joint".to_owned(),
        (FormName::SquareRoot, Block::Separate) => "square-root, update separate".to_owned(),
    }
}

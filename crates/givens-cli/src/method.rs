//! The method of a run: its name and the settings beside it, from the command line and the model file.

use crate::args::MethodArgs;
use crate::message::{Stop, say};
use givens::registry::{Choice, FormName, RuleName, Setting, SettingError, Value, find, resolve};
use givens_expr::suggest;
use givens_io::{InputError, Location, Model, SettingValue};

/// The method where neither the file nor the command line names one: the best of this version, not the oldest.
const DEFAULT: &str = "sr-ckf";

/// A method's name from the command line, and the option that brought it.
#[derive(Clone, Copy)]
pub struct Named<'a> {
    pub option: &'static str,
    pub name: &'a str,
}

/// A setting and where it came from; `None`: from the command line.
type Sourced<'a> = (Setting, Option<&'a Location>);

/// The method that the arguments ask for.
pub fn chosen(model: &Model, args: &MethodArgs) -> Result<Choice, Stop> {
    let own = args.settings.iter().map(|text| setting(text)).collect::<Result<Vec<_>, _>>()?;
    let named = args.method.as_deref().map(|name| Named { option: "--method", name });
    choose(model, named, &own)
}

/// KEY=VALUE.
pub fn pair<'a>(option: &str, text: &'a str) -> Result<(&'a str, &'a str), Stop> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() && !value.trim().is_empty() => {
            Ok((key.trim(), value.trim()))
        }
        _ => Err(Stop::input(format!("{option} {text}: write it as name=value"))),
    }
}

/// One setting of the command line.
pub fn setting(text: &str) -> Result<Setting, Stop> {
    let (key, value) = pair("--set", text)?;
    Ok(Setting { key: key.to_owned(), value: Value::from(value) })
}

/// The method: `named` on the command line, or that of the file; with the settings of both. Of the file's settings,
/// those that do not fit a method named on the command line are dropped, and that is said.
pub fn choose(model: &Model, named: Option<Named>, own: &[Setting]) -> Result<Choice, Stop> {
    let file = &model.filter;
    let of_file = file.method.as_ref().map(|(name, _)| name.as_str());
    let method = named.map(|named| named.name).or(of_file).unwrap_or(DEFAULT);
    let mut settings = of_the_file(model, named);
    settings.extend(own.iter().map(|setting| (setting.clone(), None)));
    loop {
        let plain: Vec<Setting> = settings.iter().map(|(setting, _)| setting.clone()).collect();
        let error = match resolve(method, &plain) {
            Ok(choice) => return in_range(model, choice, &settings),
            Err(error) => error,
        };
        let Some(at) = error.setting else {
            let location = file.method.as_ref().filter(|_| named.is_none()).map(|(_, location)| location);
            return Err(refused(
                &error,
                location,
                named.map(|named| format!("{} {}", named.option, named.name)),
            ));
        };
        let (setting, location) = &settings[at];
        match (location, named) {
            (Some(location), Some(_)) if error.unread => {
                say(&dropped(location, &setting.key, method));
                settings.remove(at);
            }
            _ => return Err(refused(&error, *location, Some(typed(setting)))),
        }
    }
}

/// The settings of `[filter]`. The rule and the form are those of a method named on the command line.
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
                _ => None,
            };
            if let Some(own) = own {
                if value.to_string() != own {
                    say(&dropped(&setting.location, &setting.key, entry.name));
                }
                continue;
            }
        }
        settings.push((Setting { key: setting.key.clone(), value }, Some(&setting.location)));
    }
    settings
}

/// The choice, if its options are in their ranges for this model.
fn in_range(model: &Model, choice: Choice, settings: &[Sourced]) -> Result<Choice, Stop> {
    let Err(error) = choice.check(model.states.len()) else { return Ok(choice) };
    let help = error.must.contains("(n:").then(|| format!("the model has n = {}", model.states.len()));
    let found = settings.iter().rev().find(|(setting, _)| setting.key == error.option);
    let stop = match found {
        Some((_, Some(location))) => Stop::input(location.error(error.to_string()).to_string()),
        Some((setting, None)) => Stop::input(format!("{}: {}", typed(setting), error.must)),
        None => Stop::input(error.to_string()),
    };
    Err(match help {
        Some(help) => stop.help(help),
        None => stop,
    })
}

/// A setting as it was typed.
fn typed(setting: &Setting) -> String {
    format!("--set {}={}", setting.key, setting.value)
}

fn dropped(location: &Location, key: &str, method: &str) -> String {
    let line = location.place.as_ref().map_or(String::new(), |place| format!(":{}", place.line));
    format!("{}{line}: `{key}` of [filter] does not go with {method}: left out", location.file)
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
    let stop = Stop::input(format!("{option}{}", error.message));
    match help {
        Some(help) => stop.help(help),
        None => stop,
    }
}

/// The name of a method, and the parts that were set otherwise.
pub fn title(choice: &Choice) -> String {
    let preset = find(choice.name);
    let rule = preset
        .is_some_and(|preset| preset.rule != choice.rule)
        .then(|| format!("rule {}", choice.rule.word()));
    let form = preset
        .is_some_and(|preset| preset.form != choice.form)
        .then(|| format!("form {}", choice.form.word()));
    let parts = [Some(choice.name.to_owned()), rule, form];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// The options of a method's rule, with their values for a model of `states` states.
pub fn options(choice: &Choice, states: usize) -> Vec<(&'static str, f64)> {
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
pub fn form(choice: &Choice) -> String {
    use givens::filter::Block;
    match (choice.form, choice.block) {
        (FormName::Covariance, _) => "covariance".to_owned(),
        (FormName::SquareRoot, Block::Joint) => "square-root, update joint".to_owned(),
        (FormName::SquareRoot, Block::Separate) => "square-root, update separate".to_owned(),
    }
}

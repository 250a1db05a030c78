//! From a method's name and the settings beside it to the parts of a filter.

use super::choice::Choice;
use super::entry::{Entry, find, names};
use super::option::OPTIONS;
use super::setting::{Setting, SettingError, Value};
use super::words::{
    FormName, GAUGES, Precision, ROOTS, RuleName, SOLVERS, TimeName, UPDATES, VARIANTS, VELOCITIES, Words,
};
use crate::filter::Block;
use crate::filter::predict::{Gauge, Root, Velocity};
use crate::gate::check;
use crate::ode::{Integrator, Steps};
use crate::rule::{CentralDifference, GaussHermite, RuleError, Unscented};
use crate::scalar::Shown;

/// Chooses a method by name and sets its parts and options.
///
/// ```
/// use givens::registry::{Setting, Value, resolve};
/// let kappa = Setting { key: "kappa".into(), value: Value::Number(0.5) };
/// let choice = resolve("sr-ukf", &[kappa.clone()])?;
/// assert_eq!(choice.unscented.kappa, Some(0.5));
/// assert!(resolve("sr-ckf", &[kappa]).is_err_and(|error| error.unread));
/// # Ok::<(), givens::registry::SettingError>(())
/// ```
///
/// # Errors
/// An unknown name, key or word, a value of the wrong kind or out of its range, an option that no part reads, parts
/// that exclude each other.
pub fn resolve(method: &str, settings: &[Setting]) -> Result<Choice, SettingError> {
    let Some(entry) = find(method) else { return Err(unknown_method(method)) };
    let mut choice = preset(entry);
    for (at, setting) in settings.iter().enumerate() {
        part(&mut choice, at, setting)?;
    }
    together(entry, &choice, settings)?;
    for (at, setting) in settings.iter().enumerate() {
        let Some(info) = OPTIONS.iter().find(|info| info.key == setting.key) else {
            return Err(unknown_option(at, &setting.key));
        };
        if !info.reader.reads(&choice) {
            let message = format!("`{method}` does not read `{}`", info.key);
            return Err(SettingError::unread(at, message, info.reader.why(&choice)));
        }
        option(&mut choice, at, setting)?;
    }
    let set = |key: &str| settings.iter().position(|setting| setting.key == key);
    if let (Some(substeps), Some(max_step)) = (set("substeps"), set("max_step")) {
        let message = "`substeps` and `max_step` both say how a gap is divided".to_owned();
        let help = Some("set one of them".to_owned());
        return Err(SettingError { help, ..SettingError::refused(substeps.max(max_step), message) });
    }
    Ok(choice)
}

fn preset(entry: &Entry) -> Choice {
    Choice {
        name: entry.name,
        rule: entry.rule,
        form: entry.form,
        block: Block::Joint,
        time_update: entry.time_update,
        variant: entry.variant,
        gauge: Gauge::default(),
        root: Root::default(),
        velocity: Velocity::default(),
        integrator: Integrator::default(),
        precision: Precision::F64,
        gate: None,
        unscented: Unscented::default(),
        gauss_hermite: GaussHermite::default(),
        central_difference: CentralDifference::default(),
    }
}

/// Sets a part, by its word. Who reads it is judged when all parts are known.
fn part(choice: &mut Choice, at: usize, setting: &Setting) -> Result<(), SettingError> {
    match setting.key.as_str() {
        "rule" => choice.rule = word(at, setting, RuleName::WORDS, RuleName::parse)?,
        "form" => choice.form = word(at, setting, FormName::WORDS, FormName::parse)?,
        "time_update" => choice.time_update = word(at, setting, TimeName::WORDS, TimeName::parse)?,
        "update" => choice.block = among(at, setting, UPDATES)?,
        "precision" => choice.precision = word(at, setting, Precision::WORDS, Precision::parse)?,
        "variant" => choice.variant = among(at, setting, VARIANTS)?,
        "gauge" => choice.gauge = among(at, setting, GAUGES)?,
        "root" => choice.root = among(at, setting, ROOTS)?,
        "velocity" => choice.velocity = among(at, setting, VELOCITIES)?,
        "solver" => choice.integrator.solver = among(at, setting, SOLVERS)?,
        _ => {}
    }
    Ok(())
}

/// Whether the parts go together.
fn together(entry: &Entry, choice: &Choice, settings: &[Setting]) -> Result<(), SettingError> {
    let set = |key: &str| settings.iter().position(|setting| setting.key == key);
    let refuse = |at: Option<usize>, message: String, help: &str| match at {
        Some(at) => Err(SettingError::unread(at, message, help)),
        None => Err(SettingError::method(message, Some(help.to_owned()))),
    };
    let name = entry.name;
    if choice.time_update == TimeName::LevelSet && choice.form == FormName::Covariance {
        if let Some(at) = set("form") {
            let message = "form = covariance: the level set is a square root by nature".to_owned();
            return refuse(Some(at), message, "leave `form` out, or set time_update = moment-ode");
        }
        let message =
            format!("time_update = level-set: `{name}` is in covariance form, the level set a square root");
        return refuse(set("time_update"), message, "name the method lskf, or set form = square-root");
    }
    if choice.precision == Precision::F32 && choice.form == FormName::Covariance {
        let message = format!(
            "precision = f32: `{name}` is in covariance form here, which needs twice the digits of a root"
        );
        return refuse(set("precision"), message, "set form = square-root, or leave `precision` out");
    }
    if entry.adaptive && !choice.time_update.solves() {
        let message = format!(
            "time_update = {}: `{name}` adapts its steps to the error, and this takes equal ones",
            choice.time_update.word()
        );
        return refuse(set("time_update"), message, "name the method cd-ekf");
    }
    if entry.adaptive && !choice.integrator.solver.adaptive() {
        let message = format!(
            "solver = {}: `{name}` adapts its steps to the error, and this takes equal ones",
            choice.integrator.solver.name()
        );
        return refuse(set("solver"), message, "use solver = dp5 or rodas4, or name the method cd-ekf");
    }
    Ok(())
}

/// Sets an option, a number.
fn option(choice: &mut Choice, at: usize, setting: &Setting) -> Result<(), SettingError> {
    let number = || number(at, setting);
    match setting.key.as_str() {
        "gate" => {
            let gate = number()?;
            let wrong = |error: RuleError| SettingError::refused(at, error.to_string());
            check(gate).map_err(wrong)?;
            choice.gate = Some(gate);
        }
        "alpha" => choice.unscented.alpha = number()?,
        "beta" => choice.unscented.beta = number()?,
        "kappa" => choice.unscented.kappa = Some(number()?),
        "eta" => choice.central_difference.eta = number()?,
        "points" => choice.gauss_hermite.points = whole(at, setting, 2.0, 64.0)?,
        "substeps" => {
            let most = choice.integrator.limit as f64;
            choice.integrator.steps = Steps::Count(whole(at, setting, 1.0, most)?);
        }
        "max_step" => choice.integrator.steps = Steps::Longest(number()?),
        "rtol" => choice.integrator.tolerance.rtol = number()?,
        "atol" => choice.integrator.tolerance.atol = number()?,
        _ => {}
    }
    Ok(())
}

fn number(at: usize, setting: &Setting) -> Result<f64, SettingError> {
    match setting.value {
        Value::Number(x) if x.is_finite() => Ok(x),
        _ => {
            let message = format!("{} = {}: must be a number", setting.key, setting.value);
            Err(SettingError::refused(at, message))
        }
    }
}

fn whole(at: usize, setting: &Setting, least: f64, most: f64) -> Result<usize, SettingError> {
    let x = number(at, setting)?;
    if x.fract() == 0.0 && (least..=most).contains(&x) {
        return Ok(x as usize);
    }
    let message = format!("{} = {}: must be a whole number from {least} to {most}", setting.key, Shown(x));
    Err(SettingError::refused(at, message))
}

fn word<T>(
    at: usize,
    setting: &Setting,
    words: &[&'static str],
    parse: impl Fn(&str) -> Option<T>,
) -> Result<T, SettingError> {
    let text = setting.value.to_string();
    parse(&text).ok_or_else(|| {
        let error = SettingError::refused(at, format!("{} = {text}: no such choice", setting.key));
        SettingError { unknown: Some((text, words.to_vec())), ..error }
    })
}

fn among<T: Copy>(at: usize, setting: &Setting, words: Words<T>) -> Result<T, SettingError> {
    let all: Vec<&'static str> = words.iter().map(|(word, _)| *word).collect();
    word(at, setting, &all, |text| words.iter().find(|(word, _)| *word == text).map(|(_, part)| *part))
}

fn unknown_option(at: usize, key: &str) -> SettingError {
    let keys = OPTIONS.iter().map(|info| info.key).collect();
    let error = SettingError::refused(at, format!("there is no option `{key}`"));
    SettingError { unknown: Some((key.to_owned(), keys)), ..error }
}

fn unknown_method(method: &str) -> SettingError {
    let error = SettingError::method(format!("there is no method `{method}`"), None);
    SettingError { unknown: Some((method.to_owned(), names().collect())), ..error }
}

//! From a method's name and the settings beside it to the parts of a filter.

use super::choice::{Choice, FormName, RuleName};
use super::entry::{Entry, find, names};
use crate::filter::Block;
use crate::rule::{CentralDifference, GaussHermite, Unscented};
use crate::scalar::Shown;

/// The value of a setting.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A word.
    Word(String),
}

impl core::fmt::Display for Value {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Value::Number(x) => Shown(*x).fmt(f),
            Value::Word(word) => word.fmt(f),
        }
    }
}

impl From<&str> for Value {
    /// A number if it reads as one, else a word.
    fn from(text: &str) -> Self {
        text.trim().parse().map_or_else(|_| Value::Word(text.trim().to_owned()), Value::Number)
    }
}

/// A part or an option that was set beside a method's name.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Its name.
    pub key: String,
    /// Its value.
    pub value: Value,
}

/// Why a method or a setting is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SettingError {
    /// Which of the settings; `None`: the method's name.
    pub setting: Option<usize>,
    /// The setting is a sound one that this method does not read; a caller may drop it instead.
    pub unread: bool,
    /// What is wrong.
    pub message: String,
    /// The way out.
    pub help: Option<String>,
    /// A word that is not known, and those that are: a caller may suggest the nearest.
    pub unknown: Option<(String, Vec<&'static str>)>,
}

impl core::fmt::Display for SettingError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.message.fmt(f)?;
        match (&self.help, &self.unknown) {
            (Some(help), _) => write!(f, " ({help})"),
            (None, Some((_, known))) => write!(f, " (one of: {})", known.join(", ")),
            (None, None) => Ok(()),
        }
    }
}

impl core::error::Error for SettingError {}

/// A part or option, and the method that reads it.
#[derive(Clone, Copy, Debug)]
pub struct OptionInfo {
    /// Its name.
    pub key: &'static str,
    /// What it is, with its default.
    pub about: &'static str,
    /// The rule that reads it; `None`: a part.
    pub rule: Option<RuleName>,
}

/// Every part and option of this version.
pub const OPTIONS: &[OptionInfo] = &[
    OptionInfo { key: "rule", about: "how expectations are computed", rule: None },
    OptionInfo { key: "form", about: "covariance | square-root", rule: None },
    OptionInfo {
        key: "update",
        about: "square root: joint (2010 eq 36, default) | separate (2009 Appendix B)",
        rule: None,
    },
    OptionInfo { key: "time_update", about: "transition", rule: None },
    OptionInfo { key: "alpha", about: "spread of the points (1)", rule: Some(RuleName::Unscented) },
    OptionInfo { key: "beta", about: "added to the centre's weight (0)", rule: Some(RuleName::Unscented) },
    OptionInfo {
        key: "kappa",
        about: "the plain transform's parameter (3 - n)",
        rule: Some(RuleName::Unscented),
    },
    OptionInfo {
        key: "eta",
        about: "step of the differences (sqrt 3)",
        rule: Some(RuleName::CentralDifference),
    },
    OptionInfo { key: "points", about: "points per axis (3)", rule: Some(RuleName::GaussHermite) },
];

/// The methods of continuous models, that a later version brings.
const CONTINUOUS: &[&str] = &["cd-", "acd-", "sr-cd-", "sr-acd-", "lskf"];

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
/// An unknown name, key or word, a value of the wrong kind or out of its range, an option that no part reads.
pub fn resolve(method: &str, settings: &[Setting]) -> Result<Choice, SettingError> {
    let Some(entry) = find(method) else { return Err(unknown_method(method)) };
    let mut choice = preset(entry);
    let mut block = None;
    for (at, setting) in settings.iter().enumerate() {
        match setting.key.as_str() {
            "rule" => choice.rule = word(at, setting, RuleName::WORDS, RuleName::parse)?,
            "form" => choice.form = word(at, setting, FormName::WORDS, FormName::parse)?,
            "time_update" => {
                word(at, setting, &["transition"], |word| (word == "transition").then_some(()))?;
            }
            "update" => {
                let parse = |word: &str| match word {
                    "joint" => Some(Block::Joint),
                    "separate" => Some(Block::Separate),
                    _ => None,
                };
                block = Some((at, word(at, setting, &["joint", "separate"], parse)?));
            }
            _ => {}
        }
    }
    if let Some((at, block)) = block {
        if choice.form == FormName::Covariance {
            return Err(unread(at, "update", method, "it belongs to the square-root form"));
        }
        choice.block = block;
    }
    for (at, setting) in settings.iter().enumerate() {
        set_option(&mut choice, at, setting, method)?;
    }
    Ok(choice)
}

fn preset(entry: &Entry) -> Choice {
    Choice {
        name: entry.name,
        rule: entry.rule,
        form: entry.form,
        block: Block::Joint,
        unscented: Unscented::default(),
        gauss_hermite: GaussHermite::default(),
        central_difference: CentralDifference::default(),
    }
}

fn set_option(choice: &mut Choice, at: usize, setting: &Setting, method: &str) -> Result<(), SettingError> {
    let key = setting.key.as_str();
    let Some(info) = OPTIONS.iter().find(|info| info.key == key) else {
        let keys = OPTIONS.iter().map(|info| info.key).collect();
        let error = refused(at, format!("there is no option `{key}`"));
        return Err(SettingError { unknown: Some((key.to_owned(), keys)), ..error });
    };
    let Some(rule) = info.rule else { return Ok(()) };
    let number = number(at, setting)?;
    if rule != choice.rule {
        return Err(unread(at, key, method, &format!("it belongs to the {} rule", rule.word())));
    }
    match key {
        "alpha" => choice.unscented.alpha = number,
        "beta" => choice.unscented.beta = number,
        "kappa" => choice.unscented.kappa = Some(number),
        "eta" => choice.central_difference.eta = number,
        _ => {
            if number.fract() != 0.0 || !(2.0..=64.0).contains(&number) {
                let message = format!("points = {}: must be a whole number from 2 to 64", Shown(number));
                return Err(refused(at, message));
            }
            choice.gauss_hermite.points = number as usize;
        }
    }
    Ok(())
}

fn number(at: usize, setting: &Setting) -> Result<f64, SettingError> {
    match setting.value {
        Value::Number(x) if x.is_finite() => Ok(x),
        _ => {
            let message = format!("{} = {}: must be a number", setting.key, setting.value);
            Err(refused(at, message))
        }
    }
}

fn word<T>(
    at: usize,
    setting: &Setting,
    words: &[&'static str],
    parse: impl Fn(&str) -> Option<T>,
) -> Result<T, SettingError> {
    let text = setting.value.to_string();
    parse(&text).ok_or_else(|| {
        let error = refused(at, format!("{} = {text}: no such choice", setting.key));
        SettingError { unknown: Some((text, words.to_vec())), ..error }
    })
}

/// A setting that is wrong whatever the method.
fn refused(at: usize, message: String) -> SettingError {
    SettingError { setting: Some(at), unread: false, message, help: None, unknown: None }
}

fn unread(at: usize, key: &str, method: &str, why: &str) -> SettingError {
    let error = refused(at, format!("`{method}` does not read `{key}`"));
    SettingError { unread: true, help: Some(why.to_owned()), ..error }
}

fn unknown_method(method: &str) -> SettingError {
    let continuous = CONTINUOUS.iter().any(|prefix| method.starts_with(prefix));
    SettingError {
        setting: None,
        unread: false,
        message: format!("there is no method `{method}`"),
        help: continuous
            .then(|| "this version holds the discrete-time methods; see `givens methods`".to_owned()),
        unknown: (!continuous).then(|| (method.to_owned(), names().collect())),
    }
}

//! A setting beside a method's name, and why one is refused.

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

impl SettingError {
    /// Of a setting that is wrong whatever the method.
    pub(super) fn refused(at: usize, message: String) -> Self {
        Self { setting: Some(at), unread: false, message, help: None, unknown: None }
    }

    /// Of a setting that does not go with the method.
    pub(super) fn unread(at: usize, message: String, why: impl Into<String>) -> Self {
        Self { unread: true, help: Some(why.into()), ..Self::refused(at, message) }
    }

    /// Of the method.
    pub(super) fn method(message: String, help: Option<String>) -> Self {
        Self { setting: None, unread: false, message, help, unknown: None }
    }
}

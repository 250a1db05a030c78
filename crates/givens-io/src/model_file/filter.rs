//! `[filter]` and `[plot]`: what to do with the model.

use super::document::Kind;
use super::section::{Named, Section, text, texts};
use crate::error::Location;
use crate::findings::Findings;

/// What `[filter]` says: a method, and parts and options beside it. Which of them fit is for the registry to say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilterSettings {
    /// The name of the method, and where it stands.
    pub method: Option<(String, Location)>,
    /// Parts and options in file order.
    pub options: Vec<Setting>,
}

/// One part or option of a filter.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// The key.
    pub key: String,
    /// Its value.
    pub value: SettingValue,
    /// Where the key stands.
    pub location: Location,
    /// Where the value stands.
    pub value_location: Location,
}

/// The value of a setting.
#[derive(Clone, Debug, PartialEq)]
pub enum SettingValue {
    /// A word, such as the name of a part.
    Text(String),
    /// A finite number.
    Number(f64),
    /// `true` or `false`.
    Truth(bool),
}

/// Reads `[filter]`.
pub(super) fn read(findings: &Findings, section: Section) -> FilterSettings {
    let mut settings = FilterSettings::default();
    for entry in section.entries {
        let value_location = findings.source.location(entry.value.span.clone());
        if entry.key == "method" {
            settings.method =
                text(findings, &entry.value, "`method`").map(|name| (name.to_string(), value_location));
            continue;
        }
        let value = match &entry.value.kind {
            Kind::Text(text, _) => SettingValue::Text(text.clone()),
            Kind::Number(number, _) if number.is_finite() => SettingValue::Number(*number),
            Kind::Truth(truth) => SettingValue::Truth(*truth),
            other => {
                let found = if let Kind::Number(..) = other { "no finite number" } else { other.noun() };
                let message = format!("`{}` in [filter] is a number, a word or a truth value; found {found}", entry.key);
                findings.wrong_help(&entry.value.span, message, "options have single values");
                continue;
            }
        };
        let location = findings.source.location(entry.span.clone());
        settings.options.push(Setting { key: entry.key.clone(), value, location, value_location });
    }
    settings
}

/// Reads the plane of the figure: two states.
pub(super) fn plane(findings: &Findings, section: &Section, states: &[String]) -> Option<[usize; 2]> {
    let entry = section.get("plane")?;
    let names = texts(findings, &entry.value, "`plane`")?;
    let &[(first, first_at), (second, second_at)] = names.as_slice() else {
        let message = format!("`plane` names two states, not {}", names.len());
        findings.wrong_help(&entry.value.span, message, "write the horizontal one, then the vertical one");
        return None;
    };
    let named = Named { noun: "state", names: states };
    let i = named.index(findings, first, first_at, "`plane`");
    let j = named.index(findings, second, second_at, "`plane`");
    let plane = [i?, j?];
    if plane[0] == plane[1] {
        findings.wrong_help(second_at, format!("`plane` names `{second}` twice"), "name two states");
        return None;
    }
    Some(plane)
}

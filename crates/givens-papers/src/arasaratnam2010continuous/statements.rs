//! The published statements, with their places.

use crate::{Expected, Trouble};

const EXPECTED: &str = include_str!("expected/statements.toml");

/// Of `expected/statements.toml`.
pub(super) struct Statements(Expected);

impl Statements {
    pub fn read() -> Result<Self, Trouble> {
        Ok(Self(Expected::read(EXPECTED)?))
    }

    /// What the paper says, and where.
    pub fn of(&self, key: &str) -> Result<(&str, String), Trouble> {
        match (self.0.word(&[key, "says"]), self.0.word(&[key, "page"])) {
            (Some(says), Some(page)) => Ok((says, page.to_owned())),
            _ => Err(format!("no statement `{key}`").into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_statement_has_its_words_and_its_place() {
        let statements = Statements::read().unwrap();
        assert!(statements.0.source.contains("p. 4987"));
        assert_eq!(statements.0.number(&["runs"]), Some(100.0));
        for key in ["insensitive", "extended-improves", "unscented-survives", "order", "costs"] {
            assert!(statements.of(key).is_ok(), "{key}");
        }
        assert!(statements.of("unheard").is_err());
    }
}

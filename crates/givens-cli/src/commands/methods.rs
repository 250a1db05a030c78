//! `givens methods`: the registry as a table.

use crate::message::Stop;
use crate::stdout;
use givens::registry::{ENTRIES, OPTIONS};

/// Prints every method with its parts and sources, then every part and option.
pub fn methods() -> Result<(), Stop> {
    stdout::write(|out| {
        writeln!(out, "{:<24} {:<19} {:<12} {:<11} about", "method", "rule", "form", "time")?;
        for entry in ENTRIES {
            let names = core::iter::once(entry.name).chain(entry.aliases.iter().copied()).collect::<Vec<_>>();
            let (names, rule, form) = (names.join(" = "), entry.rule.word(), entry.form.word());
            let kind = entry.kind().word();
            writeln!(out, "{names:<24} {rule:<19} {form:<12} {kind:<11} {}", entry.about)?;
            writeln!(out, "{:<24} {}", "", entry.sources.join("; "))?;
        }
        writeln!(out, "\n{:<24} {:<22} about (default)", "part or option", "of")?;
        for option in OPTIONS {
            writeln!(out, "{:<24} {:<22} {}", option.key, option.reader.word(), option.about)?;
        }
        Ok(())
    })
}

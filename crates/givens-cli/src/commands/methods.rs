//! `givens methods`: the registry as a table.

use crate::message::Stop;
use crate::stdout;
use givens::registry::{ENTRIES, OPTIONS};

/// Prints every method with its parts and sources, then every part and option.
pub fn methods() -> Result<(), Stop> {
    stdout::write(|out| {
        writeln!(out, "{:<18} {:<18} {:<12} about", "method", "rule", "form")?;
        for entry in ENTRIES {
            let names = core::iter::once(entry.name).chain(entry.aliases.iter().copied()).collect::<Vec<_>>();
            let (names, rule, form) = (names.join(" = "), entry.rule.word(), entry.form.word());
            writeln!(out, "{names:<18} {rule:<18} {form:<12} {}", entry.about)?;
            writeln!(out, "{:<18} {}", "", entry.sources.join("; "))?;
        }
        writeln!(out, "\n{:<18} {:<18} about (default)", "part or option", "of the rule")?;
        for option in OPTIONS {
            let rule = option.rule.map_or("any", |rule| rule.word());
            writeln!(out, "{:<18} {rule:<18} {}", option.key, option.about)?;
        }
        Ok(())
    })
}

//! What a program holds: its symbols, and the bytes of its code and constants.

use super::symbols::{self, Symbol};
use object::{Object, ObjectSection, ObjectSymbol};
use std::path::Path;

/// A program, as the linker left it.
pub struct Image {
    pub symbols: Vec<Symbol>,
    /// Bytes of the sections of code and of constants.
    sections: u64,
}

impl Image {
    pub fn read(path: &Path) -> Result<Self, String> {
        let fail = |error: &dyn core::fmt::Display| format!("{}: {error}", path.display());
        let bytes = std::fs::read(path).map_err(|error| fail(&error))?;
        let file = object::File::parse(&*bytes).map_err(|error| fail(&error))?;
        let all = file.symbols().chain(file.dynamic_symbols());
        let symbols: Vec<Symbol> = all
            .filter_map(|symbol| {
                // the linker writes the version of what it imports behind its name
                let name = symbol.name().ok()?.split('@').next()?.to_owned();
                let (size, imported) = (symbol.size(), symbol.is_undefined() && !symbol.is_weak());
                (!name.is_empty()).then_some(Symbol { name, size, imported })
            })
            .collect();
        if symbols.is_empty() {
            return Err(fail(&"it has no symbols to look at: build it without stripping"));
        }
        let kept = |name: &str| name.starts_with(".text") || name.starts_with(".rodata");
        let sections = file.sections().filter(|section| section.name().is_ok_and(kept));
        Ok(Self { symbols, sections: sections.map(|section| section.size()).sum() })
    }

    /// Bytes of code and constants, without the host program's own and its rows. What the linker puts in front of `main` is
    /// counted.
    pub fn flash(&self) -> u64 {
        let own = self.symbols.iter().filter(|symbol| symbol.name == "main" || symbol.is_of("host"));
        self.sections - own.map(|symbol| symbol.size).sum::<u64>()
    }

    /// Bytes of the functions and constants of a crate. What was inlined counts for where it went.
    pub fn code_of(&self, name: &str) -> u64 {
        self.symbols.iter().filter(|symbol| symbol.is_of(name)).map(|symbol| symbol.size).sum()
    }
}

impl Symbol {
    /// Whether it belongs to the crate: none stands before it in the symbol's path.
    fn is_of(&self, name: &str) -> bool {
        symbols::crates(&self.name).first() == Some(&name)
    }
}

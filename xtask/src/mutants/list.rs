//! The mutants that cargo-mutants knows.

use super::group::Group;
use core::ops::Range;
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// One small thing wrong.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// By which it is switched on.
    pub number: u32,
    /// From the root.
    pub file: String,
    /// What stands there instead of `at`; in bytes of the file.
    pub replacement: String,
    pub at: Range<usize>,
    /// The function that it is in, whole, and its name; none in a constant.
    pub function: Option<Range<usize>>,
    /// File, function, the line as it is wrong: what does not change when lines are added elsewhere.
    pub name: String,
}

/// The group's mutants, in the order of the files.
pub fn read(root: &Path, group: &Group) -> Result<Vec<Mutant>, String> {
    let mut cargo = Command::new("cargo");
    cargo.current_dir(root).args(["mutants", "--list", "--json", "-p", group.package, "-f", group.files]);
    let out = cargo.output().map_err(|error| format!("cargo cannot be run: {error}"))?;
    if !out.status.success() {
        let words = String::from_utf8_lossy(&out.stderr);
        return Err(format!("cargo mutants: {words}\n`cargo install cargo-mutants` installs it"));
    }
    let listed: Vec<Value> =
        serde_json::from_slice(&out.stdout).map_err(|error| format!("cargo mutants --list: {error}"))?;
    let mut text = (String::new(), String::new());
    let mut mutants = Vec::new();
    for (number, value) in listed.iter().enumerate().filter(|(number, _)| number % group.every == 0) {
        let file = value["file"].as_str().ok_or("a mutant without a file")?;
        if text.0 != file {
            let path = root.join(file);
            let read = std::fs::read_to_string(&path).map_err(|error| format!("{file}: {error}"))?;
            text = (file.to_owned(), read);
        }
        let mutant = one(number as u32, value, file, &text.1);
        mutants.push(mutant.ok_or_else(|| format!("a mutant that is not understood: {value}"))?);
    }
    tell_apart(&mut mutants);
    Ok(mutants)
}

fn one(number: u32, value: &Value, file: &str, text: &str) -> Option<Mutant> {
    let at = span(&value["span"], text)?;
    let function = match &value["function"] {
        Value::Null => None,
        function => Some(span(&function["span"], text)?),
    };
    let replacement = value["replacement"].as_str()?.to_owned();
    let own = value["function"]["function_name"].as_str().unwrap_or("constant");
    let first = text[..at.start].rfind('\n').map_or(0, |end| end + 1);
    let last = text[at.end..].find('\n').map_or(text.len(), |end| at.end + end);
    let line = format!("{}{replacement}{}", &text[first..at.start], &text[at.end..last]);
    let line = line.split_whitespace().collect::<Vec<_>>().join(" ");
    let short = file.split_once("/src/").map_or(file, |(_, short)| short);
    let name = format!("{short} {own}: {line}");
    Some(Mutant { number, file: file.to_owned(), replacement, at, function, name })
}

/// Lines that stand twice in a function are numbered.
fn tell_apart(mutants: &mut [Mutant]) {
    let mut seen = std::collections::HashMap::new();
    for mutant in mutants {
        let times = seen.entry(mutant.name.clone()).or_insert(0);
        *times += 1;
        if *times > 1 {
            mutant.name = format!("{} ({times})", mutant.name);
        }
    }
}

fn span(value: &Value, text: &str) -> Option<Range<usize>> {
    Some(place(&value["start"], text)?..place(&value["end"], text)?)
}

/// The byte at a line and a column of characters, both from one.
fn place(value: &Value, text: &str) -> Option<usize> {
    let (line, column) = (value["line"].as_u64()? as usize, value["column"].as_u64()? as usize);
    let start: usize = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
    let ahead = text[start..].chars().take(column - 1).map(char::len_utf8).sum::<usize>();
    Some(start + ahead)
}

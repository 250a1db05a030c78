//! A file with all its mutants in it: each function asks which of them is switched on.

use super::list::Mutant;
use crate::rust_text::RustText;
use core::fmt::Write;
use core::ops::Range;
use std::collections::BTreeMap;

/// A woven file.
#[derive(Debug, Default)]
pub struct Woven {
    pub text: String,
    /// The lines that a mutant's own copy of its function stands in, from one.
    pub lines: Vec<(Range<usize>, u32)>,
    /// By the number that a function asks with, its mutants.
    pub functions: BTreeMap<u32, Vec<u32>>,
}

/// Weaves the mutants of one file that are in functions.
pub fn weave(text: &str, mutants: &[&Mutant]) -> Woven {
    let code = RustText::of(text).code;
    let mut woven = Woven::default();
    let mut after = 0;
    for (function, own) in functions(mutants) {
        // the body is what the last brace closes
        let end = function.end - 1;
        let start = 1 + opening(code.as_bytes(), end);
        woven.push(&text[after..start]);
        let first = own[0].number;
        woven.push(&format!("match crate::switched::on({first}) {{\n"));
        for mutant in &own {
            let from = woven.line();
            let (before, behind) = (&text[start..mutant.at.start], &text[mutant.at.end..end]);
            woven.push(&format!("{} => {{ {before} {} {behind} }}\n", mutant.number, mutant.replacement));
            let until = woven.line();
            woven.lines.push((from..until, mutant.number));
        }
        woven.push(&format!("_ => {{ {} }}\n}}", &text[start..end]));
        woven.functions.insert(first, own.iter().map(|mutant| mutant.number).collect());
        after = end;
    }
    woven.push(&text[after..]);
    woven
}

impl Woven {
    fn push(&mut self, text: &str) {
        let _ = self.text.write_str(text);
    }

    /// The line that is written next.
    fn line(&self) -> usize {
        1 + self.text.bytes().filter(|&byte| byte == b'\n').count()
    }
}

/// The outermost functions with their mutants, in their order.
fn functions<'m>(mutants: &[&'m Mutant]) -> Vec<(Range<usize>, Vec<&'m Mutant>)> {
    let mut spans: Vec<Range<usize>> = mutants.iter().filter_map(|mutant| mutant.function.clone()).collect();
    spans.sort_by_key(|span| (span.start, core::cmp::Reverse(span.end)));
    let mut outer: Vec<(Range<usize>, Vec<&Mutant>)> = Vec::new();
    for span in spans {
        if outer.last().is_none_or(|(last, _)| span.start >= last.end) {
            outer.push((span, Vec::new()));
        }
    }
    for &mutant in mutants.iter().filter(|mutant| mutant.function.is_some()) {
        if let Some((_, own)) = outer.iter_mut().find(|(span, _)| span.contains(&mutant.at.start)) {
            own.push(mutant);
        }
    }
    outer.retain(|(_, own)| !own.is_empty());
    outer
}

/// Where the brace opens that closes at `end`.
fn opening(code: &[u8], end: usize) -> usize {
    let mut depth = 0_usize;
    for at in (0..=end).rev() {
        match code[at] {
            b'}' => depth += 1,
            b'{' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at;
        }
    }
    0
}

#[cfg(test)]
mod tests {
    use super::{Mutant, weave};

    #[test]
    fn a_function_asks_for_its_mutants() {
        let text = "/// f {\nfn f(a: [u8; { 2 }]) -> u8 {\n    a[0] + 1\n}\nfn g() {}\n";
        let at = text.find('+').unwrap();
        let function = text.find("fn f").unwrap()..text.find("\nfn g").unwrap();
        let mutant = |number, replacement: &str| Mutant {
            number,
            file: String::new(),
            replacement: replacement.to_owned(),
            at: at..at + 1,
            function: Some(function.clone()),
            name: String::new(),
        };
        let (minus, times) = (mutant(7, "-"), mutant(8, "*"));
        let woven = weave(text, &[&minus, &times]);
        let expected = "/// f {\nfn f(a: [u8; { 2 }]) -> u8 {match crate::switched::on(7) {\n\
             7 => { \n    a[0]  -  1\n }\n8 => { \n    a[0]  *  1\n }\n_ => { \n    a[0] + 1\n }\n}}\nfn g() {}\n";
        assert_eq!(woven.text, expected);
        assert_eq!(woven.lines, [(3..6, 7), (6..9, 8)]);
        assert_eq!(woven.functions[&7], [7, 8]);
    }
}

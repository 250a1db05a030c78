//! The references in a text: to papers by year and place, to authors, to docs/algorithms.md.

/// One reference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reference {
    /// A place in a paper that is known by its year: `2010 eq 36`.
    Place(String),
    /// Such a paper as a whole: `2009`.
    Year(String),
    /// Last author and year: `Cheng 2013`.
    Author(String),
    /// A section (`§2`) or the label of an equation (`R1`) in docs/algorithms.md.
    Label(String),
    /// A text that is no part of the project.
    Foreign(&'static str),
}

/// What the project was written from but does not hold.
const FOREIGN: &[&str] = &["`spec`", "spec §", "spec.md", "design.md", "`speed`", "../shared"];

/// All references of a text, each with its byte. Those by author are looked for in code only (`authors`): prose has
/// dates.
pub fn references(text: &str, authors: bool) -> Vec<(usize, Reference)> {
    let mut found = Vec::new();
    for (at, year) in years(text) {
        let behind = &text[at + year.len()..];
        let author = author(&text[..at]).filter(|_| authors);
        let places = places(behind);
        if let Some(author) = author {
            found.push((at, Reference::Author(format!("{author} {year}"))));
        } else if !places.is_empty() {
            found.extend(places.into_iter().map(|place| (at, Reference::Place(format!("{year} {place}")))));
        } else if text[..at].ends_with('(') && behind.starts_with([')', ';']) {
            found.push((at, Reference::Year(year.to_owned())));
        }
    }
    for (at, file) in text.match_indices("algorithms.md") {
        let mut rest = text[at + file.len()..].trim_start_matches('`').trim_start();
        while let Some(label) = label(rest) {
            found.push((at, Reference::Label(label.to_owned())));
            rest = rest[label.len()..].strip_prefix(',').unwrap_or_default().trim_start();
        }
    }
    for mark in FOREIGN {
        found.extend(text.match_indices(mark).map(|(at, _)| (at, Reference::Foreign(mark))));
    }
    found
}

/// Years that stand alone.
fn years(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let inner = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '–' | '/' | '#' | '.' | '%');
    let starts = text.match_indices(['1', '2']).map(|(at, _)| at);
    starts.filter_map(move |at| {
        let year = text.get(at..at + 4)?;
        let good = year.bytes().all(|byte| byte.is_ascii_digit())
            && (year.starts_with("19") || year.starts_with("20"));
        let mut after = text[at + 4..].chars();
        let next = after.next().unwrap_or(' ');
        // a year may end a sentence or stand in 1997/2004
        let whole =
            !inner(next) || next == '/' || (next == '.' && !after.next().is_some_and(char::is_alphanumeric));
        let alone = !text[..at].ends_with(inner);
        (good && whole && alone).then_some((at, year))
    })
}

/// The capitalised word that stands right before a year.
fn author(before: &str) -> Option<&str> {
    let before = before.strip_suffix(|c: char| c.is_whitespace())?.trim_end();
    let start = before
        .rfind(|c: char| !(c.is_alphabetic() || c == '-'))
        .map_or(0, |at| at + before[at..].chars().next().map_or(1, char::len_utf8));
    let word = &before[start..];
    let capital = word.chars().next().is_some_and(char::is_uppercase);
    (capital && word.len() > 1 && !matches!(word, "The" | "In" | "From" | "See")).then_some(word)
}

/// The places that follow a year, as they are written in docs/notation.md.
fn places(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut rest = text.trim_start();
    loop {
        let (word, one, list) = match rest {
            _ if rest.starts_with("eqs ") => ("eqs ", "eq ", true),
            _ if rest.starts_with("eq ") => ("eq ", "eq ", false),
            _ if rest.starts_with("Tables ") => ("Tables ", "Table ", true),
            _ if rest.starts_with("Table ") => ("Table ", "Table ", false),
            _ if rest.starts_with("Appendix ") => ("Appendix ", "Appendix ", false),
            _ if rest.starts_with('§') => ("§", "§", false),
            _ => return found,
        };
        rest = &rest[word.len()..];
        loop {
            let end = rest
                .find(|c: char| !(c.is_alphanumeric() || matches!(c, '–' | '-' | '.')))
                .unwrap_or(rest.len());
            let number = rest[..end].trim_end_matches(['.', '-']);
            found.push(format!("{one}{number}"));
            rest = &rest[end..];
            let next = rest.strip_prefix(',').map(str::trim_start);
            match next {
                Some(next) if list && next.starts_with(|c: char| c.is_ascii_digit()) => rest = next,
                _ => break,
            }
        }
        rest = match rest.strip_prefix(',') {
            Some(next) => next.trim_start(),
            None => return found,
        };
    }
}

/// A label at the start of a text.
fn label(text: &str) -> Option<&str> {
    let head = text.chars().next().filter(|c| *c == '§' || c.is_ascii_uppercase())?;
    let digits = text[head.len_utf8()..].bytes().take_while(u8::is_ascii_digit).count();
    (digits > 0).then(|| &text[..head.len_utf8() + digits])
}

#[cfg(test)]
mod tests {
    use super::Reference::{Author, Foreign, Label, Place, Year};
    use super::references;

    #[test]
    fn each_kind_is_found_and_other_numbers_are_not() {
        let text = "Tria (2010 eq 36; 2011 Tables 1, 3, eq 27), filter (2009), 2009 Appendix B, the radar of 2009 §VIII-B.\n\
                    Jia, Xin & Cheng 2013; Kirubarajan 2001, §11.7; Uhlmann\n1997/2004. 2020-06-25, 12009 rows, 2000 rows, 1.2009\n\
                    `docs/algorithms.md` R1, U2 and docs/algorithms.md §3; `spec` §0";
        let found: Vec<_> = references(text, true).into_iter().map(|(_, reference)| reference).collect();
        let place = |text: &str| Place(text.into());
        let expected = [
            place("2010 eq 36"),
            place("2011 Table 1"),
            place("2011 Table 3"),
            place("2011 eq 27"),
            Year("2009".into()),
            place("2009 Appendix B"),
            place("2009 §VIII-B"),
            Author("Cheng 2013".into()),
            Author("Kirubarajan 2001".into()),
            Author("Uhlmann 1997".into()),
            Label("R1".into()),
            Label("U2".into()),
            Label("§3".into()),
            Foreign("`spec`"),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn any_text_is_read() {
        for text in
            ["2009", "200", "§2009 §", "(2009", "2009 eq ", "é2010 é", "algorithms.md", "é 2011 Tables 1, "]
        {
            let _ = references(text, true);
        }
    }
}

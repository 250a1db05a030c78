//! A Rust file taken apart: code, comments and strings, each where it stands.

/// Three texts of the same length and lines as the file; in each, what belongs to the others is blank.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RustText {
    pub code: String,
    pub comments: String,
    pub strings: String,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Part {
    Code,
    Comment,
    Text,
}

impl RustText {
    pub fn of(text: &str) -> Self {
        let chars: Vec<char> = text.chars().collect();
        let mut parts = Self::default();
        let mut at = 0;
        while at < chars.len() {
            let (part, mark, end) = piece(&chars, at);
            for (k, &c) in chars[at..end].iter().enumerate() {
                parts.push(c, if k < mark { None } else { Some(part) });
            }
            at = end;
        }
        parts
    }

    /// Adds a character to the part that it belongs to, blanks to the others; marks of comments belong to none.
    fn push(&mut self, c: char, part: Option<Part>) {
        let texts = [
            (Part::Code, &mut self.code),
            (Part::Comment, &mut self.comments),
            (Part::Text, &mut self.strings),
        ];
        for (own, text) in texts {
            if c == '\n' || part == Some(own) {
                text.push(c);
            } else {
                // as many bytes, so that places agree
                text.extend(core::iter::repeat_n(' ', c.len_utf8()));
            }
        }
    }
}

/// The piece that begins at `at`: what it is, how many characters of it are only its mark, and where it ends.
fn piece(chars: &[char], at: usize) -> (Part, usize, usize) {
    let here = |ahead: usize| chars.get(at + ahead).copied().unwrap_or('\0');
    let before = if at == 0 { ' ' } else { chars[at - 1] };
    let in_word = before.is_alphanumeric() || before == '_';
    match (here(0), here(1)) {
        ('/', '/') => {
            let end = until(chars, at, |c| c == '\n');
            let mark = 2 + usize::from(matches!(here(2), '/' | '!'));
            (Part::Comment, mark.min(end - at), end)
        }
        ('/', '*') => (Part::Comment, 2, block_comment(chars, at)),
        ('"', _) => (Part::Text, 0, quoted(chars, at + 1)),
        ('b' | 'c', '"') if !in_word => (Part::Text, 0, quoted(chars, at + 2)),
        ('r', '"' | '#') if !in_word => {
            raw(chars, at + 1).map_or((Part::Code, 0, at + 1), |end| (Part::Text, 0, end))
        }
        ('b' | 'c', 'r') if !in_word => {
            raw(chars, at + 2).map_or((Part::Code, 0, at + 1), |end| (Part::Text, 0, end))
        }
        ('\'', '\\') => (Part::Text, 0, (until(chars, at + 3, |c| c == '\'') + 1).min(chars.len())),
        ('\'', _) if here(2) == '\'' => (Part::Text, 0, at + 3),
        _ => (Part::Code, 0, at + 1),
    }
}

fn until(chars: &[char], from: usize, stop: impl Fn(char) -> bool) -> usize {
    (from..chars.len()).find(|&k| stop(chars[k])).unwrap_or(chars.len())
}

/// The end of a string whose contents begin at `from`.
fn quoted(chars: &[char], from: usize) -> usize {
    let mut at = from;
    while at < chars.len() {
        match chars[at] {
            '\\' => at += 2,
            '"' => return at + 1,
            _ => at += 1,
        }
    }
    chars.len()
}

/// The end of a raw string whose hashes begin at `from`; none if it is no raw string.
fn raw(chars: &[char], from: usize) -> Option<usize> {
    let open = until(chars, from, |c| c != '#');
    if chars.get(open) != Some(&'"') {
        return None;
    }
    let hashes = open - from;
    let mut at = open + 1;
    while at < chars.len() {
        let close = until(chars, at, |c| c == '"');
        let after = chars[chars.len().min(close + 1)..].iter().take(hashes).filter(|&&c| c == '#').count();
        if after == hashes {
            return Some((close + 1 + hashes).min(chars.len()));
        }
        at = close + 1;
    }
    Some(chars.len())
}

/// The end of a block comment, which may hold others.
fn block_comment(chars: &[char], from: usize) -> usize {
    let (mut depth, mut at) = (0, from);
    while at < chars.len() {
        match (chars[at], chars.get(at + 1)) {
            ('/', Some('*')) => (depth, at) = (depth + 1, at + 2),
            ('*', Some('/')) => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            return at;
        }
    }
    chars.len()
}

#[cfg(test)]
mod tests {
    use super::RustText;

    #[test]
    fn code_comments_and_strings_keep_their_places() {
        let text = "let a = \"x // y\"; // §1 \"z\"\n/* b /* c */ d */ f('\"', r#\"e\"f\"#, 'a');\n";
        let parts = RustText::of(text);
        for part in [&parts.code, &parts.comments, &parts.strings] {
            assert_eq!(part.len(), text.len());
            assert_eq!(part.lines().count(), 2);
        }
        assert!(parts.code.contains("let a =") && parts.code.contains("f(") && !parts.code.contains("//"));
        assert_eq!(parts.comments.find("§1"), text.find("§1"));
        assert!(
            parts.strings.contains("x // y")
                && parts.strings.contains("e\"f")
                && !parts.strings.contains('z')
        );
    }

    #[test]
    fn a_lifetime_begins_no_character() {
        let parts = RustText::of("fn f<'a>(x: &'a str) {} // c");
        assert!(parts.code.contains("&'a str") && parts.comments.contains(" c"));
    }

    #[test]
    fn text_that_never_ends_is_taken_to_its_end() {
        for text in ["\"abc", "r#\"abc\"", "/* abc", "'\\", "//", "b\"\\"] {
            assert_eq!(RustText::of(text).code.len(), text.len(), "{text}");
        }
    }
}

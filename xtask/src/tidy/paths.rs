//! The names that follow a path such as `crate::`, in code.

/// The names behind every `prefix` of `code`, each with its byte: one, or those of a group in braces.
pub fn names_after<'c>(code: &'c str, prefix: &str) -> Vec<(usize, &'c str)> {
    let mut found = Vec::new();
    for (at, _) in code.match_indices(prefix) {
        let before = code[..at].chars().next_back();
        if before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | ':')) {
            continue;
        }
        heads(code, at + prefix.len(), &mut found);
    }
    found
}

/// The name at `at`, or the first names of a group there.
pub fn heads<'c>(code: &'c str, at: usize, found: &mut Vec<(usize, &'c str)>) {
    if !code[at..].starts_with('{') {
        if let Some(name) = name(code, at) {
            found.push((at, name));
        }
        return;
    }
    let (mut depth, mut fresh) = (0, true);
    for (k, c) in code[at..].char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 1 => fresh = true,
            c if depth == 1 && fresh && !c.is_whitespace() => {
                fresh = false;
                found.extend(name(code, at + k).map(|name| (at + k, name)));
            }
            _ => {}
        }
        if depth == 0 {
            return;
        }
    }
}

fn name(code: &str, at: usize) -> Option<&str> {
    let rest = &code[at..];
    let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
    (end > 0).then(|| &rest[..end])
}

#[cfg(test)]
mod tests {
    use super::names_after;

    #[test]
    fn groups_give_their_first_names() {
        let code = "use crate::{\n    a::{b, c},\n    d as e,\n};\nlet x = crate::f::g(other_crate::h);";
        let names: Vec<&str> = names_after(code, "crate::").into_iter().map(|(_, name)| name).collect();
        assert_eq!(names, ["a", "d", "f"]);
    }
}

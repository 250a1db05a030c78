//! What is said of a table's columns, and what a table is called.

use crate::message::say;
use givens_expr::suggest;

/// A file as messages call it.
pub fn source_name(path: &str) -> &str {
    if path == "-" { "standard input" } else { path }
}

/// Names columns that were not read, and what they may have been meant for among the `absent` ones.
pub fn ignored(file: &str, columns: &[String], absent: &[&str]) {
    let file = source_name(file);
    if !columns.is_empty() {
        let plural = if columns.len() == 1 { "" } else { "s" };
        let named = columns.iter().map(|column| match suggest(column, absent.iter().copied()) {
            Some(near) => format!("{column} (did you mean `{near}`?)"),
            None => column.clone(),
        });
        let named: Vec<String> = named.collect();
        say(&format!("{file}: column{plural} not used by the model: {}", named.join(", ")));
    }
}

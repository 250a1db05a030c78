//! `cargo xtask instructions`: the instructions that fixed work takes, against a committed table.
//!
//! A count says the same on a busy machine as on an idle one. It depends on the compiler, which the table names, and on the
//! vectors that the program chooses: valgrind shows none wider than AVX2, on any machine.

use crate::say;
use core::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use toml::de::DeTable;

/// How far a count may be from the table's, either way: what becomes cheaper is to be blessed too.
const WITHIN: f64 = 0.03;

/// One line of the table: `"WORKLOAD CONTESTANT" = COUNT`.
struct Row {
    workload: String,
    contestant: String,
    expected: u64,
}

/// Whether there is a valgrind to count by.
pub fn can() -> bool {
    let found = Command::new("valgrind").arg("--version").output().is_ok_and(|out| out.status.success());
    if !found {
        say("nothing was counted: valgrind is not installed");
    }
    found
}

/// Counts all rows; whether none is too far off. With `bless` the table takes the new counts.
pub fn run(root: &Path, bless: bool) -> bool {
    counted(root, bless).unwrap_or_else(|message| {
        say(&message);
        false
    })
}

fn counted(root: &Path, bless: bool) -> Result<bool, String> {
    let path = root.join("benchmarks/instructions.toml");
    let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let (compiler, rows) = read(&text)?;
    let own = crate::bench::line_of("rustc", &["--version"], root);
    if compiler != own && !bless {
        say(&format!("the table is of {compiler}, this is {own}: counts may differ for that alone"));
    }
    let program = crate::bench::build(root)?;
    let mut counts = Vec::new();
    for row in &rows {
        counts.push(count(root, &program, row)?);
    }
    let mut off = 0;
    for (row, &count) in rows.iter().zip(&counts) {
        let change = count as f64 / row.expected as f64 - 1.0;
        let mark = if change.abs() <= WITHIN { "" } else { "  ← too far off" };
        off += usize::from(!mark.is_empty());
        let name = format!("{} {}", row.workload, row.contestant);
        say(&format!("{name:<36} {count:>12} {:>+8.2} %{mark}", 100.0 * change));
    }
    if bless {
        std::fs::write(&path, table(&text, &own, &rows, &counts))
            .map_err(|error| format!("{}: {error}", path.display()))?;
        say(&format!("written: {}", path.display()));
        return Ok(true);
    }
    if off > 0 {
        say(&format!(
            "{off} of {} counts are more than {} % off. If the change is meant, `cargo xtask instructions --bless` writes the new ones",
            rows.len(),
            100.0 * WITHIN
        ));
    }
    Ok(off == 0)
}

/// The compiler that the counts are of, and the rows.
fn read(text: &str) -> Result<(String, Vec<Row>), String> {
    let table = DeTable::parse(text).map_err(|error| error.message().to_owned())?.into_inner();
    let compiler = table.get("compiler").and_then(|value| value.get_ref().as_str()).unwrap_or("?").to_owned();
    let counts =
        table.get("instructions").and_then(|value| value.get_ref().as_table()).ok_or("no [instructions]")?;
    let row = |(key, value): (&toml::Spanned<_>, &toml::Spanned<toml::de::DeValue>)| {
        let name: &str = AsRef::<str>::as_ref(key.get_ref());
        let (workload, contestant) = name.split_once(' ')?;
        let number = value.get_ref().as_integer()?;
        let expected = u64::from_str_radix(number.as_str(), number.radix()).ok()?;
        Some(Row { workload: workload.to_owned(), contestant: contestant.to_owned(), expected })
    };
    let rows = counts
        .iter()
        .map(|(key, value)| row((key, value)).ok_or("a row that is no \"WORKLOAD CONTESTANT\" = COUNT"));
    let mut rows = rows.collect::<Result<Vec<Row>, _>>()?;
    rows.sort_by(|a, b| (&a.workload, &a.contestant).cmp(&(&b.workload, &b.contestant)));
    Ok((compiler, rows))
}

/// The table again, its head as it was.
fn table(old: &str, compiler: &str, rows: &[Row], counts: &[u64]) -> String {
    let head: Vec<&str> = old.lines().take_while(|line| line.starts_with('#')).collect();
    let mut text = format!("{}\ncompiler = \"{compiler}\"\n\n[instructions]\n", head.join("\n"));
    for (row, count) in rows.iter().zip(counts) {
        let _ = writeln!(text, "\"{} {}\" = {count}", row.workload, row.contestant);
    }
    text
}

/// The instructions of one repetition.
fn count(root: &Path, program: &PathBuf, row: &Row) -> Result<u64, String> {
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]);
    valgrind.arg("--toggle-collect=givens_contest::counted_repetition");
    valgrind.arg(program).arg(format!("count {}", row.contestant)).arg(&row.workload);
    valgrind.arg(root.join("benchmarks/inputs"));
    let out = valgrind.output().map_err(|error| format!("valgrind cannot be run ({error}): install it"))?;
    let words = String::from_utf8_lossy(&out.stderr);
    let collected =
        words.lines().find_map(|line| line.split_once("Collected : ")).map(|(_, count)| count.trim());
    match collected.and_then(|count| count.parse().ok()) {
        Some(count) if out.status.success() && count > 0 => Ok(count),
        _ => {
            let last = words.lines().rev().take(3).collect::<Vec<_>>().join(" | ");
            Err(format!("{} {}: no count: {last}", row.workload, row.contestant))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{read, table};

    #[test]
    fn the_table_is_read_and_written_again() {
        let text =
            "# head\ncompiler = \"rustc 1\"\n\n[instructions]\n\"P1 a\" = 7\n\"W1 sr-ckf packs\" = 12\n";
        let (compiler, rows) = read(text).unwrap();
        assert_eq!(
            (compiler.as_str(), rows[1].contestant.as_str(), rows[1].expected),
            ("rustc 1", "sr-ckf packs", 12)
        );
        assert_eq!(table(text, "rustc 1", &rows, &[7, 12]), text);
    }
}

//! The tables of docs/mutation.md, from the records and the reasons.

use super::explained::{self, Reason};
use super::group::GROUPS;
use super::outcome::{Outcome, Record};
use super::record_path;
use crate::say;
use core::fmt::Write;
use std::path::Path;

const BEGIN: &str = "<!-- cargo xtask mutants page -->";
const END: &str = "<!-- end -->";

/// Writes the page; whether every mutant that survives has its reason, and every reason its mutant.
pub fn write(root: &Path) -> Result<bool, String> {
    let reasons = explained::read(root)?;
    let path = root.join("docs/mutation.md");
    let told = |error: std::io::Error| format!("{}: {error}", path.display());
    let page = std::fs::read_to_string(&path).map_err(told)?;
    let (before, rest) = page.split_once(BEGIN).ok_or("docs/mutation.md: no place for the tables")?;
    let (_, after) = rest.split_once(END).ok_or("docs/mutation.md: the tables have no end")?;
    let records: Vec<Record> =
        GROUPS.iter().map(|group| Record::open(&record_path(root, group), false)).collect();
    let tables = format!("{}\n{}", outcomes(&records), survivors(&reasons));
    std::fs::write(&path, format!("{before}{BEGIN}\n\n{tables}\n{END}{after}")).map_err(told)?;
    Ok(agree(&records, &reasons))
}

/// Whether reasons and survivors are the same mutants; tells those that are not.
fn agree(records: &[Record], reasons: &[Reason]) -> bool {
    let mut agrees = true;
    for (group, record) in GROUPS.iter().zip(records) {
        let listed: Vec<&String> =
            reasons.iter().filter_map(|reason| reason.mutants.get(group.name)).flatten().collect();
        let unseen = |name: &str| record.outcomes.get(name).is_some_and(Outcome::unseen);
        for (name, _) in record.outcomes.iter().filter(|(_, outcome)| outcome.unseen()) {
            if !listed.contains(&name) {
                say(&format!("{}: no reason: {name}", group.name));
                agrees = false;
            }
        }
        for name in listed.into_iter().filter(|name| !unseen(name)) {
            say(&format!("{}: does not survive: {name}", group.name));
            agrees = false;
        }
    }
    agrees
}

fn outcomes(records: &[Record]) -> String {
    let mut text =
        "| mutated | sample | mutants | do not compile | in constants | fell | went on without end | survive |\n".to_owned();
    text.push_str("|---|---|--:|--:|--:|--:|--:|--:|\n");
    for (group, record) in GROUPS.iter().zip(records) {
        let count =
            |is: &dyn Fn(&Outcome) -> bool| record.outcomes.values().filter(|&outcome| is(outcome)).count();
        let sample = if group.every == 1 { "all".to_owned() } else { format!("1/{}", group.every) };
        let _ = writeln!(
            text,
            "| `{}` | {sample} | {} | {} | {} | {} | {} | {} |",
            group.files.trim_end_matches("/**"),
            record.outcomes.len(),
            count(&|outcome| *outcome == Outcome::Unviable),
            count(&|outcome| *outcome == Outcome::Constant),
            count(&|outcome| matches!(outcome, Outcome::Fell(_))),
            count(&|outcome| matches!(outcome, Outcome::Endless(_))),
            count(&Outcome::unseen),
        );
    }
    text
}

fn survivors(reasons: &[Reason]) -> String {
    let mut text = "| why it survives |".to_owned();
    for group in GROUPS {
        let _ = write!(text, " {} |", group.name);
    }
    text.push_str("\n|---|");
    text.push_str(&"--:|".repeat(GROUPS.len()));
    for reason in reasons {
        let _ = write!(text, "\n| {} |", reason.why);
        for group in GROUPS {
            let _ = write!(text, " {} |", reason.mutants.get(group.name).map_or(0, Vec::len));
        }
    }
    text.push('\n');
    text
}

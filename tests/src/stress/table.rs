//! The tables of docs/stress.md.

use super::{Case, Verdict};

/// A filter's verdicts along a ladder; none where nothing is determined, or it was not run.
pub struct Column {
    /// The filter.
    pub name: String,
    /// In `f64`; none if it does not run the case.
    pub double: Option<Vec<Option<Verdict>>>,
    /// In `f32`.
    pub single: Option<Vec<Option<Verdict>>>,
}

/// One row for each filter: how far it is right, and how it then fails.
#[must_use]
pub fn table(case: &Case, columns: &[Column]) -> String {
    let mut text = "| filter | f64 | f32 |\n|---|---|---|\n".to_owned();
    for column in columns {
        let of = |verdicts: &Option<Vec<Option<Verdict>>>| {
            verdicts.as_ref().map_or("–".to_owned(), |verdicts| cell(case, verdicts))
        };
        text += &format!("| {} | {} | {} |\n", column.name, of(&column.double), of(&column.single));
    }
    text
}

/// How far right, then the first failure of each kind.
#[must_use]
pub fn cell(case: &Case, verdicts: &[Option<Verdict>]) -> String {
    let judged: Vec<(f64, &Verdict)> = case
        .rungs
        .iter()
        .zip(verdicts)
        .filter_map(|(rung, verdict)| Some((rung.d, verdict.as_ref()?)))
        .collect();
    let Some(&(last, _)) = judged.last() else { return "–".to_owned() };
    let first = |kind: fn(&Verdict) -> bool| judged.iter().find(|(_, verdict)| kind(verdict));
    let mut failures: Vec<(f64, String)> = Vec::new();
    if let Some((d, _)) = first(|verdict| matches!(verdict, Verdict::Said(_))) {
        failures.push((*d, "says so".to_owned()));
    }
    if let Some((d, _)) = first(|verdict| *verdict == Verdict::NotANumber) {
        failures.push((*d, "NaN".to_owned()));
    }
    if let Some((d, Verdict::Doubted(error))) = first(|verdict| matches!(verdict, Verdict::Doubted(_))) {
        failures.push((*d, format!("doubted, and off by {error:.0e} σ")));
    }
    if let Some((d, Verdict::Wrong(error))) = first(|verdict| matches!(verdict, Verdict::Wrong(_))) {
        failures.push((*d, format!("**wrong**, by {error:.0e} σ")));
    }
    if failures.is_empty() {
        return format!("right to {last:.0e}");
    }
    let place = |d: f64| judged.iter().position(|(rung, _)| *rung == d);
    failures.sort_by_key(|(d, _)| place(*d));
    failures.iter().map(|(d, how)| format!("{d:.0e}: {how}")).collect::<Vec<_>>().join("; ")
}

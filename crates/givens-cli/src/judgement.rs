//! `--report`: a run judged by its own innovations, in words.

use crate::doubts;
use crate::figure;
use crate::gaps;
use crate::message::{Stop, count, digits};
use crate::plan::Plan;
use crate::report::Summary;
use givens::Doubtful;
use givens::metrics::{Consistency, InnovationSums, MeasureVerdict, Outlier, Verdict, chi_squared_cdf};
use givens::scalar::Shown;
use givens_io::{Page, Tone, Track};
use std::path::Path;

/// Fewer measured rows are too few to say that all is well.
const FEW: usize = 20;

/// Refuses a name that is none of a page.
pub fn check(path: &Path) -> Result<(), Stop> {
    let ending = path.extension().map_or(String::new(), |ending| ending.to_string_lossy().to_lowercase());
    match ending.as_str() {
        "html" | "htm" => Ok(()),
        _ => Err(Stop::input(format!("--report {}: the name must end in .html", path.display()))),
    }
}

/// The page about a run.
pub fn page(
    plan: &Plan,
    summary: &Summary,
    innovations: &InnovationSums,
    failures: &[String],
    shown: &[figure::Shown],
) -> Result<String, Stop> {
    let mut page = Page::new(&format!("{} by {}", plan.data, plan.choice.title()));
    let (tracks, model) = (plan.tracks.tracks.len(), &plan.model);
    page.say(
        Tone::Plain,
        &format!(
            "{} of {}, {} and {}; the model is {}. Log-likelihood {:.3}.",
            count(summary.rows, "row"),
            count(tracks, "track"),
            count(model.states.len(), "state"),
            count(model.measures(), "measure"),
            model.file,
            Shown(summary.log_likelihood)
        ),
    );
    for failure in failures {
        page.say(Tone::Look, failure);
    }
    let [measured, ..] = innovations.rows();
    page.heading("Are the errors as large as the filter says?");
    let (tone, words) = size(&summary.consistency);
    page.say(tone, &words);
    if measured > 0 {
        if measured < FEW {
            let rows = count(measured, "measured row");
            page.say(Tone::Look, &format!("{rows} to judge by are few: what is told as good may be chance."));
        }
        measures(&mut page, plan, innovations);
        outliers(&mut page, plan, innovations)?;
    }
    page.heading("Are the numbers those of the method?");
    doubts(&mut page, plan, &summary.doubts);
    gaps::tell(&mut page, plan)?;
    if !shown.is_empty() {
        page.heading("The run");
        let svg = figure::draw(Path::new("report.svg"), plan, shown)?;
        page.figure(&String::from_utf8_lossy(&svg));
    }
    Ok(page.finish())
}

/// What of the answers may be wrong by rounding, or by steps that are too long.
fn doubts(page: &mut Page, plan: &Plan, found: &[Doubtful]) {
    let told = doubts::all(plan, &plan.choice, found);
    for told in &told {
        page.say(Tone::Look, told);
    }
    if told.is_empty() {
        page.say(Tone::Plain, "No digits were lost, and no step was too long, where that was looked at.");
    }
}

/// The mean NIS in words.
fn size(consistency: &Consistency) -> (Tone, String) {
    let Consistency { ratio, band, .. } = *consistency;
    let of = format!(
        "mean NIS is {ratio:.3} per degree of freedom, of a right model {:.3} to {:.3} (95 %)",
        band.0, band.1
    );
    let each = "below stands what each measure says of it";
    match consistency.verdict() {
        Verdict::Unknown => (Tone::Look, "Nothing was measured: there is nothing to judge by.".to_owned()),
        Verdict::Consistent => (Tone::Good, format!("Yes: {of}.")),
        Verdict::Overconfident => {
            (Tone::Look, format!("They are larger: {of}. The filter trusts itself too much; {each}."))
        }
        Verdict::Underconfident => {
            (Tone::Look, format!("They are smaller: {of}. The filter could be more precise; {each}."))
        }
    }
}

/// A table of the measures, and what is wrong with each.
fn measures(page: &mut Page, plan: &Plan, innovations: &InnovationSums) {
    page.heading("Measures");
    let names: Vec<String> = plan
        .model
        .sensors
        .iter()
        .flat_map(|sensor| sensor.columns.iter().map(|column| format!("{column} of {}", sensor.name)))
        .collect();
    let found = innovations.measures();
    let known: Vec<(&String, MeasureVerdict)> =
        names.iter().zip(found).filter(|(_, found)| found.count > 0).collect();
    let row = |(name, found): &(&String, MeasureVerdict)| {
        let correlation =
            if found.pairs == 0 { "–".to_owned() } else { format!("{:.3}", found.correlation) };
        let numbers = [
            found.count.to_string(),
            format!("{:.3}", found.mean),
            format!("{:.3}", found.mean_square),
            correlation,
        ];
        core::iter::once((*name).clone()).chain(numbers).collect()
    };
    page.say(
        Tone::Plain,
        "Innovations in their own standard deviations: of a right model their mean is 0, their mean square 1, and each is \
         independent of the one before.",
    );
    let header = ["measure", "innovations", "mean", "mean square", "correlation with the next"];
    page.table(&header, &known.iter().map(row).collect::<Vec<_>>());
    let mut good = true;
    for (name, found) in &known {
        for words in wrong(found) {
            good = false;
            page.say(Tone::Look, &format!("{name}: {words}"));
        }
    }
    if good && !known.is_empty() {
        page.say(
            Tone::Good,
            "No measure is biased, of another size than told, or foretells its next innovation.",
        );
    }
}

/// What is wrong with a measure.
fn wrong(found: &MeasureVerdict) -> Vec<String> {
    let mut words = Vec::new();
    if found.is_biased() {
        let mean = found.mean;
        words.push(format!(
            "it is biased by {mean:.2} of its standard deviations; look for an offset of the sensor, or add one to the state."
        ));
    }
    if found.is_correlated() {
        let how = if found.correlation > 0.0 { "with its sign" } else { "with the other sign" };
        let is_small = found.mean_square < 1.0 && found.is_of_other_size();
        let what = match (found.correlation > 0.0, is_small) {
            (true, false) => {
                "the state moves otherwise than the model says (more process noise), or the sensor's errors last"
            }
            (true, true) => "its noise is told too large",
            (false, false) => "its noise is told too small, or the process noise too large beside it",
            (false, true) => "the process noise is told too large",
        };
        words.push(format!(
            "an innovation foretells the next, {how} (correlation {:.2}): {what}.",
            found.correlation
        ));
    }
    if found.is_of_other_size() && !found.is_correlated() {
        let factor = found.mean_square.sqrt();
        words.push(format!(
            "its innovations are {factor:.2} times as large as told; if the motion is right, its std wants about that factor, or \
             somewhat {}.",
            if factor > 1.0 { "more" } else { "less" }
        ));
    }
    words
}

/// Rows that stand out.
fn outliers(page: &mut Page, plan: &Plan, innovations: &InnovationSums) -> Result<(), Stop> {
    page.heading("Outliers");
    let [rows, beyond, far] = innovations.rows();
    let expected = 1e-4 * rows as f64;
    // so far out that of so many rows of a right model one is there once in a thousand times
    let tail = |row: &Outlier| 1.0 - chi_squared_cdf(row.dof as f64, row.nis);
    let is_gross = innovations.worst().first().is_some_and(|worst| rows as f64 * tail(worst) < 1e-3);
    let many = far as f64 > 1.0 + expected + 5.0 * expected.sqrt();
    let tone = if is_gross || many { Tone::Look } else { Tone::Good };
    let percent = 100.0 * beyond as f64 / rows.max(1) as f64;
    // 5 % are expected, and those far out come on top
    let few = percent < 8.0 || beyond <= far + 1;
    let remedy = match (plan.choice.gate, tone, few) {
        (None, Tone::Look, true) => {
            " A gate (--set gate=0.9999) leaves them out, marked and counted; where rows beyond it follow each other, the \
             filter is lost and not the rows."
        }
        (_, Tone::Look, false) => {
            " So many are no outliers: the model is wrong, and a gate would lose the track."
        }
        _ => "",
    };
    let expected = if expected < 0.1 { "less than 0.1".to_owned() } else { format!("{expected:.1}") };
    page.say(
        tone,
        &format!(
            "{far} of {} lie beyond the quantile 0.9999 of NIS, where {expected} would be expected; beyond 0.95 lie \
             {percent:.1} %.{remedy}",
            count(rows, "measured row")
        ),
    );
    let row = |outlier: &Outlier| {
        let track = &plan.tracks.tracks[outlier.track];
        let row = track.rows.row(outlier.row)?;
        let used = if outlier.gated { "not taken in" } else { "taken in" };
        Ok(vec![
            row.as_ref().map_or(String::new(), |row| place(plan, track, row.line)),
            row.map_or(String::new(), |row| row.time_text),
            digits(outlier.nis),
            outlier.dof.to_string(),
            used.to_owned(),
        ])
    };
    let worst = innovations.worst().iter().map(row).collect::<Result<Vec<_>, Stop>>()?;
    page.table(&["row", "time", "NIS", "degrees of freedom", "it was"], &worst);
    Ok(())
}

/// A line of the table, and its track.
pub fn place(plan: &Plan, track: &Track, line: usize) -> String {
    let name = track.id.as_ref().map_or(String::new(), |id| format!(" (track {id})"));
    format!("{}:{line}{name}", plan.data)
}

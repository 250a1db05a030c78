//! A section of the page: the figure, and its numbers.

use super::drawing::faster;
use super::study::{Besides, Study};
use core::fmt::Write;
use givens_contest::{Spread, duration};

/// The study's, from its heading on.
pub fn section(study: &Study) -> String {
    let Study { title, about, name, x, y, .. } = study;
    let mut text = format!("## {title}\n\n{about}\n\n![{title}](images/scaling-{name}.svg)\n\n");
    let mut head: Vec<String> = vec![(*x).to_owned()];
    head.extend(study.series.iter().map(|series| series.name.to_owned()));
    match study.besides {
        Besides::Nothing => {}
        Besides::Cube => {
            let first = study.series.first().map_or("", |series| series.name);
            head.push(format!("{first} / n³"));
            head.extend(study.guides.first().map(|_| format!("{first} / the textbook's operations")));
        }
        Besides::SpeedUp => {
            let names =
                study.series.iter().map(|series| format!("{}: times as fast, efficiency", series.name));
            head.extend(names);
        }
    }
    let _ = writeln!(text, "| {} |\n|{}", head.join(" | "), "--:|".repeat(head.len()));
    for x in study.sizes() {
        let mut cells = vec![x.to_string()];
        cells.extend(study.series.iter().map(|series| series.at(x).map_or("–".to_owned(), cell)));
        cells.extend(besides(study, x));
        let _ = writeln!(text, "| {} |", cells.join(" | "));
    }
    let _ = writeln!(text, "\nMedian time of {y}, ± half of what lies between the quartiles.\n");
    text
}

fn cell(time: &Spread) -> String {
    let half = 50.0 * (time.upper - time.lower) / time.median;
    format!("{} ±{half:.1} %", duration(time.median))
}

/// What the study has besides the times, at one size.
fn besides(study: &Study, x: usize) -> Vec<String> {
    let size = x as f64;
    match study.besides {
        Besides::Nothing => Vec::new(),
        Besides::Cube => {
            let Some(time) = study.series.first().and_then(|series| series.at(x)) else { return Vec::new() };
            let over = |guide: &super::study::Guide| Some(time.median / (guide.at)(&study.series, x)?);
            let by = |guide| over(guide).map_or("–".to_owned(), |ratio| format!("{ratio:.1}"));
            let cube = format!("{:.2} ns", time.median / size.powi(3));
            core::iter::once(cube).chain(study.guides.first().map(by)).collect()
        }
        Besides::SpeedUp => {
            let one =
                |series| faster(series, x).map(|times| format!("{times:.2}, {:.0} %", 100.0 * times / size));
            study.series.iter().map(|series| one(series).unwrap_or_default()).collect()
        }
    }
}

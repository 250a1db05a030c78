//! `givens-benchmarks 'scaling ROUNDS [STUDY,…]' FIGURES INPUTS`: what a step costs as something grows. Figures go into the folder
//! FIGURES, the tables to stdout.

mod drawing;
mod measure;
mod page;
mod peak;
mod states;
mod study;
mod substeps;
mod threads;
mod tracks;

use givens_contest::{Failure, Inputs};
use std::io::{Write, stderr, stdout};
use std::path::Path;
use study::Study;

type Make = fn(&Inputs) -> Result<Study, Failure>;

const STUDIES: [(&str, Make); 4] = [
    ("states", states::study),
    ("tracks", tracks::study),
    ("threads", threads::study),
    ("substeps", substeps::study),
];

/// The cores that this process may use.
fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, core::num::NonZeroUsize::get)
}

/// Measures, draws and writes the studies; all of them if none is named.
pub fn run(wanted: &str, inputs: &Inputs, figures: &Path) -> Result<(), Failure> {
    let mut words = wanted.split(' ');
    let rounds: usize = words.next().unwrap_or_default().parse()?;
    let only: Vec<&str> = words.next().map(|names| names.split(',').collect()).unwrap_or_default();
    let known = STUDIES.map(|(name, _)| name);
    if let Some(name) = only.iter().find(|name| !known.contains(name)) {
        return Err(format!("no study `{name}`; there are {}", known.join(", ")).into());
    }
    for (name, make) in STUDIES {
        if !only.is_empty() && !only.contains(&name) {
            continue;
        }
        let mut study = make(inputs)?;
        let _ = writeln!(stderr(), "{}", study.title);
        measure::measure(&mut study, rounds)?;
        let file = format!("scaling-{}.svg", study.name);
        givens_io::figure::write(figures.join(&file), &drawing::figure(&study))?;
        write!(stdout().lock(), "{}", page::section(&study))?;
    }
    Ok(())
}

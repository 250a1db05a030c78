//! What an experiment answers with, and the files that it becomes.

use crate::claim::shown;
use crate::{Claim, Experiment, Paper};
use core::fmt::Write as _;
use givens_io::figure::{Figure, FigureError, png, svg};

/// The answer of an experiment.
#[derive(Clone, Debug, Default)]
pub struct Page {
    /// What was run, in a few sentences: runs, options, what differs from the paper.
    pub about: String,
    /// Every published number and statement, judged.
    pub claims: Vec<Claim>,
    /// The numbers in full.
    pub tables: Vec<Table>,
    /// By name.
    pub figures: Vec<(&'static str, Figure)>,
    /// What failed or was lost, by method and form.
    pub failures: Vec<(String, crate::Failures)>,
    /// What `failures` counts; empty: runs lost.
    pub failing: &'static str,
}

/// Numbers in columns.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Of the file.
    pub name: &'static str,
    /// The columns' names.
    pub columns: Vec<String>,
    /// As long as `columns`.
    pub rows: Vec<Vec<Cell>>,
}

/// One cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// A number; one that is not finite is left empty.
    Number(f64),
    /// A word.
    Word(String),
}

impl From<f64> for Cell {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}

impl From<usize> for Cell {
    fn from(x: usize) -> Self {
        Self::Number(x as f64)
    }
}

impl From<&str> for Cell {
    fn from(word: &str) -> Self {
        Self::Word(word.to_owned())
    }
}

impl From<String> for Cell {
    fn from(word: String) -> Self {
        Self::Word(word)
    }
}

impl Table {
    /// A table without rows.
    pub fn new(name: &'static str, columns: &[&str]) -> Self {
        Self { name, columns: columns.iter().map(|&c| c.to_owned()).collect(), rows: Vec::new() }
    }

    /// In comma-separated values, numbers so that they read back exactly.
    pub fn csv(&self) -> String {
        let columns: Vec<String> = self.columns.iter().map(|name| quoted(name)).collect();
        let mut text = columns.join(",") + "\n";
        for row in &self.rows {
            let cells: Vec<String> = row.iter().map(Cell::exact).collect();
            text += &(cells.join(",") + "\n");
        }
        text
    }
}

impl Cell {
    fn exact(&self) -> String {
        match self {
            Self::Number(x) if x.is_finite() => format!("{x}"),
            Self::Number(_) => String::new(),
            Self::Word(word) => quoted(word),
        }
    }

    fn short(&self) -> String {
        match self {
            Self::Number(x) if !x.is_finite() => "–".to_owned(),
            Self::Number(x) if x.fract() == 0.0 && x.abs() < 1e6 => format!("{x}"),
            Self::Number(x) => shown(*x),
            Self::Word(word) => word.clone(),
        }
    }
}

/// A word as one cell of a CSV.
fn quoted(word: &str) -> String {
    if word.contains([',', '"', '\n']) {
        format!("\"{}\"", word.replace('"', "\"\""))
    } else {
        word.to_owned()
    }
}

/// A file that a page becomes.
#[derive(Clone, Debug)]
pub struct File {
    /// Relative to the folder that all go to.
    pub path: String,
    /// Its bytes.
    pub contents: Vec<u8>,
}

/// Tables of more columns than this, such as curves over time, stand in their file alone.
const WIDEST: usize = 12;

impl Page {
    /// The Markdown page, a CSV for each table, an SVG and a PNG for each figure; `command` is what makes them.
    ///
    /// # Errors
    /// A picture that the machine cannot hold.
    pub fn files(
        &self,
        paper: &Paper,
        experiment: &Experiment,
        command: &str,
    ) -> Result<Vec<File>, FigureError> {
        let stem = format!("{}/{}", paper.key, experiment.name);
        let mut files = vec![File {
            path: format!("{stem}.md"),
            contents: self.text(paper, experiment, command).into_bytes(),
        }];
        for table in &self.tables {
            let path = format!("{stem}-{}.csv", table.name);
            files.push(File { path, contents: table.csv().into_bytes() });
        }
        for (name, figure) in &self.figures {
            files.push(File { path: format!("{stem}-{name}.svg"), contents: svg(figure).into_bytes() });
            files.push(File { path: format!("{stem}-{name}.png"), contents: png(figure)? });
        }
        Ok(files)
    }

    /// The Markdown page.
    pub fn text(&self, paper: &Paper, experiment: &Experiment, command: &str) -> String {
        let mut text =
            format!("# {}\n\n{}\n\n{MADE}{command}`.\n\n{}\n", experiment.shows, paper.citation, self.about);
        if !self.claims.is_empty() {
            text += "\n";
            text += HEAD;
            text += "|---|---|---|---|\n";
            for claim in &self.claims {
                text += &row(claim);
            }
        }
        let failing = if self.failing.is_empty() { "Runs lost" } else { self.failing };
        for (method, failures) in &self.failures {
            let _ = write!(text, "\n{failing}, {method}: {failures}.\n");
        }
        for (name, _) in &self.figures {
            let _ = write!(text, "\n![{name}]({}-{name}.svg)\n", experiment.name);
        }
        for table in &self.tables {
            let _ = write!(text, "\n[{0}]({1}-{0}.csv)\n", table.name, experiment.name);
            if table.columns.len() <= WIDEST {
                let _ = write!(
                    text,
                    "\n| {} |\n|{}\n",
                    table.columns.join(" | "),
                    "---|".repeat(table.columns.len())
                );
                for row in &table.rows {
                    let cells: Vec<String> = row.iter().map(Cell::short).collect();
                    let _ = writeln!(text, "| {} |", cells.join(" | "));
                }
            }
        }
        text
    }
}

fn row(claim: &Claim) -> String {
    let remark = if claim.remark.is_empty() { String::new() } else { format!(" — {}", claim.remark) };
    format!("| {} | {} | {} | {}{remark} |\n", claim.what, claim.published, claim.ours, claim.verdict)
}

/// Before the command that made a page.
const MADE: &str = "Made by `";
/// Of the table of claims.
const HEAD: &str = "| | published | ours | |\n";

/// The page that lists all others, with every claim: from their texts, in the order given.
pub fn index(pages: &[(&Paper, &Experiment, String)]) -> File {
    let mut text = format!("# Five papers, run again\n\n{LEGEND}\n");
    let mut last = "";
    for (paper, experiment, page) in pages {
        if paper.key != last {
            let _ = write!(text, "\n## {}\n\n{}\n", paper.key, paper.citation);
            last = paper.key;
        }
        let _ = write!(text, "\n### [{}]({}/{}.md)\n", experiment.shows, paper.key, experiment.name);
        if let Some(made) = page.lines().find(|line| line.starts_with(MADE)) {
            let _ = write!(text, "\n{made}\n");
        }
        if let Some(at) = page.find(HEAD) {
            text += "\n";
            for row in page[at..].lines().take_while(|line| line.starts_with('|')) {
                let _ = writeln!(text, "{row}");
            }
        }
    }
    File { path: "index.md".to_owned(), contents: text.into_bytes() }
}

const LEGEND: &str = "Ours stand with the standard deviation of one replication of the size that was run. *Within*: the \
published number and ours are no further apart than 3 standard deviations of the difference of two such samples (for \
counts: by Fisher's exact test); *differs*: they are. A statement *holds* or *does not hold* if what decides it lies further \
than 2 standard errors from its bound, 3 where many are compared; else it is *undecided*. Errors are compared on the runs \
that both methods kept, losses on those that one of them lost alone.";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PAPERS, Verdict};

    /// Cells of a line of CSV, by its quotes.
    fn cells(line: &str) -> usize {
        let outside = line.split('"').step_by(2);
        1 + outside.map(|part| part.matches(',').count()).sum::<usize>()
    }

    #[test]
    fn a_header_has_as_many_cells_as_the_rows() {
        let mut table = Table::new("t", &["position, m", "a \"word\", and", "plain"]);
        table.rows.push(vec!["one, two".into(), 2.5.into(), f64::NAN.into()]);
        let csv = table.csv();
        assert_eq!(csv.lines().map(cells).collect::<Vec<_>>(), [3, 3]);
        assert_eq!(csv, "\"position, m\",\"a \"\"word\"\", and\",plain\n\"one, two\",2.5,\n");
    }

    #[test]
    fn an_index_has_each_page_with_its_own_command() {
        let (paper, page) = (&PAPERS[0], |what: &str| Page {
            claims: vec![Claim::statement(what, "ours", Verdict::Holds)],
            ..Page::default()
        });
        let of = |k: usize, command: &str| {
            let experiment = &paper.experiments[k];
            (paper, experiment, page(&format!("claim {k}")).text(paper, experiment, command))
        };
        let index = String::from_utf8(index(&[of(0, "first"), of(1, "second")]).contents).unwrap();
        for wanted in ["Made by `first`.", "Made by `second`.", "| claim 0 |", "| claim 1 |"] {
            assert_eq!(index.matches(wanted).count(), 1, "{wanted}: {index}");
        }
        assert_eq!(index.matches(paper.citation).count(), 1);
    }
}

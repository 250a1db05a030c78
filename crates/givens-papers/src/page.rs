//! What an experiment answers with, and the files that it becomes.

use crate::judge::shown;
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
    /// Runs that failed or were lost, by method.
    pub failures: Vec<(String, crate::Failures)>,
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
        let mut text = self.columns.join(",") + "\n";
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
            Self::Word(word) if word.contains([',', '"']) => format!("\"{}\"", word.replace('"', "\"\"")),
            Self::Word(word) => word.clone(),
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

/// A file that a page becomes.
#[derive(Clone, Debug)]
pub struct File {
    /// Relative to the folder that all go to.
    pub path: String,
    /// Its bytes.
    pub contents: Vec<u8>,
}

/// Tables longer than this stand in their file alone.
const LONGEST: usize = 40;

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
            contents: self.markdown(paper, experiment, command).into_bytes(),
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

    fn markdown(&self, paper: &Paper, experiment: &Experiment, command: &str) -> String {
        let mut text = format!(
            "# {}\n\n{}\n\nMade by `{command}`.\n\n{}\n",
            experiment.shows, paper.citation, self.about
        );
        if !self.claims.is_empty() {
            text += "\n| | published | ours | |\n|---|---|---|---|\n";
            for claim in &self.claims {
                text += &row(claim);
            }
        }
        for (method, failures) in &self.failures {
            let _ = write!(text, "\nRuns lost, {method}: {failures}.\n");
        }
        for (name, _) in &self.figures {
            let _ = write!(text, "\n![{name}]({}-{name}.svg)\n", experiment.name);
        }
        for table in &self.tables {
            let _ = write!(text, "\n[{0}]({1}-{0}.csv)\n", table.name, experiment.name);
            if table.rows.len() <= LONGEST {
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

/// The page that lists all others, with every claim.
pub fn index(pages: &[(&Paper, &Experiment, Page)], command: &str) -> File {
    let mut text = format!("# Five papers, run again\n\nMade by `{command}`.\n\n{LEGEND}\n");
    let mut last = "";
    for (paper, experiment, page) in pages {
        if paper.key != last {
            let _ = write!(text, "\n## {}\n\n{}\n", paper.key, paper.citation);
            last = paper.key;
        }
        let _ = write!(text, "\n### [{}]({}/{}.md)\n", experiment.shows, paper.key, experiment.name);
        if !page.claims.is_empty() {
            text += "\n| | published | ours | |\n|---|---|---|---|\n";
            page.claims.iter().for_each(|claim| text += &row(claim));
        }
    }
    File { path: "index.md".to_owned(), contents: text.into_bytes() }
}

const LEGEND: &str = "Ours stand with the standard deviation of one replication of the size that was run. *Within*: the \
published number and ours are no further apart than 3 standard deviations of the difference of two such samples (for \
counts: by Fisher's exact test); *differs*: they are.";

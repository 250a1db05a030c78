//! The papers and their experiments.

use crate::{Page, Plan};

/// A paper whose experiments are run again.
#[derive(Debug)]
pub struct Paper {
    /// Its name on the command line: first author, year, a word.
    pub key: &'static str,
    /// Authors, title, journal, year.
    pub citation: &'static str,
    /// Its experiments, in the paper's order.
    pub experiments: &'static [Experiment],
}

/// A table or figure of a paper.
pub struct Experiment {
    /// Its name on the command line.
    pub name: &'static str,
    /// The table or figure, and what it shows.
    pub shows: &'static str,
    /// The paper's own number of runs; zero where nothing is drawn.
    pub runs: usize,
    /// What it keeps of a run until the end, in bytes, rounded up.
    pub(crate) bytes: usize,
    pub(crate) with: Run,
}

/// What runs an experiment.
pub(crate) type Run = fn(&Plan) -> Result<Page, Trouble>;

/// All runs together may keep so much, in bytes.
const MEMORY: usize = 2 << 30;

impl Experiment {
    /// The largest number of runs that memory is set aside for: 2 GiB for what is kept of them.
    pub fn most(&self) -> usize {
        MEMORY / self.bytes.max(1)
    }

    /// Runs it.
    ///
    /// # Errors
    /// More runs than [`most`](Self::most), or a setting that cannot be run at all.
    pub fn run(&self, plan: &Plan) -> Result<Page, Trouble> {
        match plan.runs {
            Some(runs) if self.runs > 0 && runs > self.most() => {
                Err(format!("{runs} runs are more than memory is set aside for ({})", self.most()).into())
            }
            _ => (self.with)(plan),
        }
    }
}

impl core::fmt::Debug for Experiment {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Experiment").field("name", &self.name).finish_non_exhaustive()
    }
}

/// Why an experiment could not be run at all. A run that fails is no trouble: it is counted.
pub type Trouble = Box<dyn core::error::Error + Send + Sync>;

/// All papers, by year.
pub const PAPERS: &[Paper] = &[
    crate::arasaratnam2009cubature::PAPER,
    crate::arasaratnam2010continuous::PAPER,
    crate::arasaratnam2011smoothers::PAPER,
    crate::sarkka2012continuous::PAPER,
    crate::wang2021levelset::PAPER,
];

/// Why there is no such paper or experiment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refused {
    /// No paper of this key.
    Paper {
        /// As given.
        key: String,
        /// Those there are.
        known: Vec<&'static str>,
    },
    /// No experiment of this name in the papers asked for.
    Experiment {
        /// As given.
        name: String,
        /// Those there are.
        known: Vec<&'static str>,
    },
}

/// The experiments of a paper, or of `all`; with `only`, the one of this name.
///
/// # Errors
/// A key or a name that is not known.
///
/// ```
/// let table = givens_papers::find("arasaratnam2011smoothers", Some("table-4")).unwrap();
/// assert_eq!(table.len(), 1);
/// assert!(givens_papers::find("arasaratnam2011", None).is_err());
/// ```
pub fn find(key: &str, only: Option<&str>) -> Result<Vec<(&'static Paper, &'static Experiment)>, Refused> {
    let papers: Vec<&'static Paper> =
        PAPERS.iter().filter(|paper| key == "all" || paper.key == key).collect();
    if papers.is_empty() {
        let known = core::iter::once("all").chain(PAPERS.iter().map(|paper| paper.key)).collect();
        return Err(Refused::Paper { key: key.to_owned(), known });
    }
    let all =
        papers.iter().flat_map(|&paper| paper.experiments.iter().map(move |experiment| (paper, experiment)));
    let found: Vec<_> = all.clone().filter(|(_, e)| only.is_none_or(|name| e.name == name)).collect();
    match only {
        Some(name) if found.is_empty() => {
            let mut known: Vec<_> = all.map(|(_, e)| e.name).collect();
            known.sort_unstable();
            known.dedup();
            Err(Refused::Experiment { name: name.to_owned(), known })
        }
        _ => Ok(found),
    }
}

//! `givens filter` and `givens smooth` over many files: each becomes a file of its own, several at a time.

use crate::args::FilterArgs;
use crate::checkpoint::{self, Checkpoint};
use crate::commands::filter::Done;
use crate::files::is_standard;
use crate::message::{Stop, count, doubt, say};
use crate::plan;
use crate::progress::Progress;
use core::num::NonZeroUsize;
use core::sync::atomic::{AtomicUsize, Ordering};
use givens::scalar::Shown;
use givens_io::{Format, list_files, make_folder};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::thread::{available_parallelism, scope};
use std::time::Instant;

/// Failures that are named; of the others the number.
const NAMED: usize = 20;
/// Doubts that are told.
const DOUBTS: usize = 3;

/// What came of the files so far.
#[derive(Default)]
struct Come {
    tracks: usize,
    rows: usize,
    /// Of each file, by its name: their sum does not depend on which was done first.
    log_likelihoods: BTreeMap<String, f64>,
    failures: Vec<String>,
    failed: usize,
    /// What is doubtful about answers, in words, and of how many files.
    doubts: Vec<String>,
    doubtful: usize,
    /// Files that were not read, in words.
    refused: Vec<String>,
}

/// Length and time of the last change of a file.
type State = (u64, u128);

/// A file that is done, and its answers, as a checkpoint keeps it.
#[derive(Serialize, Deserialize)]
struct File {
    name: String,
    state: State,
    answers: State,
    tracks: usize,
    rows: usize,
    log_likelihood: f64,
    failures: Vec<String>,
    doubts: Vec<String>,
}

/// The files that `data` stands for, if it is a folder or a pattern.
pub fn files(data: &str) -> Result<Option<Vec<PathBuf>>, Stop> {
    Ok(list_files(data, &["parquet", "csv"])?)
}

/// A file that is to be run, where its answers go, and its [`state`].
type Left<'f> = (&'f PathBuf, &'f PathBuf, State);

/// Runs `one` over each file, into the folder of `-o`.
pub fn run(
    args: &FilterArgs,
    files: &[PathBuf],
    task: &str,
    format: impl Fn(Option<&Path>) -> Result<Format, Stop>,
    one: impl Fn(&FilterArgs, &AtomicUsize) -> Result<Done, Stop> + Sync,
) -> Result<(), Stop> {
    let folder = folder(args)?;
    if let Some(file) = files.iter().find(|file| file.to_str().is_none()) {
        let stop = Stop::input(format!("{}: the name of this file is not UTF-8", file.display()));
        return Err(stop.help("rename it"));
    }
    for (given, option) in [
        (args.truth.is_some(), "--truth"),
        (!args.plots.is_empty(), "--plot"),
        (args.report.is_some(), "--report"),
    ] {
        if given {
            return Err(Stop::input(format!("{option} is for one table, and {} is of several", args.data)));
        }
    }
    // what is wrong with the model is told once, before any file is read
    let model = plan::model(&args.model)?;
    let choice = crate::method::chosen(&model, &args.method)?;
    let outputs = outputs(args, files, folder, &format)?;
    make_folder(folder).map_err(|error| Stop::input(error.to_string()))?;
    let whole = folder.join("run");
    Checkpoint::check(Some(&whole), args.resume.is_some())?;
    let (mut kept, mut before) = (None, Vec::new());
    if let Some(every) = args.resume {
        let identity = checkpoint::of_files(args, &model, &choice, task);
        let (checkpoint, done) = Checkpoint::open::<File>(&whole, identity, every)?;
        (kept, before) = (Some(checkpoint), done);
    }
    let (mut come, left) = left(files, &outputs, before);
    if left.len() < files.len() {
        let done = files.len() - left.len();
        say(&format!("goes on: {done} of {} were done before", count(files.len(), "file")));
    }
    let begun = Instant::now();
    let cores = args.threads.or_else(|| available_parallelism().ok()).map_or(1, NonZeroUsize::get);
    each(args, &left, cores, &mut come, kept.as_mut(), one)?;
    let per_core = come.rows as f64 / begun.elapsed().as_secs_f64().max(1e-9) / cores as f64;
    let rate = match left.len() {
        all if all == files.len() => format!(", {per_core:.0} rows a second of a core"),
        _ => String::new(),
    };
    say(&format!(
        "{}: {} of {} in {}, log-likelihood {:.3}{rate}",
        choice.title(),
        count(come.rows, "row"),
        count(come.tracks, "track"),
        count(files.len() - come.refused.len(), "file"),
        Shown(come.log_likelihoods.values().sum()),
    ));
    doubt(&come.doubts);
    if come.doubtful > 1 {
        doubt(&[format!("{} have doubtful answers", count(come.doubtful, "file"))]);
    }
    if come.refused.is_empty() {
        kept.into_iter().for_each(Checkpoint::remove);
    }
    come.end()
}

/// What another run has done, and what is left to do.
fn left<'f>(files: &'f [PathBuf], outputs: &'f [PathBuf], mut before: Vec<File>) -> (Come, Vec<Left<'f>>) {
    let (mut come, mut left) = (Come::default(), Vec::new());
    for (file, output) in files.iter().zip(outputs) {
        let (name, own, answers) = (file.display().to_string(), state(file), state(output));
        let done = |of: &File| of.name == name && (of.state, of.answers) == (own, answers);
        match before.iter().position(done) {
            Some(k) => come.add(before.swap_remove(k)),
            None => left.push((file, output, own)),
        }
    }
    (come, left)
}

/// Runs `one` over each of the files, as many at a time as there are cores.
fn each(
    args: &FilterArgs,
    left: &[Left],
    cores: usize,
    come: &mut Come,
    kept: Option<&mut Checkpoint>,
    one: impl Fn(&FilterArgs, &AtomicUsize) -> Result<Done, Stop> + Sync,
) -> Result<(), Stop> {
    let workers = cores.min(left.len()).max(1);
    let threads = NonZeroUsize::new((cores / workers).max(1));
    let (next, rows) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let shared = Mutex::new((come, kept, None));
    let work = |done: &AtomicUsize| {
        while let Some((file, output, own)) = left.get(next.fetch_add(1, Ordering::Relaxed)) {
            let name = file.display().to_string();
            let (data, to) = (name.clone(), Some((*output).clone()));
            let came = one(&FilterArgs { data, output: to, resume: None, threads, ..args.clone() }, &rows);
            let mut shared = shared.lock().unwrap_or_else(PoisonError::into_inner);
            let (come, kept, stop) = &mut *shared;
            match came {
                Ok(Done { tracks, rows, log_likelihood, failures, doubts }) => {
                    let (state, answers) = (*own, state(output));
                    let file = File { name, state, answers, tracks, rows, log_likelihood, failures, doubts };
                    if let Some(Err(error)) = kept.as_mut().map(|kept| kept.append(&file)) {
                        *stop = Some(Stop::failed(error.to_string()));
                        next.store(left.len(), Ordering::Relaxed);
                    }
                    come.add(file);
                }
                Err(refused) => come.refused.push(refused.message),
            }
            done.fetch_add(1, Ordering::Relaxed);
        }
    };
    Progress::of_files(left.len()).during(|done| {
        scope(|scope| {
            for _ in 1..workers {
                scope.spawn(|| work(done));
            }
            work(done);
        });
    });
    shared.into_inner().unwrap_or_else(PoisonError::into_inner).2.map_or(Ok(()), Err)
}

impl Come {
    fn add(&mut self, file: File) {
        self.tracks += file.tracks;
        self.rows += file.rows;
        self.log_likelihoods.insert(file.name, file.log_likelihood);
        self.failed += file.failures.len();
        let room = NAMED.saturating_sub(self.failures.len());
        self.failures.extend(file.failures.into_iter().take(room));
        self.doubtful += usize::from(!file.doubts.is_empty());
        let room = DOUBTS.saturating_sub(self.doubts.len());
        self.doubts.extend(file.doubts.into_iter().take(room));
    }

    fn end(mut self) -> Result<(), Stop> {
        if self.failed > self.failures.len() {
            let more = self.failed - self.failures.len();
            self.failures.push(format!("{} failed besides", count(more, "track")));
        }
        match (self.refused.is_empty(), self.failures.is_empty()) {
            (true, true) => Ok(()),
            (true, false) => Err(Stop::failures(&self.failures)),
            (false, _) => {
                let failures = self.failures.iter().map(|failure| format!("error: {failure}"));
                let all: Vec<String> = self.refused.iter().cloned().chain(failures).collect();
                Err(Stop { message: all.join("\n"), code: 1 })
            }
        }
    }
}

/// The folder of `-o`.
fn folder(args: &FilterArgs) -> Result<&Path, Stop> {
    let help = "name a folder, in which each file gets one of its own: -o answers";
    match args.output.as_deref() {
        Some(folder) if is_standard(folder) || folder.is_file() => {
            let message = format!("-o {}: of several tables the answers are several files", folder.display());
            Err(Stop::input(message).help(help))
        }
        Some(folder) => Ok(folder),
        None => {
            let message = format!("{} is of several tables, and there is no -o", args.data);
            Err(Stop::input(message).help(help))
        }
    }
}

/// Where the answers of each file go: the same name, with the ending of the format.
fn outputs(
    args: &FilterArgs,
    files: &[PathBuf],
    folder: &Path,
    format: &impl Fn(Option<&Path>) -> Result<Format, Stop>,
) -> Result<Vec<PathBuf>, Stop> {
    let mut seen = BTreeSet::new();
    let one = |file: &PathBuf| {
        let name = file.file_name().map_or(file.as_path(), Path::new);
        let ending = match (args.format, format(Some(name))) {
            (None, Ok(_)) => None,
            (_, Ok(Format::Csv)) => Some("csv"),
            (_, Ok(Format::Jsonl)) => Some("jsonl"),
            (_, Ok(Format::Parquet)) => Some("parquet"),
            (_, Err(stop)) => return Err(stop),
        };
        let output =
            folder.join(ending.map_or_else(|| name.to_owned(), |ending| name.with_extension(ending)));
        if !seen.insert(output.clone()) {
            let message = format!("{}: the answers of another file go there too", output.display());
            return Err(Stop::input(message).help("give the files different names"));
        }
        Ok(output)
    };
    let all = files.iter().map(one).collect::<Result<Vec<_>, _>>()?;
    let data: BTreeSet<PathBuf> = files.iter().filter_map(|file| file.canonicalize().ok()).collect();
    let inside = |output: &PathBuf| output.canonicalize().is_ok_and(|output| data.contains(&output));
    match all.iter().find(|output| inside(output)) {
        Some(output) => Err(Stop::input(format!("-o {}: that is the file of the data", output.display()))
            .help("name another folder")),
        None => Ok(all),
    }
}

/// Length and time of the last change, by which it is told whether a file is as it was.
fn state(file: &Path) -> State {
    let about = file.metadata().ok();
    let changed = about.as_ref().and_then(|about| about.modified().ok());
    let since = changed.and_then(|time| time.duration_since(std::time::UNIX_EPOCH).ok());
    (about.map_or(0, |about| about.len()), since.map_or(0, |since| since.as_nanos()))
}

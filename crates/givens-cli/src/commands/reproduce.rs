//! `givens reproduce`: the experiments of the papers, one page each.

use crate::args::ReproduceArgs;
use crate::files::Sink;
use crate::message::{Stop, count, say};
use crate::progress::Bar;
use crate::stdout;
use givens_expr::suggest;
use givens_io::make_folder;
use givens_papers::{Experiment, File, Page, Paper, Plan, Refused, Verdict, find, index};
use std::path::Path;
use std::time::Instant;

/// Runs the experiments; each page is written as soon as it is finished, the index at the end.
pub fn reproduce(args: &ReproduceArgs) -> Result<(), Stop> {
    let wanted = find(&args.paper, args.only.as_deref()).map_err(|refused| unknown(&refused))?;
    let command = typed(args);
    if let Some(folder) = &args.output {
        make_folder(folder).map_err(|error| Stop::input(error.to_string()))?;
        // a folder that cannot be written is known before the work, not after it
        drop(Sink::open(Some(&folder.join("index.md")))?);
    }
    let mut pages: Vec<(&Paper, &Experiment, Page)> = Vec::new();
    for (paper, experiment) in wanted {
        let name = format!("{} {}", paper.key, experiment.name);
        if args.runs.is_some() && experiment.runs == 0 {
            say(&format!("{name}: nothing is drawn, --runs makes no difference"));
        }
        let (bar, since) = (Bar::new(&name), Instant::now());
        let plan = Plan { runs: args.runs.map(|runs| runs as usize), seed: args.seed, progress: &bar };
        let page = (experiment.run)(&plan).map_err(|error| Stop::failed(format!("{name}: {error}")))?;
        bar.finish();
        if let Some(folder) = &args.output {
            let files = page.files(paper, experiment, &command);
            for file in files.map_err(|error| Stop::failed(format!("{name}: {error}")))? {
                write(folder, &file)?;
            }
        }
        say(&format!("{name}: {} ({:.1} s)", told(&page), since.elapsed().as_secs_f64()));
        pages.push((paper, experiment, page));
    }
    let index = index(&pages, &command);
    match &args.output {
        Some(folder) => write(folder, &index),
        None => stdout::write(|out| out.write_all(&index.contents)),
    }
}

fn write(folder: &Path, file: &File) -> Result<(), Stop> {
    let path = folder.join(&file.path);
    if let Some(folder) = path.parent() {
        make_folder(folder).map_err(|error| Stop::failed(error.to_string()))?;
    }
    Sink::open(Some(&path))?.write(|out| out.write_all(&file.contents))
}

fn told(page: &Page) -> String {
    let of = |wanted: fn(&Verdict) -> bool| page.claims.iter().filter(|claim| wanted(&claim.verdict)).count();
    let borne = of(|verdict| matches!(verdict, Verdict::Within(_) | Verdict::Holds(true)));
    let not = of(|verdict| matches!(verdict, Verdict::Differs(_) | Verdict::Holds(false)));
    format!("{}, {borne} borne out, {not} not", count(page.claims.len(), "claim"))
}

/// The command as one would type it again.
fn typed(args: &ReproduceArgs) -> String {
    let only = args.only.iter().map(|only| format!(" --only {only}"));
    let runs = args.runs.iter().map(|runs| format!(" --runs {runs}"));
    let parts: String = only.chain(runs).collect();
    format!("givens reproduce {}{parts} --seed {}", args.paper, args.seed)
}

fn unknown(refused: &Refused) -> Stop {
    let (message, name, known) = match refused {
        Refused::Paper { key, known } => (format!("there is no paper `{key}`"), key, known),
        Refused::Experiment { name, known } => {
            (format!("--only {name}: there is no such experiment"), name, known)
        }
    };
    Stop::input(message).help(match suggest(name, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("one of: {}", known.join(", ")),
    })
}

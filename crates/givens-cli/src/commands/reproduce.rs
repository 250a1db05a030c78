//! `givens reproduce`: the experiments of the papers, one page each.

use crate::args::ReproduceArgs;
use crate::files::Sink;
use crate::message::{Stop, count, say};
use crate::progress::Bar;
use crate::stdout;
use givens_expr::suggest;
use givens_io::{make_folder, read_back};
use givens_papers::{Experiment, File, PAPERS, Page, Paper, Plan, Refused, Verdict, find, index};
use std::path::Path;
use std::time::Instant;

/// Runs the experiments; each page is written as soon as it is finished, the index of all that lie there at the end.
pub fn reproduce(args: &ReproduceArgs) -> Result<(), Stop> {
    let wanted = find(&args.paper, args.only.as_deref()).map_err(|refused| unknown(&refused))?;
    bounded(args, &wanted)?;
    if let Some(folder) = &args.output {
        prepare(folder, &wanted)?;
    }
    let mut texts = Vec::new();
    for (paper, experiment) in wanted {
        let name = format!("{} {}", paper.key, experiment.name);
        let command = typed(args, paper.key, experiment.name);
        if args.runs.is_some() && experiment.runs == 0 {
            say(&format!("{name}: nothing is drawn, --runs makes no difference"));
        }
        let (bar, since) = (Bar::new(&name), Instant::now());
        let plan = Plan { runs: args.runs.map(|runs| runs as usize), seed: args.seed, progress: &bar };
        let page = experiment.run(&plan).map_err(|error| Stop::failed(format!("{name}: {error}")))?;
        bar.finish();
        match &args.output {
            Some(folder) => {
                let files = page.files(paper, experiment, &command);
                for file in files.map_err(|error| Stop::failed(format!("{name}: {error}")))? {
                    write(folder, &file)?;
                }
            }
            None => texts.push((paper, experiment, page.text(paper, experiment, &command))),
        }
        say(&format!("{name}: {} ({:.1} s)", told(&page), since.elapsed().as_secs_f64()));
    }
    match &args.output {
        Some(folder) => write(folder, &index(&found(folder))),
        None => stdout::write(|out| out.write_all(&index(&texts).contents)),
    }
}

type Wanted = (&'static Paper, &'static Experiment);

/// Refuses what memory is not set aside for.
fn bounded(args: &ReproduceArgs, wanted: &[Wanted]) -> Result<(), Stop> {
    let Some(runs) = args.runs else { return Ok(()) };
    let drawn = wanted.iter().filter(|(_, experiment)| experiment.runs > 0);
    match drawn.min_by_key(|(_, experiment)| experiment.most()) {
        Some((paper, experiment)) if runs as usize > experiment.most() => {
            let (key, name, most) = (paper.key, experiment.name, experiment.most());
            let message =
                format!("--runs {runs}: {key} {name} keeps something of each run, and makes {most} at most");
            Err(Stop::input(message).help("make several samples with other seeds"))
        }
        _ => Ok(()),
    }
}

/// Makes the folders: one that cannot be written is known before the work, not after it.
fn prepare(folder: &Path, wanted: &[Wanted]) -> Result<(), Stop> {
    if folder.as_os_str() == "-" {
        let stop = Stop::input("-o -: pages go to a folder, not to standard output");
        return Err(stop.help("leave -o out: the claims then go to standard output"));
    }
    make_folder(folder).map_err(|error| Stop::input(error.to_string()))?;
    drop(Sink::shared(&folder.join("index.md"))?);
    for (paper, experiment) in wanted {
        let own = folder.join(paper.key);
        make_folder(&own).map_err(|error| Stop::input(error.to_string()))?;
        drop(Sink::shared(&own.join(format!("{}.md", experiment.name)))?);
    }
    Ok(())
}

/// The pages that lie in a folder, this call's and those of others.
fn found(folder: &Path) -> Vec<(&'static Paper, &'static Experiment, String)> {
    let all =
        PAPERS.iter().flat_map(|paper| paper.experiments.iter().map(move |experiment| (paper, experiment)));
    let text = |(paper, experiment): Wanted| {
        let page = folder.join(paper.key).join(format!("{}.md", experiment.name));
        Some((paper, experiment, read_back(&page)?))
    };
    all.filter_map(text).collect()
}

fn write(folder: &Path, file: &File) -> Result<(), Stop> {
    Sink::shared(&folder.join(&file.path))
        .map_err(|stop| Stop { code: 1, ..stop })?
        .write(|out| out.write_all(&file.contents))
}

fn told(page: &Page) -> String {
    let of = |wanted: fn(&Verdict) -> bool| page.claims.iter().filter(|claim| wanted(&claim.verdict)).count();
    let borne = of(|verdict| matches!(verdict, Verdict::Within(_) | Verdict::Holds));
    let not = of(|verdict| matches!(verdict, Verdict::Differs(_) | Verdict::Fails));
    let open = of(|verdict| matches!(verdict, Verdict::Undecided(_)));
    format!("{}, {borne} borne out, {not} not, {open} undecided", count(page.claims.len(), "claim"))
}

/// The command that makes one page again.
fn typed(args: &ReproduceArgs, key: &str, name: &str) -> String {
    let runs = args.runs.map_or_else(String::new, |runs| format!(" --runs {runs}"));
    format!("givens reproduce {key} --only {name}{runs} --seed {}", args.seed)
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

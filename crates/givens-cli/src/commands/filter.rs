//! `givens filter` and `givens smooth`.

use crate::args::{FilterArgs, FormatArg, SmoothArgs};
use crate::checkpoint::{self, Checkpoint};
use crate::figure::{self, Shown};
use crate::files::{self, Sink};
use crate::instants::Instants;
use crate::judgement;
use crate::message::{Stop, say};
use crate::plan::Plan;
use crate::report::{self, Summary};
use crate::session::{Manner, Session};
use crate::streaming::{Stand, Streaming};
use givens::Goal;
use givens::metrics::InnovationSums;
use givens_io::{Format, Journal, Written, write_answers};
use std::path::{Path, PathBuf};

/// Estimates each state from the measurements up to it.
pub fn filter(args: &FilterArgs) -> Result<(), Stop> {
    run(args, "filter", |plan| Ok(vec![Goal::Filter; plan.tracks.tracks.len()]))
}

/// Estimates each state from the measurements after it too.
pub fn smooth(args: &SmoothArgs) -> Result<(), Stop> {
    let task = format!("smooth {:?} {:?}", args.lag, args.point);
    run(&args.run, &task, |plan| match (&args.point, args.lag) {
        (Some(point), _) => plan.points(point),
        (None, lag) => Ok(vec![lag.map_or(Goal::Interval, Goal::Lag); plan.tracks.tracks.len()]),
    })
}

fn run(args: &FilterArgs, task: &str, goals: impl Fn(&Plan) -> Result<Vec<Goal>, Stop>) -> Result<(), Stop> {
    let output = args.output.as_deref();
    let format = format(args.format, output)?;
    args.plots.iter().try_for_each(|path| figure::check(path))?;
    args.report.as_deref().map_or(Ok(()), judgement::check)?;
    let resumable = args.resume.zip(output);
    Checkpoint::check(output, resumable.is_some())?;
    let checkpoint = resumable.map(|(_, output)| Checkpoint::path(output));
    let next = checkpoint.as_deref().map(Journal::next);
    let mut outputs =
        vec![("-o", output), ("--resume", checkpoint.as_deref()), ("--resume", next.as_deref())];
    outputs.extend(args.plots.iter().map(|path| ("--plot", Some(path.as_path()))));
    outputs.push(("--report", args.report.as_deref()));
    files::check(
        &[("MODEL", Some(&args.model.model)), ("DATA", Some(&args.data)), ("--truth", args.truth.as_deref())],
        &outputs,
    )?;
    let plan = Plan::new(args)?;
    let goals = goals(&plan)?;
    let at = args.at.as_deref().map(|text| Instants::read(text, &plan)).transpose()?;
    let identity = || checkpoint::identity(args, &plan, task, format);
    let canvases = args.plots.iter().map(|path| Ok((path, Sink::open(Some(path))?)));
    let pages = Pages {
        canvases: canvases.collect::<Result<Vec<_>, Stop>>()?,
        report: args.report.as_deref().map(|path| Sink::open(Some(path))).transpose()?,
    };
    let manner = Manner {
        at: at.as_ref(),
        threads: args.threads,
        whole: format == Format::Jsonl,
        judged: args.report.is_some(),
    };
    if let [goal] = goals[..] {
        let mut alone = Streaming::new(&plan, goal, manner, format, pages.drawn())?;
        let (mut kept, mut left) = (None, None);
        let mut sink = match resumable {
            Some((every, output)) => {
                let (checkpoint, stands) = Checkpoint::open::<Stand>(output, identity(), every)?;
                (kept, left) = (Some(checkpoint), stands.into_iter().next_back());
                Sink::resumed(output, left.as_ref().map_or(Written::default(), |stand| stand.output))?
            }
            None => Sink::open(output)?,
        };
        if left.is_some() {
            say("goes on from the checkpoint of a run that was broken off");
        }
        sink.fill(|out| alone.run(out, left, kept.as_mut()))?;
        // what may be gone on with has its name last
        let sink = if kept.is_some() { Some(sink) } else { sink.finish().map(|()| None)? };
        let (summary, failures) = (alone.summary(), alone.failure().map_or(&[][..], core::slice::from_ref));
        pages.write(&plan, &summary, alone.innovations(), failures, alone.shown().as_slice())?;
        sink.map_or(Ok(()), Sink::finish)?;
        kept.into_iter().for_each(Checkpoint::remove);
        report::closing(&plan, &summary);
        return if failures.is_empty() { Ok(()) } else { Err(Stop::failures(failures)) };
    }
    let (mut kept, mut done) = (None, Vec::new());
    if let Some((every, output)) = resumable {
        let (checkpoint, found) = Checkpoint::open(output, identity(), every)?;
        (kept, done) = (Some(checkpoint), found);
    }
    if !done.is_empty() {
        say("goes on from the checkpoint of a run that was broken off");
    }
    let sink = Sink::open(output)?;
    let session = Session::resume(&plan, &plan.choice, &goals, manner, done, kept.as_mut())?;
    let (model, gated) = (&plan.model, plan.choice.gate.is_some());
    sink.write(|out| match &at {
        Some(at) => write_answers(out, format, model, &at.tracks(&plan), &session.at, gated, args.threads),
        None => write_answers(out, format, model, &plan.tracks, &session.answers, gated, args.threads),
    })?;
    let summary = session.summary(&plan);
    pages.write(&plan, &summary, session.innovations.as_ref(), &session.failures, &session.shown())?;
    kept.into_iter().for_each(Checkpoint::remove);
    report::closing(&plan, &summary);
    if session.failures.is_empty() { Ok(()) } else { Err(Stop::failures(&session.failures)) }
}

/// The figures and the report of a run.
struct Pages<'a> {
    canvases: Vec<(&'a PathBuf, Sink)>,
    report: Option<Sink>,
}

impl Pages<'_> {
    /// Whether anything is drawn.
    fn drawn(&self) -> bool {
        !self.canvases.is_empty() || self.report.is_some()
    }

    /// Draws and writes all.
    fn write(
        self,
        plan: &Plan,
        summary: &Summary,
        innovations: Option<&InnovationSums>,
        failures: &[String],
        shown: &[Shown],
    ) -> Result<(), Stop> {
        for (path, canvas) in self.canvases {
            let picture = figure::draw(path, plan, shown)?;
            canvas.write(|out| out.write_all(&picture))?;
        }
        match self.report.zip(innovations) {
            Some((report, innovations)) => {
                let page = judgement::page(plan, summary, innovations, failures, shown)?;
                report.write(|out| out.write_all(page.as_bytes()))
            }
            None => Ok(()),
        }
    }
}

/// The format asked for, or that of the output's name.
fn format(asked: Option<FormatArg>, output: Option<&Path>) -> Result<Format, Stop> {
    let ending = output.and_then(Path::extension).map(|ending| ending.to_string_lossy().to_lowercase());
    match (asked, ending.as_deref()) {
        (Some(FormatArg::Jsonl), _) | (None, Some("jsonl" | "ndjson")) => Ok(Format::Jsonl),
        (None, Some(other @ ("json" | "parquet" | "arrow" | "xlsx" | "html" | "svg" | "png"))) => {
            let name = output.unwrap_or(Path::new("")).display();
            let stop = Stop::input(format!("-o {name}: this version does not write .{other}"));
            Err(stop.help("name the output .csv or .jsonl, or say --format csv or --format jsonl"))
        }
        (Some(FormatArg::Csv) | None, _) => Ok(Format::Csv),
    }
}

//! `givens filter` and `givens smooth`.

use crate::args::{FilterArgs, SmoothArgs};
use crate::checkpoint::{self, Checkpoint};
use crate::commands::folder;
use crate::commands::written::{format, layout};
use crate::doubts;
use crate::figure::{self, Shown};
use crate::files::{self, Sink};
use crate::instants::Instants;
use crate::judgement;
use crate::message::{Stop, say};
use crate::plan::Plan;
use crate::report;
use crate::session::{Manner, Session};
use crate::streaming::{Stand, Streaming};
use crate::sums::Sums;
use core::ops::ControlFlow;
use core::sync::atomic::AtomicUsize;
use core::time::Duration;
use givens::Goal;
use givens_io::{AnswerWriter, Format, Identity, Journal, Layout, Tracks, Written};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Estimates each state from the measurements up to it.
pub fn filter(args: &FilterArgs) -> Result<(), Stop> {
    run(args, "filter", &|plan| Ok(vec![Goal::Filter; plan.tracks.tracks.len()]))
}

/// Estimates each state from the measurements after it too.
pub fn smooth(args: &SmoothArgs) -> Result<(), Stop> {
    let task = format!("smooth {:?} {:?}", args.lag, args.point);
    run(&args.run, &task, &|plan| match (&args.point, args.lag) {
        (Some(point), _) => plan.points(point),
        (None, lag) => Ok(vec![lag.map_or(Goal::Interval, Goal::Lag); plan.tracks.tracks.len()]),
    })
}

/// What came of one table.
pub struct Done {
    pub tracks: usize,
    pub rows: usize,
    pub log_likelihood: f64,
    /// Tracks that failed, in words.
    pub failures: Vec<String>,
    /// What is doubtful about the answers, in words.
    pub doubts: Vec<String>,
}

type Goals<'a> = &'a (dyn Fn(&Plan) -> Result<Vec<Goal>, Stop> + Sync);

fn run(args: &FilterArgs, task: &str, goals: Goals) -> Result<(), Stop> {
    if let Some(files) = folder::files(&args.data)? {
        let format = |output: Option<&Path>| format(args.format, output);
        return folder::run(args, &files, task, format, |args, count| one(args, task, goals, Some(count)));
    }
    let Done { failures, .. } = one(args, task, goals, None)?;
    if failures.is_empty() { Ok(()) } else { Err(Stop::failures(&failures)) }
}

/// Runs over one table; where its rows are `counted` among those of others, nothing is told of it.
fn one(args: &FilterArgs, task: &str, goals: Goals, counted: Option<&AtomicUsize>) -> Result<Done, Stop> {
    let output = args.output.as_deref();
    let format = format(args.format, output)?;
    let layout = layout(args, format)?;
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
    if layout == Layout::Covariances && plan.model.states.iter().any(|name| name == "cov") {
        let stop =
            Stop::input("--layout covariances: the state `cov` and the covariances would be one column");
        return Err(stop.help("name the state otherwise in the model, or write JSON lines"));
    }
    let goals = goals(&plan)?;
    let at = args.at.as_deref().map(|text| Instants::read(text, &plan)).transpose()?;
    let canvases = args.plots.iter().map(|path| Ok((path, Sink::open(Some(path))?)));
    let pages = Pages {
        canvases: canvases.collect::<Result<Vec<_>, Stop>>()?,
        report: args.report.as_deref().map(|path| Sink::open(Some(path))).transpose()?,
    };
    let whole = format == Format::Jsonl;
    let manner =
        Manner { at: at.as_ref(), threads: args.threads, whole, judged: args.report.is_some(), counted };
    let identity = checkpoint::identity(args, &plan, task, format);
    let target =
        Target { output, format, layout, resumable: resumable.map(|(every, path)| (every, path, identity)) };
    match goals[..] {
        // among files, a track is what it is in a table of several
        [goal] if counted.is_none() => alone(&plan, goal, manner, target, pages),
        _ if target.resumable.is_none() && !pages.drawn() && plan.tracks.in_turn() => {
            in_turn(&plan, &goals, manner, &target)
        }
        _ => together(&plan, &goals, manner, target, pages),
    }
}

/// Where the answers go, and how.
struct Target<'a> {
    output: Option<&'a Path>,
    format: Format,
    layout: Layout,
    /// How often a checkpoint is kept beside the output, and what it is of.
    resumable: Option<(Duration, &'a Path, Identity)>,
}

impl Target<'_> {
    fn writer<'p>(
        &self,
        plan: &'p Plan,
        tracks: &'p Tracks,
        goals: &[Goal],
        manner: Manner,
    ) -> AnswerWriter<'p> {
        let smoothed = goals.iter().any(|goal| *goal != Goal::Filter);
        let (gated, threads) = (plan.choice.gate.is_some(), manner.threads);
        AnswerWriter { format: self.format, layout: self.layout, tracks, smoothed, gated, threads }
    }
}

/// A single track, written as it is finished.
fn alone(plan: &Plan, goal: Goal, manner: Manner, target: Target, pages: Pages) -> Result<Done, Stop> {
    let mut run = Streaming::new(plan, goal, manner, (target.format, target.layout), pages.drawn())?;
    let (mut kept, mut left) = (None, None);
    let mut sink = match target.resumable {
        Some((every, output, identity)) => {
            let (checkpoint, stands) = Checkpoint::open::<Stand>(output, identity, every)?;
            (kept, left) = (Some(checkpoint), stands.into_iter().next_back());
            Sink::resumed(output, left.as_ref().map_or(Written::default(), |stand| stand.output))?
        }
        None => Sink::open(target.output)?,
    };
    if left.is_some() {
        say(GOES_ON);
    }
    sink.fill(|out| run.run(out, left, kept.as_mut()))?;
    run.stop().map_or(Ok(()), Err)?;
    let failures = run.failure().map_or(&[][..], core::slice::from_ref);
    named(plan, sink, kept.is_some(), pages, run.sums(), failures, run.shown().as_slice())?;
    Ok(ended(plan, manner, run.sums(), failures, kept))
}

/// Tracks side by side, written when all are done.
fn together(
    plan: &Plan,
    goals: &[Goal],
    manner: Manner,
    mut target: Target,
    pages: Pages,
) -> Result<Done, Stop> {
    let (mut kept, mut done) = (None, Vec::new());
    if let Some((every, output, identity)) = target.resumable.take() {
        let (checkpoint, found) = Checkpoint::open(output, identity, every)?;
        (kept, done) = (Some(checkpoint), found);
    }
    if !done.is_empty() {
        say(GOES_ON);
    }
    let mut sink = Sink::among(target.output, manner.counted.is_some())?;
    let session = Session::hold(plan, &plan.choice, goals, manner, done, kept.as_mut())?;
    let times = manner.at.map(|at| at.tracks(plan));
    let answers = if times.is_some() { &session.at } else { &session.answers };
    let writer = target.writer(plan, times.as_ref().unwrap_or(&plan.tracks), goals, manner);
    sink.fill(|out| writer.write(out, answers))?;
    named(plan, sink, kept.is_some(), pages, &session.sums, &session.failures, &session.shown())?;
    Ok(ended(plan, manner, &session.sums, &session.failures, kept))
}

/// Tracks that stand one behind the other in the table, written some at a time: memory does not grow with their rows.
fn in_turn(plan: &Plan, goals: &[Goal], manner: Manner, target: &Target) -> Result<Done, Stop> {
    let times = manner.at.map(|at| at.tracks(plan));
    let tracks = times.as_ref().unwrap_or(&plan.tracks);
    let writer = target.writer(plan, tracks, goals, manner);
    let mut sink = Sink::among(target.output, manner.counted.is_some())?;
    let mut session = None;
    sink.fill(|out| {
        let mut all = writer.begin(out)?;
        let mut done = Ok(());
        session = Some(Session::hand_over(plan, &plan.choice, goals, manner, &mut |range, answers, at| {
            let answers = if times.is_some() { at } else { answers };
            let parts = tracks.tracks[range].iter().zip(answers).map(|(track, answer)| answer.part(track));
            if done.is_ok() {
                done = all.rows(out, &parts.collect::<Vec<_>>());
            }
            // if nobody reads any more the run goes on, for what is told of it
            match &done {
                Err(error) if error.kind() != ErrorKind::BrokenPipe => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        }));
        done.and_then(|()| all.end(out))
    })?;
    let session = session.transpose()?;
    sink.finish()?;
    let (sums, failures) = session.map_or((Sums::default(), Vec::new()), |of| (of.sums, of.failures));
    Ok(ended(plan, manner, &sums, &failures, None))
}

const GOES_ON: &str = "goes on from the checkpoint of a run that was broken off";

/// Gives the output its name, and writes the pages; what may be gone on with has its name last.
fn named(
    plan: &Plan,
    sink: Sink,
    is_kept: bool,
    pages: Pages,
    sums: &Sums,
    failures: &[String],
    shown: &[Shown],
) -> Result<(), Stop> {
    let sink = if is_kept { Some(sink) } else { sink.finish().map(|()| None)? };
    pages.write(plan, sums, failures, shown)?;
    sink.map_or(Ok(()), Sink::finish)
}

/// The last words, when all is written.
fn ended(plan: &Plan, manner: Manner, sums: &Sums, failures: &[String], kept: Option<Checkpoint>) -> Done {
    kept.into_iter().for_each(Checkpoint::remove);
    let summary = sums.summary(plan.choice.gate);
    if manner.counted.is_none() {
        report::closing(plan, &summary);
    }
    Done {
        tracks: plan.tracks.tracks.len(),
        rows: summary.rows,
        log_likelihood: summary.log_likelihood,
        failures: failures.to_vec(),
        doubts: doubts::all(plan, &plan.choice, &summary.doubts),
    }
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
    fn write(self, plan: &Plan, sums: &Sums, failures: &[String], shown: &[Shown]) -> Result<(), Stop> {
        for (path, canvas) in self.canvases {
            let picture = figure::draw(path, plan, shown)?;
            canvas.write(|out| out.write_all(&picture))?;
        }
        match self.report.zip(sums.innovations.as_ref()) {
            Some((report, innovations)) => {
                let page =
                    judgement::page(plan, &sums.summary(plan.choice.gate), innovations, failures, shown)?;
                report.write(|out| out.write_all(page.as_bytes()))
            }
            None => Ok(()),
        }
    }
}

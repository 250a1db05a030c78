//! `givens filter` and `givens smooth`.

use crate::args::{FilterArgs, FormatArg, SmoothArgs};
use crate::figure::{self, Shown};
use crate::files::{self, Sink};
use crate::instants::Instants;
use crate::message::Stop;
use crate::plan::Plan;
use crate::report;
use crate::session::{Manner, Session};
use crate::streaming::Streaming;
use givens::Goal;
use givens_io::{Format, write_answers};
use std::path::{Path, PathBuf};

/// Estimates each state from the measurements up to it.
pub fn filter(args: &FilterArgs) -> Result<(), Stop> {
    run(args, |plan| Ok(vec![Goal::Filter; plan.tracks.tracks.len()]))
}

/// Estimates each state from the measurements after it too.
pub fn smooth(args: &SmoothArgs) -> Result<(), Stop> {
    run(&args.run, |plan| match (&args.point, args.lag) {
        (Some(point), _) => plan.points(point),
        (None, lag) => Ok(vec![lag.map_or(Goal::Interval, Goal::Lag); plan.tracks.tracks.len()]),
    })
}

fn run(args: &FilterArgs, goals: impl Fn(&Plan) -> Result<Vec<Goal>, Stop>) -> Result<(), Stop> {
    let output = args.output.as_deref();
    let format = format(args.format, output)?;
    args.plots.iter().try_for_each(|path| figure::check(path))?;
    let mut outputs = vec![("-o", output)];
    outputs.extend(args.plots.iter().map(|path| ("--plot", Some(path.as_path()))));
    files::check(
        &[("MODEL", Some(&args.model.model)), ("DATA", Some(&args.data)), ("--truth", args.truth.as_deref())],
        &outputs,
    )?;
    let plan = Plan::new(args)?;
    let goals = goals(&plan)?;
    let at = args.at.as_deref().map(|text| Instants::read(text, &plan)).transpose()?;
    let sink = Sink::open(output)?;
    let canvases = args.plots.iter().map(|path| Ok((path, Sink::open(Some(path))?)));
    let canvases = canvases.collect::<Result<Vec<_>, Stop>>()?;
    let manner = Manner { at: at.as_ref(), threads: args.threads, whole: format == Format::Jsonl };
    if let [goal] = goals[..] {
        let mut alone = Streaming::new(&plan, goal, manner, format, !canvases.is_empty())?;
        sink.write(|out| alone.run(out))?;
        draw(canvases, &plan, alone.shown().as_slice())?;
        report::closing(&plan, &alone.summary());
        return alone.failure().map_or(Ok(()), |failure| Err(Stop::failed(failure)));
    }
    let session = Session::run(&plan, &plan.choice, &goals, manner)?;
    let (model, gated) = (&plan.model, plan.choice.gate.is_some());
    sink.write(|out| match &at {
        Some(at) => write_answers(out, format, model, &at.tracks(&plan), &session.at, gated, args.threads),
        None => write_answers(out, format, model, &plan.tracks, &session.answers, gated, args.threads),
    })?;
    draw(canvases, &plan, &session.shown())?;
    report::closing(&plan, &session.summary(&plan));
    if session.failures.is_empty() { Ok(()) } else { Err(Stop::failures(&session.failures)) }
}

/// Draws the figures.
fn draw(canvases: Vec<(&PathBuf, Sink)>, plan: &Plan, shown: &[Shown]) -> Result<(), Stop> {
    canvases.into_iter().try_for_each(|(path, canvas)| {
        let picture = figure::draw(path, plan, shown)?;
        canvas.write(|out| out.write_all(&picture))
    })
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

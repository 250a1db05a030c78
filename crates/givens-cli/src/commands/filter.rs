//! `givens filter` and `givens smooth`.

use crate::args::{FilterArgs, FormatArg, SmoothArgs};
use crate::message::Stop;
use crate::plan::Plan;
use crate::session::Session;
use crate::{figure, report, stdout};
use givens::Goal;
use givens_io::{Destination, Format, write_answers};
use std::path::Path;

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
    let format = format(args.format, args.output.as_deref());
    args.plot.as_deref().map_or(Ok(()), figure::check)?;
    let plan = Plan::new(args)?;
    let goals = goals(&plan)?;
    let destination = args.output.as_ref().map(Destination::create).transpose()?;
    let session = Session::run(&plan, &plan.choice, &goals);
    let (model, tracks, answers) = (&plan.model, &plan.tracks, &session.answers);
    match destination {
        None => stdout::write(|out| write_answers(out, format, model, tracks, answers))?,
        Some(mut file) => {
            write_answers(&mut file, format, model, tracks, answers)
                .map_err(|error| Stop::failed(format!("cannot write the output: {error}")))?;
            file.finish()?;
        }
    }
    if let Some(plot) = &args.plot {
        figure::draw(plot, &plan, &session)?;
    }
    report::closing(&plan, &session);
    if session.failures.is_empty() {
        return Ok(());
    }
    Err(Stop::failed(session.failures.join("\nerror: ")))
}

/// The format asked for, or that of the output's name.
fn format(asked: Option<FormatArg>, output: Option<&Path>) -> Format {
    match asked {
        Some(FormatArg::Csv) => Format::Csv,
        Some(FormatArg::Jsonl) => Format::Jsonl,
        None => match output.and_then(Path::extension).and_then(|ending| ending.to_str()) {
            Some("jsonl" | "ndjson") => Format::Jsonl,
            _ => Format::Csv,
        },
    }
}

//! `givens simulate`: trajectories and measurements drawn from a model.

use crate::args::SimulateArgs;
use crate::columns::{ignored, source_name};
use crate::failure;
use crate::files::{self, Sink};
use crate::message::Stop;
use crate::paths::paths;
use crate::plan::{absent, model};
use crate::timetable::{bounded, regular};
use givens::Row;
use givens::filter::{Gaussian, StepError};
use givens::simulate::{Paths, Stream, simulate as draw, simulate_continuous};
use givens_io::{
    Drawn, Dynamics, Model, Row as Told, Track, Tracks, read_times, write_measurements, write_states,
};

/// Draws the runs and writes their measurements, and their states if asked for. A run that fails does not stop the
/// others.
pub fn simulate(args: &SimulateArgs) -> Result<(), Stop> {
    let (output, states) = (args.output.as_deref(), args.states.as_deref());
    files::check(
        &[("MODEL", Some(&args.model.model)), ("--times", args.times.as_deref())],
        &[("-o", output), ("--states", states)],
    )?;
    let model = model(&args.model)?;
    let paths = paths(&model, args)?;
    let prior = prior(&model)?;
    let tracks = tracks(&model, args)?;
    let output = Sink::open(output)?;
    let states = states.map(|path| Sink::open(Some(path))).transpose()?;
    let (mut runs, mut failures) = (Vec::new(), Vec::new());
    for (at, track) in tracks.tracks.iter().enumerate() {
        let rows = &*track.rows.read(0..track.rows.len())?;
        for run in 0..args.runs {
            match one(&model, &paths, &prior, (track, rows), args, at, run) {
                Ok(drawn) => runs.push(drawn),
                Err(error) => failures.push(words(&model, args, (track, rows), run, &error)),
            }
        }
    }
    output.write(|out| write_measurements(out, &model, &runs))?;
    if let Some(states) = states {
        states.write(|out| write_states(out, &model, &runs))?;
    }
    if failures.is_empty() { Ok(()) } else { Err(Stop::failures(&failures)) }
}

/// The belief from which the initial state is drawn.
fn prior(model: &Model) -> Result<Gaussian, Stop> {
    let mean: Option<Vec<f64>> = model.prior.mean.iter().copied().collect();
    let Some(mean) = mean else {
        let message = "`start` finds states from measurements, of which there are none yet";
        return Err(Stop::input(format!("{}: {message}", model.file))
            .help("to simulate, give all states `mean` and `std`"));
    };
    Gaussian::from_cov(&mean, &model.prior.cov)
        .map_err(|error| Stop::input(format!("{}: {error}", model.file)))
}

/// The rows to draw, with a number for each measure that is asked for.
fn tracks(model: &Model, args: &SimulateArgs) -> Result<Tracks, Stop> {
    let Some(path) = &args.times else { return regular(model, args) };
    let tracks = read_times(path, model)?;
    ignored(path, &tracks.ignored, &absent(model, &tracks));
    if args.runs > 1 && tracks.has_track_id {
        let stop = Stop::input(format!("--runs {}: the table of --times has tracks of its own", args.runs));
        return Err(stop.help("leave --runs out, or remove its column `track_id`"));
    }
    let rows: usize = tracks.tracks.iter().map(|track| track.rows.len()).sum();
    bounded(rows as f64 * f64::from(args.runs))?;
    Ok(tracks)
}

fn one(
    model: &Model,
    paths: &Paths,
    prior: &Gaussian,
    (track, told): (&Track, &[Told]),
    args: &SimulateArgs,
    at: usize,
    run: u32,
) -> Result<Drawn, StepError> {
    let mut stream = Stream::new(args.seed, u32::try_from(at).unwrap_or(u32::MAX), run);
    let rows = told.iter().map(|row| Row { time: row.time, z: &row.z, u: &row.u });
    let (sensors, t0, stream) = (&model.observation, track.start, &mut stream);
    let simulation = match &model.dynamics {
        Dynamics::Discrete(model) => draw(model, sensors, rows, t0, prior, stream)?,
        Dynamics::Continuous(model) => simulate_continuous(model, sensors, rows, t0, prior, paths, stream)?,
    };
    Ok(Drawn {
        run,
        track: track.id.clone().or_else(|| (args.runs > 1).then(|| run.to_string())),
        index: told.iter().map(|row| row.index).collect(),
        time_text: told.iter().map(|row| row.time_text.clone()).collect(),
        sensor: told.iter().map(|row| row.sensor).collect(),
        controls: told.iter().map(|row| row.u.clone()).collect(),
        simulation,
    })
}

/// Which run failed, where and why. A step of a simulation is a row.
fn words(
    model: &Model,
    args: &SimulateArgs,
    (track, told): (&Track, &[Told]),
    run: u32,
    error: &StepError,
) -> String {
    let which = if args.runs > 1 { format!("run {run}, ") } else { String::new() };
    let row = told.get(error.step).or(told.last());
    let place = match (&args.times, row) {
        (Some(path), Some(row)) => failure::place(source_name(path), track, row, error.time),
        _ => format!("{}: t = {}", model.file, track.time_text(error.time)),
    };
    failure::told(model, &format!("{which}{place}"), "simulation", None, error)
}

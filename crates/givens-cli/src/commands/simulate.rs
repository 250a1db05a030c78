//! `givens simulate`: trajectories and measurements drawn from a model.

use crate::args::SimulateArgs;
use crate::message::Stop;
use crate::plan::model;
use crate::{report, stdout};
use givens::Row;
use givens::filter::Gaussian;
use givens::model::Transition;
use givens::simulate::{Stream, simulate as draw};
use givens_io::{Destination, Drawn, Model, Track, Tracks, read_times, write_measurements, write_states};
use std::io::{self, Write};

/// Draws the runs and writes their measurements, and their states if asked for.
pub fn simulate(args: &SimulateArgs) -> Result<(), Stop> {
    let model = model(&args.model)?;
    let prior = prior(&model)?;
    let tracks = match &args.times {
        Some(path) => read_times(path, &model)?,
        None => regular(&model, args)?,
    };
    if args.runs == 0 {
        return Err(Stop::input("--runs 0: draw at least one"));
    }
    if args.runs > 1 && tracks.has_track_id {
        return Err(Stop::input(
            "--runs: the table of --times has tracks of its own; leave one of the two out",
        ));
    }
    let output = args.output.as_ref().map(Destination::create).transpose()?;
    let states = args.states.as_ref().map(Destination::create).transpose()?;
    let mut runs = Vec::new();
    for (at, track) in tracks.tracks.iter().enumerate() {
        for run in 0..args.runs {
            runs.push(one(&model, &prior, track, args, at, run)?);
        }
    }
    match output {
        None => stdout::write(|out| write_measurements(out, &model, &runs))?,
        Some(file) => save(file, |out| write_measurements(out, &model, &runs))?,
    }
    states.map_or(Ok(()), |file| save(file, |out| write_states(out, &model, &runs)))
}

fn save(mut file: Destination, write: impl Fn(&mut dyn Write) -> io::Result<()>) -> Result<(), Stop> {
    write(&mut file).map_err(|error| Stop::failed(format!("cannot write: {error}")))?;
    Ok(file.finish()?)
}

/// The belief from which the initial state is drawn.
fn prior(model: &Model) -> Result<Gaussian, Stop> {
    let mean: Option<Vec<f64>> = model.prior.mean.iter().copied().collect();
    let Some(mean) = mean else {
        let message = "`start` finds states from measurements, of which there are none yet";
        return Err(Stop::input(format!("{}: {message}; give all states `mean` and `std`", model.file)));
    };
    Gaussian::from_cov(&mean, &model.prior.cov)
        .map_err(|error| Stop::input(format!("{}: {error}", model.file)))
}

/// Rows at equal distances, all sensors in each.
fn regular(model: &Model, args: &SimulateArgs) -> Result<Tracks, Stop> {
    let Some(every) = args.every.or(model.transition.period()) else {
        return Err(Stop::input("--every: the model has no step, so say the time between rows"));
    };
    if !(every > 0.0 && every.is_finite()) {
        return Err(Stop::input(format!("--every {every}: must be above zero")));
    }
    let part = |step: &f64| (every / step - (every / step).round()).abs() > 1e-6;
    if let Some(step) = model.transition.period().filter(part) {
        return Err(Stop::input(format!(
            "--every {every}: not a whole number of the model's steps of {step}"
        )));
    }
    if !model.controls.is_empty() {
        let names = model.controls.join(", ");
        return Err(Stop::input(format!(
            "the model has controls ({names}): give them, with times, by --times DATA"
        )));
    }
    let t0 = model.time.unwrap_or(0.0);
    let count = match (args.steps, args.until) {
        (Some(steps), _) => steps,
        (None, Some(until)) if until.is_finite() && until > t0 => {
            ((until - t0) / every * (1.0 + 1e-12)).floor() as usize
        }
        (None, Some(until)) => {
            return Err(Stop::input(format!("--until {until}: must lie behind the beginning, {t0}")));
        }
        (None, None) => return Err(Stop::input("say how long: --until T, --steps N or --times DATA")),
    };
    if count == 0 || count > MOST_ROWS {
        return Err(Stop::input(format!("{count} rows: must be from 1 to {MOST_ROWS}")));
    }
    let row = |k: usize| {
        let time = t0 + (k + 1) as f64 * every;
        let z = vec![0.0; model.measures()];
        givens_io::Row {
            line: k + 2,
            index: k,
            time,
            time_text: time.to_string(),
            sensor: None,
            z,
            u: vec![],
        }
    };
    let track = Track { id: None, start: t0, rows: (0..count).map(row).collect(), origin: None };
    Ok(Tracks { tracks: vec![track], ignored: vec![], has_track_id: false, has_sensor: false })
}

/// What fits into memory.
const MOST_ROWS: usize = 100_000_000;

fn one(
    model: &Model,
    prior: &Gaussian,
    track: &Track,
    args: &SimulateArgs,
    at: usize,
    run: u32,
) -> Result<Drawn, Stop> {
    let mut stream = Stream::new(args.seed, u32::try_from(at).unwrap_or(u32::MAX), run);
    let asked: Vec<Vec<f64>> = track.rows.iter().map(|row| asked(model, args, row)).collect();
    let rows = track.rows.iter().zip(&asked).map(|(row, z)| Row { time: row.time, z, u: &row.u });
    let drawn = draw(&model.transition, &model.observation, rows, track.start, prior, &mut stream);
    let simulation = drawn.map_err(|error| {
        let row = &track.rows[error.step.min(track.rows.len() - 1)];
        let file = args.times.as_deref().unwrap_or(&model.file);
        Stop::failed(report::failure(model, file, track, row, &error))
    })?;
    Ok(Drawn {
        track: track.id.clone().or_else(|| (args.runs > 1).then(|| run.to_string())),
        time_text: track.rows.iter().map(|row| row.time_text.clone()).collect(),
        sensor: track.rows.iter().map(|row| row.sensor).collect(),
        controls: track.rows.iter().map(|row| row.u.clone()).collect(),
        simulation,
    })
}

/// The measures that a row asks for: those of its sensor, or all.
fn asked(model: &Model, args: &SimulateArgs, row: &givens_io::Row) -> Vec<f64> {
    let d = model.measures();
    match (&args.times, row.sensor.and_then(|sensor| model.sensors.get(sensor))) {
        (Some(_), Some(sensor)) => {
            (0..d).map(|i| if sensor.measures.contains(&i) { 0.0 } else { f64::NAN }).collect()
        }
        _ => vec![0.0; d],
    }
}

//! The rows of a simulation at equal distances.

use crate::args::SimulateArgs;
use crate::message::Stop;
use givens::scalar::Shown;
use givens_io::{Ids, Model, Row, Rows, Track, Tracks};

/// Rows, of all runs together, that fit into memory.
const MOST_ROWS: f64 = 1e7;

/// Rows at equal distances with all sensors in each; sensors that share a column have rows of their own.
pub fn regular(model: &Model, args: &SimulateArgs) -> Result<Tracks, Stop> {
    if !model.controls.is_empty() {
        let names = model.controls.join(", ");
        return Err(Stop::input(format!("{}: the model has controls: {names}", model.file))
            .help("give them, with times, in a table: --times DATA"));
    }
    let every = distance(model, args)?;
    let mut track =
        Track { id: None, start: model.time.unwrap_or(0.0), rows: Rows::default(), origin: model.epoch };
    // without a time of its own the belief holds at the first row
    let first = usize::from(model.time.is_some());
    let last = last(&track, args, every, first)?;
    let apart = shares_columns(model);
    let sensors: Vec<Option<usize>> =
        if apart { (0..model.sensors.len()).map(Some).collect() } else { vec![None] };
    let rows = (last + 1.0 - first as f64) * sensors.len() as f64 * f64::from(args.runs);
    bounded(rows)?;
    for k in first..=last as usize {
        let (time, time_text) = moment(&track, track.start + k as f64 * every);
        for &sensor in &sensors {
            let own = |i: usize| sensor.is_none_or(|sensor| model.sensors[sensor].measures.contains(&i));
            let z = (0..model.measures()).map(|i| if own(i) { 0.0 } else { f64::NAN }).collect();
            let index = track.rows.len();
            let time_text = time_text.clone();
            track.rows.push(Row { line: index + 2, index, time, time_text, sensor, z, u: vec![] });
        }
    }
    Ok(Tracks {
        scheme: model.scheme(),
        tracks: vec![track],
        refused: vec![],
        ignored: vec![],
        has_track_id: false,
        ids: Ids::Words,
        dated: model.epoch.is_some(),
        has_sensor: apart,
        ranges: vec![],
        fingerprint: String::new(),
    })
}

/// Refuses more rows than fit into memory.
pub fn bounded(rows: f64) -> Result<(), Stop> {
    if rows <= MOST_ROWS {
        return Ok(());
    }
    let rows = if rows < 1e15 { format!("{rows:.0}") } else { format!("{rows:.1e}") };
    let stop = Stop::input(format!("this would draw {rows} rows, more than {MOST_ROWS:.0}"));
    Err(stop.help("ask for fewer steps or runs, or for several files with a seed each"))
}

/// The time between two rows.
fn distance(model: &Model, args: &SimulateArgs) -> Result<f64, Stop> {
    let Some(every) = args.every.or(model.step()) else {
        return Err(Stop::input("the model has no step").help("say the time between rows: --every DT"));
    };
    if !(every > 0.0 && every.is_finite()) {
        return Err(Stop::input(format!(
            "--every {}: the time between rows must be above zero",
            Shown(every)
        )));
    }
    if let Some(step) = model.step() {
        let steps = every / step;
        if (steps - steps.round()).abs() > 1e-6 || steps.round() < 1.0 {
            let stop = Stop::input(format!(
                "--every {}: this is not a whole number of the model's steps",
                Shown(every)
            ));
            return Err(stop.help(format!("one step is {}; choose a multiple of it", Shown(step))));
        }
    }
    Ok(every)
}

/// The number of the last row; the belief stands at number 0.
fn last(track: &Track, args: &SimulateArgs, every: f64, first: usize) -> Result<f64, Stop> {
    let t0 = track.start;
    let last = match (args.steps, &args.until) {
        (Some(0), _) => return Err(Stop::input("--steps 0: draw at least one row")),
        (Some(steps), _) => steps as f64 - 1.0 + first as f64,
        (None, Some(text)) => {
            let until = track.parse_time(text).map_err(|error| Stop::input(format!("--until: {error}")))?;
            ((until - t0) / every * (1.0 + 1e-12)).floor()
        }
        (None, None) => {
            let stop = Stop::input("how long to simulate is not said");
            return Err(stop.help("add --until T, --steps N or --times DATA"));
        }
    };
    if last < first as f64 {
        let stop =
            Stop::input(format!("--until {}: no row lies so early", args.until.as_deref().unwrap_or("")));
        let earliest = moment(track, t0 + first as f64 * every).1;
        return Err(stop.help(format!(
            "the belief holds at {}, the first row stands at {earliest}",
            moment(track, t0).1
        )));
    }
    Ok(last)
}

/// A time and its text, which reads back as the same number: fifteen digits leave the rounding of sums behind.
fn moment(track: &Track, time: f64) -> (f64, String) {
    let time = format!("{time:.14e}").parse().unwrap_or(time);
    let text = track.time_text(time);
    (track.parse_time(&text).unwrap_or(time), text)
}

/// Whether two sensors have a column of the same name.
fn shares_columns(model: &Model) -> bool {
    let mut names: Vec<&String> = model.sensors.iter().flat_map(|sensor| &sensor.columns).collect();
    let all = names.len();
    names.sort_unstable();
    names.dedup();
    names.len() < all
}

//! Drawn trajectories as tables: measurements that a filter reads, and the states as their truth.

use std::io::{self, Write};

use givens::simulate::Simulation;

use super::{digits, told};
use crate::model_file::Model;

/// The drawn trajectory of one run.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// Its number among the runs: all rows of one run come before those of the next.
    pub run: u32,
    /// Its name among the tracks, if there are several.
    pub track: Option<String>,
    /// The place of each row among those of all tracks of its run.
    pub index: Vec<usize>,
    /// Its times as they are to be written.
    pub time_text: Vec<String>,
    /// The sensor that each row names, if rows do.
    pub sensor: Vec<Option<usize>>,
    /// The controls of each row.
    pub controls: Vec<Vec<f64>>,
    /// What was drawn.
    pub simulation: Simulation,
}

/// Writes `time[,track_id][,sensor],<measure>…[,u_…]`.
///
/// # Errors
/// What the writer says.
pub fn write_measurements(out: &mut dyn Write, model: &Model, runs: &[Drawn]) -> io::Result<()> {
    let columns = columns(model);
    let has_sensor = runs.iter().any(|run| run.sensor.iter().any(Option::is_some));
    let mut header = keys(runs);
    header.extend(has_sensor.then(|| "sensor".to_owned()));
    header.extend(columns.iter().map(|(name, _)| name.clone()));
    header.extend(model.controls.iter().cloned());
    let d = model.measures();
    rows(
        out,
        &header,
        runs,
        |_, _| true,
        |run, k, cells| {
            let sensor = run.sensor.get(k).copied().flatten().and_then(|i| model.sensors.get(i));
            cells.extend(has_sensor.then(|| sensor.map_or(String::new(), |sensor| sensor.name.clone())));
            let z = &run.simulation.z[k * d..(k + 1) * d];
            for (_, stack) in &columns {
                let there = stack.iter().map(|&i| z[i]).find(|z: &f64| !z.is_nan());
                cells.push(there.map_or(String::new(), digits));
            }
            cells.extend(run.controls[k].iter().map(|&x| digits(x)));
        },
    )
}

/// Writes `time[,track_id],<state>…`, one row for each time of a track.
///
/// # Errors
/// What the writer says.
pub fn write_states(out: &mut dyn Write, model: &Model, runs: &[Drawn]) -> io::Result<()> {
    let n = model.states.len();
    let mut header = keys(runs);
    header.extend(model.states.iter().cloned());
    // rows at one time have one state
    let first = |run: &Drawn, k: usize| k == 0 || run.simulation.time[k] > run.simulation.time[k - 1];
    rows(out, &header, runs, first, |run, k, cells| {
        cells.extend(run.simulation.states[k * n..(k + 1) * n].iter().map(|&x| digits(x)));
    })
}

fn keys(runs: &[Drawn]) -> Vec<String> {
    let mut header = vec!["time".to_owned()];
    header.extend(runs.iter().any(|run| run.track.is_some()).then(|| "track_id".to_owned()));
    header
}

/// The columns of the measures, in order; two sensors may share one.
fn columns(model: &Model) -> Vec<(String, Vec<usize>)> {
    let mut columns: Vec<(String, Vec<usize>)> = Vec::new();
    let names = model.sensors.iter().flat_map(|sensor| &sensor.columns);
    for (i, name) in names.enumerate() {
        match columns.iter_mut().find(|(known, _)| known == name) {
            Some((_, stack)) => stack.push(i),
            None => columns.push((name.clone(), vec![i])),
        }
    }
    columns
}

fn rows(
    out: &mut dyn Write,
    header: &[String],
    runs: &[Drawn],
    keep: impl Fn(&Drawn, usize) -> bool,
    write: impl Fn(&Drawn, usize, &mut Vec<String>),
) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(header).map_err(told)?;
    let mut cells = Vec::with_capacity(header.len());
    let mut order: Vec<(&Drawn, usize)> =
        runs.iter().flat_map(|run| (0..run.simulation.time.len()).map(move |k| (run, k))).collect();
    order.sort_by_key(|&(run, k)| (run.run, run.index[k]));
    for (run, k) in order.into_iter().filter(|&(run, k)| keep(run, k)) {
        cells.clear();
        cells.push(run.time_text[k].clone());
        cells.extend(run.track.clone());
        write(run, k, &mut cells);
        table.write_record(&cells).map_err(told)?;
    }
    table.flush()
}

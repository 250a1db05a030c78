//! Answers as JSON lines: one object per row, its keys in one order, numbers that read back exactly, null where there
//! is none.

use std::io;

use givens::Estimates;
use serde::ser::{Serialize, SerializeMap, Serializer};

use super::Line;
use crate::table::Tracks;

/// The objects of these lines.
pub(super) fn rows(tracks: &Tracks, smoothed: bool, gated: bool, lines: &[Line]) -> io::Result<Vec<u8>> {
    let columns: Vec<&str> =
        tracks.scheme.sensors.iter().flat_map(|sensor| sensor.columns.iter().map(String::as_str)).collect();
    let mut out = Vec::new();
    for line in lines {
        serde_json::to_writer(&mut out, &Object { columns: &columns, smoothed, gated, line })?;
        out.push(b'\n');
    }
    Ok(out)
}

/// One row of output.
struct Object<'a> {
    columns: &'a [&'a str],
    /// Whether the filtered belief stands beside the smoothed one.
    smoothed: bool,
    /// Whether it is told that the row was beyond the gate.
    gated: bool,
    line: &'a Line<'a>,
}

impl Serialize for Object<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { columns, smoothed, gated, line } = *self;
        let mut map = serializer.serialize_map(None)?;
        let text = &line.row.time_text;
        match text.parse::<f64>() {
            Ok(seconds) => map.serialize_entry("time", &seconds)?,
            Err(_) => map.serialize_entry("time", text)?,
        }
        map.serialize_entry("track_id", &line.track)?;
        map.serialize_entry("sensor", &line.sensor)?;
        let estimate = line.estimate;
        map.serialize_entry("mean", &estimate.map(|(est, k)| est.mean(k)))?;
        map.serialize_entry("cov", &estimate.map(|(est, k)| square(est, est.cov(k))))?;
        if smoothed {
            map.serialize_entry("filtered_mean", &estimate.map(|(est, k)| est.filtered_mean(k)))?;
            map.serialize_entry("filtered_cov", &estimate.map(|(est, k)| square(est, est.filtered_cov(k))))?;
        }
        // the row that `start` has read was neither predicted nor measured
        let stepped = estimate.filter(|_| !line.started);
        map.serialize_entry("predicted_mean", &stepped.map(|(est, k)| est.predicted_mean(k)))?;
        map.serialize_entry("predicted_cov", &stepped.map(|(est, k)| square(est, est.predicted_cov(k))))?;
        let there = stepped.map(|(est, k)| present(est, k));
        let names = |there: &Vec<usize>| -> Vec<&str> {
            there.iter().filter_map(|&i| columns.get(i).copied()).collect()
        };
        map.serialize_entry("measures", &there.as_ref().map(names))?;
        let innovation = stepped.zip(there.as_ref()).map(|((est, k), there)| {
            let nu = est.innovation(k);
            there.iter().map(|&i| nu[i]).collect::<Vec<f64>>()
        });
        map.serialize_entry("innovation", &innovation)?;
        let covariance = stepped.zip(there.as_ref()).map(|((est, k), there)| Block {
            matrix: est.innovation_cov(k),
            size: est.measures(),
            keep: there,
        });
        map.serialize_entry("innovation_cov", &covariance)?;
        map.serialize_entry("nis", &stepped.map(|(est, k)| est.nis[k]))?;
        map.serialize_entry("nis_dof", &stepped.map(|(est, k)| est.nis_dof[k]))?;
        map.serialize_entry("log_likelihood", &stepped.map(|(est, k)| est.log_likelihood[k]))?;
        if gated {
            map.serialize_entry("gated", &stepped.map(|(est, k)| est.gated[k]))?;
        }
        map.end()
    }
}

/// The components of the measurement that a row brought.
fn present(est: &Estimates, k: usize) -> Vec<usize> {
    let innovation = est.innovation(k);
    (0..innovation.len()).filter(|&i| !innovation[i].is_nan()).collect()
}

/// The rows of a covariance of the state.
fn square<'a>(est: &Estimates, cov: &'a [f64]) -> Vec<&'a [f64]> {
    cov.chunks_exact(est.states().max(1)).collect()
}

/// The rows and columns `keep` of a matrix of `size` × `size`.
struct Block<'a> {
    matrix: &'a [f64],
    size: usize,
    keep: &'a [usize],
}

impl Serialize for Block<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let row =
            |i: &usize| -> Vec<f64> { self.keep.iter().map(|j| self.matrix[i * self.size + j]).collect() };
        serializer.collect_seq(self.keep.iter().map(row))
    }
}

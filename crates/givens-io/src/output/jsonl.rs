//! Answers as JSON lines: one object per row, numbers that read back exactly, null where there is none.

use std::io::{self, Write};

use givens::Estimates;
use serde_json::{Map, Value, json};

use super::Line;
use crate::model_file::Model;

pub(super) fn write(out: &mut dyn Write, model: &Model, lines: &[Line]) -> io::Result<()> {
    let columns: Vec<&str> =
        model.sensors.iter().flat_map(|sensor| sensor.columns.iter().map(String::as_str)).collect();
    for line in lines {
        serde_json::to_writer(&mut *out, &object(&columns, line))?;
        out.write_all(b"\n")?;
    }
    Ok(())
}

/// A number; null if it is none.
fn number(x: f64) -> Value {
    serde_json::Number::from_f64(x).map_or(Value::Null, Value::Number)
}

fn vector(values: &[f64]) -> Value {
    values.iter().map(|&x| number(x)).collect()
}

/// The rows and columns of `keep`, of a matrix of `size` × `size`.
fn block(matrix: &[f64], size: usize, keep: &[usize]) -> Value {
    keep.iter().map(|&i| keep.iter().map(|&j| number(matrix[i * size + j])).collect::<Value>()).collect()
}

fn matrix(values: &[f64], size: usize) -> Value {
    values.chunks_exact(size.max(1)).map(vector).collect()
}

fn object(columns: &[&str], line: &Line) -> Map<String, Value> {
    let mut object = Map::new();
    let mut put = |key: &str, value: Value| object.insert(key.to_owned(), value);
    let text = &line.row.time_text;
    put("time", text.parse().map_or_else(|_| json!(text), number));
    put("track_id", json!(line.track));
    put("sensor", json!(line.sensor));
    let Some((est, k)) = line.estimate else {
        for key in KEYS {
            put(key, Value::Null);
        }
        return object;
    };
    let n = est.states();
    put("mean", vector(est.mean(k)));
    put("cov", matrix(est.cov(k), n));
    if est.is_smoothed() {
        put("filtered_mean", vector(est.filtered_mean(k)));
        put("filtered_cov", matrix(est.filtered_cov(k), n));
    }
    if line.started {
        for key in &KEYS[2..] {
            put(key, Value::Null);
        }
        return object;
    }
    put("predicted_mean", vector(est.predicted_mean(k)));
    put("predicted_cov", matrix(est.predicted_cov(k), n));
    measured(columns, est, k, put);
    object
}

/// What every object has beside time, track and sensor.
const KEYS: [&str; 10] = [
    "mean",
    "cov",
    "predicted_mean",
    "predicted_cov",
    "measures",
    "innovation",
    "innovation_cov",
    "nis",
    "nis_dof",
    "log_likelihood",
];

fn measured<R>(columns: &[&str], est: &Estimates, k: usize, mut put: impl FnMut(&str, Value) -> R) {
    let innovation = est.innovation(k);
    let there: Vec<usize> = (0..innovation.len()).filter(|&i| !innovation[i].is_nan()).collect();
    put("measures", there.iter().map(|&i| columns.get(i).copied()).collect());
    put("innovation", there.iter().map(|&i| number(innovation[i])).collect());
    put("innovation_cov", block(est.innovation_cov(k), est.measures(), &there));
    put("nis", number(est.nis[k]));
    put("nis_dof", json!(est.nis_dof[k]));
    put("log_likelihood", number(est.log_likelihood[k]));
}

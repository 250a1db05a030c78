//! numeris on the ladders of `tests/golden/stress.json`: `peers stress f64 FILE`, the answers as `tests/src/stress/peers.rs` reads them.

use crate::numeris_peer::VERSION;
use givens_contest::Failure;
use numeris::estimate::{Ckf, SrUkf};
use numeris::{FloatScalar, Matrix, Vector};
use serde_json::{Value, json};

/// The answers in one precision, as JSON.
pub fn run(precision: &str, file: &str) -> Result<String, Failure> {
    let cases: Value = serde_json::from_str(&std::fs::read_to_string(file)?)?;
    let filters = ["Ckf", "SrUkf"].map(|name| {
        let mut answers = serde_json::Map::new();
        for (case, of) in cases.as_object().into_iter().flatten() {
            let rungs = of["rungs"].as_array().into_iter().flatten();
            if of["rungs"][0].get("only").is_none() {
                let climbed = rungs.map(|rung| match precision {
                    "f32" => sized::<f32>(name, rung),
                    _ => sized::<f64>(name, rung),
                });
                answers.insert(case.clone(), climbed.collect());
            }
        }
        let title = format!("{VERSION}, {name}");
        json!({ "name": title, "precision": precision, "points": true, "cases": answers })
    });
    Ok(Value::from(filters.to_vec()).to_string())
}

/// Sizes are known when numeris is compiled.
fn sized<T: FloatScalar>(name: &str, rung: &Value) -> Value {
    let size = |key: &str| rung[key].as_array().map_or(0, Vec::len);
    match (size("mean"), size("r")) {
        (2, 1) => climb::<T, 2, 1>(name, rung),
        (3, 1) => climb::<T, 3, 1>(name, rung),
        (3, 2) => climb::<T, 3, 2>(name, rung),
        (n, d) => json!({ "rows": [], "error": format!("{n} states and {d} measures are not compiled in") }),
    }
}

fn number<T: FloatScalar>(of: &Value) -> T {
    of.as_f64().and_then(T::from).unwrap_or_else(T::nan)
}

fn vector<T: FloatScalar, const N: usize>(of: &Value) -> Vector<T, N> {
    Vector::from_array(core::array::from_fn(|i| number(&of[i])))
}

fn matrix<T: FloatScalar, const R: usize, const C: usize>(of: &Value) -> Matrix<T, R, C> {
    Matrix::new(core::array::from_fn(|i| core::array::from_fn(|j| number(&of[i][j]))))
}

fn climb<T: FloatScalar, const N: usize, const D: usize>(name: &str, rung: &Value) -> Value {
    let (mean, cov) = (vector::<T, N>(&rung["mean"]), matrix::<T, N, N>(&rung["cov"]));
    let (h, r, angle) =
        (matrix::<T, D, N>(&rung["h"]), matrix::<T, D, D>(&rung["r"]), rung.get("period").is_some());
    let observe = |x: &Vector<T, N>| -> Vector<T, D> {
        let z = h * *x;
        if angle { Vector::from_array(core::array::from_fn(|i| z[i].sin().atan2(z[i].cos()))) } else { z }
    };
    let repeat = rung.get("repeat").and_then(Value::as_u64);
    let count = repeat.map_or(rung["z"].as_array().map_or(0, Vec::len), |count| count as usize);
    let last = |of: &Value| of.as_array().map_or(0, |all| all.len() - 1);
    let mut rows = Vec::new();
    let mut told = |k: usize, x: &Vector<T, N>, p: &Matrix<T, N, N>| {
        if repeat.is_none() || k + 1 == count {
            let float = |x: T| x.to_f64().filter(|x| x.is_finite());
            let mean: Vec<_> = (0..N).map(|i| float(x[i])).collect();
            let cov: Vec<_> = (0..N).flat_map(|i| (0..=i).map(move |j| float(p[(i, j)]))).collect();
            rows.push(json!({ "mean": mean, "cov": cov }));
        }
    };
    let mut go = || -> Result<(), String> {
        let why = |error| format!("{error:?}");
        let step = |k: usize| {
            let step = &rung["steps"][k.min(last(&rung["steps"]))];
            let z: Vector<T, D> = vector(&rung["z"][k.min(last(&rung["z"]))]);
            (matrix::<T, N, N>(&step["f"]), matrix::<T, N, N>(&step["q"]), z)
        };
        if name == "Ckf" {
            let mut filter = Ckf::<T, N, D>::new(mean, cov);
            for k in 0..count {
                let (f, q, z) = step(k);
                filter.predict(|x| f * *x, Some(&q)).map_err(why)?;
                filter.update(&z, observe, &r).map_err(why)?;
                told(k, &filter.x, &filter.p);
            }
            return Ok(());
        }
        let (one, zero) = (T::one(), T::zero());
        let mut filter =
            SrUkf::<T, N, D>::from_covariance_with_params(mean, cov, one, zero, one).map_err(why)?;
        for k in 0..count {
            let (f, q, z) = step(k);
            filter.predict(|x| f * *x, Some(&q)).map_err(why)?;
            filter.update(&z, observe, &r).map_err(why)?;
            told(k, &filter.x, &filter.covariance());
        }
        Ok(())
    };
    let error = go().err();
    json!({ "rows": rows, "error": error })
}

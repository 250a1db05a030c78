//! Nanoseconds per row of the turning flight of the zoo, written in Rust: what a model written in Python is measured against.
//!
//!     cargo run --release -p givens --example turn_rows < ROWS
//!
//! A line of ROWS has time, range, azimuth and elevation. `python/benchmarks/targets.py` gives them. The answer is one
//! line: the least time per row, then the last mean.
#![allow(clippy::print_stdout, reason = "it is its answer")]

use core::error::Error;
use core::hint::black_box;
use givens::Data;
use givens::filter::{Gaussian, SrCdCkf};
use givens::model::zoo::{Radar3d, Turn3d};
use std::io::stdin;
use std::time::Instant;

/// Runs over all rows, of which the fastest counts.
const RUNS: usize = 40;

fn main() -> Result<(), Box<dyn Error>> {
    let mut data = Data::new(3).starting_at(0.0);
    for line in stdin().lines() {
        let row = line?.split(' ').map(str::parse).collect::<Result<Vec<f64>, _>>()?;
        let [time, z @ ..] = row.as_slice() else { return Err("an empty line".into()) };
        data.push(*time, z)?;
    }
    let mean = [1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 0.1];
    let prior = Gaussian::from_std(&mean, &[100.0, 100.0, 100.0, 100.0, 100.0, 100.0, 0.02])?;
    let (turn, radar, method) = (Turn3d::default(), Radar3d::default(), SrCdCkf::default());
    let (mut least, mut last) = (f64::INFINITY, Vec::new());
    for _ in 0..RUNS {
        let begin = Instant::now();
        let estimates = givens::filter(&method, &turn, &radar, black_box(&data), &prior)?;
        least = least.min(begin.elapsed().as_nanos() as f64 / data.len() as f64);
        last = estimates.mean(data.len() - 1).to_vec();
    }
    let last = last.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    println!("{least} {last}");
    Ok(())
}

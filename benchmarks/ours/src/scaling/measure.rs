//! The points of a study take turns, so that a disturbance meets all of them.

use super::study::Study;
use core::hint::black_box;
use core::time::Duration;
use givens_contest::{Failure, Spread, Stopwatch};
use std::time::Instant;

/// What a point may use before it sits out the remaining rounds.
const BUDGET: Duration = Duration::from_millis(400);
/// Rounds that even a slow point runs.
const FEWEST: usize = 3;

/// Fills in the times.
pub fn measure(study: &mut Study, rounds: usize) -> Result<(), Failure> {
    let (wall, named) = (study.wall, study.name);
    let mut points: Vec<_> = study.series.iter_mut().flat_map(|series| &mut series.points).collect();
    let mut samples: Vec<Vec<f64>> = points.iter().map(|_| Vec::new()).collect();
    let mut spent = vec![Duration::ZERO; points.len()];
    // the first round warms up
    for round in 0..=rounds {
        for ((point, samples), spent) in points.iter_mut().zip(&mut samples).zip(&mut spent) {
            let tired = *spent > BUDGET && samples.len() >= FEWEST;
            let Some(entry) = point.entry.as_mut().filter(|_| !tired) else { continue };
            let (begin, watch) = (Instant::now(), Stopwatch::start());
            black_box((entry.go)().map_err(|fault| format!("{named}, {}: {fault}", point.x))?);
            let (thread, passed) = watch.nanoseconds();
            *spent += begin.elapsed();
            if round > 0 {
                samples.push(if wall { passed } else { thread } as f64 / entry.steps as f64);
            }
        }
    }
    for (point, samples) in points.into_iter().zip(samples) {
        (point.time, point.entry) = (Spread::of(samples), None);
    }
    Ok(())
}

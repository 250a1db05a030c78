//! The points of a study take turns, so that a disturbance meets all of them.

use super::study::Study;
use core::hint::black_box;
use core::time::Duration;
use givens_contest::{Entry, Failure, Spread, Stopwatch};
use std::time::Instant;

/// What a point may use before it sits out the remaining rounds.
const BUDGET: Duration = Duration::from_millis(400);
/// Rounds that even a slow point runs.
const FEWEST: usize = 3;
/// A turn is timed over as many repetitions as take this long.
const TURN: f64 = 2e6;
/// Nanoseconds of a repetition from which on what was before it no longer counts.
const LONG: f64 = 1e8;

/// Fills in the times.
pub fn measure(study: &mut Study, rounds: usize) -> Result<(), Failure> {
    let (wall, name) = (study.wall, study.name);
    let mut points: Vec<_> = study.series.iter_mut().flat_map(|series| &mut series.points).collect();
    let mut samples: Vec<Vec<f64>> = points.iter().map(|_| Vec::new()).collect();
    let mut spent = vec![Duration::ZERO; points.len()];
    for _ in 0..rounds {
        for ((point, samples), spent) in points.iter_mut().zip(&mut samples).zip(&mut spent) {
            let tired = *spent > BUDGET && samples.len() >= FEWEST;
            let Some(entry) = point.entry.as_mut().filter(|_| !tired) else { continue };
            let begin = Instant::now();
            let time = turn(entry, wall).map_err(|fault| format!("{name}, {}: {fault}", point.x))?;
            *spent += begin.elapsed();
            samples.push(time);
        }
    }
    for (point, samples) in points.into_iter().zip(samples) {
        (point.time, point.entry) = (Spread::of(samples), None);
    }
    Ok(())
}

/// Nanoseconds for a step. The first repetition finds caches, and heaps, as another point left them: it does not count, unless
/// it is long.
fn turn(entry: &mut Entry, wall: bool) -> Result<f64, Failure> {
    let mut timed = |times: usize| {
        let watch = Stopwatch::start();
        for _ in 0..times {
            black_box((entry.go)()?);
        }
        let (thread, passed) = watch.nanoseconds();
        Ok::<f64, Failure>(if wall { passed } else { thread } as f64 / times as f64)
    };
    let first = timed(1)?;
    let all = if first > LONG { first } else { timed((TURN / first).ceil() as usize)? };
    Ok(all / entry.steps as f64)
}

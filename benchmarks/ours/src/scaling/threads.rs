//! Against the number of threads.

use super::study::{Besides, Guide, Point, Series, Study};
use super::{cores, tracks};
use crate::batch;
use crate::workloads::{plane, space};
use core::num::NonZeroUsize;
use givens_contest::{Entry, Failure, Inputs, Table};
use givens_core::filter::{SrCdCkf, SrCkf};

const TRACKS: usize = 2000;
/// Rows of a track in continuous time.
const ROWS: usize = 20;

pub fn study(inputs: &Inputs) -> Result<Study, Failure> {
    let discrete = tracks::first(&inputs.f32("plane_tracks", 2)?, TRACKS);
    let fast = inputs.csv("space_fast")?;
    let track = &fast.values[..ROWS * fast.columns];
    let continuous = Table { columns: fast.columns, values: track.repeat(TRACKS) };
    let root = SrCdCkf { substeps: 8, ..Default::default() };
    Ok(Study {
        name: "threads",
        title: "Against the number of threads",
        about: "`Batch::run` over 2000 tracks, with the whole record of estimates: `sr-ckf` over those of W2, 100 rows each, and `sr-cd-ckf` with 8 sub-steps over the first 20 rows of P1. The time that passes.",
        x: "threads",
        y: "one step of one track",
        wall: true,
        series: vec![
            series("sr-ckf", &|threads| {
                batch::entry(plane::problem(SrCkf::default(), discrete.clone(), 100, 100)?, threads)
            })?,
            series("sr-cd-ckf", &|threads| {
                batch::entry(space::split(root, continuous.clone(), ROWS)?, threads)
            })?,
        ],
        guides: vec![Guide {
            name: "sr-ckf, no thread wasted".to_owned(),
            at: Box::new(|series, threads| Some(series.first()?.at(1)?.median / threads as f64)),
        }],
        besides: Besides::SpeedUp,
    })
}

fn series(
    name: &'static str,
    make: &dyn Fn(NonZeroUsize) -> Result<Entry<'static>, Failure>,
) -> Result<Series, Failure> {
    let some = (1..=cores()).filter(|&threads| threads <= 8 || threads % 4 == 0 || threads == cores());
    let point = |threads| Ok(Point::new(threads, make(NonZeroUsize::MIN.saturating_add(threads - 1))?));
    Ok(Series { name, points: some.map(point).collect::<Result<_, Failure>>()? })
}

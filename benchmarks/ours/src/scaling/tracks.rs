//! Against the number of tracks.

use super::study::{Besides, Point, Series, Study};
use crate::workloads::plane;
use crate::{batch, packs, single};
use core::num::NonZeroUsize;
use givens_contest::{Entry, Failure, Inputs, Table};
use givens_core::filter::SrCkf;

const SIZES: [usize; 9] = [1, 3, 10, 30, 100, 300, 1000, 3000, 10_000];
/// Rows of a track.
const ROWS: usize = 100;

pub fn study(inputs: &Inputs) -> Result<Study, Failure> {
    let all = inputs.f32("plane_tracks", 2)?;
    let method = SrCkf::default();
    let series = |name, make: &dyn Fn(Table) -> Result<Entry<'static>, Failure>| {
        let point = |&tracks: &usize| {
            let mut entry = make(first(&all, tracks))?;
            // also where a pack has lanes to spare
            entry.steps = tracks * ROWS;
            Ok(Point::new(tracks, entry))
        };
        Ok::<_, Failure>(Series { name, points: SIZES.iter().map(point).collect::<Result<_, Failure>>()? })
    };
    let problem = |rows| plane::problem(method, rows, ROWS, ROWS);
    Ok(Study {
        name: "tracks",
        title: "Against the number of tracks",
        about: "`sr-ckf` over tracks of W2 (five states, 100 rows each), in one thread. *Batch* is `Batch::run`, which gives back the whole record of estimates; the others are stepped by hand and keep the \
                last estimate.",
        x: "tracks",
        y: "one step of one track",
        wall: false,
        series: vec![
            series("Batch", &|rows| batch::entry(problem(rows)?, NonZeroUsize::MIN))?,
            series("one by one", &|rows| Ok(single::untold(problem(rows)?)))?,
            series("packs", &|rows| packs::entry::<f64, _, _, _>(problem(rows)?))?,
            series("packs, f32", &|rows| packs::entry::<f32, _, _, _>(problem(rows)?))?,
        ],
        guides: Vec::new(),
        besides: Besides::Nothing,
    })
}

/// As many tracks, the same again where there are no more.
pub fn first(all: &Table, tracks: usize) -> Table {
    let len = tracks * ROWS * all.columns;
    Table { columns: all.columns, values: all.values.iter().copied().cycle().take(len).collect() }
}

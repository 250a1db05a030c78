//! What a study consists of.

use givens_contest::{Entry, Spread};

/// Work of one size.
pub struct Point {
    /// How large it is, in the unit of the study.
    pub x: usize,
    /// Runs it once; `steps` of it are what a time is divided by. Gone when it has been measured.
    pub entry: Option<Entry<'static>>,
    /// Nanoseconds for a step.
    pub time: Option<Spread>,
}

impl Point {
    pub fn new(x: usize, entry: Entry<'static>) -> Self {
        Self { x, entry: Some(entry), time: None }
    }
}

/// One way of doing the work, in all sizes, ascending.
pub struct Series {
    pub name: &'static str,
    pub points: Vec<Point>,
}

impl Series {
    pub fn at(&self, x: usize) -> Option<&Spread> {
        self.points.iter().find(|point| point.x == x)?.time.as_ref()
    }
}

/// Nanoseconds for a step of a size, if the series, measured, tell it.
type Law = Box<dyn Fn(&[Series], usize) -> Option<f64>>;

/// A line that the times may be compared with.
pub struct Guide {
    pub name: String,
    pub at: Law,
}

/// What the page says besides the times.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Besides {
    Nothing,
    /// The first series by the cube of its size, and by the first guide.
    Cube,
    /// How many times faster than the first of its series, and that by the size.
    SpeedUp,
}

/// Times against one size.
pub struct Study {
    pub name: &'static str,
    pub title: &'static str,
    /// What is computed, for the page.
    pub about: &'static str,
    /// What grows.
    pub x: &'static str,
    /// What is timed.
    pub y: &'static str,
    /// The time that passes, in place of what the thread uses of the processor.
    pub wall: bool,
    pub series: Vec<Series>,
    pub guides: Vec<Guide>,
    pub besides: Besides,
}

impl Study {
    /// All sizes, ascending.
    pub fn sizes(&self) -> Vec<usize> {
        let mut all: Vec<usize> =
            self.series.iter().flat_map(|series| series.points.iter().map(|point| point.x)).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}

//! The figure of a track: what a filter or smoother estimated, against measurements and truth.

mod nis;
mod page;
mod plane;
mod state;

use super::colour::Colour;
use super::plot::Figure;

/// What there is to show of one run over some data. Lengths that do not agree are cut to the
/// shortest; a value that is not finite leaves a gap.
///
/// ```
/// use givens_io::figure::{self, StateSeries, Track, TrackFigure};
///
/// let position = StateSeries {
///     name: "x".into(),
///     time: vec![0.0, 1.0, 2.0],
///     mean: vec![0.1, 1.2, 1.9],
///     std: vec![0.5, 0.4, 0.3],
///     ..StateSeries::default()
/// };
/// let run = TrackFigure {
///     title: "A walk".into(),
///     tracks: vec![Track { states: vec![position], ..Track::default() }],
///     ..TrackFigure::default()
/// };
/// assert!(figure::svg(&run.figure()).contains("A walk"));
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TrackFigure {
    /// Stands above all.
    pub title: String,
    /// Lines under the title: the method, the data, what the caller wants to be read.
    pub notes: Vec<String>,
    /// Label of the time axes; empty: `time (s)`.
    pub time_label: String,
    /// Labels of the plane, across and upwards, where one is drawn.
    pub plane_labels: [String; 2],
    /// The tracks. All are drawn in the plane; states and NIS are those of the first track that has them.
    pub tracks: Vec<Track>,
    /// Whether the estimates are smoothed ones.
    pub smoothed: bool,
}

impl TrackFigure {
    /// Lays the figure out; write it with [`write`](super::write).
    pub fn figure(&self) -> Figure {
        page::figure(self)
    }
}

/// One track.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Track {
    /// Its name, told where there are several.
    pub name: String,
    /// Its way in the plane.
    pub plane: Option<PlaneTrack>,
    /// Its states over time, in model order.
    pub states: Vec<StateSeries>,
    /// Its normalised innovation squared.
    pub nis: Option<NisSeries>,
}

/// How the estimate of a track is named and coloured, alike in all panels.
struct Look {
    name: String,
    colour: Colour,
}

impl Look {
    /// With more tracks than this they have no names in the key, and only their lines are drawn.
    const MOST_NAMED: usize = 7;

    fn of(figure: &TrackFigure, index: usize) -> Self {
        let colour = Colour::series(index);
        let name = match (figure.tracks.len(), figure.tracks.get(index)) {
            (2..=Self::MOST_NAMED, Some(track)) if !track.name.is_empty() => track.name.clone(),
            _ if figure.smoothed => "smoothed".to_owned(),
            _ => "estimate".to_owned(),
        };
        Self { name, colour }
    }
}

/// A track in the plane of two states.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlaneTrack {
    /// Estimated `[x, y]`, row by row.
    pub estimate: Vec<[f64; 2]>,
    /// Its covariances `[xx, xy, yy]`, for the 2σ ellipses.
    pub covariance: Vec<[f64; 3]>,
    /// The filter's own estimate, drawn thin beside a smoothed one.
    pub filtered: Option<Vec<[f64; 2]>>,
    /// Where the measurements place the object.
    pub measurements: Vec<[f64; 2]>,
    /// Where it was, with a length of its own.
    pub truth: Option<Vec<[f64; 2]>>,
}

/// One state over time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StateSeries {
    /// The state's name.
    pub name: String,
    /// Times of the rows, ascending.
    pub time: Vec<f64>,
    /// The estimate at these times.
    pub mean: Vec<f64>,
    /// Its standard deviation.
    pub std: Vec<f64>,
    /// The filter's own estimate, drawn thin beside a smoothed one.
    pub filtered: Option<Vec<f64>>,
    /// The truth at these times, NaN where it is not known; with it, the error is drawn. Both are lines through what is
    /// known.
    pub truth: Option<Vec<f64>>,
    /// Where these are only some of the rows: of all of them those whose error is within ±2σ, and those that have one.
    pub inside: Option<[usize; 2]>,
}

/// Normalised innovation squared, and the band that holds 95 % of it if the filter is consistent.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NisSeries {
    /// Times of the rows, ascending.
    pub time: Vec<f64>,
    /// One value for each row; NaN where there was no measurement.
    pub nis: Vec<f64>,
    /// The 2.5 % quantile of χ² with the row's degrees of freedom.
    pub lower: Vec<f64>,
    /// The 97.5 % quantile.
    pub upper: Vec<f64>,
    /// Rows beyond the gate, which were not taken in: drawn as rings, and in no count. Empty: none.
    pub gated: Vec<bool>,
    /// Where these are only some of the rows, what was counted of all.
    pub all: Option<NisCounts>,
}

/// What was counted of all rows, where only some are drawn.
#[derive(Debug, Clone, PartialEq, Default, serde::Serialize, serde::Deserialize)]
pub struct NisCounts {
    /// Rows with a value within its band, and rows with one.
    pub inside: [usize; 2],
    /// Rows beyond the gate.
    pub gated: usize,
    /// Rows of a block.
    pub block: usize,
    /// `[time, NIS]`, the mean over each block of rows.
    pub means: Vec<[f64; 2]>,
}

//! Figures, as SVG and PNG, that look the same on every machine: the text is drawn from an embedded
//! font, and equal input gives equal bytes.
//!
//! Two levels. [`TrackFigure`] takes what a filter or smoother estimated and lays out the figures of a
//! track: the plane, each state over time, its error, and NIS. Below it, [`Figure`], [`Panel`] and
//! [`Mark`] are a small plotting layer for anything else.
//!
//! ```
//! use givens_io::figure::{Block, Colour, Figure, Grid, Mark, Panel, Shape};
//!
//! let points = (0..100).map(|k| [0.1 * f64::from(k), (0.1 * f64::from(k)).sin()]).collect();
//! let sine = Mark::new("sine", Colour::BLUE, Shape::Line { points, width: 1.6, dashed: false });
//! let panel = Panel { heading: "a sine".into(), marks: vec![sine], ..Panel::default() };
//! let grid = Grid { columns: vec![1.0], rows: vec![1.0], cells: vec![Some(panel)] };
//! let figure = Figure {
//!     title: "An example".into(),
//!     notes: vec![],
//!     key: true,
//!     body: Block::Grid(grid),
//!     width: 600.0,
//!     height: 300.0,
//! };
//! assert!(givens_io::figure::svg(&figure).starts_with("<svg"));
//! ```

#[cfg(test)]
mod any_data;
mod clip;
mod colour;
mod decimate;
mod file;
mod font;
#[cfg(test)]
mod gallery;
mod key;
mod layout;
mod marks;
mod number;
mod panel;
mod plot;
mod raster;
mod scale;
mod scene;
#[cfg(test)]
mod tests;
mod ticks;
mod track;
mod vector;

pub use colour::Colour;
pub use file::{FigureError, write};
pub use plot::{Axis, Block, Figure, Grid, Mark, Panel, Shape};
pub use scale::Scale;
pub use track::{NisCounts, NisSeries, PlaneTrack, StateSeries, Track, TrackFigure};

/// The figure as an SVG document. Text is drawn as outlines, and labelled for screen readers.
pub fn svg(figure: &Figure) -> String {
    vector::write(&layout::scene(figure))
}

/// The figure as a PNG file, two device pixels for each of its own.
///
/// # Errors
///
/// [`FigureError::Encode`] if the machine cannot hold the picture.
pub fn png(figure: &Figure) -> Result<Vec<u8>, FigureError> {
    raster::write(&layout::scene(figure)).ok_or(FigureError::Encode)
}

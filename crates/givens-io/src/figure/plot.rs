//! What a figure is made of before it is laid out: panels, their axes and their marks, as plain data.

use super::colour::Colour;
use super::scale::Scale;

/// A figure: a header over panels.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Stands above all; empty for none.
    pub title: String,
    /// Lines in smaller grey under the title.
    pub notes: Vec<String>,
    /// Whether one key for all panels stands under the title: each named mark once, in order.
    pub key: bool,
    /// The panels.
    pub body: Block,
    /// Width of the whole in pixels, held within 240 and 6000.
    pub width: f64,
    /// Height of the panels in pixels, held within 120 and 12000; the header comes on top of it.
    pub height: f64,
}

/// An arrangement of panels.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// Panels whose axes stand in line.
    Grid(Grid),
    /// Blocks side by side, each with its share of the width.
    Row(Vec<(f64, Block)>),
    /// Blocks one under the other, each with its share of the height; their outer edges stand in line.
    Column(Vec<(f64, Block)>),
}

/// Panels in rows and columns.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Grid {
    /// The share of the width that each column's axes take.
    pub columns: Vec<f64>,
    /// The share of the height that each row's axes take.
    pub rows: Vec<f64>,
    /// Row by row; `None`, or a cell that is missing at the end, stays blank.
    pub cells: Vec<Option<Panel>>,
}

/// A pair of axes and what is drawn between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Panel {
    /// Above the axes on the left, in bold.
    pub heading: String,
    /// Above the axes on the right, small and grey; of parts divided by ` · `, the last ones give way
    /// where the room is short.
    pub remark: String,
    /// Across.
    pub x: Axis,
    /// Upwards.
    pub y: Axis,
    /// Whether one unit of x is as long as one of y (linear axes only); the looser range grows.
    pub equal: bool,
    /// Whether the named marks are listed above the axes.
    pub key: bool,
    /// In drawing order.
    pub marks: Vec<Mark>,
}

/// One axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The quantity and its unit; empty for none.
    pub label: String,
    /// From where to where; left out: what the marks need, and `padding` more.
    pub range: Option<[f64; 2]>,
    /// Share of the length added at each end of a range that was not given.
    pub padding: f64,
    /// How values are spread.
    pub scale: Scale,
    /// Where to tick the axis and what to write there, ascending; empty: at round values. Every second, third, … is kept
    /// where there is no room for all.
    pub ticks: Vec<(f64, String)>,
    /// Whether the ticks have numbers and the axis its label; a panel above another needs neither.
    pub labelled: bool,
}

impl Default for Axis {
    fn default() -> Self {
        Self {
            label: String::new(),
            range: None,
            padding: 0.04,
            scale: Scale::Linear,
            ticks: Vec::new(),
            labelled: true,
        }
    }
}

/// One series of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Its name in the key; empty to leave it out there.
    pub name: String,
    /// Its colour.
    pub colour: Colour,
    /// What is drawn.
    pub shape: Shape,
}

impl Mark {
    /// A named mark.
    pub fn new(name: &str, colour: Colour, shape: Shape) -> Self {
        Self { name: name.to_owned(), colour, shape }
    }
}

/// What a mark draws. A value that is not finite, or that the axis cannot hold, leaves a gap.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A line through the points `[x, y]`, `width` pixels wide.
    Line {
        /// In order along the line.
        points: Vec<[f64; 2]>,
        /// In pixels.
        width: f64,
        /// Broken into dashes.
        dashed: bool,
    },
    /// A marker at each point `[x, y]`.
    Dots {
        /// In any order.
        points: Vec<[f64; 2]>,
        /// In pixels.
        radius: f64,
        /// A ring in place of a disc.
        hollow: bool,
    },
    /// The area between two curves, as rows `[x, lower, upper]`.
    Band {
        /// In order along x.
        rows: Vec<[f64; 3]>,
    },
    /// Ellipses of equal probability about their centres. They do not widen the ranges of the axes.
    Ellipses {
        /// `[x, y]` of each.
        centres: Vec<[f64; 2]>,
        /// `[xx, xy, yy]` of each.
        covariances: Vec<[f64; 3]>,
        /// Half axes, in standard deviations.
        sigmas: f64,
        /// Those nearer than this many pixels to the last one drawn are left out.
        apart: f64,
    },
    /// A horizontal line across the panel.
    Level {
        /// Its height.
        y: f64,
        /// Broken into dashes.
        dashed: bool,
    },
}

impl Shape {
    /// The x of all points that the axes must show.
    pub(super) fn xs(&self) -> Box<dyn Iterator<Item = f64> + '_> {
        match self {
            Self::Line { points, .. } | Self::Dots { points, .. } => Box::new(points.iter().map(|p| p[0])),
            Self::Band { rows } => Box::new(rows.iter().map(|r| r[0])),
            Self::Ellipses { centres, .. } => Box::new(centres.iter().map(|c| c[0])),
            Self::Level { .. } => Box::new(core::iter::empty()),
        }
    }

    /// The y of all points that the axes must show.
    pub(super) fn ys(&self) -> Box<dyn Iterator<Item = f64> + '_> {
        match self {
            Self::Line { points, .. } | Self::Dots { points, .. } => Box::new(points.iter().map(|p| p[1])),
            Self::Band { rows } => Box::new(rows.iter().flat_map(|r| [r[1], r[2]])),
            Self::Ellipses { centres, .. } => Box::new(centres.iter().map(|c| c[1])),
            Self::Level { y, .. } => Box::new(core::iter::once(*y)),
        }
    }
}

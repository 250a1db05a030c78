//! What a figure is made of when all is laid out: shapes in pixels, y downwards, in drawing order.
//! Both writers read it and nothing else, so that SVG and PNG cannot differ.

use super::colour::Colour;

/// A point in pixels, or, in a glyph, in em.
pub(super) type Point = [f64; 2];

/// A piece of an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Segment {
    Move(Point),
    Line(Point),
    Quadratic(Point, Point),
    Cubic(Point, Point, Point),
    Close,
}

/// The two weights of the embedded font.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Weight {
    Regular,
    SemiBold,
}

/// A rectangle in pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rect {
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
}

impl Rect {
    pub fn right(&self) -> f64 {
        self.x + self.width
    }
    pub fn bottom(&self) -> f64 {
        self.y + self.height
    }
    /// The rectangle larger by `margin` on each side.
    pub fn grown(&self, margin: f64) -> Self {
        Self {
            x: self.x - margin,
            y: self.y - margin,
            width: self.width + 2.0 * margin,
            height: self.height + 2.0 * margin,
        }
    }
    pub fn contains(&self, [x, y]: Point) -> bool {
        x >= self.x && x <= self.right() && y >= self.y && y <= self.bottom()
    }
}

/// How a line is drawn; `dash` is the lengths of dash and gap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stroke {
    pub colour: Colour,
    pub width: f64,
    pub dash: Option<[f64; 2]>,
}

/// Where the text stands about its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// One line of text; `turned` reads upwards.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Text {
    /// On the baseline.
    pub at: Point,
    pub line: String,
    pub size: f64,
    pub weight: Weight,
    pub colour: Colour,
    pub anchor: Anchor,
    pub turned: bool,
}

/// The shape of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Marker {
    Disc,
    Ring,
}

/// One thing to draw.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Item {
    /// Open runs of points, at least two in each.
    Lines {
        runs: Vec<Vec<Point>>,
        stroke: Stroke,
    },
    /// Closed rings, filled and drawn along their edge where asked.
    Rings {
        rings: Vec<Vec<Point>>,
        fill: Option<Colour>,
        stroke: Option<Stroke>,
    },
    /// The same marker at many places.
    Markers {
        at: Vec<Point>,
        marker: Marker,
        radius: f64,
        colour: Colour,
    },
    Text(Text),
    /// Items cut off at a rectangle.
    Clipped {
        rect: Rect,
        items: Vec<Item>,
    },
}

/// A whole picture.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scene {
    pub title: String,
    pub description: String,
    pub width: f64,
    pub height: f64,
    pub items: Vec<Item>,
}

/// Width of a ring's line, as a share of the marker's radius.
pub(super) const RING_WIDTH: f64 = 0.4;

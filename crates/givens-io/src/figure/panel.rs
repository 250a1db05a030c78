//! One panel: ranges, ticks, the room its labels need, and its drawing.

use super::colour::Colour;
use super::font::Fonts;
use super::key;
use super::marks::{self, Frame};
use super::plot::{Axis, Panel};
use super::scale::{Ruler, Scale, span};
use super::scene::{Anchor, Item, Rect, Stroke, Text, Weight};
use super::ticks::{Ticks, ticks};

pub(super) const TICK_SIZE: f64 = 11.0;
const LABEL_SIZE: f64 = 11.5;
const HEADING_SIZE: f64 = 12.5;
const REMARK_SIZE: f64 = 10.5;

/// Room between the axes of a panel and the edge of its cell.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Margins {
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

/// A panel with its ranges known.
pub(super) struct Ranged<'a> {
    pub panel: &'a Panel,
    x: [f64; 2],
    y: [f64; 2],
    empty: bool,
}

impl<'a> Ranged<'a> {
    pub fn new(panel: &'a Panel) -> Self {
        let shapes = || panel.marks.iter().map(|m| &m.shape);
        let (x, y) = (shapes().flat_map(|s| s.xs()), shapes().flat_map(|s| s.ys()));
        let (across, up) = (span(panel.x.scale, x), span(panel.y.scale, y));
        let empty = across.is_none() || up.is_none();
        Self { panel, x: range(&panel.x, across), y: range(&panel.y, up), empty }
    }

    /// The rulers for axes that fill `rect`.
    fn frame(&self, rect: Rect) -> Frame {
        let (mut x, mut y) = (self.x, self.y);
        let linear = |a: &Axis| a.scale == Scale::Linear;
        if self.panel.equal && linear(&self.panel.x) && linear(&self.panel.y) {
            let unit = ((x[1] - x[0]) / rect.width).max((y[1] - y[0]) / rect.height);
            if unit.is_finite() && unit > 0.0 {
                (x, y) = (about(x, unit * rect.width), about(y, unit * rect.height));
            }
        }
        let across = Ruler { scale: self.panel.x.scale, range: x, pixels: [rect.x, rect.right()] };
        let up = Ruler { scale: self.panel.y.scale, range: y, pixels: [rect.bottom(), rect.y] };
        Frame { x: across, y: up, rect }
    }

    /// The ticks across and upwards; none without data.
    fn ticks(&self, frame: &Frame, fonts: &Fonts) -> (Ticks, Ticks) {
        if self.empty {
            return (Ticks::default(), Ticks::default());
        }
        let across = given(&self.panel.x, &frame.x, fonts).unwrap_or_else(|| x_ticks(frame, fonts));
        let alike = || {
            let step = across.values.windows(2).map(|w| w[1] - w[0]).next()?;
            let [lo, hi] = frame.y.range;
            let up = ticks(frame.y.scale, frame.y.range, (hi - lo) / (1.000_001 * step));
            (up.values.len() > 1).then_some(up)
        };
        let up = if self.panel.equal { alike() } else { None };
        let up = up.or_else(|| given(&self.panel.y, &frame.y, fonts)).unwrap_or_else(|| y_ticks(frame));
        (across, up)
    }

    /// The room that the labels need around axes of this size.
    pub fn margins(&self, width: f64, height: f64, fonts: &Fonts) -> Margins {
        let frame = self.frame(Rect { x: 0.0, y: 0.0, width, height });
        let widest =
            self.ticks(&frame, fonts).1.labels.iter().map(|l| tick_width(l, fonts)).fold(0.0, f64::max);
        let titled = !(self.panel.heading.is_empty() && self.panel.remark.is_empty());
        let keys =
            if self.panel.key { key::lines(&key::entries([self.panel]), width, fonts).len() } else { 0 };
        let x = &self.panel.x;
        Margins {
            left: 8.0 + widest.min(110.0) + if self.panel.y.label.is_empty() { 4.0 } else { 20.0 },
            right: 14.0,
            top: 8.0 + if titled { 16.0 } else { 0.0 } + key::LINE * keys as f64,
            bottom: match (x.labelled, x.label.is_empty()) {
                (false, _) => 8.0,
                (true, true) => 22.0,
                (true, false) => 38.0,
            },
        }
    }

    /// Draws the panel with its axes on `rect`.
    pub fn draw(&self, rect: Rect, fonts: &Fonts, items: &mut Vec<Item>) {
        let frame = self.frame(rect);
        let (across, up) = self.ticks(&frame, fonts);
        grid(&frame, &across, &up, items);
        let mut inside = Vec::new();
        for mark in &self.panel.marks {
            marks::draw(mark, &frame, &mut inside);
        }
        if !inside.is_empty() {
            items.push(Item::Clipped { rect, items: inside });
        }
        if self.empty {
            let at = [rect.x + rect.width / 2.0, rect.y + rect.height / 2.0 + 4.0];
            items.push(label(at, "no data", Anchor::Middle, Colour::GREY));
        }
        let corner = [[rect.x, rect.y], [rect.x, rect.bottom()], [rect.right(), rect.bottom()]];
        let stroke = Stroke { colour: Colour::AXIS, width: 0.9, dash: None };
        items.push(Item::Lines { runs: vec![corner.to_vec()], stroke });
        self.tick_labels(&frame, &across, &up, fonts, items);
        self.axis_labels(&frame, &across, &up, fonts, items);
        self.heading(rect, fonts, items);
    }

    fn tick_labels(&self, frame: &Frame, across: &Ticks, up: &Ticks, fonts: &Fonts, items: &mut Vec<Item>) {
        let rect = frame.rect;
        for (v, text) in across.values.iter().zip(&across.labels).filter(|_| self.panel.x.labelled) {
            if let Some(x) = frame.x.place(*v) {
                items.push(label([x, rect.bottom() + 15.5], text, Anchor::Middle, Colour::LABEL));
            }
        }
        for (v, text) in up.values.iter().zip(&up.labels).filter(|_| self.panel.y.labelled) {
            if let Some(y) = frame.y.place(*v) {
                let text = fonts.fit(text, Weight::Regular, TICK_SIZE, 110.0);
                items.push(label([rect.x - 7.0, y + 0.36 * TICK_SIZE], &text, Anchor::End, Colour::LABEL));
            }
        }
    }

    fn axis_labels(&self, frame: &Frame, across: &Ticks, up: &Ticks, fonts: &Fonts, items: &mut Vec<Item>) {
        let rect = frame.rect;
        let mut put = |text: String, at: [f64; 2], room: f64, turned: bool| {
            let text = fonts.fit(&text, Weight::Regular, LABEL_SIZE, room);
            if !text.is_empty() {
                let (size, weight, colour) = (LABEL_SIZE, Weight::Regular, Colour::INK);
                items.push(Item::Text(Text {
                    at,
                    line: text,
                    size,
                    weight,
                    colour,
                    anchor: Anchor::Middle,
                    turned,
                }));
            }
        };
        if self.panel.x.labelled {
            let at = [rect.x + rect.width / 2.0, rect.bottom() + 33.0];
            put(with_offset(&self.panel.x.label, across), at, rect.width, false);
        }
        if self.panel.y.labelled && !self.panel.y.label.is_empty() {
            let widest = up.labels.iter().map(|l| tick_width(l, fonts)).fold(0.0, f64::max);
            let at = [rect.x - 7.0 - widest.min(110.0) - 9.0, rect.y + rect.height / 2.0];
            put(with_offset(&self.panel.y.label, up), at, rect.height, true);
        }
    }

    fn heading(&self, rect: Rect, fonts: &Fonts, items: &mut Vec<Item>) {
        let panel = self.panel;
        let rows = if panel.key { key::lines(&key::entries([panel]), rect.width, fonts) } else { Vec::new() };
        let mut y = rect.y - 8.0;
        for row in rows.iter().rev() {
            key::draw(row, [rect.x, y], items);
            y -= key::LINE;
        }
        // An offset of the y axis without a label to carry it goes with the heading.
        let (_, up) = self.ticks(&self.frame(rect), fonts);
        let mut name = panel.heading.clone();
        if panel.y.label.is_empty() && up.offset.is_some() {
            name = with_offset(&name, &up);
        }
        let text = fonts.fit(&name, Weight::SemiBold, HEADING_SIZE, rect.width);
        let taken = fonts.width(&text, Weight::SemiBold, HEADING_SIZE);
        let remark = remark(&panel.remark, rect.width - taken - 14.0, fonts);
        for (text, x, size, weight, colour, anchor) in [
            (text, rect.x, HEADING_SIZE, Weight::SemiBold, Colour::INK, Anchor::Start),
            (remark, rect.right(), REMARK_SIZE, Weight::Regular, Colour::LABEL, Anchor::End),
        ] {
            if !text.is_empty() {
                items.push(Item::Text(Text {
                    at: [x, y],
                    line: text,
                    size,
                    weight,
                    colour,
                    anchor,
                    turned: false,
                }));
            }
        }
    }
}

/// As many of the remark's parts, divided by ` · `, as there is room for.
fn remark(text: &str, room: f64, fonts: &Fonts) -> String {
    let mut kept = text;
    while !kept.is_empty() && fonts.width(kept, Weight::Regular, REMARK_SIZE) > room {
        kept = kept.rfind(" · ").map_or("", |end| kept.get(..end).unwrap_or(""));
    }
    kept.to_owned()
}

fn range(axis: &Axis, found: Option<[f64; 2]>) -> [f64; 2] {
    let padding = if axis.padding.is_finite() { axis.padding.clamp(0.0, 10.0) } else { 0.0 };
    match axis.range {
        Some([a, b]) if a != b && axis.scale.holds(a) && axis.scale.holds(b) => [a.min(b), a.max(b)],
        _ => axis.scale.range(found, padding),
    }
}

/// The range of this length about the middle of another.
fn about([lo, hi]: [f64; 2], length: f64) -> [f64; 2] {
    let middle = lo + (hi - lo) / 2.0;
    [middle - length / 2.0, middle + length / 2.0]
}

fn tick_width(text: &str, fonts: &Fonts) -> f64 {
    fonts.width(text, Weight::Regular, TICK_SIZE)
}

/// The ticks that the axis asks for, every second, third, … where all have no room; none if it asks for none.
fn given(axis: &Axis, ruler: &Ruler, fonts: &Fonts) -> Option<Ticks> {
    let [lo, hi] = ruler.range;
    let inside: Vec<_> = axis.ticks.iter().filter(|(v, _)| (lo..=hi).contains(v)).collect();
    let every = |step: usize| {
        let (values, labels) = inside.iter().step_by(step).map(|(v, label)| (*v, label.clone())).unzip();
        Ticks { values, labels, offset: None }
    };
    let fits = |ticks: &Ticks| {
        let places: Vec<f64> = ticks.values.iter().filter_map(|v| ruler.place(*v)).collect();
        let gap = places.windows(2).map(|w| (w[1] - w[0]).abs()).fold(f64::INFINITY, f64::min);
        let widest = ticks.labels.iter().map(|l| tick_width(l, fonts)).fold(0.0, f64::max);
        widest + 6.0 <= gap
    };
    let steps = 1..=inside.len();
    steps.map(every).find(fits).filter(|ticks| !ticks.values.is_empty())
}

/// Ticks at easy distances; closer ones where a low panel would have fewer than three.
fn y_ticks(frame: &Frame) -> Ticks {
    let tried = [26.0, 22.0, 19.0, 17.0];
    let tried = tried.map(|apart| ticks(frame.y.scale, frame.y.range, frame.rect.height / apart));
    tried.into_iter().reduce(|best, next| if best.values.len() < 3 { next } else { best }).unwrap_or_default()
}

/// As many ticks as have room for their labels.
fn x_ticks(frame: &Frame, fonts: &Fonts) -> Ticks {
    let mut count = (frame.rect.width / 64.0).clamp(1.0, 14.0);
    loop {
        let found = ticks(frame.x.scale, frame.x.range, count);
        let places: Vec<f64> = found.values.iter().filter_map(|v| frame.x.place(*v)).collect();
        let gap = places.windows(2).map(|w| w[1] - w[0]).fold(f64::INFINITY, f64::min);
        let widest = found.labels.iter().map(|l| tick_width(l, fonts)).fold(0.0, f64::max);
        if widest + 12.0 <= gap || count <= 1.0 {
            return found;
        }
        count = (count - 1.0).max(1.0);
    }
}

fn with_offset(text: &str, ticks: &Ticks) -> String {
    match &ticks.offset {
        None => text.to_owned(),
        Some(offset) => match offset.strip_prefix('−') {
            Some(size) => format!("{text} + {size}"),
            None => format!("{text} − {offset}"),
        },
    }
}

fn label(at: [f64; 2], text: &str, anchor: Anchor, colour: Colour) -> Item {
    let (size, weight) = (TICK_SIZE, Weight::Regular);
    Item::Text(Text { at, line: text.to_owned(), size, weight, colour, anchor, turned: false })
}

fn grid(frame: &Frame, across: &Ticks, up: &Ticks, items: &mut Vec<Item>) {
    let rect = frame.rect;
    let upright = across.values.iter().filter_map(|v| frame.x.place(*v));
    let flat = up.values.iter().filter_map(|v| frame.y.place(*v));
    let runs: Vec<Vec<[f64; 2]>> = upright
        .map(|x| vec![[x, rect.y], [x, rect.bottom()]])
        .chain(flat.map(|y| vec![[rect.x, y], [rect.right(), y]]))
        .collect();
    if !runs.is_empty() {
        items.push(Item::Lines { runs, stroke: Stroke { colour: Colour::GRID, width: 0.8, dash: None } });
    }
}

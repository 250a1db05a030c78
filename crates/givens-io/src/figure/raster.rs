//! A scene as PNG, two device pixels to each of its own.

use std::collections::BTreeMap;

use tiny_skia::{FillRule, LineCap, LineJoin, Mask, Paint, Path, PathBuilder, Pixmap, StrokeDash, Transform};

use super::colour::Colour;
use super::font::Fonts;
use super::scene::{Anchor, Item, Marker, Point, RING_WIDTH, Rect, Scene, Segment, Stroke, Text, Weight};

/// Device pixels per pixel of the scene.
const FINENESS: f64 = 2.0;
/// A larger picture is drawn coarser, to bound its memory.
const MOST_PIXELS: f64 = 8e7;

/// The encoded file; `None` if the picture could not be allocated or encoded.
pub(super) fn write(scene: &Scene) -> Option<Vec<u8>> {
    let fineness = FINENESS.min((MOST_PIXELS / (scene.width * scene.height)).sqrt());
    let size = |length: f64| (length * fineness).round().clamp(1.0, 30_000.0) as u32;
    let mut pixmap = Pixmap::new(size(scene.width), size(scene.height))?;
    pixmap.fill(colour(Colour::WHITE));
    let view = Transform::from_scale(fineness as f32, fineness as f32);
    let mut canvas = Canvas { pixmap, view, mask: None, fonts: Fonts::new(), glyphs: BTreeMap::new() };
    canvas.items(&scene.items);
    canvas.pixmap.encode_png().ok()
}

struct Canvas {
    pixmap: Pixmap,
    view: Transform,
    mask: Option<Mask>,
    fonts: Fonts,
    glyphs: BTreeMap<(Weight, u16), Option<Path>>,
}

impl Canvas {
    fn items(&mut self, items: &[Item]) {
        for item in items {
            match item {
                Item::Lines { runs, stroke } => self.stroke(path(runs, false), stroke),
                Item::Rings { rings, fill, stroke } => {
                    for ring in rings {
                        let ring = path(core::slice::from_ref(ring), true);
                        if let (Some(colour), Some(ring)) = (fill, &ring) {
                            self.fill(ring, *colour, self.view);
                        }
                        if let Some(stroke) = stroke {
                            self.stroke(ring, stroke);
                        }
                    }
                }
                Item::Markers { at, marker, radius, colour } => {
                    let circles = circles(at, *radius);
                    match (marker, circles) {
                        (Marker::Disc, Some(circles)) => self.fill(&circles, *colour, self.view),
                        (Marker::Ring, circles) => {
                            let stroke = Stroke { colour: *colour, width: RING_WIDTH * radius, dash: None };
                            self.stroke(circles, &stroke);
                        }
                        (Marker::Disc, None) => {}
                    }
                }
                Item::Text(text) => self.text(text),
                Item::Clipped { rect, items } => {
                    let outer = self.mask.take();
                    self.mask = self.clip(rect);
                    self.items(items);
                    self.mask = outer;
                }
            }
        }
    }

    fn clip(&self, rect: &Rect) -> Option<Mask> {
        let mut mask = Mask::new(self.pixmap.width(), self.pixmap.height())?;
        let [x, y] = [rect.x as f32, rect.y as f32];
        let rect = tiny_skia::Rect::from_xywh(x, y, rect.width as f32, rect.height as f32)?;
        mask.fill_path(&PathBuilder::from_rect(rect), FillRule::Winding, true, self.view);
        Some(mask)
    }

    fn fill(&mut self, path: &Path, colour: Colour, at: Transform) {
        self.pixmap.fill_path(path, &paint(colour), FillRule::Winding, at, self.mask.as_ref());
    }

    fn stroke(&mut self, path: Option<Path>, stroke: &Stroke) {
        let Some(path) = path else { return };
        let style = tiny_skia::Stroke {
            width: stroke.width as f32,
            line_cap: LineCap::Butt,
            line_join: LineJoin::Round,
            dash: stroke.dash.and_then(|d| StrokeDash::new(vec![d[0] as f32, d[1] as f32], 0.0)),
            ..tiny_skia::Stroke::default()
        };
        self.pixmap.stroke_path(&path, &paint(stroke.colour), &style, self.view, self.mask.as_ref());
    }

    fn text(&mut self, text: &Text) {
        let (placed, length) = self.fonts.line(&text.line, text.weight);
        let start = match text.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -0.5 * length,
            Anchor::End => -length,
        };
        let size = text.size as f32;
        let turn = if text.turned { -90.0 } else { 0.0 };
        let base = self
            .view
            .pre_translate(text.at[0] as f32, text.at[1] as f32)
            .pre_rotate(turn)
            .pre_scale(size, -size);
        for glyph in placed {
            let (fonts, id) = (&self.fonts, (text.weight, glyph.glyph));
            let outline = self.glyphs.entry(id).or_insert_with(|| outline(&fonts.outline(id.1, id.0)));
            if let Some(path) = outline.clone() {
                self.fill(&path, text.colour, base.pre_translate((start + glyph.x) as f32, 0.0));
            }
        }
    }
}

fn colour(c: Colour) -> tiny_skia::Color {
    tiny_skia::Color::from_rgba8(c.red, c.green, c.blue, c.opacity)
}

fn paint(c: Colour) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color(colour(c));
    paint.anti_alias = true;
    paint
}

fn path(runs: &[Vec<Point>], close: bool) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for run in runs {
        for (i, p) in run.iter().enumerate() {
            let [x, y] = [p[0] as f32, p[1] as f32];
            if i == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
        }
        if close {
            builder.close();
        }
    }
    builder.finish()
}

fn circles(at: &[Point], radius: f64) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for p in at {
        builder.push_circle(p[0] as f32, p[1] as f32, radius as f32);
    }
    builder.finish()
}

fn outline(segments: &[Segment]) -> Option<Path> {
    let mut builder = PathBuilder::new();
    let f = |p: Point| (p[0] as f32, p[1] as f32);
    for segment in segments {
        match *segment {
            Segment::Move(p) => builder.move_to(f(p).0, f(p).1),
            Segment::Line(p) => builder.line_to(f(p).0, f(p).1),
            Segment::Quadratic(a, p) => builder.quad_to(f(a).0, f(a).1, f(p).0, f(p).1),
            Segment::Cubic(a, b, p) => builder.cubic_to(f(a).0, f(a).1, f(b).0, f(b).1, f(p).0, f(p).1),
            Segment::Close => builder.close(),
        }
    }
    builder.finish()
}

//! A scene as SVG 1.1. Glyphs are defined once and used by reference.

use core::fmt::Write as _;
use std::collections::BTreeSet;

use super::colour::Colour;
use super::font::Fonts;
use super::scene::{Anchor, Item, Marker, Point, RING_WIDTH, Rect, Scene, Segment, Stroke, Text, Weight};

/// Units per em in which glyphs are defined.
const EM: f64 = 1000.0;

/// The whole document.
pub(super) fn write(scene: &Scene) -> String {
    let mut body =
        Writer { fonts: Fonts::new(), glyphs: BTreeSet::new(), clips: Vec::new(), out: String::new() };
    body.items(&scene.items);
    let (w, h) = (number(scene.width), number(scene.height));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
         width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" role=\"img\">\n<title>{}</title>\n<desc>{}</desc>\n<defs>\n",
        escaped(&scene.title),
        escaped(&scene.description)
    );
    for rect in &body.clips {
        let [x, y, w, h] = corners(rect);
        push(
            &mut out,
            format_args!(
                "<clipPath id=\"{}\"><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/></clipPath>\n",
                clip_id(rect)
            ),
        );
    }
    for (weight, glyph) in &body.glyphs {
        let outline = outline(&body.fonts.outline(*glyph, *weight));
        push(&mut out, format_args!("<path id=\"{}\" d=\"{outline}\"/>\n", glyph_id(*weight, *glyph)));
    }
    push(&mut out, format_args!("</defs>\n<rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n"));
    out + &body.out + "</svg>\n"
}

/// Writing to a `String` cannot fail.
fn push(out: &mut String, what: core::fmt::Arguments<'_>) {
    let _ = out.write_fmt(what);
}

struct Writer {
    fonts: Fonts,
    glyphs: BTreeSet<(Weight, u16)>,
    clips: Vec<Rect>,
    out: String,
}

impl Writer {
    fn items(&mut self, items: &[Item]) {
        for item in items {
            match item {
                Item::Lines { runs, stroke } => {
                    let d: String = runs.iter().map(|run| polyline(run, false)).collect();
                    push(
                        &mut self.out,
                        format_args!("<path d=\"{d}\" fill=\"none\"{}/>\n", stroke_of(stroke)),
                    );
                }
                Item::Rings { rings, fill, stroke } => {
                    let fill = fill.map_or(" fill=\"none\"".to_owned(), |c| paint("fill", c));
                    let stroke = stroke.as_ref().map_or(String::new(), stroke_of);
                    // Rings that overlap are drawn one by one, so that their tints add up as they should.
                    for ring in rings {
                        push(
                            &mut self.out,
                            format_args!("<path d=\"{}\"{fill}{stroke}/>\n", polyline(ring, true)),
                        );
                    }
                }
                Item::Markers { at, marker, radius, colour } => self.markers(at, *marker, *radius, *colour),
                Item::Text(text) => self.text(text),
                Item::Clipped { rect, items } => {
                    if !self.clips.contains(rect) {
                        self.clips.push(*rect);
                    }
                    push(&mut self.out, format_args!("<g clip-path=\"url(#{})\">\n", clip_id(rect)));
                    self.items(items);
                    self.out.push_str("</g>\n");
                }
            }
        }
    }

    fn markers(&mut self, at: &[Point], marker: Marker, radius: f64, colour: Colour) {
        match marker {
            Marker::Disc => {
                // A line of no length with round ends is a disc, in the fewest bytes.
                let mut d = String::new();
                for p in at {
                    push(&mut d, format_args!("M{} {}h0", number(p[0]), number(p[1])));
                }
                let stroke = paint("stroke", colour);
                let width = number(2.0 * radius);
                push(
                    &mut self.out,
                    format_args!(
                        "<path d=\"{d}\" fill=\"none\"{stroke} stroke-width=\"{width}\" stroke-linecap=\"round\"/>\n"
                    ),
                );
            }
            Marker::Ring => {
                let (r, across) = (number(radius), number(2.0 * radius));
                let ring = |p: &Point| {
                    let (x, y) = (number(p[0] - radius), number(p[1]));
                    format!("M{x} {y}a{r} {r} 0 1 1 {across} 0a{r} {r} 0 1 1 -{across} 0z")
                };
                let d: String = at.iter().map(ring).collect();
                let stroke = Stroke { colour, width: RING_WIDTH * radius, dash: None };
                push(&mut self.out, format_args!("<path d=\"{d}\" fill=\"none\"{}/>\n", stroke_of(&stroke)));
            }
        }
    }

    fn text(&mut self, text: &Text) {
        let (placed, length) = self.fonts.line(&text.line, text.weight);
        let start = EM
            * match text.anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => -0.5 * length,
                Anchor::End => -length,
            };
        let (x, y, scale) = (number(text.at[0]), number(text.at[1]), text.size / EM);
        let turn = if text.turned { " rotate(-90)" } else { "" };
        push(
            &mut self.out,
            format_args!(
                "<g transform=\"translate({x} {y}){turn} scale({scale} -{scale})\"{} aria-label=\"{}\">",
                paint("fill", text.colour),
                escaped(&text.line)
            ),
        );
        for glyph in placed {
            self.glyphs.insert((text.weight, glyph.glyph));
            let x = (start + EM * glyph.x).round();
            push(
                &mut self.out,
                format_args!(
                    "<use xlink:href=\"#{}\" x=\"{}\"/>",
                    glyph_id(text.weight, glyph.glyph),
                    number(x)
                ),
            );
        }
        self.out.push_str("</g>\n");
    }
}

/// The same for the same rectangle: several figures can stand in one HTML page without a clash.
fn clip_id(rect: &Rect) -> String {
    let [x, y, w, h] = corners(rect);
    format!("clip_{x}_{y}_{w}_{h}")
}

fn corners(rect: &Rect) -> [String; 4] {
    [number(rect.x), number(rect.y), number(rect.width), number(rect.height)]
}

fn glyph_id(weight: Weight, glyph: u16) -> String {
    format!("{}{glyph}", if weight == Weight::Regular { "r" } else { "b" })
}

fn polyline(points: &[Point], close: bool) -> String {
    let mut d = String::new();
    for (i, p) in points.iter().enumerate() {
        push(&mut d, format_args!("{}{} {}", if i == 0 { 'M' } else { 'L' }, number(p[0]), number(p[1])));
    }
    if close {
        d.push('z');
    }
    d
}

fn outline(segments: &[Segment]) -> String {
    let at = |p: &Point| format!("{} {}", number((EM * p[0]).round()), number((EM * p[1]).round()));
    segments
        .iter()
        .map(|segment| match segment {
            Segment::Move(p) => format!("M{}", at(p)),
            Segment::Line(p) => format!("L{}", at(p)),
            Segment::Quadratic(a, p) => format!("Q{} {}", at(a), at(p)),
            Segment::Cubic(a, b, p) => format!("C{} {} {}", at(a), at(b), at(p)),
            Segment::Close => "z".to_owned(),
        })
        .collect()
}

fn paint(what: &str, colour: Colour) -> String {
    let Colour { red, green, blue, opacity } = colour;
    let mut out = format!(" {what}=\"#{red:02x}{green:02x}{blue:02x}\"");
    if opacity < 255 {
        push(&mut out, format_args!(" {what}-opacity=\"{}\"", number(f64::from(opacity) / 255.0)));
    }
    out
}

fn stroke_of(stroke: &Stroke) -> String {
    let mut out = paint("stroke", stroke.colour);
    push(&mut out, format_args!(" stroke-width=\"{}\" stroke-linejoin=\"round\"", number(stroke.width)));
    if let Some([dash, gap]) = stroke.dash {
        push(&mut out, format_args!(" stroke-dasharray=\"{} {}\"", number(dash), number(gap)));
    }
    out
}

/// To a hundredth of a pixel, without idle zeros.
fn number(v: f64) -> String {
    let text = format!("{v:.2}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

/// For text and attributes; what XML cannot hold becomes `�`.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.push(' '),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

//! The embedded font: outlines, advances and kerning. Text is drawn as shapes, so that a picture
//! looks the same with and without fonts on the machine.

use ttf_parser::gpos::{PairAdjustment, PositioningSubtable};
use ttf_parser::{Face, GlyphId, OutlineBuilder};

use super::scene::{Point, Segment, Weight};

static REGULAR: &[u8] = include_bytes!("../../assets/Inter-Regular.otf");
static SEMIBOLD: &[u8] = include_bytes!("../../assets/Inter-SemiBold.otf");

/// One glyph of a line and where it starts, in em from the start of the line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Placed {
    pub glyph: u16,
    pub x: f64,
}

/// Both weights, parsed once per drawing.
pub(super) struct Fonts {
    regular: Option<Face<'static>>,
    semibold: Option<Face<'static>>,
}

impl Fonts {
    pub fn new() -> Self {
        Self { regular: Face::parse(REGULAR, 0).ok(), semibold: Face::parse(SEMIBOLD, 0).ok() }
    }

    fn face(&self, weight: Weight) -> Option<&Face<'static>> {
        match weight {
            Weight::Regular => self.regular.as_ref(),
            Weight::SemiBold => self.semibold.as_ref(),
        }
    }

    /// The glyphs of one line and its length in em. A character that the font lacks becomes `�`;
    /// control characters become spaces.
    pub fn line(&self, text: &str, weight: Weight) -> (Vec<Placed>, f64) {
        let Some(face) = self.face(weight) else { return (Vec::new(), 0.0) };
        let em = f64::from(face.units_per_em());
        let missing = face.glyph_index('\u{fffd}').unwrap_or(GlyphId(0));
        let (mut placed, mut x, mut last) = (Vec::new(), 0.0, None);
        for c in text.chars().map(|c| if c.is_control() { ' ' } else { c }) {
            let glyph = face.glyph_index(c).unwrap_or(missing);
            x += last.map_or(0.0, |left| kerning(face, left, glyph)) / em;
            placed.push(Placed { glyph: glyph.0, x });
            x += f64::from(face.glyph_hor_advance(glyph).unwrap_or(0)) / em;
            last = Some(glyph);
        }
        (placed, x)
    }

    /// Length of `text` in pixels at `size` pixels per em.
    pub fn width(&self, text: &str, weight: Weight, size: f64) -> f64 {
        self.line(text, weight).1 * size
    }

    /// `text`, or as much of its beginning as fits into `room` pixels, with an ellipsis.
    pub fn fit(&self, text: &str, weight: Weight, size: f64, room: f64) -> String {
        const LONGEST: usize = 400; // no line of a figure holds more, and measuring stays cheap
        let mut kept: String = text.chars().take(LONGEST).collect();
        if kept.len() == text.len() && self.width(text, weight, size) <= room {
            return kept;
        }
        while kept.pop().is_some() {
            let shorter = format!("{}…", kept.trim_end());
            if self.width(&shorter, weight, size) <= room {
                return shorter;
            }
        }
        String::new()
    }

    /// The outline of a glyph in em, y upwards.
    pub fn outline(&self, glyph: u16, weight: Weight) -> Vec<Segment> {
        let Some(face) = self.face(weight) else { return Vec::new() };
        let mut pen = Pen { em: f64::from(face.units_per_em()), segments: Vec::new() };
        face.outline_glyph(GlyphId(glyph), &mut pen);
        pen.segments
    }
}

/// Kerning between two neighbours, in font units; the embedded subsets hold no other lookups.
fn kerning(face: &Face<'_>, left: GlyphId, right: GlyphId) -> f64 {
    let Some(gpos) = face.tables().gpos else { return 0.0 };
    for lookup in gpos.lookups {
        for subtable in lookup.subtables.into_iter::<PositioningSubtable<'_>>() {
            let PositioningSubtable::Pair(pair) = subtable else { continue };
            let Some(index) = pair.coverage().get(left) else { continue };
            let values = match pair {
                PairAdjustment::Format1 { sets, .. } => sets.get(index).and_then(|set| set.get(right)),
                PairAdjustment::Format2 { classes, matrix, .. } => {
                    matrix.get((classes.0.get(left), classes.1.get(right)))
                }
            };
            if let Some((first, _)) = values {
                return f64::from(first.x_advance);
            }
        }
    }
    0.0
}

struct Pen {
    em: f64,
    segments: Vec<Segment>,
}

impl Pen {
    fn at(&self, x: f32, y: f32) -> Point {
        [f64::from(x) / self.em, f64::from(y) / self.em]
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let to = self.at(x, y);
        self.segments.push(Segment::Move(to));
    }
    fn line_to(&mut self, x: f32, y: f32) {
        let to = self.at(x, y);
        self.segments.push(Segment::Line(to));
    }
    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (by, to) = (self.at(x1, y1), self.at(x, y));
        self.segments.push(Segment::Quadratic(by, to));
    }
    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (a, b, to) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.segments.push(Segment::Cubic(a, b, to));
    }
    fn close(&mut self) {
        self.segments.push(Segment::Close);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sign_of_the_labels_has_an_outline() {
        let fonts = Fonts::new();
        for weight in [Weight::Regular, Weight::SemiBold] {
            let missing = fonts.line("\u{4e00}", weight).0[0].glyph;
            for c in "Az09−±²³°√χσθφωΔμ×·⁻⁵₀→…\u{2009}".chars() {
                let (placed, width) = fonts.line(&c.to_string(), weight);
                assert_ne!(placed[0].glyph, missing, "{c} is not in the subset");
                assert!(width > 0.0, "{c} has no width");
            }
            assert!(!fonts.outline(fonts.line("σ", weight).0[0].glyph, weight).is_empty());
        }
    }

    #[test]
    fn neighbours_are_kerned() {
        let fonts = Fonts::new();
        let apart = fonts.width("A", Weight::Regular, 1.0) + fonts.width("V", Weight::Regular, 1.0);
        assert!(fonts.width("AV", Weight::Regular, 1.0) < apart);
    }

    #[test]
    fn a_long_text_is_cut_to_its_room() {
        let fonts = Fonts::new();
        let cut = fonts.fit(&"long ".repeat(5000), Weight::Regular, 12.0, 100.0);
        assert!(cut.ends_with('…') && fonts.width(&cut, Weight::Regular, 12.0) <= 100.0);
        assert_eq!(fonts.fit("short", Weight::Regular, 12.0, 100.0), "short");
    }
}

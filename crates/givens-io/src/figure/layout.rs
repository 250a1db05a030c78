//! From a figure to a scene: the header, then every panel in its place.

use super::colour::Colour;
use super::font::Fonts;
use super::key;
use super::panel::{Margins, Ranged};
use super::plot::{Block, Figure, Grid, Panel};
use super::scene::{Anchor, Item, Rect, Scene, Text, Weight};

const EDGE: f64 = 18.0;
const BETWEEN: f64 = 16.0;
/// Blocks nested deeper than this are not drawn.
const DEEPEST: usize = 24;

/// Lays out the whole figure.
pub(super) fn scene(figure: &Figure) -> Scene {
    let fonts = Fonts::new();
    let width = within(figure.width, 240.0, 6000.0);
    let body = within(figure.height, 120.0, 12_000.0);
    let mut items = Vec::new();
    let top = header(figure, width, &fonts, &mut items);
    let rect = Rect { x: EDGE, y: top, width: width - 2.0 * EDGE, height: body };
    let layout = Layout { fonts: &fonts };
    let mut placed = Vec::new();
    layout.place(&figure.body, rect, [0.0; 2], DEEPEST, &mut placed);
    for (panel, rect) in placed {
        panel.draw(rect, &fonts, &mut items);
    }
    let description = figure.notes.join(" ");
    Scene { title: figure.title.clone(), description, width, height: (top + body + EDGE).ceil(), items }
}

fn within(given: f64, least: f64, most: f64) -> f64 {
    if given.is_finite() { given.round().clamp(least, most) } else { 1000.0_f64.clamp(least, most) }
}

/// Draws title, notes and key; returns where the body begins.
fn header(figure: &Figure, width: f64, fonts: &Fonts, items: &mut Vec<Item>) -> f64 {
    let room = width - 2.0 * EDGE;
    let mut y = EDGE;
    let title = (figure.title.as_str(), 18.0, Weight::SemiBold, Colour::INK, 14.0, 10.0);
    let notes = figure.notes.iter().map(|n| (n.as_str(), 11.5, Weight::Regular, Colour::LABEL, 9.0, 8.0));
    for (text, size, weight, colour, above, below) in core::iter::once(title).chain(notes.take(6)) {
        let text = fonts.fit(text, weight, size, room);
        if !text.is_empty() {
            y += above;
            let anchor = Anchor::Start;
            items.push(Item::Text(Text {
                at: [EDGE, y],
                line: text,
                size,
                weight,
                colour,
                anchor,
                turned: false,
            }));
            y += below;
        }
    }
    if figure.key {
        let mut panels = Vec::new();
        collect(&figure.body, DEEPEST, &mut panels);
        for row in key::lines(&key::entries(panels), room, fonts) {
            y += 13.0;
            key::draw(&row, [EDGE, y], items);
            y += key::LINE - 13.0;
        }
        y += 4.0;
    }
    y
}

fn collect<'a>(block: &'a Block, depth: usize, panels: &mut Vec<&'a Panel>) {
    let Some(depth) = depth.checked_sub(1) else { return };
    match block {
        Block::Grid(grid) => panels.extend(grid.cells.iter().flatten()),
        Block::Row(blocks) | Block::Column(blocks) => {
            for (_, block) in blocks {
                collect(block, depth, panels);
            }
        }
    }
}

struct Layout<'f> {
    fonts: &'f Fonts,
}

impl Layout<'_> {
    /// Finds the axes of every panel of `block` in `rect`; `edges` is the least room kept at its left and right.
    fn place<'a>(
        &self,
        block: &'a Block,
        rect: Rect,
        edges: [f64; 2],
        depth: usize,
        out: &mut Vec<(Ranged<'a>, Rect)>,
    ) {
        let Some(depth) = depth.checked_sub(1) else { return };
        match block {
            Block::Grid(grid) => self.grid(grid, rect, edges, out),
            Block::Row(blocks) => {
                for (rect, (_, block)) in split(rect, blocks, true).into_iter().zip(blocks) {
                    self.place(block, rect, [0.0; 2], depth, out);
                }
            }
            Block::Column(blocks) => {
                let rects = split(rect, blocks, false);
                let mut edges = edges;
                for (rect, (_, block)) in rects.iter().zip(blocks) {
                    if let Block::Grid(grid) = block {
                        let found = Cells::new(grid).solve(grid, *rect, [0.0; 2], self.fonts);
                        edges[0] = edges[0].max(found.0.first().map_or(0.0, |c| c[0] - rect.x));
                        edges[1] = edges[1].max(found.0.last().map_or(0.0, |c| rect.right() - c[0] - c[1]));
                    }
                }
                for (rect, (_, block)) in rects.into_iter().zip(blocks) {
                    self.place(block, rect, edges, depth, out);
                }
            }
        }
    }

    fn grid<'a>(&self, grid: &'a Grid, rect: Rect, edges: [f64; 2], out: &mut Vec<(Ranged<'a>, Rect)>) {
        let cells = Cells::new(grid);
        let (columns, rows) = cells.solve(grid, rect, edges, self.fonts);
        for (i, cell) in cells.0.into_iter().enumerate() {
            let (Some(row), Some(column)) = (rows.get(i / columns.len()), columns.get(i % columns.len()))
            else {
                continue;
            };
            if let Some(cell) = cell {
                out.push((cell, Rect { x: column[0], y: row[0], width: column[1], height: row[1] }));
            }
        }
    }
}

/// Parts of `rect` in proportion to the weights of `blocks`.
fn split(rect: Rect, blocks: &[(f64, Block)], across: bool) -> Vec<Rect> {
    let weights: Vec<f64> = blocks.iter().map(|b| weight(b.0)).collect();
    let total: f64 = weights.iter().sum();
    let length = if across { rect.width } else { rect.height };
    let gap = if across { BETWEEN } else { 0.0 };
    let room = (length - gap * (blocks.len() as f64 - 1.0)).max(1.0);
    let mut start = if across { rect.x } else { rect.y };
    let mut parts = Vec::new();
    for w in weights {
        let part = room * w / total;
        parts.push(if across {
            Rect { x: start, width: part, ..rect }
        } else {
            Rect { y: start, height: part, ..rect }
        });
        start += part + gap;
    }
    parts
}

fn weight(given: f64) -> f64 {
    if given.is_finite() { given.clamp(1e-3, 1e6) } else { 1.0 }
}

/// Where the axes of each column, or of each row, start and how long they are.
type Tracks = Vec<[f64; 2]>;

/// The cells of a grid with their ranges.
struct Cells<'a>(Vec<Option<Ranged<'a>>>);

impl<'a> Cells<'a> {
    fn new(grid: &'a Grid) -> Self {
        let count = grid.columns.len().saturating_mul(grid.rows.len());
        Self(grid.cells.iter().take(count).map(|c| c.as_ref().map(Ranged::new)).collect())
    }

    /// Columns and rows. The margins depend on the labels, these on the size of the axes, and that on
    /// the margins: the second round starts from what the first one found.
    fn solve(&self, grid: &Grid, rect: Rect, edges: [f64; 2], fonts: &Fonts) -> (Tracks, Tracks) {
        let (n, m) = (grid.columns.len(), grid.rows.len());
        let mut columns = vec![[0.0, (rect.width / n as f64 - 60.0).max(10.0)]; n];
        let mut rows = vec![[0.0, (rect.height / m as f64 - 40.0).max(10.0)]; m];
        for _ in 0..3 {
            let mut beside = vec![[0.0f64; 2]; n];
            let mut about = vec![[0.0f64; 2]; m];
            for (i, cell) in self.0.iter().enumerate() {
                let (r, c) = (i / n.max(1), i % n.max(1));
                let (Some(cell), Some(row), Some(column)) = (cell, rows.get(r), columns.get(c)) else {
                    continue;
                };
                let Margins { left, right, top, bottom } = cell.margins(column[1], row[1], fonts);
                beside[c] = [beside[c][0].max(left), beside[c][1].max(right)];
                // Over a blank cell the labels have that cell's room.
                let below = self.0.get(i + n).is_some_and(Option::is_some);
                let bottom = if below || r + 1 == m { bottom } else { about[r][1] };
                about[r] = [about[r][0].max(top), about[r][1].max(bottom)];
            }
            if let Some(first) = beside.first_mut() {
                first[0] = first[0].max(edges[0]);
            }
            if let Some(last) = beside.last_mut() {
                last[1] = last[1].max(edges[1]);
            }
            columns = share(rect.x, rect.width, &grid.columns, &beside);
            rows = share(rect.y, rect.height, &grid.rows, &about);
        }
        (columns, rows)
    }
}

/// Shares what the margins leave of a length.
fn share(start: f64, length: f64, weights: &[f64], margins: &[[f64; 2]]) -> Tracks {
    let total: f64 = weights.iter().map(|w| weight(*w)).sum();
    let room = length - margins.iter().map(|m| m[0] + m[1]).sum::<f64>();
    let mut at = start;
    let mut tracks = Vec::new();
    for (w, [before, after]) in weights.iter().zip(margins) {
        let long = (room * weight(*w) / total).max(6.0);
        tracks.push([at + before, long]);
        at += before + long + after;
    }
    tracks
}

//! The panel of the normalised innovation squared.

use core::iter::repeat;

use super::NisSeries;
use crate::figure::colour::Colour;
use crate::figure::number;
use crate::figure::plot::{Axis, Mark, Panel, Shape};
use crate::figure::scale::Scale;

/// With more changes of the degrees of freedom than this, bands are drawn over one another.
const FEW_CHANGES: usize = 10;
/// At most so many bands over one another.
const MOST_BANDS: usize = 4;

/// With more rows than this their mean is drawn too.
const DENSE: usize = 2000;
/// Of so many blocks.
const BLOCKS: usize = 150;

struct Row {
    time: f64,
    nis: f64,
    bounds: [f64; 2],
    gated: bool,
}

/// NIS over time against its 95 % band. The scale is linear where the band is and logarithmic above it,
/// so that outliers are shown and yet flatten nothing.
pub(super) fn panel(series: &NisSeries, x: Axis) -> Panel {
    let bounds = series.lower.iter().zip(&series.upper);
    let rows: Vec<Row> = series
        .time
        .iter()
        .zip(&series.nis)
        .zip(bounds)
        .zip(series.gated.iter().copied().chain(repeat(false)))
        .map(|(((&time, &nis), (&lower, &upper)), gated)| Row { time, nis, bounds: [lower, upper], gated })
        .filter(|r| r.time.is_finite() && r.nis.is_finite())
        .collect();
    let mut marks = Vec::new();
    for rows in bands(&rows) {
        marks.push(Mark::new("", Colour::GREEN.faded(38), Shape::Band { rows }));
    }
    let judged: Vec<&Row> =
        rows.iter().filter(|r| !r.gated && r.bounds.iter().all(|b| b.is_finite())).collect();
    let inside = |r: &Row| r.nis >= r.bounds[0] && r.nis <= r.bounds[1];
    let dots = |keep: &dyn Fn(&Row) -> bool| -> Vec<[f64; 2]> {
        rows.iter().filter(|r| keep(r)).map(|r| [r.time, r.nis]).collect()
    };
    let outside = |r: &Row| !r.gated && r.bounds.iter().all(|b| b.is_finite()) && !inside(r);
    let disc = |points| Shape::Dots { points, radius: 1.7, hollow: false };
    let dense = rows.len() > DENSE;
    let colour = if dense { Colour::PALE } else { Colour::GREY };
    marks.push(Mark::new("", colour, disc(dots(&|r| !r.gated && !outside(r)))));
    marks.push(Mark::new("", Colour::VERMILION, disc(dots(&outside))));
    let rings = dots(&|r| r.gated);
    if !rings.is_empty() {
        let shape = Shape::Dots { points: rings, radius: 2.6, hollow: true };
        marks.push(Mark::new("", Colour::VERMILION, shape));
    }
    let mut remark = Vec::new();
    let counted = [judged.iter().filter(|r| inside(r)).count(), judged.len()];
    let [count, of] = series.all.as_ref().map_or(counted, |all| all.inside);
    if of > 0 {
        let share = 100.0 * count as f64 / of as f64;
        remark.push(format!("{}\u{2009}% within", number::short(share.round())));
    }
    let gated = series.all.as_ref().map_or(rows.iter().filter(|r| r.gated).count(), |all| all.gated);
    if gated > 0 {
        remark.push(format!("{gated} beyond the gate (rings)"));
    }
    if dense {
        // Dots that fill the panel show nothing any more; their mean does.
        let (points, block) = match &series.all {
            Some(all) => (all.means.clone(), all.block),
            None => (means(&rows, rows.len() / BLOCKS), rows.len() / BLOCKS),
        };
        let shape = Shape::Line { points, width: 1.3, dashed: false };
        marks.push(Mark::new("", Colour::INK, shape));
        remark.push(format!("line: mean of {block} rows"));
    }
    let (heading, remark) = ("NIS and its 95\u{2009}% band (χ²)".to_owned(), remark.join(" · "));
    Panel { heading, remark, x, y: axis(&rows), marks, ..Panel::default() }
}

/// The mean over each block of rows, at the middle of its time.
fn means(rows: &[Row], block: usize) -> Vec<[f64; 2]> {
    let mean = |rows: &[&Row], f: fn(&Row) -> f64| rows.iter().map(|r| f(r)).sum::<f64>() / rows.len() as f64;
    let taken: Vec<&Row> = rows.iter().filter(|r| !r.gated).collect();
    taken.chunks(block.max(1)).map(|rows| [mean(rows, |r| r.time), mean(rows, |r| r.nis)]).collect()
}

fn axis(rows: &[Row]) -> Axis {
    let bound = rows.iter().map(|r| r.bounds[1]).filter(|b| b.is_finite()).fold(0.0, f64::max);
    let top = rows.iter().map(|r| r.nis).filter(|v| *v < 1e290).fold(bound, f64::max);
    if !(top > 0.0 && top < 1e290) {
        return Axis::default();
    }
    let unit = if bound > 0.0 { 0.3 * bound } else { 0.1 * top };
    let scale = Scale::Compressed { unit };
    let over = scale.backward(1.06 * scale.forward(top));
    Axis { scale, range: Some([0.0, over]), ..Axis::default() }
}

/// The bands to draw. Degrees of freedom that change now and then give one stepped band; where they
/// change all the time, as with sensors in turn, each pair of bounds gives a band of its own.
fn bands(rows: &[Row]) -> Vec<Vec<[f64; 3]>> {
    let known: Vec<&Row> = rows.iter().filter(|r| r.bounds.iter().all(|b| b.is_finite())).collect();
    let changes = known.windows(2).filter(|w| w[0].bounds != w[1].bounds).count();
    let mut kinds: Vec<[f64; 2]> = Vec::new();
    for row in &known {
        if kinds.len() <= MOST_BANDS && !kinds.contains(&row.bounds) {
            kinds.push(row.bounds);
        }
    }
    if changes > FEW_CHANGES && kinds.len() <= MOST_BANDS {
        let of = |kind: &[f64; 2]| {
            let mut of_kind = known.iter().filter(|r| r.bounds == *kind);
            let first = of_kind.next()?.time;
            let last = of_kind.next_back().map_or(first, |r| r.time);
            Some(vec![[first, kind[0], kind[1]], [last, kind[0], kind[1]]])
        };
        return kinds.iter().filter_map(of).collect();
    }
    let mut stepped: Vec<[f64; 3]> = Vec::new();
    let mut last: Option<&Row> = None;
    for row in known {
        if let Some(before) = last.filter(|b| b.bounds != row.bounds) {
            let middle = before.time + (row.time - before.time) / 2.0;
            stepped.push([middle, before.bounds[0], before.bounds[1]]);
            stepped.push([middle, row.bounds[0], row.bounds[1]]);
        }
        stepped.push([row.time, row.bounds[0], row.bounds[1]]);
        last = Some(row);
    }
    if stepped.is_empty() { Vec::new() } else { vec![stepped] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(bounds: impl Fn(usize) -> [f64; 2]) -> Vec<Row> {
        (0..100).map(|i| Row { time: i as f64, nis: 1.0, bounds: bounds(i), gated: false }).collect()
    }

    #[test]
    fn sensors_in_turn_give_a_band_each_and_a_dropout_gives_a_step() {
        let [two, three] = [[0.05, 7.4], [0.2, 9.3]];
        assert_eq!(bands(&rows(|i| if i % 2 == 0 { two } else { three })).len(), 2);
        let stepped = bands(&rows(|i| if i < 50 { two } else { three }));
        assert_eq!((stepped.len(), stepped[0].len()), (1, 102));
    }

    #[test]
    fn an_outlier_leaves_the_band_a_quarter_of_the_panel() {
        let mut rows = rows(|_| [0.05, 7.4]);
        rows[7].nis = 5000.0;
        let axis = axis(&rows);
        let share = axis.scale.forward(7.4) / axis.scale.forward(axis.range.unwrap()[1]);
        assert!(share > 0.15, "{share}");
        assert!(axis.range.unwrap()[1] > 5000.0);
    }
}

//! Fewer points for the same picture: what is left out could not be seen, and every extreme stays.

use std::collections::BTreeSet;

use super::scene::Point;

/// Width of a column of pixels in which a curve is one vertical stroke.
const COLUMN: f64 = 0.5;
/// Points nearer than this to the last one kept are left out of a curve in the plane.
const NEAR: f64 = 0.2;

/// A run of points in pixels, thinned. Where x never turns back, each column of pixels keeps its
/// first, lowest, highest and last point; elsewhere points that fall onto each other are dropped,
/// but not the leftmost, rightmost, lowest and highest.
pub(super) fn run(points: &[Point]) -> Vec<Point> {
    if points.len() < 500 {
        return points.to_vec();
    }
    if points.windows(2).all(|w| w[0][0] <= w[1][0]) { columns(points) } else { near(points) }
}

fn columns(points: &[Point]) -> Vec<Point> {
    let mut out = Vec::new();
    for column in points.chunk_by(|a, b| (a[0] / COLUMN).floor() == (b[0] / COLUMN).floor()) {
        let mut kept = vec![0, least(column, |p| p[1]), least(column, |p| -p[1]), column.len() - 1];
        kept.sort_unstable();
        kept.dedup();
        out.extend(kept.iter().filter_map(|&i| column.get(i)));
    }
    out
}

fn near(points: &[Point]) -> Vec<Point> {
    let extremes = [
        0,
        points.len() - 1,
        least(points, |p| p[0]),
        least(points, |p| -p[0]),
        least(points, |p| p[1]),
        least(points, |p| -p[1]),
    ];
    let mut last = [f64::NAN; 2];
    let mut out = Vec::new();
    for (i, p) in points.iter().enumerate() {
        let close = (p[0] - last[0]).hypot(p[1] - last[1]) < NEAR;
        if !close || extremes.contains(&i) {
            out.push(*p);
            last = *p;
        }
    }
    out
}

/// Index of the first point with the least `key`.
fn least(points: &[Point], key: impl Fn(&Point) -> f64) -> usize {
    let better = |best: usize, i: usize| if key(&points[i]) < key(&points[best]) { i } else { best };
    (0..points.len()).fold(0, better)
}

/// A band as rows of `[x, lower, upper]` in pixels, thinned: each column of pixels keeps its first and
/// last x and its outermost edges. (Down is up in pixels: `lower` is the larger.)
pub(super) fn band(rows: &[[f64; 3]]) -> Vec<[f64; 3]> {
    if rows.len() < 500 || !rows.windows(2).all(|w| w[0][0] <= w[1][0]) {
        return rows.to_vec();
    }
    let mut out = Vec::new();
    for column in rows.chunk_by(|a, b| (a[0] / COLUMN).floor() == (b[0] / COLUMN).floor()) {
        let lower = column.iter().fold(f64::NEG_INFINITY, |m, r| m.max(r[1]));
        let upper = column.iter().fold(f64::INFINITY, |m, r| m.min(r[2]));
        let [first, last] = [column.first(), column.last()].map(|r| r.map_or(0.0, |r| r[0]));
        out.push([first, lower, upper]);
        if last > first {
            out.push([last, lower, upper]);
        }
    }
    out
}

/// Markers, where they are many: one for each pixel that has any, or each square of four.
pub(super) fn markers(points: &[Point]) -> Vec<Point> {
    if points.len() < 3000 {
        return points.to_vec();
    }
    let thinned = |cell: f64| -> Vec<Point> {
        let mut taken = BTreeSet::new();
        let of = |p: &Point| p.map(|v| (v / cell).round() as i64);
        points.iter().filter(|p| taken.insert(of(p))).copied().collect()
    };
    let fine = thinned(1.0);
    // Where the panel is nearly full, every second pixel shows it as well.
    if fine.len() > 12_000 { thinned(2.0) } else { fine }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn extremes(points: &[Point]) -> [f64; 4] {
        points.iter().fold([f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY], |m, p| {
            [m[0].min(p[0]), m[1].max(p[0]), m[2].min(p[1]), m[3].max(p[1])]
        })
    }

    proptest! {
        #[test]
        fn a_thinned_curve_keeps_its_extremes(ys in prop::collection::vec(-1e3..1e3f64, 500..3000), turns in any::<bool>()) {
            let x = |i: usize| if turns { (i as f64 / 50.0).sin() * 100.0 } else { i as f64 / 20.0 };
            let points: Vec<Point> = ys.iter().enumerate().map(|(i, y)| [x(i), *y]).collect();
            let thin = run(&points);
            prop_assert!(thin.len() <= points.len());
            prop_assert_eq!(extremes(&thin), extremes(&points));
            prop_assert_eq!((thin[0], thin[thin.len() - 1]), (points[0], points[points.len() - 1]));
        }

        #[test]
        fn a_thinned_band_covers_the_band(ys in prop::collection::vec((-1e3..1e3f64, 0.0..10.0f64), 500..3000)) {
            let rows: Vec<[f64; 3]> = ys.iter().enumerate().map(|(i, y)| [i as f64 / 20.0, y.0 + y.1, y.0 - y.1]).collect();
            let thin = band(&rows);
            for r in &rows {
                prop_assert!(thin.iter().any(|t| (t[0] - r[0]).abs() <= COLUMN && t[1] >= r[1] && t[2] <= r[2]));
            }
        }
    }

    #[test]
    fn a_hundred_thousand_points_become_a_few_for_each_pixel() {
        let points: Vec<Point> =
            (0..100_000).map(|i| [f64::from(i) / 200.0, f64::from(i).sin() * 50.0]).collect();
        assert!(run(&points).len() <= 4 * 1001);
        let dots: Vec<Point> = (0..100_000).map(|i| [f64::from(i % 300), f64::from(i % 7)]).collect();
        assert!(markers(&dots).len() <= 2100);
    }
}

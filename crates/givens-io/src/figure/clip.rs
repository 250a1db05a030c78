//! Clipping in pixels, so that no writer ever sees a coordinate far from the picture.

use super::scene::{Point, Rect};

/// The parts of a run of points inside `rect`.
pub(super) fn lines(run: &[Point], rect: &Rect) -> Vec<Vec<Point>> {
    let mut out: Vec<Vec<Point>> = Vec::new();
    let mut open = false;
    for pair in run.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        let Some((from, to)) = segment(a, b, rect) else {
            open = false;
            continue;
        };
        match out.last_mut().filter(|_| open) {
            Some(part) => part.push(to),
            None => out.push(vec![from, to]),
        }
        open = to == b;
    }
    out
}

/// The part of one segment inside `rect`, after Liang and Barsky.
fn segment(a: Point, b: Point, rect: &Rect) -> Option<(Point, Point)> {
    let d = [b[0] - a[0], b[1] - a[1]];
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for (slope, room) in [
        (-d[0], a[0] - rect.x),
        (d[0], rect.right() - a[0]),
        (-d[1], a[1] - rect.y),
        (d[1], rect.bottom() - a[1]),
    ] {
        if slope == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if slope < 0.0 {
            enter = enter.max(room / slope);
        } else {
            leave = leave.min(room / slope);
        }
    }
    // False for NaN as well, which the difference of two far points can give.
    if enter <= leave {
        let at = |s: f64| within([a[0] + s * d[0], a[1] + s * d[1]], rect);
        let from = if enter > 0.0 { at(enter) } else { a };
        Some((from, if leave < 1.0 { at(leave) } else { b }))
    } else {
        None
    }
}

/// What rounding left outside, when the ends were far away.
fn within([x, y]: Point, rect: &Rect) -> Point {
    [x.clamp(rect.x, rect.right()), y.clamp(rect.y, rect.bottom())]
}

/// The part of a closed ring inside `rect`, after Sutherland and Hodgman; empty when nothing is.
pub(super) fn ring(ring: &[Point], rect: &Rect) -> Vec<Point> {
    // (axis, bound, sign): the inside is where sign × (coordinate − bound) ≥ 0.
    let edges = [(0, rect.x, 1.0), (0, rect.right(), -1.0), (1, rect.y, 1.0), (1, rect.bottom(), -1.0)];
    let mut points = ring.to_vec();
    for (axis, bound, sign) in edges {
        let depth = |p: &Point| sign * (p[axis] - bound);
        let mut kept = Vec::with_capacity(points.len());
        let Some(mut last) = points.last().copied() else { return points };
        for p in points {
            let (before, after) = (depth(&last), depth(&p));
            if (before < 0.0) != (after < 0.0) {
                let s = before / (before - after);
                let mut cut = [last[0] + s * (p[0] - last[0]), last[1] + s * (p[1] - last[1])];
                cut[axis] = bound;
                if cut.iter().all(|c| c.is_finite()) {
                    kept.push(cut);
                }
            }
            if after >= 0.0 {
                kept.push(p);
            }
            last = p;
        }
        points = kept;
    }
    points.into_iter().map(|p| within(p, rect)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: Rect = Rect { x: 0.0, y: 0.0, width: 10.0, height: 10.0 };

    #[test]
    fn a_line_through_the_box_keeps_its_slope() {
        assert_eq!(lines(&[[-64.0, -64.0], [64.0, 64.0]], &BOX), [vec![[0.0, 0.0], [10.0, 10.0]]]);
        let far = lines(&[[-1e200, -3e200], [1e200, 3e200]], &BOX);
        assert!(far.iter().flatten().all(|p| BOX.contains(*p)));
    }

    #[test]
    fn a_line_that_leaves_and_returns_is_two_parts() {
        assert_eq!(lines(&[[1.0, 5.0], [5.0, 50.0], [9.0, 5.0]], &BOX).len(), 2);
        assert_eq!(lines(&[[1.0, 5.0], [5.0, 9.0], [9.0, 5.0]], &BOX).len(), 1);
        assert!(lines(&[[20.0, 5.0], [30.0, 9.0]], &BOX).is_empty());
    }

    #[test]
    fn a_ring_about_the_box_becomes_the_box() {
        let inside = ring(&[[-9.0, -9.0], [99.0, -9.0], [99.0, 99.0], [-9.0, 99.0]], &BOX);
        assert_eq!(inside.len(), 4);
        assert!(inside.iter().all(|p| BOX.contains(*p)));
        assert!(ring(&[[20.0, 20.0], [30.0, 20.0], [30.0, 30.0]], &BOX).is_empty());
    }
}

//! Rows of a matrix side by side in the lanes of packs, and back: blocks of four by four, which the compiler turns in registers.

/// The first `height` rows, of length `size`: their `columns` become rows of `lanes`, of length `side`. Lanes left over are
/// zero.
#[inline(always)]
pub(super) fn gather(
    rows: &[f64],
    size: usize,
    height: usize,
    lanes: &mut [f64],
    columns: core::ops::Range<usize>,
    side: usize,
) {
    let lanes = &mut lanes[columns.start * side..columns.end * side];
    if height < side {
        lanes.fill(0.0);
    }
    for first in (0..height).step_by(4) {
        let row = |lane: usize| &rows[(first + lane) * size..][columns.clone()];
        if first + 4 > height {
            for lane in 0..height - first {
                for (to, &x) in lanes.chunks_exact_mut(side).zip(row(lane)) {
                    to[first + lane] = x;
                }
            }
            return;
        }
        let [r, s, t, u] = [row(0), row(1), row(2), row(3)];
        let whole = r.len() / 4 * 4;
        for j in (0..whole).step_by(4) {
            let (r, s, t, u) = (&r[j..j + 4], &s[j..j + 4], &t[j..j + 4], &u[j..j + 4]);
            for k in 0..4 {
                lanes[(j + k) * side + first..][..4].copy_from_slice(&[r[k], s[k], t[k], u[k]]);
            }
        }
        for j in whole..r.len() {
            lanes[j * side + first..][..4].copy_from_slice(&[r[j], s[j], t[j], u[j]]);
        }
    }
}

/// The first `columns` of the rows of lanes `from` to `to` back.
#[inline(always)]
pub(super) fn scatter(
    rows: &mut [f64],
    size: usize,
    lanes: &[f64],
    from: usize,
    to: usize,
    columns: usize,
    side: usize,
) {
    let mut lane = from;
    while lane < to {
        let row = &mut rows[lane * size..];
        if lane + 4 > to {
            for (to, from) in row[..columns].iter_mut().zip(lanes.chunks_exact(side)) {
                *to = from[lane];
            }
            lane += 1;
            continue;
        }
        let (r, row) = row.split_at_mut(size);
        let (s, row) = row.split_at_mut(size);
        let (t, u) = row.split_at_mut(size);
        let whole = columns / 4 * 4;
        for j in (0..whole).step_by(4) {
            let mut of = [[0.0; 4]; 4];
            for (k, of) in of.iter_mut().enumerate() {
                of.copy_from_slice(&lanes[(j + k) * side + lane..][..4]);
            }
            for (k, row) in [&mut *r, &mut *s, &mut *t, &mut *u].into_iter().enumerate() {
                row[j..j + 4].copy_from_slice(&[of[0][k], of[1][k], of[2][k], of[3][k]]);
            }
        }
        for j in whole..columns {
            let of = &lanes[j * side + lane..];
            (r[j], s[j], t[j], u[j]) = (of[0], of[1], of[2], of[3]);
        }
        lane += 4;
    }
}

#[cfg(test)]
mod tests {
    use super::{gather, scatter};

    const SIDE: usize = 8;

    /// Element (i, j) of rows of length `size`, each of its own.
    fn numbered(height: usize, size: usize) -> Vec<f64> {
        (0..height * size).map(|k| 1.0 + k as f64).collect()
    }

    #[test]
    fn rows_stand_side_by_side_and_lanes_left_over_are_zero() {
        for (height, size) in (0..=SIDE).flat_map(|height| (1..12).map(move |size| (height, size))) {
            let rows = numbered(height, size);
            for columns in [0..size, size / 2..size, 0..size / 2] {
                let mut lanes = [7.0; 12 * SIDE];
                gather(&rows, size, height, &mut lanes, columns.clone(), SIDE);
                for (j, lane) in (0..12).flat_map(|j| (0..SIDE).map(move |lane| (j, lane))) {
                    let expected = match (columns.contains(&j), lane < height) {
                        (true, true) => rows[lane * size + j],
                        (true, false) => 0.0,
                        _ => 7.0,
                    };
                    assert_eq!(
                        lanes[j * SIDE + lane],
                        expected,
                        "{height} × {size}, {columns:?}: {j} {lane}"
                    );
                }
            }
        }
    }

    #[test]
    fn lanes_go_back_to_the_rows_that_are_told() {
        for size in 1..12 {
            let lanes = numbered(size, SIDE);
            for (from, to) in (0..=SIDE).flat_map(|to| (0..=to).map(move |from| (from, to))) {
                for columns in [size, size / 2] {
                    let mut rows = vec![0.5; SIDE * size];
                    scatter(&mut rows, size, &lanes, from, to, columns, SIDE);
                    for (i, j) in (0..SIDE).flat_map(|i| (0..size).map(move |j| (i, j))) {
                        let told = (from..to).contains(&i) && j < columns;
                        let expected = if told { lanes[j * SIDE + i] } else { 0.5 };
                        assert_eq!(rows[i * size + j], expected, "{from}..{to} of {size}: {i} {j}");
                    }
                }
            }
        }
    }
}

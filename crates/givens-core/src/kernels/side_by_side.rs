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

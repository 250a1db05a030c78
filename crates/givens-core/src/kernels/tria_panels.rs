//! The same triangularisation of a large matrix of `f64`: four reflections at a time go over the rows below, so that each
//! row is fetched and stored once for all of them.

use crate::scalar::{Job, Pack, Real};

/// The rows whose reflections go over those below together; a whole number of packs, so that all panels begin with one.
pub(super) const PANEL: usize = 4;

/// `rows` × `columns` in rows of length `stride` that have room for whole packs.
pub(super) struct Panels<'a> {
    pub a: &'a mut [f64],
    pub rows: usize,
    pub columns: usize,
    pub stride: usize,
}

impl Job<f64> for Panels<'_> {
    /// The number of rows that are done; the next one has nothing left.
    type Output = usize;
    const AVX512: bool = false;
    #[inline(always)]
    fn run<P: Pack<Element = f64>>(self) -> usize {
        let Self { a, rows, columns, stride } = self;
        if !PANEL.is_multiple_of(P::WIDTH) {
            return 0;
        }
        for row in a.chunks_exact_mut(stride).take(rows) {
            row[columns..].fill(0.0);
        }
        let mut end = 0;
        for first in (0..rows).step_by(PANEL) {
            let height = PANEL.min(rows - first);
            let from = &mut a[first * stride..];
            for row in from.chunks_exact(stride).take(height) {
                end = reach(&row[..columns], end);
            }
            let whole = end.max(columns.min(first + height)).next_multiple_of(P::WIDTH);
            let range = [first, whole, columns];
            let done = match height {
                1 => panel::<P, 1>(from, range, stride, rows - first),
                2 => panel::<P, 2>(from, range, stride, rows - first),
                3 => panel::<P, 3>(from, range, stride, rows - first),
                _ => panel::<P, PANEL>(from, range, stride, rows - first),
            };
            if done < height {
                return first + done;
            }
        }
        rows
    }
}

/// Where the zeros begin that the row and those above it end with: no reflection so far goes beyond. Behind a diagonal
/// noise that is a quarter of the work.
#[inline(always)]
fn reach(row: &[f64], end: usize) -> usize {
    let mut own = row.len();
    while own > end && row[own - 1] == 0.0 {
        own -= 1;
    }
    own.max(end)
}

/// H rows that are reflected within themselves. Their settled elements are kept aside and are zero in the rows, which are
/// then the vectors v of the reflections, all of the same columns.
struct Panel<'a, const H: usize> {
    first: usize,
    v: [&'a mut [f64]; H],
    settled: [[f64; H]; H],
    /// x becomes x + factor (v·x) v, and then its element in the column of the head is flipped.
    factor: [f64; H],
    flip: [f64; H],
    /// What is left of the next row, times itself and times the rows below.
    along: [f64; H],
}

/// Reflects the first H of `rows` rows within themselves, and those below by them: how many of the H had anything left.
#[inline(always)]
fn panel<P: Pack<Element = f64>, const H: usize>(
    from: &mut [f64],
    [first, whole, columns]: [usize; 3],
    stride: usize,
    rows: usize,
) -> usize {
    let (own, below) = from.split_at_mut(H * stride);
    let mut squares = [0.0; H];
    for (row, square) in own.chunks_exact(stride).zip(&mut squares) {
        *square = dot::<P>(&row[..first], &row[..first]).sum();
    }
    let mut own = own.chunks_exact_mut(stride);
    let v = core::array::from_fn(|_| own.next().map_or_else(Default::default, |row| &mut row[first..whole]));
    let mut panel =
        Panel { first, v, settled: [[0.0; H]; H], factor: [0.0; H], flip: [1.0; H], along: [0.0; H] };
    for j in 0..H {
        panel.along[j] = dot::<P>(panel.v[0], panel.v[j]).sum();
    }
    let bound = columns as f64 * f64::EPSILON;
    let mut nothing = |q: usize, panel: &Panel<H>| {
        for x in panel.settled[q] {
            squares[q] += x * x;
        }
        let rest = panel.along[q];
        let little = bound * bound * (squares[q] + rest) + f64::FAINT * f64::FAINT;
        first + q >= columns || !(rest >= little && rest.is_finite())
    };
    let mut done = 0;
    macro_rules! reflect {
        ($($q:literal)*) => { $(if done == $q && $q < H && !nothing($q, &panel) {
            panel.reflect::<P, $q>();
            done += 1;
        })* };
    }
    reflect!(0 1 2 3);
    if done > 0 {
        panel.go_over::<P>(done, below, stride, rows - H);
    }
    for (j, (row, settled)) in panel.v.iter_mut().zip(panel.settled).enumerate() {
        let kept = if j < done { j + 1 } else { done };
        row[..kept].copy_from_slice(&settled[..kept]);
        if j < done {
            row[kept..].fill(0.0);
        }
    }
    done
}

impl<const H: usize> Panel<'_, H> {
    /// Reflects what is left of row Q into its head, and the rows below it in the panel with it.
    #[inline(always)]
    fn reflect<P: Pack<Element = f64>, const Q: usize>(&mut self) {
        let Self { v, settled, factor, flip, along, .. } = self;
        let norm = Real::sqrt(along[Q]);
        let head = v[Q][Q];
        let moved = head + norm.copysign(head);
        factor[Q] = -(norm * (norm + head.abs())).recip();
        flip[Q] = -1.0_f64.copysign(head);
        settled[Q][Q] = norm;
        // the head's column apart: what it becomes is settled
        let mut by = [0.0; H];
        for j in Q + 1..H {
            let x = v[j][Q];
            by[j] = factor[Q] * norm.copysign(head).mul_add(x, along[j]);
            settled[j][Q] = by[j].mul_add(moved, x) * flip[Q];
            v[j][Q] = 0.0;
        }
        v[Q][Q] = 0.0;
        if Q + 1 < H {
            let mut sums = [P::zero(); H];
            for c in (0..v[Q].len()).step_by(P::WIDTH) {
                let head = P::load(&v[Q][c..]);
                let next = P::splat(by[Q + 1]).mul_add(head, P::load(&v[Q + 1][c..]));
                next.store(&mut v[Q + 1][c..]);
                sums[Q + 1] = next.mul_add(next, sums[Q + 1]);
                for j in Q + 2..H {
                    let x = P::splat(by[j]).mul_add(head, P::load(&v[j][c..]));
                    x.store(&mut v[j][c..]);
                    sums[j] = next.mul_add(x, sums[j]);
                }
            }
            for j in Q + 1..H {
                along[j] = sums[j].sum();
            }
        }
        v[Q][Q] = moved;
    }

    /// Reflects the rows below by the first `done` of the panel.
    #[inline(always)]
    fn go_over<P: Pack<Element = f64>>(&self, done: usize, below: &mut [f64], stride: usize, rows: usize) {
        let blank: &[f64] = self.v[0];
        let mut v = [blank; PANEL];
        for (to, row) in v.iter_mut().zip(&self.v).take(done) {
            *to = row;
        }
        let mut products = [[0.0; PANEL]; PANEL];
        for s in 0..done {
            for q in s + 1..done {
                products[s][q] = dot::<P>(v[s], v[q]).sum();
            }
        }
        // all at once x becomes x + Σ t_q v_q with t = Tᵀ d and d_q = v_q·x
        let mut t = [[0.0; PANEL]; PANEL];
        for q in 0..done {
            t[q][q] = self.factor[q];
            for s in 0..q {
                for r in s..q {
                    t[s][q] = t[s][r].mul_add(products[r][q] * self.factor[q], t[s][q]);
                }
            }
        }
        let first = self.first;
        let mut lower = below.chunks_exact_mut(stride).take(rows);
        while let Some(x) = lower.next() {
            let x = &mut x[first..][..blank.len()];
            if let Some(y) = lower.next() {
                let y = &mut y[first..][..blank.len()];
                two::<P>(v, &t, x, y);
                turn(y, &self.flip);
                turn(x, &self.flip);
            } else {
                one::<P>(v, &t, x);
                turn(x, &self.flip);
            }
        }
    }
}

#[inline(always)]
fn turn(x: &mut [f64], flip: &[f64]) {
    for (x, flip) in x.iter_mut().zip(flip) {
        *x *= flip;
    }
}

/// Four reflections go over two rows, which share the loads of v.
#[inline(always)]
fn two<P: Pack<Element = f64>>(v: [&[f64]; PANEL], t: &[[f64; PANEL]; PANEL], x: &mut [f64], y: &mut [f64]) {
    let [v0, v1, v2, v3] = v.map(|v| v.chunks_exact(P::WIDTH));
    let (mut d, mut e) = ([P::zero(); PANEL], [P::zero(); PANEL]);
    let both = x.chunks_exact(P::WIDTH).zip(y.chunks_exact(P::WIDTH));
    for ((((v0, v1), v2), v3), (x, y)) in v0.clone().zip(v1.clone()).zip(v2.clone()).zip(v3.clone()).zip(both)
    {
        let (x, y) = (P::load(x), P::load(y));
        let v = [P::load(v0), P::load(v1), P::load(v2), P::load(v3)];
        for q in 0..PANEL {
            d[q] = v[q].mul_add(x, d[q]);
            e[q] = v[q].mul_add(y, e[q]);
        }
    }
    let (d, e) = (turned(t, d), turned(t, e));
    let both = x.chunks_exact_mut(P::WIDTH).zip(y.chunks_exact_mut(P::WIDTH));
    for ((((v0, v1), v2), v3), (x, y)) in v0.zip(v1).zip(v2).zip(v3).zip(both) {
        let v = [P::load(v0), P::load(v1), P::load(v2), P::load(v3)];
        let (mut a, mut b) = (P::load(x), P::load(y));
        for q in 0..PANEL {
            a = d[q].mul_add(v[q], a);
            b = e[q].mul_add(v[q], b);
        }
        a.store(x);
        b.store(y);
    }
}

/// Four reflections go over one row.
#[inline(always)]
fn one<P: Pack<Element = f64>>(v: [&[f64]; PANEL], t: &[[f64; PANEL]; PANEL], x: &mut [f64]) {
    let mut d = [P::zero(); PANEL];
    for (d, v) in d.iter_mut().zip(v) {
        *d = dot::<P>(v, x);
    }
    let d = turned(t, d);
    for c in (0..x.len()).step_by(P::WIDTH) {
        let mut a = P::load(&x[c..]);
        for q in 0..PANEL {
            a = d[q].mul_add(P::load(&v[q][c..]), a);
        }
        a.store(&mut x[c..]);
    }
}

/// Tᵀ d, of d the sums of its lanes.
#[inline(always)]
fn turned<P: Pack<Element = f64>>(t: &[[f64; PANEL]; PANEL], d: [P; PANEL]) -> [P; PANEL] {
    let mut by = [0.0; PANEL];
    for s in 0..PANEL {
        let d = d[s].sum();
        for q in s..PANEL {
            by[q] = t[s][q].mul_add(d, by[q]);
        }
    }
    let mut splat = [P::zero(); PANEL];
    for (splat, by) in splat.iter_mut().zip(by) {
        *splat = P::splat(by);
    }
    splat
}

/// Σ v x over whole packs, as the sum of the lanes.
#[inline(always)]
fn dot<P: Pack<Element = f64>>(v: &[f64], x: &[f64]) -> P {
    let mut sum = P::zero();
    for (v, x) in v.chunks_exact(P::WIDTH).zip(x.chunks_exact(P::WIDTH)) {
        sum = P::load(v).mul_add(P::load(x), sum);
    }
    sum
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_zeros_that_rows_end_with_are_left_out() {
        let row = [1.0, 0.0, -2.0, 0.0, 0.0];
        assert_eq!([0, 3, 4, 5].map(|above| super::reach(&row, above)), [3, 3, 4, 5]);
        assert_eq!((super::reach(&[0.0; 4], 0), super::reach(&[0.0, f64::NAN], 0)), (0, 2));
    }
}

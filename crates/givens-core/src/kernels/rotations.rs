//! Rotations of many rows of D, kept to be gone over by rows that stand side by side.

use crate::scalar::{LANES, Pack, Real};

/// Rotations that go over a row together, so that it is fetched once for all of them.
const TOGETHER: usize = 4;

/// Their numbers in a column.
const BLOCK: usize = 2 * TOGETHER + 1;

/// Packs of rows side by side, which share the loads of a rotation.
pub(super) const PACKS: usize = 2;

/// Rows of numbers that finding a rotation takes.
const LAST: usize = 7;

/// Their length.
const fn last_row(n: usize) -> usize {
    n.saturating_add(2 * LANES)
}

/// Scalars of scratch of d rows of D of n columns.
pub(super) const fn rotations_scratch(d: usize, n: usize) -> usize {
    let of = d.div_ceil(TOGETHER).saturating_mul(BLOCK).saturating_mul(n);
    of.saturating_add(d.saturating_mul(2)).saturating_add(last_row(n).saturating_mul(LAST))
}

/// The rotations of the rows of D that are absorbed. That of row q turns x, in column j, and y, in column q, by
/// c = ρ_{j+1}/ρ_j and s = z_j/ρ_j, ρ_j being the norm of the pivot and of z from j on. Two substitutions make it two
/// operations and not four: over Y = ρ y it is x ← c x − g Y, Y ← Y + z x with g = s/ρ_{j+1}; and over X = x/κ, κ the
/// product of the c so far of those that go together, X ← X − (g/κ) Y, Y ← Y + (z κ₋) X, κ₋ the one before.
pub(super) struct Rotations<'a> {
    n: usize,
    /// g/κ and z κ₋ of those that go together, side by side, and the last κ; column by column.
    of: &'a mut [f64],
    /// z, ρ, κ, c, −g, −g/κ and z κ₋ of the last row, each of them in one piece, with room for whole packs.
    last: [&'a mut [f64]; LAST],
    /// ρ_n, the pivot before, and 1/ρ_0, that after.
    ends: &'a mut [f64],
    /// The number of rows.
    pub done: usize,
}

impl<'a> Rotations<'a> {
    /// None so far.
    pub fn none(d: usize, n: usize, scratch: &'a mut [f64]) -> Self {
        let (of, scratch) = scratch.split_at_mut(d.div_ceil(TOGETHER) * BLOCK * n);
        let (ends, scratch) = scratch.split_at_mut(2 * d);
        let mut last = scratch.chunks_exact_mut(last_row(n));
        let last = core::array::from_fn(|_| last.next().unwrap_or_default());
        Self { n, of, last, ends, done: 0 }
    }

    /// The last pivot.
    #[inline(always)]
    pub fn pivot(&self) -> f64 {
        self.last[1][0]
    }

    /// Finds the rotations of the next row of D, which is in lane `lane`; false if it has nothing left, or numbers so far
    /// apart that products of them might not be of full precision.
    #[inline(always)]
    pub fn absorb<P: Pack<Element = f64>>(&mut self, lanes: &[f64], d: usize, lane: usize) -> bool {
        let (n, q, side) = (self.n, self.done, PACKS * P::WIDTH);
        let [z, norms, scale, c, g, parts, rows] = &mut self.last;
        let pivot = lanes[q * side + lane];
        let mut settled = 0.0;
        for x in lanes.chunks_exact(side).take(q) {
            settled += x[lane] * x[lane];
        }
        let mut sum = pivot * pivot;
        norms[n] = sum;
        let spread = &lanes[d * side..][..n * side];
        for (z, x) in z.iter_mut().zip(spread.chunks_exact(side)) {
            *z = x[lane];
        }
        // four at a time, so that only every fourth addition has to wait for the one before
        let (rest, fours) = z[..n].as_rchunks::<4>();
        for (k, z) in fours.iter().enumerate().rev() {
            let mut part = 0.0;
            for j in (0..4).rev() {
                part = z[j].mul_add(z[j], part);
                norms[rest.len() + 4 * k + j] = sum + part;
            }
            sum += part;
        }
        for (j, &z) in rest.iter().enumerate().rev() {
            sum = Real::mul_add(z, z, sum);
            norms[j] = sum;
        }
        let bound = (d + n) as f64 * f64::EPSILON;
        let near = pivot > 1e-120 && pivot < 1e120 && sum < 1e100 * (pivot * pivot);
        if !near || sum <= bound * bound * (settled + sum) {
            return false;
        }
        for j in (0..=n).step_by(P::WIDTH) {
            P::load(&norms[j..]).sqrt().store(&mut norms[j..]);
        }
        let place = q % TOGETHER;
        if place == 0 {
            scale.fill(1.0);
        }
        let block = &mut self.of[q / TOGETHER * n * BLOCK..][..n * BLOCK];
        for j in (0..n).step_by(P::WIDTH) {
            let (norm, before) = (P::load(&norms[j..]), P::load(&norms[j + 1..]));
            let scaled = P::load(&scale[j..]);
            let turn = before / norm;
            let left = scaled * turn;
            let row = P::load(&z[j..]);
            let part = -row / (norm * before * left);
            turn.store(&mut c[j..]);
            (part * left).store(&mut g[j..]);
            part.store(&mut parts[j..]);
            (row * scaled).store(&mut rows[j..]);
            left.store(&mut scale[j..]);
        }
        for (j, to) in block.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
            to[place] = parts[j];
            to[TOGETHER + place] = rows[j];
            to[2 * TOGETHER] = scale[j];
        }
        self.ends[2 * q] = pivot;
        self.ends[2 * q + 1] = norms[0].recip();
        self.done += 1;
        true
    }

    /// Turns the rows in the lanes by the last rotations.
    #[inline(always)]
    pub fn turn_by_last<P: Pack<Element = f64>>(&self, lanes: &mut [f64], d: usize) {
        let (n, q, side) = (self.n, self.done - 1, PACKS * P::WIDTH);
        let [z, _, _, c, g, ..] = &self.last;
        let (y, x) = lanes.split_at_mut(d * side);
        let mut sums = self.begin::<P, 1>(q, y);
        let columns = z[..n].iter().zip(&c[..n]).zip(&g[..n]).zip(x.chunks_exact_mut(side));
        for (((&z, &c), &g), x) in columns.rev() {
            for (x, sum) in x.chunks_exact_mut(P::WIDTH).zip(&mut sums[0]) {
                let now = P::load(x);
                P::splat(g).mul_add(*sum, P::splat(c) * now).store(x);
                *sum = P::splat(z).mul_add(now, *sum);
            }
        }
        self.end::<P, 1>(q, y, sums);
    }

    /// Turns the rows in the lanes by all rotations, in their first `reach` columns of S.
    #[inline(always)]
    pub fn turn<P: Pack<Element = f64>>(&self, lanes: &mut [f64], d: usize, reach: usize) {
        let (y, x) = lanes.split_at_mut(d * PACKS * P::WIDTH);
        for q in (0..self.done).step_by(TOGETHER) {
            match self.done - q {
                1 => self.go_over::<P, 1>(q, y, x, reach),
                2 => self.go_over::<P, 2>(q, y, x, reach),
                3 => self.go_over::<P, 3>(q, y, x, reach),
                _ => self.go_over::<P, TOGETHER>(q, y, x, reach),
            }
        }
    }

    /// The first Q rotations of those together from number `q` on.
    #[inline(always)]
    fn go_over<P: Pack<Element = f64>, const Q: usize>(
        &self,
        q: usize,
        y: &mut [f64],
        x: &mut [f64],
        reach: usize,
    ) {
        let side = PACKS * P::WIDTH;
        let mut sums = self.begin::<P, Q>(q, y);
        let block = &self.of[q / TOGETHER * self.n * BLOCK..][..reach * BLOCK];
        for (of, x) in block.as_chunks::<BLOCK>().0.iter().zip(x.chunks_exact_mut(side)).rev() {
            let mut now = [P::load(x), P::load(&x[P::WIDTH..])];
            for k in 0..Q {
                let (g, z) = (P::splat(of[k]), P::splat(of[TOGETHER + k]));
                for p in 0..PACKS {
                    let moved = g.mul_add(sums[k][p], now[p]);
                    sums[k][p] = z.mul_add(now[p], sums[k][p]);
                    now[p] = moved;
                }
            }
            let scale = P::splat(of[2 * TOGETHER]);
            (now[0] * scale).store(x);
            (now[1] * scale).store(&mut x[P::WIDTH..]);
        }
        self.end::<P, Q>(q, y, sums);
    }

    /// Y of Q rotations from number `q` on, before they begin.
    #[inline(always)]
    fn begin<P: Pack<Element = f64>, const Q: usize>(&self, q: usize, y: &[f64]) -> [[P; PACKS]; Q] {
        let mut sums = [[P::zero(); PACKS]; Q];
        for (k, sums) in sums.iter_mut().enumerate() {
            let y = &y[(q + k) * PACKS * P::WIDTH..][..PACKS * P::WIDTH];
            for (sum, y) in sums.iter_mut().zip(y.chunks_exact(P::WIDTH)) {
                *sum = P::load(y) * P::splat(self.ends[2 * (q + k)]);
            }
        }
        sums
    }

    /// And y when they are done.
    #[inline(always)]
    fn end<P: Pack<Element = f64>, const Q: usize>(&self, q: usize, y: &mut [f64], sums: [[P; PACKS]; Q]) {
        for (k, sums) in sums.iter().enumerate() {
            let y = &mut y[(q + k) * PACKS * P::WIDTH..][..PACKS * P::WIDTH];
            for (sum, y) in sums.iter().zip(y.chunks_exact_mut(P::WIDTH)) {
                (*sum * P::splat(self.ends[2 * (q + k) + 1])).store(y);
            }
        }
    }
}

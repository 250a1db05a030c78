//! The same sweep of one matrix of `f64`, several rows side by side in the lanes of packs.

use crate::scalar::{Grain, Job, LANES, NARROW, Pack, Real, floats_mut};

/// The fewest columns of S for which that pays.
const FEWEST: usize = 12;

/// Rotations that go over a row together, so that it is fetched once for all of them.
const TOGETHER: usize = 4;

/// What each of them needs in a column: c, g and z.
const BLOCK: usize = 3 * TOGETHER;

/// Packs of rows side by side, which share the loads of a rotation.
const PACKS: usize = 2;

/// Scalars of scratch of [`sweep`](super::sweep()).
#[must_use]
pub const fn sweep_scratch(d: usize, n: usize) -> usize {
    if n < FEWEST || LANES == 1 {
        return n;
    }
    let rotations = d.div_ceil(TOGETHER).saturating_mul(BLOCK).saturating_mul(n);
    let rows = d.saturating_add(n).saturating_mul(PACKS * LANES);
    rotations.saturating_add(rows).saturating_add(2 * d).saturating_add(2 * n)
}

/// [`sweep`](super::sweep()) of `f64`, where the machine has registers for packs and n is not too small for them: the number
/// of rows of D that are absorbed. The next one has nothing left, or a pivot whose square is not a number of full precision.
#[inline(always)]
pub(super) fn sweep_in_lanes<T: Real>(a: &mut [T], d: usize, n: usize, scratch: &mut [T]) -> usize {
    let one = matches!(Grain::of::<T>(), Some(Grain { set: None, depth: 0 }));
    if !one || LANES == 1 || n < FEWEST {
        return 0;
    }
    sweep_f64(floats_mut(a), d, n, floats_mut(scratch))
}

#[inline(never)]
fn sweep_f64(a: &mut [f64], d: usize, n: usize, scratch: &mut [f64]) -> usize {
    if scratch.len() < sweep_scratch(d, n) {
        return 0;
    }
    let (rotations, scratch) = scratch.split_at_mut(d.div_ceil(TOGETHER) * BLOCK * n);
    let (ends, scratch) = scratch.split_at_mut(2 * d);
    let (row, lanes) = scratch.split_at_mut(2 * n);
    let job = Sweep { a, rotations: Rotations { n, of: rotations, ends, done: 0 }, row, lanes, d, n };
    NARROW.run_in_registers(job).unwrap_or(0)
}

struct Sweep<'a> {
    a: &'a mut [f64],
    rotations: Rotations<'a>,
    row: &'a mut [f64],
    lanes: &'a mut [f64],
    d: usize,
    n: usize,
}

impl Job<f64> for Sweep<'_> {
    type Output = usize;
    const AVX512: bool = false;
    #[inline(always)]
    fn run<P: Pack<Element = f64>>(self) -> usize {
        let Self { a, mut rotations, row, lanes, d, n } = self;
        let (size, side) = (d + n, PACKS * P::WIDTH);
        let (above, below) = a.split_at_mut(d * size);
        let mut going = true;
        for first in (0..d).step_by(side) {
            let rows = &mut above[first * size..];
            let height = side.min(d - first);
            gather(rows, size, height, lanes, 0..size, side);
            rotations.turn::<P>(0, lanes, d, n);
            let mut absorbed = 0;
            while going && absorbed < height {
                let q = first + absorbed;
                going = rotations.absorb::<P>(lanes, d, absorbed, row);
                if going {
                    let done = &mut rows[absorbed * size..][..size];
                    for (to, from) in done.iter_mut().zip(lanes.chunks_exact(side)).take(q) {
                        *to = from[absorbed];
                    }
                    done[q] = rotations.after(q);
                    done[d..].fill(0.0);
                    rotations.turn::<P>(q, lanes, d, n);
                    absorbed += 1;
                }
            }
            for lane in absorbed..height {
                scatter(&mut rows[lane * size..][..size], lanes, lane, side);
            }
        }
        for s in below.chunks_exact_mut(n * size) {
            for first in (0..n).step_by(side) {
                let rows = &mut s[first * size..];
                let height = side.min(n - first);
                let reach = first + height;
                lanes[..d * side].fill(0.0);
                gather(rows, size, height, lanes, d..d + reach, side);
                rotations.turn::<P>(0, lanes, d, reach);
                for lane in 0..height {
                    scatter(&mut rows[lane * size..][..d + reach], lanes, lane, side);
                }
            }
        }
        rotations.done
    }
}

/// Rows of length `size` side by side: their columns become rows of `lanes`.
#[inline(always)]
fn gather(
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
    for (lane, row) in rows.chunks_exact(size).take(height).enumerate() {
        for (to, &x) in lanes.chunks_exact_mut(side).zip(&row[columns.clone()]) {
            to[lane] = x;
        }
    }
}

/// One of them back.
#[inline(always)]
fn scatter(row: &mut [f64], lanes: &[f64], lane: usize, side: usize) {
    for (to, from) in row.iter_mut().zip(lanes.chunks_exact(side)) {
        *to = from[lane];
    }
}

/// The rotations of the rows of D that are absorbed. That of row q turns x, in column j, and y, in column q, by
/// c = ρ_{j+1}/ρ_j and s = z_j/ρ_j, ρ_j being the norm of the pivot and of z from j on. Over Y = ρ y, which takes one
/// operation and not two, it is x ← c x − g Y, Y ← Y + z x with g = s/ρ_{j+1}.
struct Rotations<'a> {
    n: usize,
    /// c, −g and z of four rows side by side, column by column.
    of: &'a mut [f64],
    /// ρ_n, the pivot before, and ρ_0, the one after.
    ends: &'a mut [f64],
    done: usize,
}

impl Rotations<'_> {
    #[inline(always)]
    fn after(&self, q: usize) -> f64 {
        self.ends[2 * q + 1]
    }

    /// Finds the rotations of the next row of D, which is in lane `lane`; false if it has nothing left, or squares that
    /// would not be numbers of full precision.
    #[inline(always)]
    fn absorb<P: Pack<Element = f64>>(
        &mut self,
        lanes: &[f64],
        d: usize,
        lane: usize,
        row: &mut [f64],
    ) -> bool {
        let (n, q, side) = (self.n, self.done, PACKS * P::WIDTH);
        let (z, norms) = row.split_at_mut(n);
        let pivot = lanes[q * side + lane];
        if !(1e-140..1e140).contains(&pivot) {
            return false;
        }
        let mut settled = 0.0;
        for x in lanes.chunks_exact(side).take(q) {
            settled += x[lane] * x[lane];
        }
        let mut sum = pivot * pivot;
        for j in (0..n).rev() {
            let x = lanes[(d + j) * side + lane];
            z[j] = x;
            sum = x.mul_add(x, sum);
            norms[j] = sum;
        }
        let bound = (d + n) as f64 * f64::EPSILON;
        if sum <= bound * bound * (settled + sum) {
            return false;
        }
        for j in (0..n).step_by(P::WIDTH) {
            P::load(&norms[j..]).sqrt().store(&mut norms[j..]);
        }
        let (block, place) = (q / TOGETHER * n * BLOCK, q % TOGETHER);
        let block = &mut self.of[block..block + n * BLOCK];
        for (j, to) in block.chunks_exact_mut(BLOCK).enumerate() {
            let before = norms.get(j + 1).copied().unwrap_or(pivot);
            to[place] = before / norms[j];
            to[TOGETHER + place] = -z[j] / (norms[j] * before);
            to[2 * TOGETHER + place] = z[j];
        }
        self.ends[2 * q] = pivot;
        self.ends[2 * q + 1] = norms[0];
        self.done += 1;
        true
    }

    /// Turns the rows in the lanes by the rotations from number `from` on, in their first `reach` columns of S.
    #[inline(always)]
    fn turn<P: Pack<Element = f64>>(&self, from: usize, lanes: &mut [f64], d: usize, reach: usize) {
        let mut q = from;
        let (y, x) = lanes.split_at_mut(d * PACKS * P::WIDTH);
        while q < self.done {
            if q.is_multiple_of(TOGETHER) && q + TOGETHER <= self.done {
                self.go_over::<P, TOGETHER>(q, y, x, reach);
                q += TOGETHER;
            } else {
                self.go_over::<P, 1>(q, y, x, reach);
                q += 1;
            }
        }
    }

    /// Q rotations from number `q` on.
    #[inline(always)]
    fn go_over<P: Pack<Element = f64>, const Q: usize>(
        &self,
        q: usize,
        y: &mut [f64],
        x: &mut [f64],
        reach: usize,
    ) {
        let (side, place) = (PACKS * P::WIDTH, q % TOGETHER);
        let mut sums = [[P::zero(); PACKS]; Q];
        for (k, sums) in sums.iter_mut().enumerate() {
            for (p, sum) in sums.iter_mut().enumerate() {
                *sum = P::load(&y[(q + k) * side + p * P::WIDTH..]) * P::splat(self.ends[2 * (q + k)]);
            }
        }
        let block = &self.of[q / TOGETHER * self.n * BLOCK..][..reach * BLOCK];
        let columns = block.as_chunks::<BLOCK>().0.iter().zip(x.chunks_exact_mut(side));
        for (of, x) in columns.rev() {
            let mut now = [P::load(x), P::load(&x[P::WIDTH..])];
            for k in 0..Q {
                let c = P::splat(of[place + k]);
                let g = P::splat(of[TOGETHER + place + k]);
                let z = P::splat(of[2 * TOGETHER + place + k]);
                for p in 0..PACKS {
                    let turned = g.mul_add(sums[k][p], c * now[p]);
                    sums[k][p] = z.mul_add(now[p], sums[k][p]);
                    now[p] = turned;
                }
            }
            now[0].store(x);
            now[1].store(&mut x[P::WIDTH..]);
        }
        for (k, sums) in sums.iter().enumerate() {
            for (p, &sum) in sums.iter().enumerate() {
                let y = &mut y[(q + k) * side + p * P::WIDTH..];
                (sum / P::splat(self.after(q + k))).store(y);
            }
        }
    }
}

//! The same triangularisation of one matrix of `f64`, its rows in packs.

use super::plus_dot;
use super::tria_panels::Panels;
use crate::scalar::{Grain, Job, LANES, NARROW, Pack, Real, floats_mut};

/// The longest row that is kept in packs while it is reflected: longer ones go faster four reflections at a time, by measurement.
const LONGEST: usize = 12;

/// The most rows.
const TALLEST: usize = 32;

/// [`tria`](super::tria()) of `f64`, where the machine has registers for packs, and the rows are neither too short nor too
/// long for them and end in room for a whole pack: the number of rows that are done. Those below are reflected by them, and
/// the next one has nothing left.
#[inline(always)]
pub(super) fn tria_in_packs<T: Real>(a: &mut [T], rows: usize, columns: usize, stride: usize) -> usize {
    if !Grain::is_double::<T>() || LANES == 1 {
        return 0;
    }
    tria_f64(floats_mut(a), rows, columns, stride)
}

#[inline(never)]
fn tria_f64(a: &mut [f64], rows: usize, columns: usize, stride: usize) -> usize {
    let packs = columns.div_ceil(LANES);
    if columns == 0 || packs * LANES > stride || a.len() < rows * stride {
        return 0;
    }
    if packs > LONGEST || rows > TALLEST {
        return NARROW.run_in_registers(Panels { a, rows, columns, stride }).unwrap_or(0);
    }
    NARROW.run_in_registers(Matrix { a, rows, columns, stride }).unwrap_or(0)
}

struct Matrix<'a> {
    a: &'a mut [f64],
    rows: usize,
    columns: usize,
    stride: usize,
}

impl Job<f64> for Matrix<'_> {
    type Output = usize;
    const AVX512: bool = false;
    #[inline(always)]
    fn run<P: Pack<Element = f64>>(self) -> usize {
        macro_rules! of_known_packs {
            ($($packs:literal)*) => {
                match self.columns.div_ceil(P::WIDTH) {
                    $($packs => self.reflected::<P, $packs>(),)*
                    _ => 0,
                }
            };
        }
        of_known_packs!(1 2 3 4 5 6 7 8 9 10 11 12)
    }
}

impl Matrix<'_> {
    /// All rows, of K packs each. While a reflection goes over the rows below, it takes the products that the next one needs:
    /// each row is read once. A reflection leaves the signs of its column, and what is left of its row, to the end.
    #[inline(always)]
    fn reflected<P: Pack<Element = f64>, const K: usize>(self) -> usize {
        let Self { a, rows, columns, stride } = self;
        let bound = columns as f64 * f64::EPSILON;
        // what is left of row i, and of the next one, and the products of row i with itself and with the rows below
        let (mut v, mut next, mut signs) = ([P::zero(); K], [P::zero(); K], [P::one(); K]);
        let mut along = [0.0; TALLEST];
        for (j, row) in a.chunks_exact_mut(stride).take(rows).enumerate() {
            let row = &mut row[..K * P::WIDTH];
            let mut x = packs::<P, K>(row);
            x[K - 1] = P::select(place::<P>(K - 1).lt(P::splat(columns as f64)), x[K - 1], P::zero());
            x[K - 1].store(&mut row[(K - 1) * P::WIDTH..]);
            if j == 0 {
                v = x;
            }
            along[j] = dot(&v, &x);
        }
        let mut done = 0;
        for i in 0..rows.min(columns) {
            let (above, below) = a.split_at_mut((i + 1) * stride);
            let row = &mut above[i * stride..];
            let rest = along[i];
            let little =
                bound * bound * (plus_dot(0.0, &row[..i], &row[..i]) + rest) + f64::FAINT * f64::FAINT;
            if !(rest >= little && rest.is_finite()) {
                break;
            }
            let norm = rest.sqrt();
            let head = row[i];
            let toward = norm.copysign(head);
            let scale = -(norm * (norm + head.abs())).recip();
            row[i] = -toward;
            let (column, moved, sign) =
                (P::splat(i as f64), P::splat(head + toward), P::splat(-1.0_f64.copysign(head)));
            for k in 0..K {
                let here = place::<P>(k).same(column);
                v[k] = P::select(here, moved, v[k]);
                signs[k] = P::select(here, sign, signs[k]);
            }
            for (j, row) in below.chunks_exact_mut(stride).take(rows - i - 1).enumerate() {
                let row = &mut row[..K * P::WIDTH];
                let product = &mut along[i + 1 + j];
                let by = P::splat(toward.mul_add(row[i], *product) * scale);
                let mut x = packs::<P, K>(row);
                for k in 0..K {
                    x[k] = by.mul_add(v[k], x[k]);
                    x[k].store(&mut row[k * P::WIDTH..]);
                }
                if j == 0 {
                    for k in 0..K {
                        next[k] = P::select(column.lt(place::<P>(k)), x[k], P::zero());
                    }
                }
                *product = dot(&next, &x);
            }
            v = next;
            done = i + 1;
        }
        for (j, row) in a.chunks_exact_mut(stride).take(rows).enumerate() {
            let last = P::splat(if j < done { j } else { columns } as f64);
            let x = packs::<P, K>(row);
            for k in 0..K {
                P::select(place::<P>(k).le(last), signs[k] * x[k], P::zero()).store(&mut row[k * P::WIDTH..]);
            }
            if stride > K * P::WIDTH {
                row[K * P::WIDTH..].fill(0.0);
            }
        }
        done
    }
}

/// The columns of pack k.
#[inline(always)]
fn place<P: Pack<Element = f64>>(k: usize) -> P {
    P::load(&COLUMNS[k * P::WIDTH..])
}

const COLUMNS: [f64; LONGEST * LANES] = {
    let mut columns = [0.0; LONGEST * LANES];
    let mut j = 0;
    while j < columns.len() {
        columns[j] = j as f64;
        j += 1;
    }
    columns
};

/// The first K packs of a row.
#[inline(always)]
fn packs<P: Pack<Element = f64>, const K: usize>(row: &[f64]) -> [P; K] {
    let mut x = [P::zero(); K];
    for k in 0..K {
        x[k] = P::load(&row[k * P::WIDTH..]);
    }
    x
}

/// Σ v x, in two sums: the additions need not all wait for each other.
#[inline(always)]
fn dot<P: Pack<Element = f64>, const K: usize>(v: &[P; K], x: &[P; K]) -> f64 {
    let mut sums = [P::zero(); 2];
    for k in 0..K {
        sums[k % 2] = v[k].mul_add(x[k], sums[k % 2]);
    }
    (sums[0] + sums[1]).sum()
}

#[cfg(test)]
mod tests {
    use super::{LANES, NARROW, tria_in_packs};

    /// Numbers between −1 and 1 in rows of whole packs.
    fn mixed(rows: usize, columns: usize, unit: f64) -> (Vec<f64>, usize) {
        let stride = columns.max(rows).next_multiple_of(LANES);
        let at = |k: usize| unit * crate::scalar::Real::sin(1.0 + (k * k) as f64 * 0.7);
        ((0..rows * stride).map(at).collect(), stride)
    }

    #[test]
    fn a_machine_with_registers_does_all_rows_in_them() {
        if LANES == 1 || !NARROW.available() {
            return;
        }
        // both kernels; lengths at which one ends and the other begins
        for (rows, columns) in [
            (1, 1),
            (1, 9),
            (3, 4),
            (7, 22),
            (32, 45),
            (32, 48),
            (1, 49),
            (30, 90),
            (33, 33),
            (34, 40),
            (41, 43),
        ] {
            for unit in [1.0, 2_f64.powi(-200), 2_f64.powi(400)] {
                for spare in [0, 3] {
                    let (mut a, stride) = mixed(rows + spare, columns, unit);
                    let done = tria_in_packs(&mut a, rows, columns, stride);
                    assert_eq!(done, rows, "{rows} × {columns} in {unit:e}, {spare} rows behind");
                }
            }
        }
    }

    #[test]
    fn a_row_stops_it_that_the_ones_above_leave_nothing_of() {
        if LANES == 1 || !NARROW.available() {
            return;
        }
        for (rows, columns) in [(7, 22_usize), (34, 60)] {
            for lost in [1, 2, rows - 2, rows - 1] {
                // a unit matrix but for row `lost`, of which the first column has 1 and its own what is left
                let stops = |left: f64| {
                    let stride = columns.next_multiple_of(LANES);
                    let mut a = vec![0.0; rows * stride];
                    for i in 0..rows {
                        a[i * stride + i] = if i == lost { left } else { 1.0 };
                    }
                    a[lost * stride] = 1.0;
                    tria_in_packs(&mut a, rows, columns, stride)
                };
                let bound = columns as f64 * f64::EPSILON;
                assert_eq!((stops(0.5 * bound), stops(2.0 * bound)), (lost, rows), "{lost} of {rows}");
            }
        }
    }
}

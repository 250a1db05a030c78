//! The spread of a rule whose unit points stand in a table.

use super::Spread;
use super::moments::{even_moment, odd_moment};
use super::pairs::evaluate;
use crate::model::{At, Map};
use crate::scalar::{Mask, Real};

/// D = A J Ξᵀ and E = A − D Ξ, with A the weighted odd and even parts of the images.
#[inline(always)]
pub(super) fn from_table<T: Real, G: Map>(
    table: &[T],
    count: usize,
    negative: usize,
    centre: Option<f64>,
    g: &G,
    at: &At<T>,
    mean: &[T],
    factor: &[T],
    out: &mut Spread<T>,
    scratch: &mut [T],
) {
    let n = mean.len();
    let (weights, rest) = table.split_at(count);
    let (scales, nodes) = rest.split_at(count);
    let lay = |x: &mut [T], points: usize| {
        for (i, (row, &m)) in x.chunks_exact_mut(points).zip(mean).enumerate() {
            let (plus, rest) = row.split_at_mut(count);
            let (minus, centre) = rest.split_at_mut(count);
            plus.fill(T::zero());
            for (&s, xi) in factor[i * n..=i * n + i].iter().zip(nodes.chunks_exact(count)) {
                for (step, &xi) in plus.iter_mut().zip(xi) {
                    *step = s.mul_add(xi, *step);
                }
            }
            for (plus, minus) in plus.iter_mut().zip(minus) {
                let step = *plus;
                (*plus, *minus) = (m + step, m - step);
            }
            centre.fill(m);
        }
    };
    let images = evaluate(g, at, n, count, centre.is_some(), lay, scratch);
    let half = T::of(0.5);
    let positive = count - negative;
    let minus_columns = 2 * negative + usize::from(centre.is_some_and(|weight| weight < 0.0));
    let plus_columns = 2 * positive + usize::from(centre.is_some_and(|weight| weight >= 0.0));
    for i in 0..g.outputs() {
        let (plus, minus, at_mean) = images.row(i);
        let reference = if centre.is_some() { at_mean } else { None };
        let row = &mut out.dev[i * out.stride..(i + 1) * out.stride];
        let lost = &mut out.minus[i * minus_columns..(i + 1) * minus_columns];
        let first = plus[0];
        let mut level = T::Mask::splat(true);
        for y in plus.iter().chain(minus).chain(&reference) {
            level = level & y.same(first);
        }
        if level.all() {
            out.mean[i] = first;
            let columns = row.len().min(n + plus_columns);
            row[..columns].fill(T::zero());
            lost.fill(T::zero());
            continue;
        }
        // the weights sum to one: averaged about the centre or a first average, the sum over many points stays small, and
        // a component without spread has no deviation of rounding
        let about = |near: T| near + even_moment(weights, plus, minus, near);
        let ybar = T::select(level, first, about(reference.unwrap_or_else(|| about(T::zero()))));
        out.mean[i] = ybar;
        for (d, xi) in row.iter_mut().zip(nodes.chunks_exact(count)) {
            // Σ over both points of w y ξ
            *d = odd_moment(weights, plus, minus, xi);
        }
        if out.stride == n {
            continue;
        }
        let (moved, rest) = row.split_at_mut(n);
        let (even, rest) = rest.split_at_mut(positive);
        let (odd, middle) = rest.split_at_mut(positive);
        let (even_lost, odd_lost) = lost.split_at_mut(negative);
        for (l, even) in even.iter_mut().chain(even_lost).enumerate() {
            *even = scales[l] * (half * (plus[l] + minus[l]) - ybar);
        }
        let kinds = [(odd, 0..positive), (&mut odd_lost[..negative], positive..count)];
        for (odd, range) in kinds {
            let (plus, minus) = (&plus[range.clone()], &minus[range.clone()]);
            for ((odd, &p), &m) in odd.iter_mut().zip(plus).zip(minus) {
                *odd = half * (p - m);
            }
            for (&d, xi) in moved.iter().zip(nodes.chunks_exact(count)) {
                for (odd, &xi) in odd.iter_mut().zip(&xi[range.clone()]) {
                    *odd = (-d).mul_add(xi, *odd);
                }
            }
            for (odd, &scale) in odd.iter_mut().zip(&scales[range]) {
                *odd *= scale;
            }
        }
        put_centre(centre, reference, ybar, middle, lost.last_mut());
    }
}

/// The centre's column √|w| (y₀ − ȳ), among the positive or the negative ones by the sign of its weight.
#[inline(always)]
fn put_centre<T: Real>(
    centre: Option<f64>,
    image: Option<T>,
    ybar: T,
    plus: &mut [T],
    minus: Option<&mut T>,
) {
    let (Some(weight), Some(image)) = (centre, image) else { return };
    let column = T::of(Real::sqrt(Real::abs(weight))) * (image - ybar);
    match minus {
        Some(minus) if weight < 0.0 => *minus = column,
        _ => plus[0] = column,
    }
}

//! Dense output: the solution between the ends of a step (docs/algorithms.md O4).

use crate::scalar::Real;

/// An accepted step, and the solution within it.
#[derive(Clone, Copy, Debug)]
pub struct Segment<'a, T> {
    /// The time at which the step starts.
    pub t: f64,
    /// Its length; negative if time runs backwards.
    pub h: f64,
    /// The state at its start.
    pub start: &'a [T],
    /// The state at its end.
    pub end: &'a [T],
    /// The second, third and fourth coefficient of the interpolation, one behind the other.
    pub(super) curve: &'a [T],
}

impl<T: Real> Segment<'_, T> {
    /// Writes the solution at t + θ h to `y`, of the state's length; 0 ≤ θ ≤ 1.
    ///
    /// It is of order 4 for `dp5`, and else a cubic, of order 3. A cubic that lacks the slope at its end, because the
    /// system has no derivative where the gap ends, is the parabola of the rest.
    #[inline(always)]
    pub fn at(&self, theta: f64, y: &mut [T]) {
        let (x, rest) = (T::of(theta), T::of(1.0 - theta));
        let n = self.start.len();
        for (i, y) in y.iter_mut().enumerate() {
            let [c2, c3, c4] = [0, 1, 2].map(|k| self.curve[k * n + i]);
            let inner = c4.mul_add(rest, c3).mul_add(x, c2);
            *y = inner.mul_add(rest, self.end[i] - self.start[i]).mul_add(x, self.start[i]);
        }
    }
}

/// Who reads the steps, if anybody does.
pub(super) type Visit<'v, T> = Option<&'v mut dyn FnMut(&Segment<T>)>;

/// The cubic through both ends with the slopes there.
#[inline(always)]
pub(super) fn hermite<T: Real>(h: T, y: &[T], end: &[T], slopes: (&[T], &[T]), ended: bool, curve: &mut [T]) {
    let (second, rest) = curve.split_at_mut(y.len());
    let (third, fourth) = rest.split_at_mut(y.len());
    fourth.fill(T::zero());
    for i in 0..y.len() {
        let rise = end[i] - y[i];
        second[i] = h * slopes.0[i] - rise;
        third[i] = if ended { rise - h * slopes.1[i] - second[i] } else { T::zero() };
    }
}

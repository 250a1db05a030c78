//! Systems with known solutions.

use core::fmt;
use givens_core::model::At;
use givens_core::ode::{Integrator, Segment, Solver, Steps, Stop, System, Tolerance, Work};
use givens_core::scalar::Real;

/// A state outside the system's domain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outside;

impl fmt::Display for Outside {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("outside the domain")
    }
}

/// A system written as a function, with the largest component of the error as its norm.
macro_rules! system {
    ($(#[$doc:meta])* $name:ident, $len:expr, |$at:ident, $table:ident, $y:ident, $dy:ident| $body:expr) => {
        $(#[$doc])*
        pub struct $name;
        impl System for $name {
            type Fault = Outside;
            fn len(&self) -> usize {
                $len
            }
            fn scratch(&self) -> usize {
                1
            }
            fn derivative<T: Real>(
                &self,
                $at: &At<T>,
                $table: &[T],
                $y: &[T],
                $dy: &mut [T],
                scratch: &mut [T],
            ) -> Result<(), Outside> {
                assert!($at.dt.first() == 0.0 && $y.len() == $len && $dy.len() == $len);
                scratch[0] = T::zero();
                $body
            }
            fn error<T: Real>(&self, tolerance: Tolerance, before: &[T], after: &[T], error: &[T]) -> f64 {
                largest(tolerance, before, after, error)
            }
        }
    };
}

fn largest<T: Real>(tolerance: Tolerance, before: &[T], after: &[T], error: &[T]) -> f64 {
    let size = |y: &[T]| y.iter().map(|y| y.first().powi(2)).sum::<f64>().sqrt();
    let scale = tolerance.of(size(before).max(size(after)));
    error
        .iter()
        .map(|error| error.first().abs() / scale)
        .fold(0.0, |worst: f64, error| if error.is_nan() { error } else { worst.max(error) })
}

system!(
    /// Nonlinear, driven by time, with a parameter and a table, both 1: y = 1/(1 + t²), exp(sin t).
    Driven, 2, |at, table, y, dy| {
        dy[0] = -at.p[0] * (at.t + at.t) * y[0] * y[0] + y[1].ln() - at.t.sin();
        dy[1] = table[0] * y[1] * at.t.cos();
        Ok(())
    }
);

impl Driven {
    pub fn solution(t: f64) -> [f64; 2] {
        [1.0 / (1.0 + t * t), t.sin().exp()]
    }
}

system!(
    /// y'' = −y.
    Oscillator, 2, |at, table, y, dy| {
        let _ = (at, table);
        dy[0] = y[1];
        dy[1] = -y[0];
        Ok(())
    }
);

system!(
    /// A body around the sun, period 2π.
    Kepler, 4, |at, table, y, dy| {
        let _ = (at, table);
        let r = y[0].hypot(y[1]);
        let pull = (r * r * r).recip();
        (dy[0], dy[1]) = (y[2], y[3]);
        (dy[2], dy[3]) = (-y[0] * pull, -y[1] * pull);
        Ok(())
    }
);

system!(
    /// Lorenz's with the classical parameters, times a rate.
    Lorenz, 3, |at, table, y, dy| {
        let _ = table;
        dy[0] = T::of(10.0) * (y[1] - y[0]);
        dy[1] = y[0] * (T::of(28.0) - y[2]) - y[1];
        dy[2] = y[0] * y[1] - T::of(8.0 / 3.0) * y[2];
        for dy in dy {
            *dy *= at.p[0];
        }
        Ok(())
    }
);

system!(
    /// The stiff Van der Pol oscillator, μ = 1000.
    VanDerPol, 2, |at, table, y, dy| {
        let _ = (at, table);
        dy[0] = y[1];
        dy[1] = T::of(1000.0) * (T::one() - y[0] * y[0]) * y[1] - y[0];
        Ok(())
    }
);

system!(
    /// y' = −1 where y ≥ ¼; no derivative below.
    Floor, 1, |at, table, y, dy| {
        let _ = (at, table);
        dy[0] = -T::one();
        if y[0].first() < 0.25 { Err(Outside) } else { Ok(()) }
    }
);

system!(
    /// The second slope, −√(1 − t), is no number after t = 1.
    Ends, 2, |at, table, y, dy| {
        let _ = table;
        dy[0] = y[0];
        dy[1] = -(T::one() - at.t).sqrt();
        Ok(())
    }
);

/// Who reads the steps, if anybody does.
pub type Visit<'v, T> = Option<&'v mut dyn FnMut(&Segment<T>)>;

/// Integrates over [t, t + gap] in scratch of exactly the length asked for.
pub fn solve<T: Real, S: System>(
    integrator: &Integrator,
    system: &S,
    span: (f64, f64),
    y: &mut [T],
    visit: Visit<T>,
) -> (Result<(), Stop<S::Fault>>, Work) {
    solve_at_rate(1.0, integrator, system, span, y, visit)
}

/// The same with a parameter of its own.
pub fn solve_at_rate<T: Real, S: System>(
    rate: f64,
    integrator: &Integrator,
    system: &S,
    (t, gap): (f64, f64),
    y: &mut [T],
    visit: Visit<T>,
) -> (Result<(), Stop<S::Fault>>, Work) {
    integrator.check().unwrap();
    let (rate, one, mut work) = ([T::of(rate)], [T::one()], Work::default());
    let at = At { t: T::of(t), dt: T::of(gap), u: &[], p: &rate };
    let mut scratch = vec![T::of(f64::NAN); integrator.scratch(system.len(), system.scratch(), 1, 1)];
    let done = match visit {
        Some(visit) => integrator.solve(system, &at, &one, y, &mut work, visit, &mut scratch),
        None => integrator.advance(system, &at, &one, y, &mut work, &mut scratch),
    };
    (done, work)
}

/// With the relative tolerance alone.
pub fn to(solver: Solver, rtol: f64) -> Integrator {
    Integrator { solver, tolerance: Tolerance { rtol, atol: 0.0 }, ..Integrator::default() }
}

/// Equal steps for every solver: the adaptive ones accept whatever the bound gives.
pub fn equal(solver: Solver, h: f64) -> Integrator {
    Integrator { steps: Steps::Longest(h), ..to(solver, 1e12) }
}

/// The largest error against the length of the expected vector.
pub fn error(found: &[f64], expected: &[f64]) -> f64 {
    let size = expected.iter().map(|x| x * x).sum::<f64>().sqrt();
    found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
}

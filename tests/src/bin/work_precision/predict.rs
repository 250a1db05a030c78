//! One prediction over one interval, by any time update, solver and setting.

use givens::filter::predict::{EulerMaruyama, ItoTaylor, LevelSet, MomentOde, TimeUpdate, Variant, Velocity};
use givens::filter::{Filter, Gaussian, Method, SquareRoot, StepError};
use givens::model::Sde;
use givens::ode::{Integrator, Solver, Steps, Tolerance, Work};
use givens::rule::Cubature3;
use givens_tests::counted::Counted;
use std::time::Instant;

/// A belief to be predicted over an interval.
pub struct Problem<M> {
    /// Of the figure's file.
    pub name: &'static str,
    /// Of the section.
    pub title: &'static str,
    pub model: M,
    pub prior: Gaussian,
    /// Length of the interval.
    pub span: f64,
    /// The most steps of equal length that are tried, a power of two.
    pub most: usize,
}

/// A time update.
#[derive(Clone, Copy, PartialEq)]
pub enum Way {
    Moments,
    LevelSet(Velocity),
    ItoTaylor,
    EulerMaruyama,
}

/// How finely it is computed.
#[derive(Clone, Copy, PartialEq)]
pub enum Setting {
    Steps(usize),
    Rtol(f64),
}

/// A predicted belief, and what it has cost.
pub struct Predicted {
    pub mean: Vec<f64>,
    pub cov: Vec<f64>,
    /// Evaluations of the drift.
    pub evaluations: usize,
    /// The filter's own counters.
    pub work: Work,
    /// Median time of a prediction, where it was asked for.
    pub microseconds: f64,
}

/// The cubature rule in square-root form with any time update.
#[derive(Clone, Copy)]
struct By<U>(U);

impl<U: Copy> Method for By<U> {
    type Rule = Cubature3;
    type Form = SquareRoot;
    type Time = U;
    fn rule(&self) -> Cubature3 {
        Cubature3
    }
    fn time_update(&self) -> U {
        self.0
    }
}

impl<M: Sde + Copy> Problem<M> {
    /// The prediction, timed if that is wanted.
    pub fn predict(
        &self,
        way: Way,
        solver: Solver,
        setting: Setting,
        timed: bool,
    ) -> Result<Predicted, StepError> {
        let (steps, rtol) = match setting {
            Setting::Steps(count) => (Steps::Count(count), 1e-6),
            Setting::Rtol(rtol) => (Steps::Count(1), rtol),
        };
        let tolerance = Tolerance { rtol, atol: 0.0 };
        let integrator = Integrator { solver, steps, tolerance, ..Integrator::default() };
        match way {
            Way::Moments => self.by(MomentOde { integrator }, timed),
            Way::LevelSet(velocity) => {
                self.by(LevelSet { velocity, integrator, ..LevelSet::default() }, timed)
            }
            Way::ItoTaylor => self.by(ItoTaylor { variant: Variant::Full, steps }, timed),
            Way::EulerMaruyama => self.by(EulerMaruyama { steps }, timed),
        }
    }

    fn by<U: TimeUpdate<M> + TimeUpdate<Counted<M>>>(
        &self,
        time: U,
        timed: bool,
    ) -> Result<Predicted, StepError> {
        let counted = Counted::new(self.model);
        let mut filter = By(time).start(&counted, 0.0, &self.prior)?;
        counted.take();
        filter.predict(self.span)?;
        let (evaluations, work) = (counted.take(), filter.work());
        let (mean, cov) = (filter.mean().to_vec(), filter.cov());
        let microseconds = if timed { self.time(By(time))? } else { f64::NAN };
        Ok(Predicted { mean, cov, evaluations, work, microseconds })
    }

    /// Median time of the model itself, which counts nothing, in µs.
    fn time<U: TimeUpdate<M>>(&self, method: By<U>) -> Result<f64, StepError> {
        let start = method.start(&self.model, 0.0, &self.prior)?;
        let once = || {
            let mut filter: Filter<_, _, _, _> = start.clone();
            let begun = Instant::now();
            filter.predict(self.span)?;
            Ok(1e6 * begun.elapsed().as_secs_f64())
        };
        let first: f64 = once()?;
        let repeats = (1e4 / first).clamp(5.0, 101.0) as usize;
        let mut times = (0..repeats).map(|_| once()).collect::<Result<Vec<_>, _>>()?;
        times.sort_by(f64::total_cmp);
        Ok(times[repeats / 2])
    }
}

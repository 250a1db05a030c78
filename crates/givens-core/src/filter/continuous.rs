//! The methods for continuous models by name: a type for each, its registry name in camel case, its options as fields.

use super::constants::continuous_constants;
use super::form::{Covariance, SquareRoot};
use super::methods::Method;
use super::predict::{Gauge, ItoTaylor, LevelSet, MomentOde, Root, Variant, Velocity};
use super::start::Sizes;
use super::update::Block;
use crate::ode::{Integrator, Solver, Steps, Tolerance};
use crate::rule::{Cubature3, GaussHermite, Taylor, Unscented};

/// How a gap is divided: `max_step` if it is given, or else `substeps`.
const fn steps(substeps: usize, max_step: Option<f64>) -> Steps {
    match max_step {
        Some(longest) => Steps::Longest(longest),
        None => Steps::Count(substeps),
    }
}

macro_rules! method {
    ($(#[$doc:meta])* $name:ident: $form:ident, $rule:ident { $($field:ident: $type:ty = $default:expr, $about:literal);* },
     $time:ident { $($option:ident: $option_type:ty = $option_default:expr, $option_about:literal);* } by |$m:ident| $make:expr $(, $update:ident)?) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            $(#[doc = $about] pub $field: $type,)*
            $(#[doc = $option_about] pub $option: $option_type,)*
            /// Into how many steps a gap is divided, where steps are fixed.
            pub substeps: usize,
            /// The longest step, in the unit of time; it takes the place of `substeps`, and bounds steps that are adapted.
            pub max_step: Option<f64>,
            $(/// The block that a measurement update triangularises.
            pub $update: Block,)?
        }

        continuous_constants!($name: $rule { $($field = $default),* }, $time {
            $($option = $option_default,)* substeps = 16, max_step = None $(, $update = Block::Joint)?
        } by |$m| $make);

        impl Method for $name {
            type Rule = $rule;
            type Form = $form;
            type Time = $time;
            fn rule(&self) -> $rule {
                self.parts()
            }
            fn time_update(&self) -> $time {
                self.time()
            }
            $(fn block(&self) -> Block {
                self.$update
            })?
        }
    };
}

/// A pair of methods, in covariance and in square-root form, whose time update is a step by Itô and Taylor.
macro_rules! ito_taylor {
    ($($(#[$doc:meta])* $cov:ident, $(#[$sr_doc:meta])* $sr:ident: $rule:ident $options:tt, $variant:ident;)*) => {$(
        method!($(#[$doc])* $cov: Covariance, $rule $options, ItoTaylor {} by |m| ItoTaylor {
            variant: Variant::$variant, steps: steps(m.substeps, m.max_step),
        });
        method!($(#[$sr_doc])* $sr: SquareRoot, $rule $options, ItoTaylor {} by |m| ItoTaylor {
            variant: Variant::$variant, steps: steps(m.substeps, m.max_step),
        }, update);
    )*};
}

/// A pair of methods, in covariance and in square-root form, whose time update integrates the moments.
macro_rules! moment_ode {
    ($($(#[$doc:meta])* $cov:ident, $(#[$sr_doc:meta])* $sr:ident: $rule:ident $options:tt;)*) => {$(
        moment_ode!(@one $(#[$doc])* $cov: Covariance, $rule $options);
        moment_ode!(@one $(#[$sr_doc])* $sr: SquareRoot, $rule $options, update);
    )*};
    (@one $(#[$doc:meta])* $name:ident: $form:ident, $rule:ident $options:tt $(, $update:ident)?) => {
        method!($(#[$doc])* $name: $form, $rule $options, MomentOde {
            solver: Solver = Solver::Dp5, "The solver.";
            rtol: f64 = 1e-6, "What an adaptive solver keeps the error of a step below, in standard deviations.";
            atol: f64 = 0.0, "The same in the states' own units; the sum of both counts."
        } by |m| MomentOde { integrator: integrator(m.solver, m.substeps, m.max_step, m.rtol, m.atol) } $(, $update)?);

        impl $name {
            /// [`sizes_for`](Self::sizes_for) a model whose diffusion depends on the state: the columns of its noise are then
            /// spread by the rule, and there are more of them.
            #[must_use]
            pub const fn sizes_with_state(&self, sizes: Sizes) -> Sizes {
                self.time().sizes_with_state(sizes, self.parts().shape_for(sizes.states))
            }
        }
    };
}

pub(super) const fn integrator(
    solver: Solver,
    substeps: usize,
    max_step: Option<f64>,
    rtol: f64,
    atol: f64,
) -> Integrator {
    let (steps, tolerance) = (steps(substeps, max_step), Tolerance { rtol, atol });
    Integrator { solver, steps, tolerance, ..Integrator::DEFAULT }
}

ito_taylor! {
    /// `cd-ckf`: the continuous-discrete cubature Kalman filter (2010), Itô–Taylor, simplified.
    CdCkf,
    /// `sr-cd-ckf`: the continuous-discrete cubature Kalman filter in square-root form (2010 eq 25–36).
    ///
    /// ```
    /// use givens_core::filter::{Gaussian, Method, SrCdCkf};
    /// use givens_core::model::{At, Sde};
    /// use givens_core::scalar::Real;
    /// # use givens_core::model::{Noise, Observation};
    /// # struct Angle;
    /// # impl Observation for Angle {
    /// #     fn states(&self) -> usize { 2 }
    /// #     fn measures(&self) -> usize { 1 }
    /// #     fn observe<T: Real>(&self, _: &At<T>, x: &[T], z: &mut [T]) { z[0] = x[0]; }
    /// #     fn noise(&self) -> Noise { Noise::Root(1) }
    /// #     fn measurement_noise<T: Real>(&self, _: &At<T>, out: &mut [T]) { out[0] = T::of(0.05); }
    /// # }
    ///
    /// /// A noisy pendulum: angle and rate.
    /// struct Pendulum;
    /// impl Sde for Pendulum {
    ///     fn states(&self) -> usize { 2 }
    ///     fn noises(&self) -> usize { 1 }
    ///     fn drift<T: Real>(&self, _: &At<T>, x: &[T], dx: &mut [T]) {
    ///         dx[0] = x[1];
    ///         dx[1] = -T::of(9.81) * x[0].sin();
    ///     }
    ///     fn diffusion<T: Real>(&self, _: &At<T>, _: &[T], g: &mut [T]) {
    ///         g[0] = T::zero();
    ///         g[1] = T::of(0.1);
    ///     }
    /// }
    ///
    /// let prior = Gaussian::from_std(&[0.5, 0.0], &[0.1, 0.1])?;
    /// let mut f = SrCdCkf { substeps: 8, ..Default::default() }.start(&Pendulum, 0.0, prior)?;
    /// f.predict(0.25)?;                       // at any time
    /// f.update(&Angle, &[0.36])?;
    /// assert!((f.mean()[0] - 0.36).abs() < 0.05);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    SrCdCkf: Cubature3 {}, Simplified;
    /// `cd-ckf1`: the cubature filter with the full Itô–Taylor step (2012 eq 12).
    CdCkf1,
    /// `sr-cd-ckf1`: the same in square-root form.
    SrCdCkf1: Cubature3 {}, Full;
    /// `cd-ukf1`: the unscented filter with the full Itô–Taylor step (2012).
    CdUkf1,
    /// `sr-cd-ukf1`: the same in square-root form.
    SrCdUkf1: Unscented {
        alpha: f64 = 1.0, "Spread of the points about the mean.";
        beta: f64 = 0.0, "Added to the centre's weight in the covariance.";
        kappa: Option<f64> = None, "The plain transform's κ; 3 − n if `None`."
    }, Full;
    /// `cd-ghkf1`: the Gauss–Hermite filter with the full Itô–Taylor step (2012).
    CdGhkf1,
    /// `sr-cd-ghkf1`: the same in square-root form.
    SrCdGhkf1: GaussHermite { points: usize = 3, "Points per axis." }, Full;
}

moment_ode! {
    /// `cd-ekf`: the continuous-discrete extended Kalman filter by its moment equations (Jazwinski 1970).
    CdEkf,
    /// `sr-cd-ekf`: the same in square-root form (2012 eq 20–21 with the Taylor rule).
    SrCdEkf: Taylor {};
    /// `cd-ukf`: the unscented filter by the moment equations (Särkkä 2007; 2012).
    CdUkf,
    /// `sr-cd-ukf`: the same in square-root form (2012 eq 20–21).
    SrCdUkf: Unscented {
        alpha: f64 = 1.0, "Spread of the points about the mean.";
        beta: f64 = 0.0, "Added to the centre's weight in the covariance.";
        kappa: Option<f64> = None, "The plain transform's κ; 3 − n if `None`."
    };
    /// `cd-ckf2`: the cubature filter by the moment equations (2012).
    CdCkf2,
    /// `sr-cd-ckf2`: the same in square-root form (2012 eq 20–21).
    SrCdCkf2: Cubature3 {};
    /// `cd-ghkf2`: the Gauss–Hermite filter by the moment equations (2012).
    CdGhkf2,
    /// `sr-cd-ghkf2`: the same in square-root form (2012 eq 20–21).
    SrCdGhkf2: GaussHermite { points: usize = 3, "Points per axis." };
}

method! {
    /// `lskf`: the level-set Kalman filter (2021), a square-root method by nature; the cubature rule updates it.
    Lskf: SquareRoot, Cubature3 {}, LevelSet {
        velocity: Velocity = Velocity::Cubature, "What moves mean and root.";
        gauge: Gauge = Gauge::Free, "What becomes of the root between measurements.";
        root: Root = Root::Lower, "The root that the update draws its points from.";
        solver: Solver = Solver::Dp5, "The solver.";
        rtol: f64 = 1e-6, "What an adaptive solver keeps the error of a step below, in standard deviations.";
        atol: f64 = 0.0, "The same in the states' own units; the sum of both counts."
    } by |m| LevelSet {
        velocity: m.velocity,
        gauge: m.gauge,
        root: m.root,
        integrator: integrator(m.solver, m.substeps, m.max_step, m.rtol, m.atol),
    }, update
}

//! The methods by name: a type for each, its registry name in camel case, its options as fields.

use super::error::Fault;
use super::form::{Covariance, Form, SquareRoot};
use super::predict::{OneTransition, TimeUpdate};
use super::sizes::Sizes;
use super::update::Block;
#[cfg(feature = "alloc")]
use super::{Filter, Gaussian, Grow, Prior, Snapshot, StepError};
use crate::rule::{CentralDifference, Cubature3, Cubature5, GaussHermite, Rule, Taylor, Unscented};
#[cfg(feature = "alloc")]
use crate::scalar::Real;
#[cfg(feature = "alloc")]
use core::borrow::Borrow;

/// What a method's type brings beside its parts: its defaults and the length of its memory, as constants.
macro_rules! constants {
    ($name:ident: $rule:ident { $($field:ident = $default:expr),* } $($update:ident)?) => {
        impl $name {
            /// The method with its options as in the papers, as a constant.
            pub const DEFAULT: Self = Self { $($field: $default,)* $($update: Block::Joint)? };

            /// Scalars of memory of a filter of these sizes.
            #[must_use]
            pub const fn memory(&self, sizes: Sizes) -> usize {
                OneTransition::layout(sizes, self.parts().shape_for(sizes.states), false).len
            }

            /// Scalars of memory of a filter of these sizes whose predictions leave what a smoother needs.
            #[must_use]
            pub const fn smoothing_memory(&self, sizes: Sizes) -> usize {
                OneTransition::layout(sizes, self.parts().shape_for(sizes.states), true).len
            }

            const fn parts(&self) -> $rule {
                $rule { $($field: self.$field,)* }
            }
        }

        impl Default for $name {
            fn default() -> Self {
                Self::DEFAULT
            }
        }
    };
}

/// A filter as its parts: a rule, a form, a time update and a measurement update.
pub trait Method: Copy {
    /// How expectations are computed.
    type Rule: Rule;
    /// Covariance or square root.
    type Form: Form;
    /// How the belief moves from one time to a later one.
    type Time: Copy;
    /// The rule with the options chosen.
    fn rule(&self) -> Self::Rule;
    /// The time update with the options chosen.
    fn time_update(&self) -> Self::Time;
    /// The block of the measurement update; covariance form has only one.
    fn block(&self) -> Block {
        Block::Joint
    }

    /// Starts the filter from `prior`, the belief at time `t0`, in memory of its own, in `f64`.
    ///
    /// # Errors
    /// An option out of its range, or a prior of another length than the model's state.
    #[cfg(feature = "alloc")]
    fn start<'m, M>(
        &self,
        model: &'m M,
        t0: f64,
        prior: impl Borrow<Gaussian>,
    ) -> Result<Filter<'m, Self, M, f64, alloc::vec::Vec<f64>>, StepError>
    where
        Self: Over<M>,
    {
        let sizes = self.sizes(model).map_err(|fault| StepError { fault, time: t0, step: 0 })?;
        let mut memory = alloc::vec::Vec::new();
        memory.grow(Filter::<Self, M, f64, alloc::vec::Vec<f64>>::memory_len(self, sizes, false));
        let prior = prior.borrow();
        let prior = Prior { time: t0, mean: prior.mean(), factor: prior.factor(), cov: prior.cov() };
        Filter::start_in(*self, model, sizes, false, prior, memory)
    }

    /// Starts the filter where another one of the same method was when the snapshot was taken, in memory of its own: it
    /// goes on with the same numbers to the bit.
    ///
    /// # Errors
    /// Those of [`Filter::resume_in`].
    #[cfg(feature = "alloc")]
    fn resume<'m, M, T: Real>(
        &self,
        model: &'m M,
        snapshot: &Snapshot<T>,
    ) -> Result<Filter<'m, Self, M, T, alloc::vec::Vec<T>>, StepError>
    where
        Self: Over<M>,
    {
        let Snapshot { time, step, .. } = *snapshot;
        let sizes = self.sizes(model).map_err(|fault| StepError { fault, time, step })?;
        let mut memory = alloc::vec::Vec::new();
        memory.grow(Filter::<Self, M, T, alloc::vec::Vec<T>>::memory_len(self, sizes, false));
        Filter::resume_in(*self, model, sizes, false, snapshot.carried(), memory)
    }
}

/// A method for models of type `M`: a [`Transition`](crate::model::Transition) for discrete methods, an
/// [`Sde`](crate::model::Sde) for continuous ones. Every method whose time update serves such models is one.
pub trait Over<M>: Method<Time: TimeUpdate<M>> {
    /// The model's sizes for the method's rule, without a sensor.
    ///
    /// # Errors
    /// An option of the rule that is out of its range.
    fn sizes(&self, model: &M) -> Result<Sizes, Fault> {
        let n = self.time_update().states(model);
        self.rule().check(n).map_err(Fault::Option)?;
        Ok(self.time_update().sizes(model, self.rule().shape(n)))
    }
}

impl<M, X: Method<Time: TimeUpdate<M>>> Over<M> for X {}

macro_rules! methods {
    ($($(#[$doc:meta])* $cov:ident, $(#[$sr_doc:meta])* $sr:ident: $rule:ident { $($field:ident: $type:ty = $default:expr, $about:literal);* };)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $cov {
            $(#[doc = $about] pub $field: $type,)*
        }

        constants!($cov: $rule { $($field = $default),* });

        impl Method for $cov {
            type Rule = $rule;
            type Form = Covariance;
            type Time = OneTransition;
            fn time_update(&self) -> OneTransition {
                OneTransition
            }
            fn rule(&self) -> $rule {
                self.parts()
            }
        }

        $(#[$sr_doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $sr {
            $(#[doc = $about] pub $field: $type,)*
            /// The block that a measurement update triangularises.
            pub update: Block,
        }

        constants!($sr: $rule { $($field = $default),* } update);

        impl Method for $sr {
            type Rule = $rule;
            type Form = SquareRoot;
            type Time = OneTransition;
            fn time_update(&self) -> OneTransition {
                OneTransition
            }
            fn rule(&self) -> $rule {
                self.parts()
            }
            fn block(&self) -> Block {
                self.update
            }
        }
    )*};
}

methods! {
    /// `ckf`: the cubature Kalman filter (2009).
    Ckf,
    /// `sr-ckf`: the square-root cubature Kalman filter (2009 Appendix B; 2010 eq 36).
    ///
    /// Without an allocator, in memory whose length is a constant:
    ///
    /// ```
    /// use givens_core::filter::{Filter, Prior, Sizes, SrCkf};
    /// use givens_core::model::zoo::{CoordinatedTurn, RangeBearing};
    ///
    /// const SIZES: Sizes = Sizes::new(5, 2);
    /// let (model, radar) = (CoordinatedTurn::default(), RangeBearing::published());
    /// let mut factor = [0.0; 25];
    /// for (i, std) in [10.0, 3.2, 10.0, 3.2, 0.01].into_iter().enumerate() {
    ///     factor[6 * i] = std;
    /// }
    /// let prior = Prior { time: 0.0, mean: &[1000.0, 300.0, 1000.0, 0.0, -0.05], factor: &factor, cov: &[] };
    /// let memory = [0.0_f32; SrCkf::DEFAULT.memory(SIZES)];
    /// let mut f = Filter::start_in(SrCkf::DEFAULT, &model, SIZES, false, prior, memory)?;
    /// f.predict(1.0)?;
    /// f.update(&radar, &[1640.0, 0.65])?;
    /// assert!((f.mean()[0] - 1300.0).abs() < 20.0);
    /// # Ok::<(), givens_core::filter::StepError>(())
    /// ```
    SrCkf: Cubature3 {};
    /// `ckf5`: the fifth-degree cubature Kalman filter (Jia, Xin & Cheng 2013).
    Ckf5,
    /// `sr-ckf5`: the fifth-degree cubature Kalman filter in square-root form.
    SrCkf5: Cubature5 {};
    /// `ukf`: the unscented Kalman filter (Julier & Uhlmann 1997).
    Ukf,
    /// `sr-ukf`: the square-root unscented Kalman filter (van der Merwe & Wan 2001).
    SrUkf: Unscented {
        alpha: f64 = 1.0, "Spread of the points about the mean.";
        beta: f64 = 0.0, "Added to the centre's weight in the covariance.";
        kappa: Option<f64> = None, "The plain transform's κ; 3 − n if `None`."
    };
    /// `qkf`: the quadrature (Gauss–Hermite) Kalman filter (Arasaratnam, Haykin & Elliott 2007).
    Qkf,
    /// `sr-qkf`: the quadrature Kalman filter in square-root form.
    SrQkf: GaussHermite { points: usize = 3, "Points per axis." };
    /// `cdkf`: the central-difference Kalman filter (Nørgaard, Poulsen & Ravn 2000).
    Cdkf,
    /// `sr-cdkf`: the central-difference Kalman filter in square-root form.
    SrCdkf: CentralDifference { eta: f64 = 1.732_050_807_568_877_2, "The step, in standard deviations." };
    /// `ekf`: the extended Kalman filter with exact derivatives.
    Ekf,
    /// `sr-ekf`: the extended Kalman filter in square-root form.
    SrEkf: Taylor {};
}

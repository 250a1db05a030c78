//! The extended filter of continuous models that always keeps its solver's error in bounds.

use super::constants::continuous_constants;
use super::continuous::integrator;
use super::form::{Covariance, SquareRoot};
use super::methods::Method;
use super::predict::MomentOde;
use super::start::Sizes;
use super::update::Block;
use crate::ode::{AdaptiveSolver, Integrator};
use crate::rule::Taylor;

macro_rules! adaptive {
    ($($(#[$doc:meta])* $name:ident: $form:ident $(, $update:ident)?;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            /// The solver.
            pub solver: AdaptiveSolver,
            /// What it keeps the error of a step below, in standard deviations.
            pub rtol: f64,
            /// The same in the states' own units; the sum of both counts.
            pub atol: f64,
            /// The longest step, in the unit of time.
            pub max_step: Option<f64>,
            $(/// The block that a measurement update triangularises.
            pub $update: Block,)?
        }

        continuous_constants!($name: Taylor {}, MomentOde {
            solver = AdaptiveSolver::Dp5, rtol = 1e-6, atol = 0.0, max_step = None $(, $update = Block::Joint)?
        } by |m| MomentOde { integrator: bounded(m.solver, m.max_step, m.rtol, m.atol) });

        impl Method for $name {
            type Rule = Taylor;
            type Form = $form;
            type Time = MomentOde;
            fn rule(&self) -> Taylor {
                self.parts()
            }
            fn time_update(&self) -> MomentOde {
                self.time()
            }
            $(fn block(&self) -> Block {
                self.$update
            })?
        }
    )*};
}

/// The steps of an adaptive solver: their number is not read.
const fn bounded(solver: AdaptiveSolver, max_step: Option<f64>, rtol: f64, atol: f64) -> Integrator {
    integrator(solver.solver(), 16, max_step, rtol, atol)
}

adaptive! {
    /// `acd-ekf`: the accurate continuous-discrete extended Kalman filter (Kulikov & Kulikova 2014): [`CdEkf`](super::CdEkf)
    /// by a solver that keeps its error in bounds. A number of equal steps it does not have.
    ///
    /// ```
    /// use givens_core::filter::{AcdEkf, Gaussian, Method};
    /// use givens_core::model::zoo::{Components, VanDerPol};
    /// use givens_core::ode::AdaptiveSolver;
    ///
    /// // an oscillator that jumps: stiff in between
    /// let model = VanDerPol { stiffness: 100.0, noise: 0.1 };
    /// let eye = Components { states: 2, which: [0], std: [0.1] };
    /// let prior = Gaussian::from_std(&[2.0, 0.0], &[0.1, 0.1])?;
    /// let method = AcdEkf { solver: AdaptiveSolver::Rodas4, rtol: 1e-7, ..Default::default() };
    /// let mut f = method.start(&model, 0.0, prior)?;
    /// f.predict(10.0)?;
    /// f.update(&eye, &[1.93])?;
    /// assert!((f.mean()[0] - 1.93).abs() < 0.1);
    /// assert!(f.work().accepted < 1000);       // steps, over all predictions
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    AcdEkf: Covariance;
    /// `sr-acd-ekf`: the same in square-root form (2012 eq 20–21 with the Taylor rule).
    SrAcdEkf: SquareRoot, update;
}

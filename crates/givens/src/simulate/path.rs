//! The path of a stochastic differential equation, step by step.

use super::Stream;
use super::rows::{Moves, finite};
use crate::filter::predict::Plan;
use crate::filter::{Fault, Quantity};
use crate::model::{At, Sde, Varies};
use crate::ode::{Integrator, Steps};
use crate::scalar::Dual2;

/// How a path is followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scheme {
    /// The strong Itô–Taylor scheme of order 1.5 for a diffusion that does not depend on the state (docs/algorithms.md
    /// C4).
    #[default]
    ItoTaylor,
    /// x + δ f + G w, of strong order 1 for such a diffusion and ½ for one that depends on the state.
    EulerMaruyama,
}

/// The options of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paths {
    /// The scheme.
    pub scheme: Scheme,
    /// How the gap between two rows is divided.
    pub steps: Steps,
}

impl Default for Paths {
    fn default() -> Self {
        Self { scheme: Scheme::default(), steps: Steps::Count(16) }
    }
}

/// A model whose paths are followed, and the memory for it.
///
/// A step takes the white noise that drives it: the same noise, summed over finer steps, gives the same path.
///
/// ```
/// use givens::model::{At, zoo::Turn3d};
/// use givens::simulate::{Path, Paths};
///
/// let turn = Turn3d::default();
/// let mut path = Path::new(&turn, Paths::default())?;
/// let mut x = [1000.0, 0.0, 2650.0, 150.0, 200.0, 0.0, 0.1];
/// let at = At { t: 0.0, dt: 0.5, u: &[], p: &[] };
/// path.step(&at, &mut x, &[0.3, -1.1, 0.7, 0.5], &[-0.4, 0.9, 0.2, -1.3])?;
/// assert!((x[2] - 2725.0).abs() < 1.0);
/// # Ok::<(), givens::filter::Fault>(())
/// ```
#[derive(Clone, Debug)]
pub struct Path<'m, M> {
    model: &'m M,
    paths: Paths,
    drift: Vec<f64>,
    second: Vec<f64>,
    lf: Vec<f64>,
    g: Vec<f64>,
    rate: Vec<f64>,
    noise: Vec<f64>,
    scratch: Vec<f64>,
    duals: Vec<Dual2<f64>>,
}

impl<'m, M: Sde> Path<'m, M> {
    /// Memory for the paths of a model.
    ///
    /// # Errors
    /// Steps out of their range, a diffusion that depends on the state by the Itô–Taylor scheme.
    pub fn new(model: &'m M, paths: Paths) -> Result<Self, Fault> {
        Integrator { steps: paths.steps, ..Integrator::default() }.check().map_err(Fault::Option)?;
        if paths.scheme == Scheme::ItoTaylor && model.diffusion_varies() == Varies::WithState {
            return Err(Fault::Mismatch {
                why: "the diffusion depends on the state; the scheme for such a model is euler-maruyama",
            });
        }
        let (n, q) = (model.states(), model.noises());
        let zeros = |len| vec![0.0; len];
        Ok(Self {
            model,
            paths,
            drift: zeros(n),
            second: zeros(n),
            lf: zeros(n * q),
            g: zeros(n * q),
            rate: zeros(n * q),
            noise: zeros(2 * q),
            scratch: zeros(model.expansion_scratch(1)),
            duals: vec![Dual2::constant(0.0); n + n * q + model.controls() + model.parameters().len()],
        })
    }

    /// Moves `x` from time `at.t` over `at.dt` = δ, driven by w = √δ u₁ and y = ½ δ^(3/2) (u₁ + u₂/√3), the noise and
    /// its integral over the step; `u1` and `u2` have length q. Euler–Maruyama does not read `u2`.
    ///
    /// # Errors
    /// A drift or a diffusion that is not finite, a state that is not or would not be; `x` is then as before.
    pub fn step(&mut self, at: &At<f64>, x: &mut [f64], u1: &[f64], u2: &[f64]) -> Result<(), Fault> {
        let (model, n, q) = (self.model, x.len(), self.model.noises());
        for (of, expected, found) in [
            ("the model's state", model.states(), n),
            ("u1", q, u1.len()),
            ("u2", q, u2.len()),
            ("controls", model.controls(), at.u.len()),
            ("parameters", model.parameters().len(), at.p.len()),
        ] {
            if expected != found {
                return Err(Fault::Length { of, expected, found });
            }
        }
        let (delta, root) = (at.dt, at.dt.sqrt());
        model.diffusion(at, x, &mut self.g);
        finite(&self.g, q.max(1), Quantity::Diffusion)?;
        let taylor = self.paths.scheme == Scheme::ItoTaylor;
        if taylor {
            let (f, l0, lf) = (&mut self.drift, &mut self.second, &mut self.lf);
            model.expansion_points(at, 1, x, f, l0, lf, &mut self.scratch);
            finite(&self.drift, 1, Quantity::Drift)?;
            finite(&self.second, 1, Quantity::DriftDerivative)?;
            finite(&self.lf, q.max(1), Quantity::DriftDerivative)?;
            self.rate_of_diffusion(at, x);
            finite(&self.rate, q.max(1), Quantity::Diffusion)?;
        } else {
            model.drift(at, x, &mut self.drift);
            finite(&self.drift, 1, Quantity::Drift)?;
        }
        for (i, x) in x.iter().enumerate() {
            let mut moved = delta * self.drift[i];
            if taylor {
                moved += 0.5 * delta * delta * self.second[i];
            }
            for j in 0..q {
                let w = root * u1[j];
                moved += self.g[i * q + j] * w;
                if taylor {
                    let y = 0.5 * delta * root * (u1[j] + u2[j] / 3f64.sqrt());
                    moved += self.lf[i * q + j] * y + self.rate[i * q + j] * (delta * w - y);
                }
            }
            self.drift[i] = x + moved;
        }
        finite(&self.drift, 1, Quantity::Estimate)?;
        x.copy_from_slice(&self.drift);
        Ok(())
    }

    /// ∂G/∂t: a G that changes with time adds Ġ (δ w − y).
    fn rate_of_diffusion(&mut self, at: &At<f64>, x: &[f64]) {
        self.rate.fill(0.0);
        if self.model.diffusion_varies() == Varies::Never {
            return;
        }
        let (point, rest) = self.duals.split_at_mut(x.len());
        let (image, rest) = rest.split_at_mut(self.rate.len());
        let (u, p) = rest.split_at_mut(at.u.len());
        let constants = point.iter_mut().zip(x).chain(u.iter_mut().zip(at.u)).chain(p.iter_mut().zip(at.p));
        constants.for_each(|(dual, &v)| *dual = Dual2::constant(v));
        let at = At { t: Dual2::variable(at.t), dt: Dual2::constant(at.dt), u, p };
        self.model.diffusion(&at, point, image);
        self.rate.iter_mut().zip(&*image).for_each(|(rate, image)| *rate = image.d);
    }
}

impl<M: Sde> Moves for Path<'_, M> {
    fn states(&self) -> usize {
        self.model.states()
    }

    fn controls(&self) -> usize {
        self.model.controls()
    }

    fn parameters(&self) -> &[f64] {
        self.model.parameters()
    }

    fn advance(
        &mut self,
        from: f64,
        to: f64,
        u: &[f64],
        x: &mut [f64],
        stream: &mut Stream,
    ) -> Result<(), Fault> {
        let gap = to - from;
        let Plan { count, dt } = Plan::of(self.paths.steps, gap)?;
        let q = self.model.noises();
        let mut noise = core::mem::take(&mut self.noise);
        for k in 0..count {
            noise.fill_with(|| stream.normal());
            let (u1, u2) = noise.split_at(q);
            let at = At { t: from + k as f64 * dt, dt, u, p: self.model.parameters() };
            self.step(&at, x, u1, u2)?;
        }
        self.noise = noise;
        Ok(())
    }
}

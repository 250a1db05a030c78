//! Discrete-time dynamics made of expressions.

use givens_core::model::{At, Linear, Noise, Transition};
use givens_core::scalar::Real;

use super::error::{ModelError, Nameable, finite, length, period};
use super::frame::with_frame;
use super::jacobian::Jacobian;
use crate::graph::{Graph, Input, Node};
use crate::program::{Inputs, Program};

/// What [`ModelTransition::new`] needs; n is the number of states.
#[derive(Clone, Debug, Default)]
pub struct TransitionParts {
    /// Number n of states.
    pub states: usize,
    /// Number of controls.
    pub controls: usize,
    /// The parameters' values.
    pub parameters: Vec<f64>,
    /// The fixed length of a step, if there is one.
    pub period: Option<f64>,
    /// The state after the step, length n.
    pub next: Vec<Node>,
    /// The covariance of the noise of a step, n × n row by row, of which the lower triangle counts; empty: no
    /// noise. It may depend on time, step, controls and parameters, not on the state.
    pub noise_cov: Vec<Node>,
}

/// x(t + dt) = f(x, t, dt, u; p) + w, w ~ N(0, Q), from expressions.
///
/// ```
/// use givens_core::model::{At, Transition};
/// use givens_expr::{Graph, Input, Meaning, ModelTransition, Scope, TransitionParts, parse};
///
/// let (mut graph, mut scope) = (Graph::new(), Scope::new());
/// let inputs = [("x", Input::State(0)), ("v", Input::State(1)), ("dt", Input::Step)];
/// for (name, input) in inputs {
///     scope.insert(name, Meaning::Is(graph.input(input)));
/// }
/// let next = vec![parse(&mut graph, &scope, "x + dt*v")?, parse(&mut graph, &scope, "v")?];
/// let parts = TransitionParts { states: 2, next, ..Default::default() };
/// let model = ModelTransition::new(&mut graph, parts)?;
///
/// let mut out = [0.0; 2];
/// model.transition(&At { t: 0.0, dt: 0.5, u: &[], p: &[] }, &[1.0, 4.0], &mut out);
/// assert_eq!(out, [3.0, 4.0]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ModelTransition {
    states: usize,
    controls: usize,
    parameters: Vec<f64>,
    period: Option<f64>,
    next: Program,
    jacobian: Jacobian,
    noise_cov: Option<Program>,
}

impl ModelTransition {
    /// Differentiates and compiles the expressions.
    ///
    /// # Errors
    /// A list of the wrong length, an expression that names what it may not, a parameter that is not finite, a
    /// period that is not positive, or a graph that is full.
    pub fn new(graph: &mut Graph, parts: TransitionParts) -> Result<Self, ModelError> {
        let TransitionParts { states, controls, parameters, period: every, next, noise_cov } = parts;
        length("the transition", next.len(), states)?;
        if !noise_cov.is_empty() {
            length("the covariance of the process noise", noise_cov.len(), states.saturating_mul(states))?;
        }
        finite("the parameters", &parameters)?;
        period("the period of the transition", 0, every)?;
        let nameable = Nameable { states, controls, parameters: parameters.len(), measures: 0, step: true };
        nameable.check(graph, "the transition", &next)?;
        let still = Nameable { states: 0, ..nameable };
        still.check(graph, "the covariance of the process noise", &noise_cov)?;
        let columns: Vec<Input> = (0..states).map(|i| Input::State(i as u32)).collect();
        Ok(Self {
            states,
            controls,
            parameters,
            period: every,
            jacobian: Jacobian::new(graph, &next, &columns)?,
            next: Program::compile(graph, &next)?,
            noise_cov: match noise_cov.as_slice() {
                [] => None,
                entries => Some(Program::compile(graph, entries)?),
            },
        })
    }

    /// Gives the parameters other values, in the same order.
    ///
    /// # Errors
    /// Their number differs, or one is not finite.
    pub fn set_parameters(&mut self, values: &[f64]) -> Result<(), ModelError> {
        length("the parameters", values.len(), self.parameters.len())?;
        finite("the parameters", values)?;
        self.parameters.copy_from_slice(values);
        Ok(())
    }
}

impl Transition for ModelTransition {
    fn states(&self) -> usize {
        self.states
    }

    fn period(&self) -> Option<f64> {
        self.period
    }

    fn controls(&self) -> usize {
        self.controls
    }

    fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    fn transition<T: Real>(&self, at: &At<T>, x: &[T], out: &mut [T]) {
        let inputs = Inputs { at: *at, x, z: &[] };
        with_frame(self.next.scratch_len(1), |scratch| self.next.eval(&inputs, 1, out, scratch));
    }

    fn noise(&self) -> Noise {
        match self.noise_cov {
            None => Noise::Root(0),
            Some(_) => Noise::Covariance,
        }
    }

    fn process_noise<T: Real>(&self, at: &At<T>, out: &mut [T]) {
        if let Some(program) = &self.noise_cov {
            let inputs = Inputs { at: *at, x: &[], z: &[] };
            with_frame(program.scratch_len(1), |scratch| program.eval(&inputs, 1, out, scratch));
        }
    }

    fn transition_scratch(&self, points: usize) -> usize {
        self.next.scratch_len(points).max(self.jacobian.scratch_len())
    }

    fn transition_points<T: Real>(
        &self,
        at: &At<T>,
        points: usize,
        x: &[T],
        out: &mut [T],
        scratch: &mut [T],
    ) {
        self.next.eval(&Inputs { at: *at, x, z: &[] }, points, out, scratch);
    }

    fn transition_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        let inputs = Inputs { at: *at, x, z: &[] };
        self.jacobian.times(&inputs, self.states, s, out, scratch);
    }
}

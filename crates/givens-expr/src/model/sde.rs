//! Continuous-time dynamics made of expressions.

use givens_core::model::{At, Linear, Sde, Varies, expansion_by_duals, expansion_scratch};
use givens_core::scalar::Real;

use super::error::{ModelError, Nameable, finite, length};
use super::expansion::Expansion;
use super::frame::with_frame;
use super::jacobian::Jacobian;
use crate::graph::{Graph, Input, Node};
use crate::program::{Inputs, Program};

/// What [`ModelSde::new`] needs; n is the number of states.
#[derive(Clone, Debug, Default)]
pub struct SdeParts {
    /// Number n of states.
    pub states: usize,
    /// Number of controls.
    pub controls: usize,
    /// The parameters' values.
    pub parameters: Vec<f64>,
    /// The drift f, length n. It may depend on the state, time, controls and parameters.
    pub drift: Vec<Node>,
    /// The diffusion G, n × [`noises`](Self::noises) row by row, per square root of the unit of time. It may depend
    /// on what the drift may depend on.
    pub diffusion: Vec<Node>,
    /// Columns of G; there may be none.
    pub noises: usize,
}

/// dx = f(x, t, u; p) dt + G dβ, from expressions.
///
/// Columns of G that are the constant zero throughout are left out, so that the model may have fewer noises than its
/// parts. The Itô derivatives of the drift are derived by symbol; what vanishes in them costs nothing.
///
/// ```
/// use givens_core::model::{At, Sde, Varies};
/// use givens_expr::{Graph, Input, Meaning, ModelSde, Scope, SdeParts, parse};
///
/// let (mut graph, mut scope) = (Graph::new(), Scope::new());
/// for (i, name) in ["x", "v"].into_iter().enumerate() {
///     scope.insert(name, Meaning::Is(graph.input(Input::State(i as u32))));
/// }
/// let mut read = |texts: &[&str]| texts.iter().map(|text| parse(&mut graph, &scope, text)).collect();
/// let drift: Result<Vec<_>, _> = read(&["v", "-sin(x)"]);
/// let diffusion: Result<Vec<_>, _> = read(&["0", "0", "0", "0.1"]);
/// let parts =
///     SdeParts { states: 2, drift: drift?, diffusion: diffusion?, noises: 2, ..Default::default() };
/// let model = ModelSde::new(&mut graph, parts)?;
///
/// assert_eq!((model.noises(), model.diffusion_varies()), (1, Varies::Never));
/// let (mut dx, mut g) = ([0.0; 2], [0.0; 2]);
/// let at = At { t: 0.0, dt: 0.0, u: &[], p: &[] };
/// model.drift(&at, &[0.0, 3.0], &mut dx);
/// model.diffusion(&at, &[0.0, 3.0], &mut g);
/// assert_eq!((dx, g), ([3.0, 0.0], [0.0, 0.1]));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct ModelSde {
    states: usize,
    controls: usize,
    parameters: Vec<f64>,
    noises: usize,
    varies: Varies,
    drift: Program,
    jacobian: Jacobian,
    diffusion: Program,
    /// None where G depends on the state, and where the derivatives are more than a graph holds: they
    /// are then worked out by duals.
    expansion: Option<Box<Expansion>>,
}

impl ModelSde {
    /// Differentiates and compiles the expressions.
    ///
    /// # Errors
    /// A list of the wrong length, an expression that names what it may not (the step among them), a parameter that
    /// is not finite, or a graph that is full.
    pub fn new(graph: &mut Graph, parts: SdeParts) -> Result<Self, ModelError> {
        let SdeParts { states, controls, parameters, drift, diffusion, noises } = parts;
        length("the drift", drift.len(), states)?;
        length("the diffusion", diffusion.len(), states.saturating_mul(noises))?;
        finite("the parameters", &parameters)?;
        let nameable = Nameable { states, controls, parameters: parameters.len(), measures: 0, step: false };
        nameable.check(graph, "the drift", &drift)?;
        nameable.check(graph, "the diffusion", &diffusion)?;
        let (diffusion, noises) = without_zero_columns(graph, &diffusion, noises);
        let varies = varies(graph, &diffusion);
        let expansion = match varies {
            Varies::WithState => None,
            // in a graph of its own, so that derivatives which do not fit leave the model's usable
            _ => Expansion::new(&mut graph.clone(), &drift, &diffusion, noises).map(Box::new),
        };
        let columns: Vec<Input> = (0..states).map(|i| Input::State(i as u32)).collect();
        Ok(Self {
            states,
            controls,
            parameters,
            noises,
            varies,
            jacobian: Jacobian::new(graph, &drift, &columns)?,
            drift: Program::compile(graph, &drift)?,
            diffusion: Program::compile(graph, &diffusion)?,
            expansion,
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

/// The columns of G that are not the constant zero in every row, and their number.
fn without_zero_columns(graph: &Graph, diffusion: &[Node], noises: usize) -> (Vec<Node>, usize) {
    let zero = |node: &Node| graph.constant_value(*node) == Some(0.0);
    let column = |j: usize| diffusion.iter().skip(j).step_by(noises.max(1));
    let kept: Vec<usize> = (0..noises).filter(|&j| !column(j).all(zero)).collect();
    let rows = diffusion.chunks(noises.max(1));
    let nodes = rows.flat_map(|row| kept.iter().filter_map(|&j| row.get(j).copied())).collect();
    (nodes, kept.len())
}

/// What G depends on. A control is constant between two rows.
fn varies(graph: &Graph, diffusion: &[Node]) -> Varies {
    let of = |input: &Input| match input {
        Input::State(_) => Varies::WithState,
        Input::Time => Varies::WithTime,
        _ => Varies::Never,
    };
    let inputs = graph.inputs_of_all(diffusion);
    inputs.iter().map(of).max().unwrap_or(Varies::Never)
}

impl Sde for ModelSde {
    fn states(&self) -> usize {
        self.states
    }

    fn noises(&self) -> usize {
        self.noises
    }

    fn controls(&self) -> usize {
        self.controls
    }

    fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    fn drift<T: Real>(&self, at: &At<T>, x: &[T], dx: &mut [T]) {
        let inputs = Inputs { at: *at, x, z: &[] };
        with_frame(self.drift.scratch_len(1), |scratch| self.drift.eval(&inputs, 1, dx, scratch));
    }

    fn diffusion<T: Real>(&self, at: &At<T>, x: &[T], g: &mut [T]) {
        let inputs = Inputs { at: *at, x, z: &[] };
        with_frame(self.diffusion.scratch_len(1), |scratch| self.diffusion.eval(&inputs, 1, g, scratch));
    }

    fn diffusion_varies(&self) -> Varies {
        self.varies
    }

    fn drift_scratch(&self, points: usize) -> usize {
        self.drift.scratch_len(points).max(self.jacobian.scratch_len())
    }

    fn drift_points<T: Real>(&self, at: &At<T>, points: usize, x: &[T], out: &mut [T], scratch: &mut [T]) {
        self.drift.eval(&Inputs { at: *at, x, z: &[] }, points, out, scratch);
    }

    fn drift_linear<T: Real>(&self, at: &At<T>, x: &[T], s: &[T], out: Linear<T>, scratch: &mut [T]) {
        let inputs = Inputs { at: *at, x, z: &[] };
        self.jacobian.times(&inputs, self.states, s, out, scratch);
    }

    fn expansion_scratch(&self, points: usize) -> usize {
        match &self.expansion {
            Some(expansion) => expansion.scratch_len(points),
            None => expansion_scratch(self.states, self.noises, self.controls + self.parameters.len()),
        }
    }

    fn expansion_points<T: Real>(
        &self,
        at: &At<T>,
        points: usize,
        x: &[T],
        f: &mut [T],
        l0: &mut [T],
        lf: &mut [T],
        scratch: &mut [T],
    ) {
        match &self.expansion {
            Some(expansion) => expansion.points(&Inputs { at: *at, x, z: &[] }, points, [f, l0, lf], scratch),
            None => expansion_by_duals(self, at, points, x, f, l0, lf, scratch),
        }
    }
}

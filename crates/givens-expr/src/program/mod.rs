//! Expressions as a program: bytecode that evaluates all points of a batch at once.
//!
//! What does not depend on the state is worked out once, in a section of its own. The rest runs over blocks of a few points
//! whose number the compiler knows, one dispatch for each operation and block.

mod compile;
mod fuse;
mod lifetime;
mod run;

use givens_core::model::At;
use givens_core::scalar::Real;

use crate::graph::Input;
use crate::operation::{Binary, Unary};

/// What an instruction computes.
#[derive(Clone, Copy, Debug)]
enum Code {
    Unary(Unary),
    Binary(Binary),
    Power(i32),
    Select,
    /// a b + c, a b − c or c − a b, rounded twice: x x − y y of equal x and y is zero, as it is written.
    Product(Sum),
    /// Sine and cosine of one angle: two results.
    SinCos,
}

/// How a product is added.
#[derive(Clone, Copy, Debug)]
enum Sum {
    /// a b + c
    Plus,
    /// a b − c
    Minus,
    /// c − a b
    From,
}

/// One operation, and the rows of its operands and results; those beyond what the code has are not read.
#[derive(Clone, Copy, Debug)]
struct Instruction {
    code: Code,
    args: [u32; 3],
    results: [u32; 2],
}

/// How many components of each kind the inputs must bring.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Extent {
    states: usize,
    controls: usize,
    parameters: usize,
    measures: usize,
}

/// A list of expressions, compiled.
///
/// ```
/// use givens_expr::{Graph, Input, Inputs, Program};
/// let mut graph = Graph::new();
/// let (x, t) = (graph.input(Input::State(0)), graph.input(Input::Time));
/// let product = graph.mul(x, t);
/// let program = Program::compile(&graph, &[product])?;
/// let mut inputs = Inputs::of_state(&[1.0, 2.0, 3.0]);
/// inputs.at.t = 10.0;
/// let (mut out, mut scratch) = ([0.0; 3], vec![0.0; program.scratch_len(3)]);
/// program.eval(&inputs, 3, &mut out, &mut scratch);
/// assert_eq!(out, [10.0, 20.0, 30.0]);
/// # Ok::<(), givens_expr::GraphError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Program {
    extent: Extent,
    /// Constants and inputs of the scalar section, and the scalars that hold them.
    constants: Vec<(f64, u32)>,
    loads: Vec<(Input, u32)>,
    scalar_code: Vec<Instruction>,
    scalars: usize,
    /// Scalars that are read at every point, and the rows that hold them.
    lent: Vec<(u32, u32)>,
    /// Components of the state, and the rows that hold them at first.
    states: Vec<(u32, u32)>,
    code: Vec<Instruction>,
    rows: usize,
    /// The rows of the results.
    outputs: Vec<u32>,
}

/// What a program is evaluated at.
#[derive(Clone, Copy, Debug)]
pub struct Inputs<'a, T> {
    /// Time, step, controls and parameters.
    pub at: At<'a, T>,
    /// The states of all points, component by component: `x[i * points + point]`.
    pub x: &'a [T],
    /// A measurement.
    pub z: &'a [T],
}

impl<'a, T: Real> Inputs<'a, T> {
    /// Nothing but states; time and step are zero.
    #[must_use]
    pub fn of_state(x: &'a [T]) -> Self {
        Self { at: At { t: T::zero(), dt: T::zero(), u: &[], p: &[] }, x, z: &[] }
    }

    /// Nothing but parameters; time and step are zero.
    #[must_use]
    pub fn of_parameters(p: &'a [T]) -> Self {
        Self { at: At { t: T::zero(), dt: T::zero(), u: &[], p }, x: &[], z: &[] }
    }
}

impl Program {
    /// Number of expressions.
    pub fn outputs(&self) -> usize {
        self.outputs.len()
    }

    /// Scalars of scratch that [`eval`](Program::eval) needs for `points` points.
    pub fn scratch_len(&self, points: usize) -> usize {
        self.scalars.saturating_add(self.rows.saturating_mul(points.clamp(1, run::BLOCK)))
    }

    /// Number of operations for a batch, and for each of its points.
    pub fn operations(&self) -> (usize, usize) {
        (self.scalar_code.len(), self.code.len())
    }

    /// The values at one point, in memory of their own: for what is done once.
    pub fn values(&self, inputs: &Inputs<'_, f64>) -> Vec<f64> {
        let (mut out, mut scratch) = (vec![0.0; self.outputs.len()], vec![0.0; self.scratch_len(1)]);
        self.eval(inputs, 1, &mut out, &mut scratch);
        out
    }
}

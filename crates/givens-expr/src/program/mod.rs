//! Expressions as a program: bytecode that evaluates all points of a batch at once.
//!
//! What does not depend on the state is worked out once, in a section of its own with rows of length one; the rest
//! runs on rows of `points` values, one dispatch for each operation and row.

mod compile;
mod fuse;
mod lifetime;
mod loops;
mod run;

use givens_core::model::At;
use givens_core::scalar::Real;

use crate::graph::Input;
use crate::operation::{Binary, Unary};

/// Where a value stands while a program runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// A register: a row of the section's own memory.
    Register(u32),
    /// A row of the result.
    Output(u32),
    /// A value of the scalar section, the same for all points.
    Scalar(u32),
}

/// What an instruction computes.
#[derive(Clone, Copy, Debug)]
enum Code {
    Unary(Unary),
    Binary(Binary),
    Power(i32),
    Select,
    /// a b + c, a b − c or c − a b: fused where the machine does that in one instruction.
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

/// One operation: operands and results beyond those that the code has are not read.
#[derive(Clone, Copy, Debug)]
struct Instruction {
    code: Code,
    args: [Place; 3],
    results: [Place; 2],
}

/// A result that no instruction computes in its place.
#[derive(Clone, Copy, Debug)]
enum Given {
    Constant(f64),
    Input(Input),
    Scalar(u32),
    /// The same as another result.
    Output(u32),
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
    outputs: usize,
    extent: Extent,
    /// Constants and inputs of the scalar section, and the scalars that hold them.
    constants: Vec<(f64, u32)>,
    loads: Vec<(Input, u32)>,
    scalar_code: Vec<Instruction>,
    scalars: usize,
    /// Components of the state and the registers that hold them at first.
    states: Vec<(u32, u32)>,
    code: Vec<Instruction>,
    registers: usize,
    given: Vec<(u32, Given)>,
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
        self.outputs
    }

    /// Scalars of scratch that [`eval`](Program::eval) needs for `points` points.
    pub fn scratch_len(&self, points: usize) -> usize {
        self.scalars.saturating_add(self.registers.saturating_mul(points))
    }

    /// Number of operations for a batch, and for each of its points.
    pub fn operations(&self) -> (usize, usize) {
        (self.scalar_code.len(), self.code.len())
    }

    /// The values at one point, in memory of their own: for what is done once.
    pub fn values(&self, inputs: &Inputs<'_, f64>) -> Vec<f64> {
        let (mut out, mut scratch) = (vec![0.0; self.outputs], vec![0.0; self.scratch_len(1)]);
        self.eval(inputs, 1, &mut out, &mut scratch);
        out
    }
}

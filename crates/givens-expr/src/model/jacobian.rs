//! Values and Jacobian of several expressions in one program.

use givens_core::model::Linear;
use givens_core::scalar::Real;

use crate::graph::{Graph, GraphError, Input, Node};
use crate::program::{Inputs, Program};

/// g(x) and the entries of ∂g/∂x that are not zero for every x.
#[derive(Clone, Debug)]
pub(super) struct Jacobian {
    program: Program,
    rows: usize,
    /// Row and column of the entries, which follow the values in the program's order.
    entries: Vec<(u32, u32)>,
}

impl Jacobian {
    /// Differentiates `values` with respect to `inputs`, the columns.
    pub fn new(graph: &mut Graph, values: &[Node], inputs: &[Input]) -> Result<Self, GraphError> {
        let (mut outputs, mut entries) = (values.to_vec(), Vec::new());
        for (column, &input) in inputs.iter().enumerate() {
            for (row, slope) in graph.derivatives(values, input)?.into_iter().enumerate() {
                if graph.constant_value(slope) != Some(0.0) {
                    entries.push((row as u32, column as u32));
                    outputs.push(slope);
                }
            }
        }
        Ok(Self { program: Program::compile(graph, &outputs)?, rows: values.len(), entries })
    }

    /// Scalars of scratch that both methods need.
    pub fn scratch_len(&self) -> usize {
        self.program.outputs() + self.program.scratch_len(1)
    }

    /// g to `value` and the entries to `visit`, as row, column, entry.
    pub fn entries<T: Real>(
        &self,
        inputs: &Inputs<'_, T>,
        value: &mut [T],
        scratch: &mut [T],
        mut visit: impl FnMut(usize, usize, T),
    ) {
        let (results, scratch) = scratch.split_at_mut(self.program.outputs());
        self.program.eval(inputs, 1, results, scratch);
        let (values, slopes) = results.split_at(self.rows);
        value[..self.rows].copy_from_slice(values);
        for (&(row, column), &slope) in self.entries.iter().zip(slopes) {
            visit(row as usize, column as usize, slope);
        }
    }

    /// g and (∂g/∂x) S; S is n × n.
    pub fn times<T: Real>(
        &self,
        inputs: &Inputs<'_, T>,
        n: usize,
        s: &[T],
        out: Linear<T>,
        scratch: &mut [T],
    ) {
        let Linear { value, image, stride } = out;
        for row in image.chunks_mut(stride.max(1)).take(self.rows) {
            row[..n].fill(T::zero());
        }
        self.entries(inputs, value, scratch, |row, column, slope| {
            let row = &mut image[row * stride..row * stride + n];
            for (x, &deviation) in row.iter_mut().zip(&s[column * n..column * n + n]) {
                *x = slope.mul_add(deviation, *x);
            }
        });
    }
}

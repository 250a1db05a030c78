//! The machine that runs a program.

use givens_core::scalar::{Inside, Real};

use crate::graph::Input;
use crate::operation::{Binary, Unary, choose};

use super::{Code, Inputs, Instruction, Program, Sum};

/// Points of a large block.
pub(super) const BLOCK: usize = 4;

impl Program {
    /// Evaluates all expressions at `points` points: `inputs.x` is n × `points` and `out` outputs × `points`,
    /// component by component, and `scratch` has the length that [`scratch_len`](Program::scratch_len) tells. The
    /// result of a point does not depend on the others, nor on their number. Allocates nothing.
    ///
    /// Inputs or memory that are shorter than the program needs give not-a-number throughout.
    pub fn eval<T: Real>(&self, inputs: &Inputs<'_, T>, points: usize, out: &mut [T], scratch: &mut [T]) {
        self.eval_apart(inputs, points, [out], scratch);
    }

    /// The same with the results in several places, one after the other; each takes what it has room for.
    pub(crate) fn eval_apart<T: Real, const K: usize>(
        &self,
        inputs: &Inputs<'_, T>,
        points: usize,
        out: [&mut [T]; K],
        scratch: &mut [T],
    ) {
        let room = out.iter().fold(0, |room: usize, out| room.saturating_add(out.len()));
        let fits = room >= self.outputs.len().saturating_mul(points)
            && scratch.len() >= self.scratch_len(points)
            && inputs.x.len() >= self.extent.states.saturating_mul(points)
            && inputs.at.u.len() >= self.extent.controls
            && inputs.at.p.len() >= self.extent.parameters
            && inputs.z.len() >= self.extent.measures;
        if !fits {
            for out in out {
                out.fill(T::of(f64::NAN));
            }
        } else if points > 0 {
            T::within(Evaluation { program: self, inputs, points, out, scratch });
        }
    }
}

/// A program at work, in a function of its own: packs need their instructions there.
struct Evaluation<'e, T, const K: usize> {
    program: &'e Program,
    inputs: &'e Inputs<'e, T>,
    points: usize,
    out: [&'e mut [T]; K],
    scratch: &'e mut [T],
}

impl<T: Real, const K: usize> Inside for Evaluation<'_, T, K> {
    type Output = ();

    #[inline(always)]
    fn go(mut self) {
        let Program { constants, loads, scalar_code, scalars, .. } = self.program;
        let (scalars, memory) = core::mem::take(&mut self.scratch).split_at_mut(*scalars);
        for &(value, scalar) in constants {
            scalars[scalar as usize] = T::of(value);
        }
        for &(input, scalar) in loads {
            scalars[scalar as usize] = uniform(self.inputs, input);
        }
        run::<T, 1>(scalar_code, scalars.as_chunks_mut().0);
        let mut done = 0;
        // programs derive by symbol and are hardly ever asked for duals, whose operations side by side are most of the machine's code
        if T::DEPTH == 0 {
            self.blocks::<BLOCK>(&mut done, scalars, memory);
            self.blocks::<2>(&mut done, scalars, memory);
        }
        self.blocks::<1>(&mut done, scalars, memory);
    }
}

impl<T: Real, const K: usize> Evaluation<'_, T, K> {
    /// As many whole blocks of `B` points as are left.
    #[inline(always)]
    fn blocks<const B: usize>(&mut self, done: &mut usize, scalars: &[T], memory: &mut [T]) {
        let Self { program, inputs, points, out, .. } = self;
        if *points - *done < B {
            return;
        }
        let rows = memory.as_chunks_mut::<B>().0;
        for &(scalar, row) in &program.lent {
            rows[row as usize] = [scalars[scalar as usize]; B];
        }
        while *points - *done >= B {
            for &(state, row) in &program.states {
                if let Some(x) = inputs.x[state as usize * *points + *done..].first_chunk() {
                    rows[row as usize] = *x;
                }
            }
            run(&program.code, rows);
            let mut results = program.outputs.iter();
            for out in out.iter_mut() {
                for (out, &row) in out.chunks_exact_mut(*points).zip(results.by_ref()) {
                    if let Some(out) = out[*done..].first_chunk_mut() {
                        *out = rows[row as usize];
                    }
                }
            }
            *done += B;
        }
    }
}

/// An input that is the same for all points.
fn uniform<T: Real>(inputs: &Inputs<'_, T>, input: Input) -> T {
    match input {
        Input::Time => inputs.at.t,
        Input::Step => inputs.at.dt,
        Input::Control(i) => inputs.at.u[i as usize],
        Input::Parameter(i) => inputs.at.p[i as usize],
        Input::Measure(i) => inputs.z[i as usize],
        Input::State(i) => inputs.x[i as usize],
    }
}

/// An operation at all points of a block, by an expression of its operands. It is a macro, for a closure would not always be
/// inlined.
macro_rules! at_each {
    ($rows:ident, $instruction:ident, |$x:ident $(, $more:ident)*| $of:expr) => {{
        let [$x $(, $more)*, ..] = $instruction.args;
        let $x = $rows[$x as usize];
        $(let $more = $rows[$more as usize];)*
        let mut values = $x;
        for k in 0..B {
            let $x = $x[k];
            $(let $more = $more[k];)*
            values[k] = $of;
        }
        $rows[$instruction.results[0] as usize] = values;
    }};
}

/// The code of a section over its rows, of `B` points each.
#[inline(always)]
fn run<T: Real, const B: usize>(code: &[Instruction], rows: &mut [[T; B]]) {
    for instruction in code {
        match instruction.code {
            Code::Unary(op) => unary(op, instruction, rows),
            Code::Binary(op) => binary(op, instruction, rows),
            Code::Product(Sum::Plus) => at_each!(rows, instruction, |a, b, c| a * b + c),
            Code::Product(Sum::Minus) => at_each!(rows, instruction, |a, b, c| a * b - c),
            Code::Product(Sum::From) => at_each!(rows, instruction, |a, b, c| c - a * b),
            Code::Power(e) => at_each!(rows, instruction, |a| a.powi(e)),
            Code::Select => at_each!(rows, instruction, |c, a, b| choose(c, a, b)),
            Code::SinCos => {
                let ([a, ..], [sine, cosine]) = (instruction.args, instruction.results);
                for k in 0..B {
                    let (s, c) = rows[a as usize][k].sin_cos();
                    (rows[sine as usize][k], rows[cosine as usize][k]) = (s, c);
                }
            }
        }
    }
}

#[inline(always)]
fn unary<T: Real, const B: usize>(op: Unary, instruction: &Instruction, rows: &mut [[T; B]]) {
    macro_rules! each {
        ($($op:ident)*) => {
            match op {
                $(Unary::$op => at_each!(rows, instruction, |a| Unary::$op.apply(a)),)*
            }
        };
    }
    each!(
        Neg Abs Sign Floor Sqrt Not Exp Log Log10 Sin Cos Tan Asin Acos Atan Sinh Cosh Tanh Erf Erfc
    );
}

#[inline(always)]
fn binary<T: Real, const B: usize>(op: Binary, instruction: &Instruction, rows: &mut [[T; B]]) {
    macro_rules! each {
        ($($op:ident)*) => {
            match op {
                $(Binary::$op => at_each!(rows, instruction, |a, b| Binary::$op.apply(a, b)),)*
            }
        };
    }
    each!(
        Add Sub Mul Div Pow Atan2 Hypot Min Max Less LessEqual Equal And Or Scale
    );
}

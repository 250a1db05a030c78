//! The machine that runs a program.

use core::array::from_fn;
use core::cell::Cell;

use givens_core::scalar::Real;

use crate::graph::Input;
use crate::operation::{Binary, Unary, choose};

use super::{Code, Given, Inputs, Instruction, Place, Program, Sum};

impl Program {
    /// Evaluates all expressions at `points` points: `inputs.x` is n × `points` and `out` outputs × `points`,
    /// component by component, and `scratch` has the length that [`scratch_len`](Program::scratch_len) tells. The
    /// result of a point does not depend on the others, nor on their number. Allocates nothing.
    ///
    /// Inputs or memory that are shorter than the program needs give not-a-number throughout.
    pub fn eval<T: Real>(&self, inputs: &Inputs<'_, T>, points: usize, out: &mut [T], scratch: &mut [T]) {
        let fits = out.len() >= self.outputs.saturating_mul(points)
            && scratch.len() >= self.scratch_len(points)
            && inputs.x.len() >= self.extent.states.saturating_mul(points)
            && inputs.at.u.len() >= self.extent.controls
            && inputs.at.p.len() >= self.extent.parameters
            && inputs.z.len() >= self.extent.measures;
        if !fits {
            out.fill(T::of(f64::NAN));
            return;
        }
        let (scalars, rows) = scratch.split_at_mut(self.scalars);
        for &(value, scalar) in &self.constants {
            scalars[scalar as usize] = T::of(value);
        }
        for &(input, scalar) in &self.loads {
            scalars[scalar as usize] = uniform(inputs, input);
        }
        for &(state, row) in &self.states {
            let (from, to) = (state as usize * points, row as usize * points);
            rows[to..to + points].copy_from_slice(&inputs.x[from..from + points]);
        }
        let scalars = cells(scalars);
        Machine { rows: scalars, out: &[], scalars: &[], width: 1 }.run(&self.scalar_code);
        Machine { rows: cells(rows), out: cells(out), scalars, width: points }.run(&self.code);
        for &(row, given) in &self.given {
            let row = row as usize * points;
            match given {
                Given::Constant(value) => out[row..row + points].fill(T::of(value)),
                Given::Input(Input::State(i)) => {
                    let from = i as usize * points;
                    out[row..row + points].copy_from_slice(&inputs.x[from..from + points]);
                }
                Given::Input(input) => out[row..row + points].fill(uniform(inputs, input)),
                Given::Scalar(i) => out[row..row + points].fill(scalars[i as usize].get()),
                Given::Output(first) => {
                    let from = first as usize * points;
                    out.copy_within(from..from + points, row);
                }
            }
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

/// Memory in which a row may be read and written at once.
fn cells<T>(memory: &mut [T]) -> &[Cell<T>] {
    Cell::from_mut(memory).as_slice_of_cells()
}

/// A section at work: its rows, those of the result, and the scalars, which it reads only.
struct Machine<'m, T> {
    rows: &'m [Cell<T>],
    out: &'m [Cell<T>],
    scalars: &'m [Cell<T>],
    width: usize,
}

/// An operand of an instruction.
enum Source<'m, T> {
    Row(&'m [Cell<T>]),
    Same(T),
}

impl<T: Real> Source<'_, T> {
    #[inline(always)]
    fn get(&self, i: usize) -> T {
        match self {
            Source::Row(row) => row[i].get(),
            Source::Same(value) => *value,
        }
    }
}

impl<'m, T: Real> Machine<'m, T> {
    fn run(&self, code: &[Instruction]) {
        for instruction in code {
            match instruction.code {
                Code::Unary(op) => self.unary(op, instruction),
                Code::Binary(op) => self.binary(op, instruction),
                Code::Product(sum) => self.product(sum, instruction),
                Code::Power(e) => self.power(e, instruction),
                Code::Select => self.select(instruction),
                Code::SinCos => self.sin_cos(instruction),
            }
        }
    }

    #[inline(always)]
    fn row(&self, place: Place) -> &'m [Cell<T>] {
        let (rows, i) = match place {
            Place::Output(i) => (self.out, i),
            Place::Register(i) | Place::Scalar(i) => (self.rows, i),
        };
        &rows[i as usize * self.width..][..self.width]
    }

    #[inline(always)]
    fn source(&self, place: Place) -> Source<'m, T> {
        match place {
            Place::Scalar(i) => Source::Same(self.scalars[i as usize].get()),
            Place::Register(_) | Place::Output(_) => Source::Row(self.row(place)),
        }
    }

    #[inline(always)]
    fn map(&self, instruction: &Instruction, f: impl Fn(T) -> T) {
        map(self.row(instruction.results[0]), self.row(instruction.args[0]), f);
    }

    #[inline(always)]
    fn zip(&self, instruction: &Instruction, f: impl Fn(T, T) -> T) {
        let result = self.row(instruction.results[0]);
        match (self.source(instruction.args[0]), self.source(instruction.args[1])) {
            (Source::Row(a), Source::Row(b)) => zip(result, a, b, f),
            (Source::Row(a), Source::Same(b)) => map(result, a, |a| f(a, b)),
            (Source::Same(a), Source::Row(b)) => map(result, b, |b| f(a, b)),
            (Source::Same(a), Source::Same(b)) => map(result, result, |_| f(a, b)),
        }
    }

    /// The first operand may be the same for all points, the second never is.
    #[inline(always)]
    fn zip3(&self, instruction: &Instruction, f: impl Fn(T, T, T) -> T) {
        let [a, b, c] = instruction.args;
        let (result, b) = (self.row(instruction.results[0]), self.row(b));
        match (self.source(a), self.source(c)) {
            (Source::Row(a), Source::Row(c)) => zip3(result, a, b, c, f),
            (Source::Row(a), Source::Same(c)) => zip(result, a, b, |a, b| f(a, b, c)),
            (Source::Same(a), Source::Row(c)) => zip(result, b, c, |b, c| f(a, b, c)),
            (Source::Same(a), Source::Same(c)) => map(result, b, |b| f(a, b, c)),
        }
    }

    #[inline(never)]
    fn product(&self, sum: Sum, instruction: &Instruction) {
        match sum {
            Sum::Plus => self.zip3(instruction, T::mul_add),
            Sum::Minus => self.zip3(instruction, |a, b, c| a.mul_add(b, -c)),
            Sum::From => self.zip3(instruction, |a, b, c| (-a).mul_add(b, c)),
        }
    }

    #[inline(never)]
    fn power(&self, e: i32, instruction: &Instruction) {
        self.map(instruction, |a| a.powi(e));
    }

    #[inline(never)]
    fn select(&self, instruction: &Instruction) {
        let [c, a, b] = instruction.args.map(|place| self.source(place));
        for (i, result) in self.row(instruction.results[0]).iter().enumerate() {
            result.set(choose(c.get(i), a.get(i), b.get(i)));
        }
    }

    #[inline(never)]
    fn sin_cos(&self, instruction: &Instruction) {
        let a = self.row(instruction.args[0]);
        let [sine, cosine] = instruction.results.map(|place| self.row(place));
        for ((a, sine), cosine) in a.iter().zip(sine).zip(cosine) {
            let (s, c) = a.get().sin_cos();
            sine.set(s);
            cosine.set(c);
        }
    }

    /// One loop for each operation, so that the operation is not chosen again for each point.
    #[inline(never)]
    fn unary(&self, op: Unary, instruction: &Instruction) {
        macro_rules! loops {
            ($($op:ident)*) => { match op { $(Unary::$op => self.map(instruction, |a| Unary::$op.apply(a)),)* } };
        }
        loops!(Neg Abs Sign Floor Sqrt Exp Log Log10 Sin Cos Tan Asin Acos Atan Sinh Cosh Tanh Erf Erfc Not);
    }

    #[inline(never)]
    fn binary(&self, op: Binary, instruction: &Instruction) {
        macro_rules! loops {
            ($($op:ident)*) => { match op { $(Binary::$op => self.zip(instruction, |a, b| Binary::$op.apply(a, b)),)* } };
        }
        loops!(Add Sub Mul Div Pow Atan2 Hypot Min Max Less LessEqual Equal And Or Scale);
    }
}

/// Points that are worked out side by side: all of a block is read before it is written, so that nothing hinders
/// the machine from doing so, even where a row is operand and result.
const BLOCK: usize = 4;

#[inline(always)]
fn map<T: Real>(result: &[Cell<T>], a: &[Cell<T>], f: impl Fn(T) -> T) {
    let (blocks, rest) = result.as_chunks::<BLOCK>();
    let (a, a_rest) = a.as_chunks::<BLOCK>();
    for (block, a) in blocks.iter().zip(a) {
        write(block, from_fn(|k| f(a[k].get())));
    }
    for (result, a) in rest.iter().zip(a_rest) {
        result.set(f(a.get()));
    }
}

#[inline(always)]
fn zip<T: Real>(result: &[Cell<T>], a: &[Cell<T>], b: &[Cell<T>], f: impl Fn(T, T) -> T) {
    let (blocks, rest) = result.as_chunks::<BLOCK>();
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<BLOCK>(), b.as_chunks::<BLOCK>());
    for ((block, a), b) in blocks.iter().zip(a).zip(b) {
        write(block, from_fn(|k| f(a[k].get(), b[k].get())));
    }
    for ((result, a), b) in rest.iter().zip(a_rest).zip(b_rest) {
        result.set(f(a.get(), b.get()));
    }
}

#[inline(always)]
fn zip3<T: Real>(result: &[Cell<T>], a: &[Cell<T>], b: &[Cell<T>], c: &[Cell<T>], f: impl Fn(T, T, T) -> T) {
    let (blocks, rest) = result.as_chunks::<BLOCK>();
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<BLOCK>(), b.as_chunks::<BLOCK>());
    let (c, c_rest) = c.as_chunks::<BLOCK>();
    for (((block, a), b), c) in blocks.iter().zip(a).zip(b).zip(c) {
        write(block, from_fn(|k| f(a[k].get(), b[k].get(), c[k].get())));
    }
    for (((result, a), b), c) in rest.iter().zip(a_rest).zip(b_rest).zip(c_rest) {
        result.set(f(a.get(), b.get(), c.get()));
    }
}

#[inline(always)]
fn write<T: Real>(block: &[Cell<T>; BLOCK], values: [T; BLOCK]) {
    for (cell, value) in block.iter().zip(values) {
        cell.set(value);
    }
}

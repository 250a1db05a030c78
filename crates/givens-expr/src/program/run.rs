//! The machine that runs a program.

use core::cell::Cell;

use givens_core::scalar::{Inside, Real};

use crate::graph::Input;
use crate::operation::{Binary, Unary, choose};

use super::loops::{BLOCK, map, read, three, two, write, zip, zip3};
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

/// The instructions of a section, done in one piece: packs need them in a function of their own.
struct Section<'s, 'm, T> {
    machine: Machine<'m, T>,
    code: &'s [Instruction],
}

impl<T: Real> Inside for Section<'_, '_, T> {
    type Output = ();
    #[inline(always)]
    fn go(self) {
        for instruction in self.code {
            self.machine.step(instruction);
        }
    }
}

impl<'m, T: Real> Machine<'m, T> {
    fn run(self, code: &[Instruction]) {
        T::within(Section { machine: self, code });
    }

    /// One loop for each operation, so that the operation is not chosen again for each point.
    #[inline(always)]
    fn step(&self, instruction: &Instruction) {
        match instruction.code {
            Code::Unary(op) => self.unary(op, instruction),
            Code::Binary(op) => self.binary(op, instruction),
            Code::Product(Sum::Plus) => three!(self, instruction, |a, b, c| a.mul_add(b, c)),
            Code::Product(Sum::Minus) => three!(self, instruction, |a, b, c| a.mul_add(b, -c)),
            Code::Product(Sum::From) => three!(self, instruction, |a, b, c| (-a).mul_add(b, c)),
            Code::Power(e) => {
                map!(self.row(instruction.results[0]), self.row(instruction.args[0]), |a| a.powi(e));
            }
            Code::Select => self.select(instruction),
            Code::SinCos => self.sin_cos(instruction),
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
    fn select(&self, instruction: &Instruction) {
        let [c, a, b] = instruction.args;
        let (c, a, b) = (self.source(c), self.source(a), self.source(b));
        for (i, result) in self.row(instruction.results[0]).iter().enumerate() {
            result.set(choose(c.get(i), a.get(i), b.get(i)));
        }
    }

    #[inline(always)]
    fn sin_cos(&self, instruction: &Instruction) {
        let a = self.row(instruction.args[0]);
        let [sine, cosine] = instruction.results;
        let (sine, cosine) = (self.row(sine), self.row(cosine));
        for ((a, sine), cosine) in a.iter().zip(sine).zip(cosine) {
            let (s, c) = a.get().sin_cos();
            sine.set(s);
            cosine.set(c);
        }
    }

    #[inline(always)]
    fn unary(&self, op: Unary, instruction: &Instruction) {
        let (result, a) = (self.row(instruction.results[0]), self.row(instruction.args[0]));
        macro_rules! loops {
            (quick $($quick:ident)*; slow $($slow:ident)*) => {
                match op {
                    $(Unary::$quick => map!(result, a, |a| Unary::$quick.apply(a)),)*
                    $(Unary::$slow => {
                        for (result, a) in result.iter().zip(a) {
                            result.set(Unary::$slow.apply(a.get()));
                        }
                    })*
                }
            };
        }
        loops!(
            quick Neg Abs Sign Floor Sqrt Not;
            slow Exp Log Log10 Sin Cos Tan Asin Acos Atan Sinh Cosh Tanh Erf Erfc
        );
    }

    #[inline(always)]
    fn binary(&self, op: Binary, instruction: &Instruction) {
        macro_rules! loops {
            (quick $($quick:ident)*; slow $($slow:ident)*) => {
                match op {
                    $(Binary::$quick => two!(self, instruction, |a, b| Binary::$quick.apply(a, b)),)*
                    $(Binary::$slow => {
                        let (a, b) = (self.source(instruction.args[0]), self.source(instruction.args[1]));
                        for (i, result) in self.row(instruction.results[0]).iter().enumerate() {
                            result.set(Binary::$slow.apply(a.get(i), b.get(i)));
                        }
                    })*
                }
            };
        }
        loops!(
            quick Add Sub Mul Div Min Max Less LessEqual Equal And Or Scale;
            slow Pow Atan2 Hypot
        );
    }
}

//! Loops over the points of a row.

use core::cell::Cell;

use givens_core::scalar::Real;

/// The result of an operation at all points, from one row.
///
/// All of a block is read before it is written, so that nothing hinders the machine from working it out side by side, even
/// where a row is operand and result. It is a macro, as are the two below, for a closure would not always be inlined.
macro_rules! map {
    ($result:expr, $a:expr, |$x:pat_param| $of:expr) => {{
        let ((blocks, rest), (a, a_rest)) = ($result.as_chunks::<BLOCK>(), $a.as_chunks::<BLOCK>());
        for (block, a) in blocks.iter().zip(a) {
            let a = read(a);
            let mut values = a;
            for k in 0..BLOCK {
                let $x = a[k];
                values[k] = $of;
            }
            write(block, values);
        }
        for (result, a) in rest.iter().zip(a_rest) {
            let $x = a.get();
            result.set($of);
        }
    }};
}

/// The same from two rows.
macro_rules! zip {
    ($result:expr, $a:expr, $b:expr, |$x:pat_param, $y:pat_param| $of:expr) => {{
        let ((blocks, rest), (a, a_rest)) = ($result.as_chunks::<BLOCK>(), $a.as_chunks::<BLOCK>());
        let (b, b_rest) = $b.as_chunks::<BLOCK>();
        for ((block, a), b) in blocks.iter().zip(a).zip(b) {
            let (a, b) = (read(a), read(b));
            let mut values = a;
            for k in 0..BLOCK {
                let ($x, $y) = (a[k], b[k]);
                values[k] = $of;
            }
            write(block, values);
        }
        for ((result, a), b) in rest.iter().zip(a_rest).zip(b_rest) {
            let ($x, $y) = (a.get(), b.get());
            result.set($of);
        }
    }};
}

/// The same from three rows.
macro_rules! zip3 {
    ($result:expr, $a:expr, $b:expr, $c:expr, |$x:pat_param, $y:pat_param, $z:pat_param| $of:expr) => {{
        let ((blocks, rest), (a, a_rest)) = ($result.as_chunks::<BLOCK>(), $a.as_chunks::<BLOCK>());
        let ((b, b_rest), (c, c_rest)) = ($b.as_chunks::<BLOCK>(), $c.as_chunks::<BLOCK>());
        for (((block, a), b), c) in blocks.iter().zip(a).zip(b).zip(c) {
            let (a, b, c) = (read(a), read(b), read(c));
            let mut values = a;
            for k in 0..BLOCK {
                let ($x, $y, $z) = (a[k], b[k], c[k]);
                values[k] = $of;
            }
            write(block, values);
        }
        for (((result, a), b), c) in rest.iter().zip(a_rest).zip(b_rest).zip(c_rest) {
            let ($x, $y, $z) = (a.get(), b.get(), c.get());
            result.set($of);
        }
    }};
}

/// An operation of two operands, either of which may be the same for all points.
macro_rules! two {
    ($machine:expr, $instruction:expr, |$x:ident, $y:ident| $of:expr) => {{
        let result = $machine.row($instruction.results[0]);
        match ($machine.source($instruction.args[0]), $machine.source($instruction.args[1])) {
            (Source::Row(a), Source::Row(b)) => zip!(result, a, b, |$x, $y| $of),
            (Source::Row(a), Source::Same($y)) => map!(result, a, |$x| $of),
            (Source::Same($x), Source::Row(b)) => map!(result, b, |$y| $of),
            (Source::Same($x), Source::Same($y)) => map!(result, result, |_| $of),
        }
    }};
}

/// An operation of three, of which the first and the last may be the same for all points.
macro_rules! three {
    ($machine:expr, $instruction:expr, |$x:ident, $y:ident, $z:ident| $of:expr) => {{
        let [a, b, c] = $instruction.args;
        let (result, b) = ($machine.row($instruction.results[0]), $machine.row(b));
        match ($machine.source(a), $machine.source(c)) {
            (Source::Row(a), Source::Row(c)) => zip3!(result, a, b, c, |$x, $y, $z| $of),
            (Source::Row(a), Source::Same($z)) => zip!(result, a, b, |$x, $y| $of),
            (Source::Same($x), Source::Row(c)) => zip!(result, b, c, |$y, $z| $of),
            (Source::Same($x), Source::Same($z)) => map!(result, b, |$y| $of),
        }
    }};
}

pub(super) use {map, three, two, zip, zip3};

/// Points that are worked out side by side.
pub(super) const BLOCK: usize = 4;

#[inline(always)]
pub(super) fn read<T: Real>(block: &[Cell<T>; BLOCK]) -> [T; BLOCK] {
    [block[0].get(), block[1].get(), block[2].get(), block[3].get()]
}

#[inline(always)]
pub(super) fn write<T: Real>(block: &[Cell<T>; BLOCK], values: [T; BLOCK]) {
    for (cell, value) in block.iter().zip(values) {
        cell.set(value);
    }
}

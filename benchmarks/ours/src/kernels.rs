//! Kernels alone, for the count of instructions: `tria f64 7x21`, `sweep packs 2x5`, `cholesky portable 7x7`.
//!
//! `f64` is what a single filter calls, `packs` are those of the machine, `portable` the arrays that any machine has.

use crate::VERSION;
use givens_contest::{Entry, Failure};
use givens_core::kernels::{cholesky, sweep, tria};
use givens_core::scalar::{InstructionSet, Job, LaneMask, Mask, Pack};

/// Repetitions in one.
const TIMES: usize = 100;

#[derive(Clone, Copy)]
enum Kernel {
    Tria,
    Sweep,
    Cholesky,
}

#[derive(Clone, Copy)]
struct Work {
    kernel: Kernel,
    rows: usize,
    columns: usize,
}

/// The work that these words name.
pub fn offer(words: &str) -> Result<Entry<'static>, Failure> {
    let unknown = || format!("no kernel `{words}`");
    let [name, scalar, size] =
        <[&str; 3]>::try_from(words.split(' ').collect::<Vec<_>>()).map_err(|_| unknown())?;
    let (rows, columns) = size.split_once('x').ok_or_else(unknown)?;
    let kernel = match name {
        "tria" => Kernel::Tria,
        "sweep" => Kernel::Sweep,
        "cholesky" => Kernel::Cholesky,
        _ => return Err(unknown().into()),
    };
    let work = Work { kernel, rows: rows.parse()?, columns: columns.parse()? };
    let set = match scalar {
        "f64" => None,
        "packs" => Some(crate::packs::vectors::<f64>()?.0),
        "portable" => Some(InstructionSet::Portable),
        _ => return Err(unknown().into()),
    };
    let go = move || match set {
        None => Ok(work.run::<f64>()),
        Some(set) => set.run(work).ok_or_else(|| "this machine has no such packs".into()),
    };
    Ok(Entry { version: VERSION.to_owned(), steps: TIMES, result: Vec::new(), go: Box::new(go) })
}

impl Job<f64> for Work {
    type Output = f64;

    #[inline(always)]
    fn run<P: Pack<Element = f64>>(self) -> f64 {
        let Self { kernel, rows, columns } = self;
        // of a sweep, rows is d and columns n
        let (height, width) = match kernel {
            Kernel::Sweep => (rows + columns, rows + columns),
            _ => (rows, columns),
        };
        let entry = |k: usize| {
            let (i, j) = (k / width, k % width);
            // a sweep starts from [L D; 0 S], L and S lower triangular
            let empty = matches!(kernel, Kernel::Sweep)
                && (i >= rows && j < rows || j > i && (j < rows || i >= rows));
            let inside = if empty { 0.0 } else { ((k * 37) % 11) as f64 / 11.0 };
            P::of(if i == j { 4.0 + i as f64 } else { inside })
        };
        let start: Vec<P> = (0..height * width).map(entry).collect();
        let (mut a, mut scratch) = (start.clone(), vec![P::zero(); 4 * width]);
        let mut sum = 0.0;
        for _ in 0..TIMES {
            a.copy_from_slice(&start);
            let health = match kernel {
                Kernel::Tria => tria(&mut a, height, width, width),
                Kernel::Sweep => sweep(&mut a, rows, columns, &mut scratch),
                Kernel::Cholesky => cholesky(&mut a, height),
            };
            sum += a[0].lane(0) + f64::from(health.sick.bits());
            if health.sick.any() {
                return f64::NAN;
            }
        }
        sum
    }
}

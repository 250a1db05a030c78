//! Lines made in blocks, on several threads, and written in their order.

use core::num::NonZeroUsize;
use std::io::{self, Write};
use std::thread::{Builder, available_parallelism, scope};

/// Lines of a block: some milliseconds of work, against which a thread costs nothing.
const BLOCK: usize = 2048;

/// Writes what `make` makes of the lines, block by block, as many at once as there are threads: all cores where it is not said.
pub(super) fn write<L: Sync>(
    out: &mut dyn Write,
    lines: &[L],
    threads: Option<NonZeroUsize>,
    make: impl Fn(&[L]) -> io::Result<Vec<u8>> + Sync,
) -> io::Result<()> {
    let cores = || available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let threads = threads.unwrap_or_else(cores).get().min(lines.len().div_ceil(BLOCK)).max(1);
    for together in lines.chunks(BLOCK * threads) {
        let mut blocks = together.chunks(BLOCK);
        let own = blocks.next().unwrap_or_default();
        scope(|scope| {
            let make = &make;
            let others: Vec<_> = blocks
                .map(|block| (block, Builder::new().spawn_scoped(scope, move || make(block)).ok()))
                .collect();
            out.write_all(&make(own)?)?;
            for (block, thread) in others {
                // what no thread could be had for is made here
                let made = thread.and_then(|thread| thread.join().ok());
                out.write_all(&made.unwrap_or_else(|| make(block))?)?;
            }
            io::Result::Ok(())
        })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{BLOCK, write};
    use core::num::NonZeroUsize;
    use std::io;

    #[test]
    fn blocks_stand_in_their_order_whatever_the_number_of_threads() {
        let lines: Vec<usize> = (0..5 * BLOCK + 7).collect();
        let text = |of: &[usize]| of.iter().map(usize::to_string).collect::<Vec<_>>().join("\n") + "\n";
        for threads in [None, Some(1), Some(2), Some(3), Some(9)] {
            let mut out = Vec::new();
            let make = |block: &[usize]| Ok(text(block).into_bytes());
            write(&mut out, &lines, threads.and_then(NonZeroUsize::new), make).unwrap();
            assert!(out == text(&lines).into_bytes(), "{threads:?}");
        }
        let mut none = Vec::new();
        write(&mut none, &[0_usize; 0], None, |_| Ok(Vec::new())).unwrap();
        let broken = write(&mut none, &lines, None, |block| {
            if block[0] == BLOCK { Err(io::Error::other("full")) } else { Ok(Vec::new()) }
        });
        assert_eq!(broken.unwrap_err().to_string(), "full");
    }
}

//! What one core can do at most: multiplications with addition, in registers, none of which waits for another.

use core::hint::black_box;
use givens_contest::{Failure, Stopwatch};
use givens_core::scalar::{Job, Pack};

/// Chains side by side: more than a fused operation takes cycles, times the operations begun in each.
const CHAINS: usize = 12;
const TIMES: usize = 1_000_000;

/// Multiplications and additions in a nanosecond, in f64: the best of some runs.
pub fn operations_per_nanosecond() -> Result<f64, Failure> {
    let (set, width) = crate::packs::vectors::<f64>()?;
    let mut best = 0.0_f64;
    for _ in 0..9 {
        let watch = Stopwatch::start();
        black_box(set.run_in_registers::<f64, _>(Chains).map_err(|_| "no packs")?);
        best = best.max((2 * width * CHAINS * TIMES) as f64 / watch.nanoseconds().0 as f64);
    }
    Ok(best)
}

struct Chains;

impl Job<f64> for Chains {
    type Output = f64;

    #[inline(always)]
    fn run<P: Pack<Element = f64>>(self) -> f64 {
        let (by, plus) = (P::of(black_box(0.999)), P::of(black_box(0.001)));
        let mut chains = [P::one(); CHAINS];
        for _ in 0..TIMES {
            for chain in &mut chains {
                *chain = chain.mul_add(by, plus);
            }
        }
        let mut sum = P::zero();
        for chain in chains {
            sum += chain;
        }
        sum.lane(0)
    }
}

//! A program over packs says what it says over floats, to the bit, where it only adds, multiplies and divides.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test may stop at what it did not expect"
)]

mod session;

use givens_core::scalar::{InstructionSet, Job, Pack};
use givens_expr::{Inputs, Program};
use session::Session;

/// The results at two states, the same in every lane.
struct Evaluation<'a> {
    program: &'a Program,
    x: [f64; 2],
}

impl Job<f64> for Evaluation<'_> {
    type Output = Vec<f64>;
    #[inline(always)]
    fn run<P: Pack<Element = f64>>(self) -> Vec<f64> {
        let mut out = vec![P::zero(); self.program.outputs()];
        let mut scratch = vec![P::zero(); self.program.scratch_len(1)];
        self.program.eval(&Inputs::of_state(&self.x.map(P::splat)), 1, &mut out, &mut scratch);
        out.into_iter().map(|value| value.lane(0)).collect()
    }
}

#[test]
fn products_and_their_sums_are_rounded_alike_in_packs_and_alone() {
    let mut session = Session::new();
    let texts = ["x*x - y*y", "x*y + x*x", "x*y - 0.1", "0.1 - x*y", "sqrt(x*x + y*y - 2*x*y)"];
    let nodes: Vec<_> = texts.iter().map(|text| session.read(text)).collect();
    let program = Program::compile(&session.graph, &nodes).unwrap();
    for k in 1..200 {
        let a = f64::from(k) / 7.0;
        for x in [[a, a], [a, -a], [a, 1.0 / a]] {
            let alone = program.values(&Inputs::of_state(&x));
            assert!(x[0] != x[1].abs() || alone[0].to_bits() == 0);
            for set in InstructionSet::ALL {
                if let Some(found) = set.run(Evaluation { program: &program, x }) {
                    let bits =
                        |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
                    assert!(
                        bits(&found) == bits(&alone) || alone[4].is_nan(),
                        "{set:?} at {x:?}: {found:?} {alone:?}"
                    );
                }
            }
        }
    }
}

//! The drift and its Itô derivatives in one program.

use givens_core::scalar::Real;

use crate::graph::{Graph, Input, Node};
use crate::program::{Inputs, Program};

/// Nodes that are looked at before an expansion is given up: about a second's work.
const MOST_VISITS: usize = 300_000_000;

/// f, L₀f and Lf = J G, derived by symbol; what vanishes in them is not computed.
#[derive(Clone, Debug)]
pub(super) struct Expansion {
    program: Program,
    /// The same without Lf.
    still: Program,
    states: usize,
}

impl Expansion {
    /// L₀f = ∂f/∂t + Σ_p f_p ∂f/∂x_p + ½ Σ_pr (G Gᵀ)_pr ∂²f/∂x_p∂x_r; G, n × `noises`, does not depend on the state.
    ///
    /// None if that is more than a graph holds, or takes too long to derive.
    pub fn new(graph: &mut Graph, drift: &[Node], diffusion: &[Node], noises: usize) -> Option<Self> {
        let n = drift.len();
        let zero = graph.constant(0.0);
        let mut l0 = graph.derivatives(drift, Input::Time).ok()?;
        let mut lf = vec![zero; n * noises];
        let mut visits = 0_usize;
        for (p, &velocity) in drift.iter().enumerate() {
            let slopes = graph.derivatives(drift, Input::State(p as u32)).ok()?;
            let row = &diffusion[p * noises..][..noises];
            let blown: Vec<usize> = (0..noises).filter(|&j| !is_zero(graph, row[j])).collect();
            for (i, &slope) in slopes.iter().enumerate().filter(|(_, slope)| **slope != zero) {
                l0[i] = plus(graph, l0[i], velocity, slope);
                for &j in &blown {
                    lf[i * noises + j] = plus(graph, lf[i * noises + j], row[j], slope);
                }
            }
            let inputs = graph.inputs_of_all(&slopes);
            for r in (0..=p).filter(|&r| inputs.contains(&Input::State(r as u32))) {
                // made for the pairs that need it only: for a full G it is the larger part
                let weight = weight(graph, diffusion, noises, [p, r]);
                visits += noises;
                if is_zero(graph, weight) {
                    continue;
                }
                visits += graph.len();
                let seconds = graph.derivatives(&slopes, Input::State(r as u32)).ok()?;
                for (l0, second) in l0.iter_mut().zip(seconds) {
                    *l0 = plus(graph, *l0, weight, second);
                }
            }
            if visits > MOST_VISITS {
                return None;
            }
        }
        let program = Program::compile(graph, &[drift, &l0, &lf].concat()).ok()?;
        let still = Program::compile(graph, &[drift, &l0].concat()).ok()?;
        Some(Self { program, still, states: n })
    }

    /// Scalars of scratch for `points` points.
    pub fn scratch_len(&self, points: usize) -> usize {
        self.program.scratch_len(points).max(self.still.scratch_len(points))
    }

    /// All points at once, component by component; without Lf if it is empty.
    pub fn points<T: Real>(
        &self,
        inputs: &Inputs<'_, T>,
        points: usize,
        [f, l0, lf]: [&mut [T]; 3],
        scratch: &mut [T],
    ) {
        let program = if lf.is_empty() { &self.still } else { &self.program };
        let all = self.states * points;
        program.eval_apart(inputs, points, [&mut f[..all], &mut l0[..all], lf], scratch);
    }
}

/// What ∂²f/∂x_p∂x_r counts for: (G Gᵀ)_pr, halved where p = r.
fn weight(graph: &mut Graph, diffusion: &[Node], noises: usize, [p, r]: [usize; 2]) -> Node {
    let (zero, half) = (graph.constant(0.0), graph.constant(0.5));
    let row = |i: usize| &diffusion[i * noises..][..noises];
    let sum = row(p).iter().zip(row(r)).fold(zero, |sum, (&a, &b)| plus(graph, sum, a, b));
    if p == r { times(graph, half, sum) } else { sum }
}

/// sum + a b.
fn plus(graph: &mut Graph, sum: Node, a: Node, b: Node) -> Node {
    let product = times(graph, a, b);
    graph.add(sum, product)
}

/// a b, and zero where either vanishes for every state.
fn times(graph: &mut Graph, a: Node, b: Node) -> Node {
    match [a, b].into_iter().find(|&x| is_zero(graph, x)) {
        Some(zero) => zero,
        None => graph.mul(a, b),
    }
}

fn is_zero(graph: &Graph, node: Node) -> bool {
    graph.constant_value(node) == Some(0.0)
}

//! Other quantities in the place of inputs.

use crate::graph::{Graph, Input, Node, Op};

impl Graph {
    /// `node` with other nodes in the place of its inputs; an input for which there is none stays.
    pub(crate) fn substitute(
        &mut self,
        node: Node,
        mut other: impl FnMut(&mut Self, Input) -> Option<Node>,
    ) -> Node {
        let order = self.reachable(&[node]);
        let mut new: Vec<Node> = (0..order.last().map_or(0, |last| last.index() + 1)).map(|_| node).collect();
        for old in order {
            let op = self.op(old);
            let of = |node: Node| new[node.index()];
            new[old.index()] = match op {
                Op::Constant(_) => old,
                Op::Input(input) => other(self, input).unwrap_or(old),
                Op::Unary(op, a) => self.unary(op, of(a)),
                Op::Binary(op, a, b) => self.binary(op, of(a), of(b)),
                Op::Power(a, exponent) => self.power(of(a), exponent),
                Op::Select(condition, a, b) => self.select(of(condition), of(a), of(b)),
            };
        }
        new.last().copied().unwrap_or(node)
    }
}

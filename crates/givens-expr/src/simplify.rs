//! The operations of a graph, with the algebra that is exact.

use crate::graph::{Graph, Node, Op};
use crate::operation::{Binary, Unary};

/// The largest exponent that is worked out by multiplication: beyond, `pow` is closer.
const MAX_POWER: u32 = 32;

impl Graph {
    /// An operation on one node.
    pub fn unary(&mut self, op: Unary, a: Node) -> Node {
        match (op, self.op(a)) {
            (Unary::Neg, Op::Unary(Unary::Neg, inner)) => inner,
            _ => self.folded(Op::Unary(op, a)),
        }
    }

    /// An operation on two nodes.
    pub fn binary(&mut self, op: Binary, a: Node, b: Node) -> Node {
        let (left, right) = (self.constant_value(a), self.constant_value(b));
        match (op, left, right) {
            (_, Some(_), Some(_)) => {}
            (Binary::Add | Binary::Sub, _, Some(0.0)) | (Binary::Mul | Binary::Div, _, Some(1.0)) => {
                return a;
            }
            (Binary::Add, Some(0.0), _) | (Binary::Mul, Some(1.0), _) => return b,
            (Binary::Mul | Binary::Div, _, Some(-1.0)) => return self.unary(Unary::Neg, a),
            (Binary::Mul, Some(-1.0), _) => return self.unary(Unary::Neg, b),
            (Binary::Mul, None, None) if a == b => return self.power(a, 2),
            (Binary::Pow, None, Some(0.5)) => return self.unary(Unary::Sqrt, a),
            (Binary::Pow, None, Some(e)) if e.abs() <= f64::from(MAX_POWER) && e.fract() == 0.0 => {
                return self.power(a, e as i32);
            }
            (Binary::Add, None, None) => {
                if let Op::Unary(Unary::Neg, b) = self.op(b) {
                    return self.binary(Binary::Sub, a, b);
                }
            }
            (Binary::Sub, None, None) => {
                if let Op::Unary(Unary::Neg, b) = self.op(b) {
                    return self.binary(Binary::Add, a, b);
                }
            }
            _ => {}
        }
        let (a, b) = if op.is_symmetric() && b < a { (b, a) } else { (a, b) };
        self.folded(Op::Binary(op, a, b))
    }

    /// `a` to a whole power, by multiplication up to the 32nd.
    pub fn power(&mut self, a: Node, exponent: i32) -> Node {
        match exponent {
            0 => self.constant(1.0),
            1 => a,
            _ if exponent.unsigned_abs() > MAX_POWER => {
                let exponent = self.constant(f64::from(exponent));
                self.binary(Binary::Pow, a, exponent)
            }
            _ => self.folded(Op::Power(a, exponent)),
        }
    }

    /// `yes` where the condition holds, `no` elsewhere. What is not chosen has no influence, even if it is not a
    /// number.
    pub fn select(&mut self, condition: Node, yes: Node, no: Node) -> Node {
        match self.constant_value(condition) {
            Some(c) => {
                if c == 0.0 {
                    no
                } else {
                    yes
                }
            }
            None if yes == no => yes,
            None => self.push(Op::Select(condition, yes, no)),
        }
    }

    /// −a.
    pub fn neg(&mut self, a: Node) -> Node {
        self.unary(Unary::Neg, a)
    }

    /// a + b.
    pub fn add(&mut self, a: Node, b: Node) -> Node {
        self.binary(Binary::Add, a, b)
    }

    /// a − b.
    pub fn sub(&mut self, a: Node, b: Node) -> Node {
        self.binary(Binary::Sub, a, b)
    }

    /// a b.
    pub fn mul(&mut self, a: Node, b: Node) -> Node {
        self.binary(Binary::Mul, a, b)
    }

    /// a / b.
    pub fn div(&mut self, a: Node, b: Node) -> Node {
        self.binary(Binary::Div, a, b)
    }

    fn folded(&mut self, op: Op) -> Node {
        match self.fold(op) {
            Some(value) => self.constant(value),
            None => self.push(op),
        }
    }
}

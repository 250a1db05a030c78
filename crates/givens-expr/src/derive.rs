//! Exact derivatives by symbol.

use core::f64::consts::{FRAC_2_SQRT_PI, LOG10_E};

use crate::graph::{Graph, GraphError, Input, Node, Op};
use crate::operation::{Binary, Unary};

impl Graph {
    /// The derivative of a node with respect to an input; derivatives of derivatives are exact as well.
    ///
    /// Where a function has none, the convention of [`Unary`] and [`Binary`] holds: abs has slope 1 at zero; sign,
    /// floor and conditions have slope zero everywhere; min and max take the slope of the operand they return, of
    /// the second one if both are equal; a choice takes the slope of what it chooses.
    ///
    /// # Errors
    /// The graph is full.
    pub fn derivative(&mut self, node: Node, input: Input) -> Result<Node, GraphError> {
        let slopes = self.derivatives(&[node], input)?;
        slopes.first().copied().ok_or(GraphError::TooLarge)
    }

    /// The derivatives of several nodes with respect to one input.
    ///
    /// # Errors
    /// The graph is full.
    pub fn derivatives(&mut self, nodes: &[Node], input: Input) -> Result<Vec<Node>, GraphError> {
        let zero = self.constant(0.0);
        let order = self.reachable(nodes);
        let mut slopes = vec![zero; order.last().map_or(0, |node| node.index() + 1)];
        for node in order {
            let op = self.op(node);
            let moves = |operand: Node| slopes[operand.index()] != zero;
            if op == Op::Input(input) {
                slopes[node.index()] = self.constant(1.0);
            } else if op.operands().any(moves) {
                slopes[node.index()] = self.slope(node, op, |operand| slopes[operand.index()]);
                self.check()?;
            }
        }
        self.check()?;
        Ok(nodes.iter().map(|node| slopes.get(node.index()).copied().unwrap_or(zero)).collect())
    }

    /// The slope of `node` = `op` from those of its operands.
    fn slope(&mut self, node: Node, op: Op, of: impl Fn(Node) -> Node) -> Node {
        match op {
            Op::Constant(_) | Op::Input(_) => self.constant(0.0),
            Op::Unary(op, a) => self.slope_unary(node, op, a, of(a)),
            Op::Binary(op, a, b) => self.slope_binary(node, op, [a, b], [of(a), of(b)]),
            Op::Power(a, e) => {
                let (factor, power) = (self.constant(f64::from(e)), self.power(a, e - 1));
                let slope = self.mul(factor, power);
                if e > 0 { self.times(slope, of(a)) } else { self.scale(slope, of(a)) }
            }
            Op::Select(c, a, b) => self.select(c, of(a), of(b)),
        }
    }

    fn slope_unary(&mut self, node: Node, op: Unary, a: Node, da: Node) -> Node {
        let one = self.constant(1.0);
        match op {
            Unary::Neg => self.neg(da),
            Unary::Abs => {
                let (zero, back) = (self.constant(0.0), self.neg(da));
                let left = self.binary(Binary::Less, a, zero);
                self.select(left, back, da)
            }
            Unary::Sign | Unary::Floor | Unary::Not => self.constant(0.0),
            Unary::Sqrt => {
                let half = self.constant(0.5);
                let slope = self.div(half, node);
                self.scale(slope, da)
            }
            Unary::Exp => self.times(node, da),
            Unary::Log => {
                let slope = self.div(one, a);
                self.scale(slope, da)
            }
            Unary::Log10 => {
                let factor = self.constant(LOG10_E);
                let slope = self.div(factor, a);
                self.scale(slope, da)
            }
            Unary::Sin => {
                let cosine = self.unary(Unary::Cos, a);
                self.times(cosine, da)
            }
            Unary::Cos => {
                let sine = self.unary(Unary::Sin, a);
                let slope = self.neg(sine);
                self.times(slope, da)
            }
            Unary::Tan => {
                let square = self.power(node, 2);
                let slope = self.add(one, square);
                self.times(slope, da)
            }
            Unary::Asin | Unary::Acos => {
                let within = self.one_minus_square(a);
                let width = self.unary(Unary::Sqrt, within);
                let rise = self.div(one, width);
                let slope = if op == Unary::Asin { rise } else { self.neg(rise) };
                self.scale(slope, da)
            }
            Unary::Atan => {
                let square = self.power(a, 2);
                let below = self.add(one, square);
                self.div(da, below)
            }
            Unary::Sinh => {
                let slope = self.unary(Unary::Cosh, a);
                self.times(slope, da)
            }
            Unary::Cosh => {
                let slope = self.unary(Unary::Sinh, a);
                self.times(slope, da)
            }
            Unary::Erf | Unary::Erfc => {
                let square = self.power(a, 2);
                let fall = self.neg(square);
                let bell = self.unary(Unary::Exp, fall);
                let sign = if op == Unary::Erf { 1.0 } else { -1.0 };
                let height = self.constant(sign * FRAC_2_SQRT_PI);
                let slope = self.mul(height, bell);
                self.times(slope, da)
            }
            Unary::Tanh => {
                let slope = self.one_minus_square(node);
                self.times(slope, da)
            }
        }
    }

    fn slope_binary(&mut self, node: Node, op: Binary, [a, b]: [Node; 2], [da, db]: [Node; 2]) -> Node {
        match op {
            Binary::Add => self.add(da, db),
            Binary::Sub => self.difference(da, db),
            Binary::Mul => {
                let (left, right) = (self.times(b, da), self.times(a, db));
                self.add(left, right)
            }
            Binary::Div => {
                let back = self.times(node, db);
                let above = self.difference(da, back);
                self.div(above, b)
            }
            Binary::Scale => {
                let (left, right) = (self.scale(da, b), self.scale(a, db));
                self.add(left, right)
            }
            Binary::Pow => {
                let left = if self.is_zero(da) { da } else { self.power_rule(a, b, da) };
                if self.is_zero(db) {
                    return left;
                }
                let growth = self.unary(Unary::Log, a);
                let growth = self.mul(node, growth);
                let right = self.scale(growth, db);
                self.add(left, right)
            }
            Binary::Atan2 => {
                let (above, across) = (self.power(a, 2), self.power(b, 2));
                let square = self.add(above, across);
                let (by_a, by_b) = (self.div(b, square), self.div(a, square));
                let (left, right) = (self.scale(by_a, da), self.scale(by_b, db));
                self.difference(left, right)
            }
            Binary::Hypot => {
                let (by_a, by_b) = (self.div(a, node), self.div(b, node));
                let (left, right) = (self.scale(by_a, da), self.scale(by_b, db));
                self.add(left, right)
            }
            Binary::Min => {
                let first = self.binary(Binary::Less, a, b);
                self.select(first, da, db)
            }
            Binary::Max => {
                let first = self.binary(Binary::Less, b, a);
                self.select(first, da, db)
            }
            Binary::Less | Binary::LessEqual | Binary::Equal | Binary::And | Binary::Or => self.constant(0.0),
        }
    }

    /// b a^(b − 1) da.
    fn power_rule(&mut self, a: Node, b: Node, da: Node) -> Node {
        let one = self.constant(1.0);
        let below = self.sub(b, one);
        let power = self.binary(Binary::Pow, a, below);
        let slope = self.mul(b, power);
        self.scale(slope, da)
    }

    /// (1 − a)(1 + a), which keeps its digits near |a| = 1.
    fn one_minus_square(&mut self, a: Node) -> Node {
        let one = self.constant(1.0);
        let (below, above) = (self.sub(one, a), self.add(one, a));
        self.mul(below, above)
    }

    /// A bounded slope times the derivative of the argument; nothing where the argument does not move.
    fn times(&mut self, slope: Node, da: Node) -> Node {
        if self.is_zero(da) { da } else { self.mul(slope, da) }
    }

    /// The same for a slope that may be infinite.
    fn scale(&mut self, slope: Node, da: Node) -> Node {
        match (self.constant_value(slope), self.constant_value(da)) {
            (Some(0.0), _) => slope,
            (_, Some(0.0)) => da,
            (slope_value, None) if !slope_value.is_some_and(f64::is_finite) => {
                self.binary(Binary::Scale, slope, da)
            }
            _ => self.mul(slope, da),
        }
    }

    fn difference(&mut self, a: Node, b: Node) -> Node {
        if self.is_zero(a) && !self.is_zero(b) { self.neg(b) } else { self.sub(a, b) }
    }

    fn is_zero(&self, node: Node) -> bool {
        self.constant_value(node) == Some(0.0)
    }
}

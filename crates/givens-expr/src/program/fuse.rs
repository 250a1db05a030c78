//! Products and the sums that alone read them, as one instruction.

use std::collections::{HashMap, HashSet};

use crate::graph::Node;
use crate::operation::Binary;

use super::lifetime::Step;
use super::{Code, Sum};

/// Joins each product that only a sum or a difference reads with that. `kept` are the nodes that others read, and
/// `moving` those that differ from point to point.
pub(super) fn fuse(steps: Vec<Step>, kept: &HashSet<Node>, moving: &HashSet<Node>) -> Vec<Step> {
    let mut readers: HashMap<Node, usize> = HashMap::new();
    for node in steps.iter().flat_map(|step| &step.args) {
        *readers.entry(*node).or_default() += 1;
    }
    let products: HashMap<Node, [Node; 2]> = steps
        .iter()
        .filter_map(|step| match (step.code, step.args.as_slice(), step.results.as_slice()) {
            (Code::Binary(Binary::Mul), &[a, b], &[product]) => {
                let alone = readers.get(&product) == Some(&1) && !kept.contains(&product);
                // the operand that may be the same for all points stands first
                alone.then_some((product, if moving.contains(&b) { [a, b] } else { [b, a] }))
            }
            _ => None,
        })
        .collect();
    let mut joined = HashSet::new();
    let mut fused: Vec<Step> = Vec::with_capacity(steps.len());
    for mut step in steps {
        if let (Code::Binary(op @ (Binary::Add | Binary::Sub)), &[left, right]) =
            (step.code, step.args.as_slice())
        {
            let found = match (op, products.get(&left), products.get(&right)) {
                (Binary::Add, _, Some(&[a, b])) => Some((right, Sum::Plus, vec![a, b, left])),
                (Binary::Add, Some(&[a, b]), None) => Some((left, Sum::Plus, vec![a, b, right])),
                (_, _, Some(&[a, b])) => Some((right, Sum::From, vec![a, b, left])),
                (_, Some(&[a, b]), None) => Some((left, Sum::Minus, vec![a, b, right])),
                (_, None, None) => None,
            };
            if let Some((product, sum, args)) = found {
                joined.insert(product);
                (step.code, step.args) = (Code::Product(sum), args);
            }
        }
        fused.push(step);
    }
    fused.retain(|step| !step.results.iter().any(|result| joined.contains(result)));
    fused
}

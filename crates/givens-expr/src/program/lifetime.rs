//! Which value stands in which row: rows are used again once their value is no longer needed.

use std::collections::HashMap;

use crate::graph::Node;

use super::{Code, Instruction};

/// An operation of a section before its rows are chosen.
pub(super) struct Step {
    pub code: Code,
    pub args: Vec<Node>,
    pub results: Vec<Node>,
}

/// The rows of a section, and the row of each of its values.
pub(super) struct Rows {
    places: HashMap<Node, u32>,
    /// Rows in use at the same time, at most.
    pub count: u32,
    free: Vec<u32>,
    /// For each value that is read, the last step that reads it; none: it is kept.
    last_use: HashMap<Node, Option<usize>>,
}

impl Rows {
    /// `kept` are the values whose row is never used again.
    pub fn new(steps: &[Step], kept: impl Iterator<Item = Node>) -> Self {
        let mut last_use = HashMap::new();
        for (i, step) in steps.iter().enumerate() {
            for &node in &step.args {
                last_use.insert(node, Some(i));
            }
        }
        for node in kept {
            last_use.insert(node, None);
        }
        Self { places: HashMap::new(), count: 0, free: Vec::new(), last_use }
    }

    /// Never uses the rows of these again.
    pub fn keep(&mut self, nodes: &[Node]) {
        self.last_use.extend(nodes.iter().map(|&node| (node, None)));
    }

    /// Whether a value is read in the section, or kept.
    pub fn wants(&self, node: Node) -> bool {
        self.last_use.contains_key(&node)
    }

    /// Gives a value its row.
    pub fn begin(&mut self, node: Node) -> u32 {
        let row = self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        });
        self.places.insert(node, row);
        row
    }

    /// The row of a value.
    pub fn place(&self, node: Node) -> u32 {
        self.places.get(&node).copied().unwrap_or_default()
    }

    /// Chooses the rows of all steps in order. A result may take the row of an operand that is read for the last
    /// time: all operands are read before a result is written.
    pub fn instructions(&mut self, steps: &[Step]) -> Vec<Instruction> {
        let mut code = Vec::with_capacity(steps.len());
        for (i, step) in steps.iter().enumerate() {
            let args = places(step.args.iter().map(|&node| self.place(node)));
            for (k, &node) in step.args.iter().enumerate() {
                if self.last_use.get(&node) == Some(&Some(i)) && !step.args[..k].contains(&node) {
                    self.end(node);
                }
            }
            for &node in &step.results {
                self.begin(node);
            }
            let results = places(step.results.iter().map(|&node| self.place(node)));
            code.push(Instruction { code: step.code, args, results });
        }
        code
    }

    /// Frees the row of a value that is no longer needed.
    fn end(&mut self, node: Node) {
        self.free.extend(self.places.get(&node));
    }
}

fn places<const N: usize>(found: impl Iterator<Item = u32>) -> [u32; N] {
    let mut places = [0; N];
    places.iter_mut().zip(found).for_each(|(place, found)| *place = found);
    places
}

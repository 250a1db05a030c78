//! Which value stands in which row: rows are used again once their value is no longer needed.

use std::collections::HashMap;

use crate::graph::Node;

use super::{Code, Instruction, Place};

/// An operation of a section before its rows are chosen.
pub(super) struct Step {
    pub code: Code,
    pub args: Vec<Node>,
    pub results: Vec<Node>,
}

/// The rows of a section, and the place of each of its values.
pub(super) struct Rows {
    /// The places of values that need no row, then also of those that have one.
    pub places: HashMap<Node, Place>,
    /// Rows in use at the same time, at most.
    pub count: u32,
    free: Vec<u32>,
    /// For each value with a row, the last step that reads it; none: it is kept.
    last_use: HashMap<Node, Option<usize>>,
}

impl Rows {
    /// `places` holds the values that stand elsewhere, `kept` those whose row is never used again.
    pub fn new(steps: &[Step], kept: impl Iterator<Item = Node>, places: HashMap<Node, Place>) -> Self {
        let mut last_use = HashMap::new();
        for (i, step) in steps.iter().enumerate() {
            for &node in &step.args {
                last_use.insert(node, Some(i));
            }
        }
        for node in kept {
            last_use.insert(node, None);
        }
        Self { places, count: 0, free: Vec::new(), last_use }
    }

    /// Gives a value its row.
    pub fn begin(&mut self, node: Node) -> u32 {
        let row = self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        });
        self.places.insert(node, Place::Register(row));
        row
    }

    /// The place of a value.
    pub fn place(&self, node: Node) -> Place {
        self.places.get(&node).copied().unwrap_or(Place::Register(0))
    }

    /// Chooses the rows of all steps in order. A result may take the row of an operand that is read for the last
    /// time: every point is read before it is written.
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
                if !self.places.contains_key(&node) {
                    self.begin(node);
                }
            }
            let results = places(step.results.iter().map(|&node| self.place(node)));
            code.push(Instruction { code: step.code, args, results });
        }
        code
    }

    /// Frees the row of a value that is no longer needed.
    fn end(&mut self, node: Node) {
        if let Place::Register(row) = self.place(node) {
            self.free.push(row);
        }
    }
}

fn places<const N: usize>(found: impl Iterator<Item = Place>) -> [Place; N] {
    let mut places = [Place::Register(0); N];
    places.iter_mut().zip(found).for_each(|(place, found)| *place = found);
    places
}

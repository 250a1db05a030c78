//! What the sections of a model file share while they are read.

use core::ops::Range;

use givens_core::scalar::Shown;
use givens_expr::{Graph, Input, Node, Scope};

use super::document::Value;
use super::evaluate::{Moment, evaluate};
use super::vocabulary::{Role, Vocabulary, expression};
use crate::findings::Findings;

/// The largest number of states, measures or controls.
pub(super) const MANY: usize = 1000;

/// Expressions so far, and the values of the parameters.
pub(super) struct Context<'a> {
    pub findings: &'a Findings<'a>,
    pub graph: Graph,
    pub vocabulary: Vocabulary,
    pub parameters: Vec<f64>,
    pub controls: usize,
    /// The fixed length of a step, once it is known.
    pub step: Option<f64>,
}

impl Context<'_> {
    pub fn scope(&self, role: Role) -> Scope {
        self.vocabulary.scope(role)
    }

    /// Reads a number or an expression; what is wrong is found so.
    pub fn expression(&mut self, scope: &Scope, value: &Value, what: &str) -> Option<Node> {
        expression(self.findings, &mut self.graph, scope, value, what)
    }

    /// Reads an expression that is finite if it is the same at every time.
    pub fn finite_expression(&mut self, scope: &Scope, value: &Value, what: &str) -> Option<Node> {
        let node = self.expression(scope, value, what)?;
        let known = self.known(node);
        known.is_none_or(|number| self.finite(number, &value.span, what)).then_some(node)
    }

    /// Reads a number, or an expression in parameters, and gives its value.
    pub fn number(&mut self, scope: &Scope, value: &Value, what: &str) -> Option<f64> {
        let node = self.expression(scope, value, what)?;
        let number = self.known(node)?;
        self.finite(number, &value.span, what).then_some(number)
    }

    /// The value of a node that is the same at every time.
    pub fn known(&self, node: Node) -> Option<f64> {
        self.all_known(&[node]).first().copied().flatten()
    }

    /// The values of those nodes that are the same at every time, in one go: there may be a million of them.
    pub fn all_known(&self, nodes: &[Node]) -> Vec<Option<f64>> {
        let fixed = |input: Input| match input {
            Input::Parameter(_) => true,
            Input::Step => self.step.is_some(),
            _ => false,
        };
        let same = self.graph.depend_only_on(nodes, fixed);
        let pick = |(&node, &same): (&Node, &bool)| same.then_some(node);
        let known: Vec<Node> = nodes.iter().zip(&same).filter_map(pick).collect();
        let moment = Moment { t: 0.0, dt: self.step.unwrap_or(0.0), u: &[] };
        let mut values = self.at(&moment, &known).into_iter();
        same.into_iter().map(|same| if same { values.next() } else { None }).collect()
    }

    /// The values of nodes at a moment.
    pub fn at(&self, moment: &Moment, nodes: &[Node]) -> Vec<f64> {
        evaluate(&self.graph, nodes, moment, &self.parameters)
    }

    /// Finds a value wrong that is not finite.
    pub fn finite(&self, number: f64, span: &Range<usize>, what: &str) -> bool {
        if !number.is_finite() {
            let help = "look for a division by zero, or the root of a negative number";
            self.findings.wrong_help(span, format!("{what} is {number}, not a finite number"), help);
        }
        number.is_finite()
    }

    /// Reads standard deviations, one for each value; those that are known must not be negative.
    pub fn deviations(
        &mut self,
        scope: &Scope,
        values: &[&Value],
        names: &[String],
        what: &str,
    ) -> Option<Vec<Node>> {
        let mut nodes = Vec::with_capacity(values.len());
        for (value, name) in values.iter().zip(names) {
            let what = format!("{what} of `{name}`");
            let node = self.expression(scope, value, &what);
            let good = match node.and_then(|node| self.known(node)) {
                Some(number) if number < 0.0 => {
                    let message =
                        format!("{what} is {}, but a standard deviation is not negative", Shown(number));
                    self.findings.wrong_help(
                        &value.span,
                        message,
                        "write zero for a quantity that is known exactly",
                    );
                    false
                }
                Some(number) => self.finite(number, &value.span, &what),
                None => true,
            };
            nodes.push(node.filter(|_| good));
        }
        nodes.into_iter().collect()
    }
}

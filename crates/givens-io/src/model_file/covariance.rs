//! Covariance matrices: rows of numbers and expressions, symmetric and positive semidefinite.

use core::ops::Range;

use givens_core::kernels::cholesky;
use givens_core::scalar::Shown;
use givens_expr::{Node, Scope};

use super::context::Context;
use super::document::{Kind, Value};
use super::evaluate::Moment;
use crate::findings::{Findings, count};

/// Entries of a matrix row by row, and where each stands.
struct Matrix {
    nodes: Vec<Node>,
    spans: Vec<Range<usize>>,
}

/// Reads a covariance with one row and column for each name, row by row. What is wrong is found so: the shape,
/// asymmetry, and an indefinite matrix if its entries are known.
pub(super) fn covariance(
    context: &mut Context,
    scope: &Scope,
    value: &Value,
    names: &[String],
    what: &str,
) -> Option<Vec<Node>> {
    let rows = square(context.findings, value, names.len(), what)?;
    let matrix = entries(context, scope, &rows, names, what)?;
    let check = Check { context, matrix: &matrix, names, what };
    (check.symmetric() && check.semidefinite()).then_some(matrix.nodes)
}

/// The entries of a list of n lists of n, row by row.
fn square<'v>(findings: &Findings, value: &'v Value, n: usize, what: &str) -> Option<Vec<&'v Value>> {
    let help = format!("write {} of {}: [[…], …]", count(n, "row"), count(n, "value"));
    let Kind::List(rows) = &value.kind else {
        let message = format!("{what} is a list of rows; found {}", value.kind.noun());
        findings.wrong_help(&value.span, message, help);
        return None;
    };
    if rows.len() != n {
        let message = format!("{what} has {}, but needs {n}", count(rows.len(), "row"));
        findings.wrong_help(&value.span, message, help);
        return None;
    }
    let mut entries = Vec::with_capacity(n * n);
    let mut good = true;
    for (i, row) in rows.iter().enumerate() {
        let found = match &row.kind {
            Kind::List(items) if items.len() == n => {
                entries.extend(items);
                continue;
            }
            Kind::List(items) => count(items.len(), "value"),
            other => other.noun().to_string(),
        };
        good = false;
        findings.wrong_help(
            &row.span,
            format!("row {} of {what} has {found}, but needs {n}", i + 1),
            help.clone(),
        );
    }
    good.then_some(entries)
}

fn entries(
    context: &mut Context,
    scope: &Scope,
    rows: &[&Value],
    names: &[String],
    what: &str,
) -> Option<Matrix> {
    let n = names.len().max(1);
    let mut nodes = Vec::with_capacity(rows.len());
    for (k, value) in rows.iter().enumerate() {
        nodes.push(context.expression(scope, value, &format!("{} of {what}", place(k, n))));
    }
    let read: Vec<Node> = nodes.iter().copied().flatten().collect();
    let mut known = context.all_known(&read).into_iter();
    let mut good = true;
    for (k, value) in rows.iter().enumerate().filter(|(k, _)| nodes[*k].is_some()) {
        if let Some(number) = known.next().flatten().filter(|number| !number.is_finite()) {
            good = context.finite(number, &value.span, &format!("{} of {what}", place(k, n)));
        }
    }
    let nodes = nodes.into_iter().collect::<Option<Vec<Node>>>().filter(|_| good)?;
    Some(Matrix { nodes, spans: rows.iter().map(|value| value.span.clone()).collect() })
}

/// Where an entry stands in a matrix of `n` columns.
fn place(k: usize, n: usize) -> String {
    format!("row {}, column {}", k / n + 1, k % n + 1)
}

/// Moments at which matrices that depend on time, step and controls are compared with their transposes.
const PROBES: [(f64, f64, f64); 3] = [(0.37, 1.3, 0.71), (2.9, 0.21, -1.7), (11.3, 3.1, 0.13)];

/// Entries this near, against their diagonal, differ by rounding.
const ROUNDING: f64 = 1e-12;

struct Check<'a, 'c> {
    context: &'a Context<'c>,
    matrix: &'a Matrix,
    names: &'a [String],
    what: &'a str,
}

impl Check<'_, '_> {
    fn n(&self) -> usize {
        self.names.len()
    }

    fn name(&self, i: usize) -> &str {
        self.names.get(i).map_or("", String::as_str)
    }

    fn span(&self, i: usize, j: usize) -> Range<usize> {
        self.matrix.spans.get(i * self.n() + j).cloned().unwrap_or(0..0)
    }

    fn symmetric(&self) -> bool {
        PROBES.iter().all(|&(t, dt, u)| {
            let controls = vec![u; self.context.controls];
            let dt = self.context.step.unwrap_or(dt);
            let values = self.context.at(&Moment { t, dt, u: &controls }, &self.matrix.nodes);
            self.symmetric_at(&values, &format!(" at t = {t}, dt = {dt}"))
        })
    }

    fn symmetric_at(&self, values: &[f64], moment: &str) -> bool {
        let n = self.n();
        let at = |i: usize, j: usize| values.get(i * n + j).copied().unwrap_or(f64::NAN);
        for i in 0..n {
            for j in 0..i {
                let (below, above) = (at(i, j), at(j, i));
                let scale = below.abs().max(above.abs()).max((at(i, i) * at(j, j)).abs().sqrt());
                // Where a probe lies outside an expression's domain, nothing is known.
                if (below - above).abs() > ROUNDING * scale {
                    let node = |i: usize, j: usize| self.matrix.nodes.get(i * n + j).copied();
                    let fixed = [node(i, j), node(j, i)]
                        .into_iter()
                        .flatten()
                        .all(|node| self.context.known(node).is_some());
                    let moment = if fixed { "" } else { moment };
                    let message = format!(
                        "{} is not symmetric: row {}, column {} (`{}`, `{}`) is {}, but row {}, column {} is {}{moment}",
                        self.what,
                        i + 1,
                        j + 1,
                        self.name(i),
                        self.name(j),
                        Shown(below),
                        j + 1,
                        i + 1,
                        Shown(above)
                    );
                    self.context.findings.wrong_help(
                        &self.span(i, j),
                        message,
                        "write the same value in both",
                    );
                    return false;
                }
            }
        }
        true
    }

    /// A matrix whose entries are all known must be a covariance.
    fn semidefinite(&self) -> bool {
        let known: Option<Vec<f64>> = self.context.all_known(&self.matrix.nodes).into_iter().collect();
        let Some(mut values) = known else { return true };
        let Some(pivot) = cholesky(&mut values, self.n()).failed() else { return true };
        let message = format!(
            "{} is not positive semidefinite: pivot {} (`{}`) of its Cholesky factorisation is negative",
            self.what,
            pivot + 1,
            self.name(pivot)
        );
        let help = "a covariance has no negative variance, and no correlation above one";
        self.context.findings.wrong_help(&self.span(pivot, pivot), message, help);
        false
    }
}

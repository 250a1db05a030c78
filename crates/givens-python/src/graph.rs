//! Where traced functions become expressions.

use givens::model::At;
use givens_expr::{Binary, Input, Inputs, MAX_NODES, Node, Program, Unary};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArrayDyn};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::Input as Refused;
use crate::listed::Listed;
use crate::numbers::numbers;

/// Expressions in which equal subexpressions are one node, known by its number.
#[pyclass(module = "givens._native")]
#[derive(Default)]
pub struct Graph {
    graph: givens_expr::Graph,
}

impl Graph {
    /// The graph itself.
    pub fn inner(&mut self) -> &mut givens_expr::Graph {
        &mut self.graph
    }

    /// The nodes of these numbers.
    pub fn nodes(&self, numbers: &[u32]) -> PyResult<Vec<Node>> {
        numbers.iter().map(|&number| self.node(number)).collect()
    }

    fn node(&self, number: u32) -> PyResult<Node> {
        let missing = || PyValueError::new_err(format!("there is no node {number} in this graph"));
        self.graph.node(number).ok_or_else(missing)
    }

    /// The node's number, unless the graph is full.
    fn give(&self, node: Node) -> PyResult<u32> {
        if self.graph.is_full() {
            return Err(too_many(format!("the expressions have more than {MAX_NODES} distinct operations")));
        }
        Ok(node.number())
    }
}

fn too_many(message: String) -> PyErr {
    Refused::plain(message).help("shorten them, or pass trace=False").into()
}

const UNARY: &[(&str, Unary)] = &[
    ("neg", Unary::Neg),
    ("abs", Unary::Abs),
    ("sign", Unary::Sign),
    ("floor", Unary::Floor),
    ("sqrt", Unary::Sqrt),
    ("exp", Unary::Exp),
    ("log", Unary::Log),
    ("log10", Unary::Log10),
    ("sin", Unary::Sin),
    ("cos", Unary::Cos),
    ("tan", Unary::Tan),
    ("asin", Unary::Asin),
    ("acos", Unary::Acos),
    ("atan", Unary::Atan),
    ("sinh", Unary::Sinh),
    ("cosh", Unary::Cosh),
    ("tanh", Unary::Tanh),
    ("erf", Unary::Erf),
    ("erfc", Unary::Erfc),
    ("not", Unary::Not),
];

const BINARY: &[(&str, Binary)] = &[
    ("add", Binary::Add),
    ("sub", Binary::Sub),
    ("mul", Binary::Mul),
    ("div", Binary::Div),
    ("pow", Binary::Pow),
    ("atan2", Binary::Atan2),
    ("hypot", Binary::Hypot),
    ("min", Binary::Min),
    ("max", Binary::Max),
    ("less", Binary::Less),
    ("less_equal", Binary::LessEqual),
    ("equal", Binary::Equal),
    ("and", Binary::And),
    ("or", Binary::Or),
];

#[pymethods]
impl Graph {
    #[new]
    fn new() -> Self {
        Self::default()
    }

    fn __len__(&self) -> usize {
        self.graph.len()
    }

    fn state(&mut self, index: u32) -> PyResult<u32> {
        let node = self.graph.input(Input::State(index));
        self.give(node)
    }

    fn time(&mut self) -> PyResult<u32> {
        let node = self.graph.input(Input::Time);
        self.give(node)
    }

    fn step(&mut self) -> PyResult<u32> {
        let node = self.graph.input(Input::Step);
        self.give(node)
    }

    fn control(&mut self, index: u32) -> PyResult<u32> {
        let node = self.graph.input(Input::Control(index));
        self.give(node)
    }

    fn parameter(&mut self, index: u32) -> PyResult<u32> {
        let node = self.graph.input(Input::Parameter(index));
        self.give(node)
    }

    fn constant(&mut self, value: f64) -> PyResult<u32> {
        let node = self.graph.constant(value);
        self.give(node)
    }

    fn unary(&mut self, operation: &str, a: u32) -> PyResult<u32> {
        let Some((_, code)) = UNARY.iter().find(|(name, _)| *name == operation) else {
            return Err(PyValueError::new_err(format!("there is no operation `{operation}` on one number")));
        };
        let a = self.node(a)?;
        let node = self.graph.unary(*code, a);
        self.give(node)
    }

    fn binary(&mut self, operation: &str, a: u32, b: u32) -> PyResult<u32> {
        let Some((_, code)) = BINARY.iter().find(|(name, _)| *name == operation) else {
            return Err(PyValueError::new_err(format!("there is no operation `{operation}` on two numbers")));
        };
        let (a, b) = (self.node(a)?, self.node(b)?);
        let node = self.graph.binary(*code, a, b);
        self.give(node)
    }

    fn power(&mut self, a: u32, exponent: i32) -> PyResult<u32> {
        let a = self.node(a)?;
        let node = self.graph.power(a, exponent);
        self.give(node)
    }

    fn select(&mut self, condition: u32, yes: u32, no: u32) -> PyResult<u32> {
        let (condition, yes, no) = (self.node(condition)?, self.node(yes)?, self.node(no)?);
        let node = self.graph.select(condition, yes, no);
        self.give(node)
    }

    /// The number that a node always is, or None.
    fn constant_value(&self, node: u32) -> PyResult<Option<f64>> {
        Ok(self.graph.constant_value(self.node(node)?))
    }

    /// Whether a node is a comparison, or made of comparisons.
    fn is_condition(&self, node: u32) -> PyResult<bool> {
        Ok(self.graph.is_condition(self.node(node)?))
    }

    /// The values of nodes at one point.
    #[pyo3(signature = (nodes, x, t, dt, u, p))]
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        nodes: Listed<u32>,
        x: PyReadonlyArrayDyn<'py, f64>,
        t: f64,
        dt: f64,
        u: PyReadonlyArrayDyn<'py, f64>,
        p: PyReadonlyArrayDyn<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let nodes = self.nodes(&nodes)?;
        let program = Program::compile(&self.graph, &nodes).map_err(|error| too_many(error.to_string()))?;
        let (x, u, p) = (numbers(&x)?, numbers(&u)?, numbers(&p)?);
        let at = At { t, dt, u: &u, p: &p };
        Ok(program.values(&Inputs { at, x: &x, z: &[] }).into_pyarray(py))
    }
}

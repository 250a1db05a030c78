//! Models at run time: expressions as text, exact derivatives by symbol, and bytecode that evaluates many points at
//! once.
//!
//! Text and other front ends meet in one [`Graph`], in which equal subexpressions are one node. From there
//! [`Graph::derivative`] differentiates and [`Program`] compiles; [`ModelTransition`], [`ModelSde`],
//! [`ModelObservation`] and [`ModelStart`] are the models that filters take.
//!
//! ```
//! use givens_expr::{Graph, Input, Inputs, Meaning, Program, Scope, parse};
//!
//! let (mut graph, mut scope) = (Graph::new(), Scope::new());
//! for (i, name) in ["x", "y"].into_iter().enumerate() {
//!     scope.insert(name, Meaning::Is(graph.input(Input::State(i as u32))));
//! }
//! let range = parse(&mut graph, &scope, "sqrt(x^2 + y^2)")?;
//! let slope = graph.derivative(range, Input::State(0))?;
//!
//! let program = Program::compile(&graph, &[range, slope])?;
//! // two points, component by component: (3, 4) and (5, 12)
//! let inputs = Inputs::of_state(&[3.0, 5.0, 4.0, 12.0]);
//! let (mut out, mut scratch) = ([0.0_f64; 4], vec![0.0; program.scratch_len(2)]);
//! program.eval(&inputs, 2, &mut out, &mut scratch);
//! assert_eq!(out[..2], [5.0, 13.0]);
//! assert!((out[2] - 3.0 / 5.0).abs() < 1e-15 && (out[3] - 5.0 / 13.0).abs() < 1e-15);
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod call;
mod derive;
mod error;
mod function;
mod graph;
mod hints;
mod lex;
mod model;
mod operation;
mod parse;
mod program;
mod refuse;
mod scope;
mod simplify;
mod substitute;
mod suggest;

pub use error::ExprError;
pub use function::{functions, is_reserved};
pub use graph::{Graph, GraphError, Input, MAX_NODES, Node};
pub use lex::{is_name, names};
pub use model::{
    ModelError, ModelObservation, ModelSde, ModelStart, ModelTransition, NoiseBlock, ObservationParts,
    SdeParts, StartParts, TransitionParts, rate,
};
pub use operation::{Binary, Unary};
pub use parse::{parse, parse_any};
pub use program::{Inputs, Program};
pub use scope::{Meaning, Scope};
pub use suggest::suggest;

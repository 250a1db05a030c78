//! W5: many states.

use super::unknown;
use crate::models::{Circle, Every};
use crate::problem::{Problem, prior};
use crate::single;
use givens_contest::{Entry, Failure, Inputs};
use givens_core::filter::{Ckf, SrCkf};

fn problem<X>(method: X, n: usize, inputs: &Inputs) -> Result<Problem<X, Circle, Every>, Failure> {
    let rows = inputs.csv(&format!("circle_{n}"))?;
    let mean = inputs.csv(&format!("circle_{n}_prior"))?.values;
    let prior = prior(&mean, &vec![1.0; n])?;
    let steps = rows.rows();
    Ok(Problem { method, model: Circle(n), sensor: Every(n), prior, dt: 0.05, rows, steps, every: steps })
}

pub fn states(n: &str, contestant: &str, inputs: &Inputs) -> Result<Entry<'static>, Failure> {
    let n = n.parse()?;
    Ok(match contestant {
        "sr-ckf" => single::entry(problem(SrCkf::default(), n, inputs)?)?,
        "ckf" => single::entry(problem(Ckf::default(), n, inputs)?)?,
        _ => return unknown(contestant),
    })
}

//! The Rust peers: `peers CONTESTANT WORKLOAD INPUTS`, as `givens_contest` says; `peers stress PRECISION FILE` for docs/stress.md.

mod bayes;
mod circle;
mod kfilter_peer;
mod model;
mod numeris_peer;
mod plane;
mod race;
mod smelly_peer;
mod space;
mod stress;
mod ukf_peer;

use circle::Circle;
use givens_contest::{Entry, Failure, Inputs, Table, called_with, lacks, serve};
use model::Model;
use plane::Plane;
use race::entry;
use space::Space;

fn main() -> Result<(), Failure> {
    let (contestant, workload, inputs) = called_with()?;
    if contestant == "stress" {
        let file = std::env::args().nth(3).unwrap_or_default();
        println!("{}", stress::run(&workload, &file)?);
        return Ok(());
    }
    let entry = match workload.as_str() {
        "W1" => fixed::<_, 5, 11, 2>(Plane, &contestant, inputs.csv("plane")?, 1000, 10)?,
        "W2" => fixed::<_, 5, 11, 2>(Plane, &contestant, inputs.f32("plane_tracks", 2)?, 100, 100)?,
        "W3b" => fixed::<_, 7, 15, 3>(Space, &contestant, inputs.csv("space")?, 30, 1)?,
        _ => match workload.strip_prefix("W5-") {
            Some(n) => circle(n, &contestant, &inputs)?,
            None => None,
        },
    };
    match entry {
        Some(entry) => serve(entry),
        None => lacks("it has no filter for this workload"),
    }
}

/// Sizes known when it is compiled: N states, X = 2 N + 1 points, D measures.
fn fixed<M: Model, const N: usize, const X: usize, const D: usize>(
    model: M,
    contestant: &str,
    rows: Table,
    steps: usize,
    every: usize,
) -> Result<Option<Entry<'static>>, Failure>
where
    nalgebra35::Const<D>: nalgebra35::DimMin<nalgebra35::Const<D>, Output = nalgebra35::Const<D>>,
{
    Ok(Some(match contestant {
        "bayes_estimate" => {
            entry(bayes::VERSION, move || bayes::fixed::<M, N, D>(model), rows, steps, every)?
        }
        "bayes_estimate root" => {
            entry(bayes::VERSION, move || bayes::root::<M, N, D>(model), rows, steps, every)?
        }
        "kfilter" => {
            entry(kfilter_peer::VERSION, move || kfilter_peer::new::<M, N, X, D>(model), rows, steps, every)?
        }
        "smelly" => entry(smelly_peer::VERSION, move || smelly_peer::dynamic(model), rows, steps, every)?,
        "smelly static" => {
            entry(smelly_peer::VERSION, move || smelly_peer::fixed::<M, N, D>(model), rows, steps, every)?
        }
        "numeris ckf" => {
            entry(numeris_peer::VERSION, move || numeris_peer::ckf::<M, N, D>(model), rows, steps, every)?
        }
        "numeris srukf" => {
            entry(numeris_peer::VERSION, move || numeris_peer::srukf::<M, N, D>(model), rows, steps, every)?
        }
        "ukf" => return ukf_peer::of(model, rows, steps, every),
        _ => return Ok(None),
    }))
}

/// Lorenz-96 of `n` states, which is known when it runs.
fn circle(n: &str, contestant: &str, inputs: &Inputs) -> Result<Option<Entry<'static>>, Failure> {
    let (mean, rows) =
        (inputs.csv(&format!("circle_{n}_prior"))?.values, inputs.csv(&format!("circle_{n}"))?);
    let (model, steps) = (Circle::new(mean), rows.rows());
    Ok(Some(match contestant {
        "bayes_estimate" => entry(bayes::VERSION, move || bayes::dynamic(model), rows, steps, steps)?,
        "smelly" => entry(smelly_peer::VERSION, move || smelly_peer::dynamic(model), rows, steps, steps)?,
        _ => return Ok(None),
    }))
}

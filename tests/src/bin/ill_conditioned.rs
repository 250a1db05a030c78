//! Prints the table of `docs/ill-conditioned.md`: the relative error of P, in `f64` and in `f32`.

use givens::scalar::Real;
use givens_tests::ill_conditioned::{cases, methods};

fn main() {
    table::<f64>("f64", 10);
    println!();
    table::<f32>("f32", 3);
}

fn table<T: Real>(scalar: &str, columns: usize) {
    let cases = cases(scalar);
    let header: Vec<_> = (3..3 + columns).map(|k| format!("1e-{k}")).collect();
    println!("| {scalar}, δ = | {} |", header.join(" | "));
    println!("|---|{}", "---|".repeat(columns));
    for (name, _, error, _) in methods::<T>() {
        let cells = cases[..columns].iter().map(|case| match error(case) {
            Ok(error) => format!("{error:.0e}"),
            Err(_) => "error".into(),
        });
        println!("| {name} | {} |", cells.collect::<Vec<_>>().join(" | "));
    }
}

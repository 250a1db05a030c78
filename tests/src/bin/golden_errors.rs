//! Prints the errors reached on every scenario of `golden`: the table of `golden/README.md`.

use givens_tests::SCENARIOS;
use givens_tests::scenario::{ROADS, Reached, SMALL, Scenario};

fn main() {
    let roads = ROADS.map(|(road, _)| road).join(" | ");
    println!("| folder | filter: {roads} | smoothers: {roads} | α = .001: {roads} |");
    println!("|---{}|", "|---".repeat(9));
    for name in SCENARIOS {
        let scenario = Scenario::read(name);
        let columns = ROADS.map(|(_, parts)| {
            let worst = |small: bool| {
                let rules = scenario.rules().filter(|&rule| (rule == SMALL) == small);
                let reached = rules.map(|rule| scenario.reached(rule, parts).unwrap());
                reached.fold(Reached::default(), Reached::worse)
            };
            let (others, small) = (worst(false), worst(true));
            [others.filter(), others.smoothed, small.filter().max(small.smoothed)]
        });
        let cells = [0, 1, 2].map(|of| columns.map(|column| shown(column[of])).join(" | "));
        println!("| `{name}` | {} |", cells.join(" | "));
    }
}

/// Zero is what a scenario without such a rule reaches.
fn shown(error: f64) -> String {
    if error == 0.0 { "–".to_owned() } else { format!("{error:.0e}") }
}

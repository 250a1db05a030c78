//! Prints the tables of `docs/stress.md`: givens' methods, and behind them the peers whose answers stand in the files that are
//! named; with `--long`, ten million rows of `sr-ckf` in place of them.

use givens::registry::{Choice, Precision, Setting, resolve};
use givens_tests::stress::{
    Answered, Asks, Case, Column, Peer, Rung, Verdict, case, cases, judge, named_methods, read_peers, table,
};

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    if words.first().is_some_and(|word| word == "--long") {
        return long();
    }
    let read =
        |path: &String| std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let peers: Vec<Peer> = words.iter().flat_map(|path| read_peers(&read(path))).collect();
    for case in cases() {
        println!("\n### `{}`: {}\n", case.name, case.about);
        let mut columns = ours(&case);
        columns.extend(theirs(&case, &peers));
        print!("{}", table(&case, &columns));
    }
}

/// Verdicts along the ladder.
fn verdicts(
    case: &Case,
    precision: Precision,
    asks: Asks,
    answers: impl Iterator<Item = Answered>,
) -> Vec<Option<Verdict>> {
    let of = |(rung, given): (&Rung, Answered)| judge(rung.answer(precision)?, asks, &given);
    case.rungs.iter().zip(answers).map(of).collect()
}

fn ours(case: &Case) -> Vec<Column> {
    let along = |choice: &Choice, precision| {
        let choice = Choice { precision, ..*choice };
        case.rungs.iter().map(|rung| rung.verdict(&choice)).collect()
    };
    let singles = named_methods(&case.rungs[0], Precision::F32);
    let of = |(name, choice): (String, Choice)| {
        let served = singles.iter().any(|(single, _)| *single == name);
        let double = Some(along(&choice, Precision::F64));
        Column { double, single: served.then(|| along(&choice, Precision::F32)), name }
    };
    named_methods(&case.rungs[0], Precision::F64).into_iter().map(of).collect()
}

/// The peers that run the case, in the order of the files.
fn theirs(case: &Case, peers: &[Peer]) -> Vec<Column> {
    let mut columns: Vec<Column> = Vec::new();
    for peer in peers {
        let Some(answers) = peer.answers(&case.name) else { continue };
        let known = columns.iter().position(|column| column.name == peer.name);
        let at = known.unwrap_or(columns.len());
        if known.is_none() {
            columns.push(Column { name: peer.name.clone(), double: None, single: None });
        }
        let precision = if peer.single { Precision::F32 } else { Precision::F64 };
        let found = Some(verdicts(case, precision, peer.asks, answers.into_iter()));
        if peer.single { columns[at].single = found } else { columns[at].double = found }
    }
    columns
}

/// Ten million rows, and how far mean and covariance are then from the steady state.
fn long() {
    println!("| 10⁷ rows, process noise | f64 | f32 |\n|---|---|---|");
    for rung in &case("long_run").rungs {
        let cell = |precision, word: &str| {
            let Some(answer) = rung.answer(precision) else { return "–".to_owned() };
            let settings = [Setting { key: "precision".into(), value: word.into() }];
            let choice = resolve("sr-ckf", &settings).unwrap();
            match judge(answer, Asks::Points, &rung.run(&choice, Some(10_000_000))) {
                Some(Verdict::Right(error)) => format!("right, to {error:.0e} σ"),
                Some(Verdict::Wrong(error) | Verdict::Doubted(error)) => {
                    format!("**wrong**, by {error:.0e} σ")
                }
                Some(Verdict::Said(why)) => why,
                Some(Verdict::NotANumber) => "NaN".to_owned(),
                None => "–".to_owned(),
            }
        };
        println!("| {:.0e} | {} | {} |", rung.d, cell(Precision::F64, "f64"), cell(Precision::F32, "f32"));
    }
}

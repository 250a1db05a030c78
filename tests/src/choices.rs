//! Every method of the registry with every value of an option that makes a difference.

use givens::filter::Block;
use givens::registry::{Choice, ENTRIES, FormName, Kind, OPTIONS, Reader, RuleName, Setting, Value, resolve};

/// The settings to try with a rule. An option of the registry that has no place here fails the tests.
fn settings(rule: RuleName) -> Vec<Vec<(&'static str, f64)>> {
    let all = match rule {
        RuleName::Unscented => vec![
            vec![],
            vec![("kappa", 0.0)],
            vec![("kappa", 1.5)],
            vec![("alpha", 0.5), ("beta", 2.0), ("kappa", 0.0)],
            vec![("alpha", 0.8), ("beta", -0.3), ("kappa", 0.5)],
        ],
        RuleName::GaussHermite => [2.0, 3.0, 4.0, 5.0].map(|points| vec![("points", points)]).to_vec(),
        RuleName::CentralDifference => [1.0, 1.5, 3f64.sqrt(), 2.5].map(|eta| vec![("eta", eta)]).to_vec(),
        _ => vec![vec![]],
    };
    for option in OPTIONS.iter().filter(|option| option.reader == Reader::Rule(rule)) {
        let tried = all.iter().flatten().any(|(key, _)| *key == option.key);
        assert!(tried, "no value of `{}` is tried", option.key);
    }
    all
}

/// Every discrete method for a state of length n, by a name that tells its options. Grids beyond a thousand points are left
/// out.
#[must_use]
pub fn choices(n: usize) -> Vec<(String, Choice)> {
    of_kind(Kind::Discrete, n)
}

/// The same of the methods for continuous models.
#[must_use]
pub fn continuous_choices(n: usize) -> Vec<(String, Choice)> {
    of_kind(Kind::Continuous, n)
}

fn of_kind(kind: Kind, n: usize) -> Vec<(String, Choice)> {
    let mut all = Vec::new();
    for entry in ENTRIES.iter().filter(|entry| entry.kind() == kind) {
        let updates: &[&str] =
            if entry.form == FormName::SquareRoot { &["joint", "separate"] } else { &[""] };
        for numbers in settings(entry.rule) {
            for &update in updates {
                let number =
                    |&(key, x): &(&str, f64)| Setting { key: key.to_owned(), value: Value::Number(x) };
                let mut settings: Vec<_> = numbers.iter().map(number).collect();
                if !update.is_empty() {
                    settings.push(Setting { key: "update".into(), value: update.into() });
                }
                let choice = resolve(entry.name, &settings).unwrap();
                let points = choice.gauss_hermite.points.pow(n as u32);
                if choice.check(n).is_ok() && (entry.rule != RuleName::GaussHermite || points <= 1000) {
                    all.push((format!("{} {update} {numbers:?}", entry.name), choice));
                }
            }
        }
    }
    all
}

/// The same method in covariance form, or with the other update: what it must agree with.
#[must_use]
pub fn counterparts(choice: &Choice) -> [Choice; 2] {
    let covariance = Choice { form: FormName::Covariance, block: Block::Joint, ..*choice };
    let other = match choice.block {
        Block::Joint => Block::Separate,
        Block::Separate => Block::Joint,
    };
    [covariance, Choice { block: other, ..*choice }]
}

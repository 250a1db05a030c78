//! `cargo run --release -p givens-fuzz --bin long TARGET EXECUTIONS [SEED]`: so many changes of the corpus, on stable Rust.
//!
//! It goes on after a finding, tells each place that breaks once, with the shortest input that was met, and what took longest.

use givens_fuzz::{Random, mutate, target};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook};
use std::path::Path;
use std::time::Instant;

/// Inputs that are kept beside the corpus, each made of another one.
const POOL: usize = 5000;

thread_local! {
    /// Where the last panic was, and its words.
    static LAST: RefCell<(String, String)> = RefCell::default();
}

fn main() -> Result<(), String> {
    let mut words = std::env::args().skip(1);
    let of = target(&words.next().ok_or("which target?")?);
    let number =
        |word: Option<String>| word.map(|word| word.parse::<u64>().map_err(|error| error.to_string()));
    let executions = number(words.next()).ok_or("how many executions?")??;
    let mut random = Random::new(number(words.next()).unwrap_or(Ok(1))?);
    set_hook(Box::new(|info| {
        let place = info.location().map_or_else(String::new, ToString::to_string);
        let told = info.payload_as_str().unwrap_or("").chars().take(300).collect();
        LAST.set((place, told));
    }));
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(of.name);
    let read = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut pool = Vec::new();
    for entry in std::fs::read_dir(&folder).map_err(read)? {
        pool.push(std::fs::read(entry.map_err(read)?.path()).map_err(read)?);
    }
    let kept = pool.len();
    let mut findings: BTreeMap<String, (usize, Vec<u8>, String)> = BTreeMap::new();
    let (begin, mut slowest) = (Instant::now(), (0.0, Vec::new()));
    for done in 0..executions {
        if done > 0 && done % (executions / 10).max(1) == 0 {
            eprintln!(
                "{}: {done} in {:.0} s, {} places",
                of.name,
                begin.elapsed().as_secs_f64(),
                findings.len()
            );
        }
        let input = mutate(&pool[random.below(pool.len())], of.words, of.longest, &mut random);
        let start = Instant::now();
        if catch_unwind(AssertUnwindSafe(|| (of.body)(&input))).is_err() {
            let (place, told) = LAST.take();
            let found = findings.entry(place).or_insert_with(|| (0, input.clone(), told.clone()));
            found.0 += 1;
            if input.len() < found.1.len() {
                (found.1, found.2) = (input.clone(), told);
            }
        }
        let seconds = start.elapsed().as_secs_f64();
        if seconds > slowest.0 {
            slowest = (seconds, input.clone());
        }
        // what was changed is changed further
        if random.below(8) == 0 {
            if pool.len() < kept + POOL {
                pool.push(input);
            } else {
                let at = kept + random.below(POOL);
                pool[at] = input;
            }
        }
    }
    let seconds = begin.elapsed().as_secs_f64();
    println!("{}: {executions} executions in {seconds:.0} s, {} places break", of.name, findings.len());
    println!("slowest: {:.3} s: {}", slowest.0, slowest.1.escape_ascii());
    for (place, (times, input, told)) in findings {
        println!("\n{place}, {times} times: {told}\n  {}", input.escape_ascii());
    }
    Ok(())
}

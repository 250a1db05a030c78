//! What strangers may hand to givens, and what must come of it: one function of bytes for each face.
//!
//! A target takes any bytes and stops the program where a promise is broken: a panic, a number that is not finite, an
//! error without a place or a word. The same targets run under libFuzzer (`fuzz_targets`) and on stable Rust (`tests`).
#![allow(clippy::float_cmp)]

mod by_hand;
mod bytes;
mod columns;
mod constructors;
mod expression;
mod method;
mod model_file;
mod mutate;
mod options;
mod promise;
mod run;
mod table;
mod world;

pub use mutate::{Random, mutate};

/// A face of givens, as a function of bytes.
pub struct Target {
    /// Its name, which is that of the folder of its corpus.
    pub name: &'static str,
    /// Hands the bytes over; panics where a promise is broken.
    pub body: fn(&[u8]),
    /// What inputs are made of, where they are texts.
    pub words: &'static [&'static str],
    /// The longest inputs that the bounded runs try, in bytes.
    pub longest: usize,
}

/// All targets.
pub const TARGETS: &[Target] = &[
    Target { name: "expression", body: expression::body, words: expression::WORDS, longest: 300 },
    Target { name: "model_file", body: model_file::body, words: model_file::WORDS, longest: 2000 },
    Target { name: "table", body: table::body, words: table::WORDS, longest: 1000 },
    Target { name: "columns", body: columns::body, words: &[], longest: 200 },
    Target { name: "options", body: options::body, words: options::WORDS, longest: 200 },
    Target { name: "constructors", body: constructors::body, words: &[], longest: 400 },
    Target { name: "by_hand", body: by_hand::body, words: &[], longest: 400 },
    Target { name: "run", body: run::body, words: &[], longest: 400 },
];

/// The target of this name.
///
/// # Panics
/// There is none.
#[must_use]
pub fn target(name: &str) -> &'static Target {
    TARGETS.iter().find(|target| target.name == name).unwrap_or_else(|| panic!("no target {name}"))
}

/// The program of a target under libFuzzer. Half of the mutations are its own, half are ours, which know the target's words.
#[cfg(feature = "libfuzzer")]
#[macro_export]
macro_rules! libfuzzer {
    ($name:literal) => {
        libfuzzer_sys::fuzz_target!(|data: &[u8]| ($crate::target($name).body)(data));
        libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
            if seed % 2 == 0 {
                return libfuzzer_sys::fuzzer_mutate(data, size, max_size);
            }
            let mut random = $crate::Random::new(u64::from(seed));
            let made = $crate::mutate(&data[..size], $crate::target($name).words, max_size, &mut random);
            data[..made.len()].copy_from_slice(&made);
            made.len()
        });
    };
}

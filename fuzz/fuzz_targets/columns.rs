//! `cargo +nightly fuzz run columns --features libfuzzer`
#![no_main]
givens_fuzz::libfuzzer!("columns");

//! `cargo +nightly fuzz run run --features libfuzzer`
#![no_main]
givens_fuzz::libfuzzer!("run");

//! `cargo +nightly fuzz run expression --features libfuzzer`
#![no_main]
givens_fuzz::libfuzzer!("expression");

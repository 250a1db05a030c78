//! `cargo +nightly fuzz run options --features libfuzzer`
#![no_main]
givens_fuzz::libfuzzer!("options");

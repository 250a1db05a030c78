//! `cargo +nightly fuzz run table --features libfuzzer`
#![no_main]
givens_fuzz::libfuzzer!("table");

//! `cargo +nightly fuzz run by_hand --features libfuzzer`
#![no_main]
givens_fuzz::libfuzzer!("by_hand");

//! `cargo +nightly fuzz run constructors --features libfuzzer`
#![no_main]
givens_fuzz::libfuzzer!("constructors");

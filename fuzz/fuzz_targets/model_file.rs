//! `cargo +nightly fuzz run model_file --features libfuzzer`
#![no_main]
givens_fuzz::libfuzzer!("model_file");

//! See `lar_fuzz::arrangement`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lar_fuzz::arrangement(bytes));

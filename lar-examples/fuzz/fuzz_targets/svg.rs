//! See `lar_fuzz::svg`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lar_fuzz::svg(bytes));

//! See `lar_fuzz::off`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lar_fuzz::off(bytes));

//! See `lar_fuzz::structure`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lar_fuzz::structure(bytes));

//! See `lar_fuzz::ply`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lar_fuzz::ply(bytes));

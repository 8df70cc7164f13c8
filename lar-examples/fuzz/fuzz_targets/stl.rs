//! See `lar_fuzz::stl`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lar_fuzz::stl(bytes));

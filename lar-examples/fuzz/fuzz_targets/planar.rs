//! See `lar_fuzz::planar`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lar_fuzz::planar(bytes));

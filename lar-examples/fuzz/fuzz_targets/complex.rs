//! See `lar_fuzz::complex`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lar_fuzz::complex(bytes));

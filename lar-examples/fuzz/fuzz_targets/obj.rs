//! See `lar_fuzz::obj`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| lar_fuzz::obj(bytes));

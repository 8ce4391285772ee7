#![no_main]
//! [`fsample_oracle::property::document`] under libFuzzer.

libfuzzer_sys::fuzz_target!(|data: &[u8]| fsample_oracle::property::document(data));

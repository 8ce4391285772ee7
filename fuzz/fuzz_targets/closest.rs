#![no_main]
//! [`fsample_oracle::property::closest`] under libFuzzer.

libfuzzer_sys::fuzz_target!(|data: &[u8]| fsample_oracle::property::closest(data));

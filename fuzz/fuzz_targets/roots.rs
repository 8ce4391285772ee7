#![no_main]
//! [`fsample_oracle::property::roots`] under libFuzzer.

libfuzzer_sys::fuzz_target!(|data: &[u8]| fsample_oracle::property::roots(data));

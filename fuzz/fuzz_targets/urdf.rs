//! The target `urdf`.
#![no_main]

#[path = "../bodies/urdf.rs"]
mod body;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    body::run(data);
});

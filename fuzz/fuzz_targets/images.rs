//! The target `images`.
#![no_main]

#[path = "../bodies/images.rs"]
mod body;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    body::run(data);
});

//! A table of measurements is refused, or its numbers are finite.

use piola_measured::fitting::Measurements;
use piola_measured::rheology::{FlowKind, Measured};

pub(super) fn run(data: &[u8]) {
    let Ok(text) = core::str::from_utf8(data) else { return };
    if let Err(error) = Measurements::parse("fuzz.csv", text) {
        assert!(!error.to_string().is_empty());
    }
    for kind in [FlowKind::Plates, FlowKind::Pipe] {
        if let Err(error) = Measured::parse("fuzz.csv", text, kind, &[]) {
            assert!(!error.to_string().is_empty());
        }
    }
}

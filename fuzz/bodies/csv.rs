//! A table of measurements is refused in words, or read.

use piola_measured::fitting::Measurements;
use piola_measured::rheology::{FlowKind, Measured};

/// Whether some table is read.
pub(super) fn run(data: &[u8]) -> bool {
    let Ok(text) = core::str::from_utf8(data) else { return false };
    let measurements = Measurements::parse("fuzz.csv", text);
    let mut accepted = measurements.is_ok();
    if let Err(error) = measurements {
        assert!(!error.to_string().is_empty());
    }
    for kind in [FlowKind::Plates, FlowKind::Pipe] {
        let measured = Measured::parse("fuzz.csv", text, kind, &[]);
        accepted |= measured.is_ok();
        if let Err(error) = measured {
            assert!(!error.to_string().is_empty());
        }
    }
    accepted
}

//! What stands on the terminal is in words: no names of types, no sentence that the numbers beside it contradict.

use std::path::Path;

use piola_fit::fluids::FluidModel;
use piola_measured::MeasuredError;
use piola_measured::rheology::{FlowKind, Measured, Noise, RecoveryRequest, Request, compare, recover};

fn shipped(name: &str, kind: FlowKind) -> Result<Measured, MeasuredError> {
    Measured::load(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/rheology").join(name), kind, &[])
}

/// `KnownNoise`, `Powers { mean: … }`, `Some(…)`: a capital inside or after a word's start, braces, parentheses after a capital.
fn assert_in_words(text: &str) {
    assert!(!text.contains(['{', '}']) && !text.contains("Some(") && !text.contains("None"), "{text}");
    for word in text.split(|c: char| !c.is_alphabetic()) {
        let is_of_two = word.chars().zip(word.chars().skip(1)).any(|(a, b)| a.is_lowercase() && b.is_uppercase());
        assert!(!is_of_two || ["Pa", "kPa", "MPa", "mPa"].contains(&word), "`{word}` in {text}");
    }
}

#[test]
fn recoveries_are_printed_in_words() -> Result<(), MeasuredError> {
    for (name, kind, heading) in [
        ("pipe.csv", FlowKind::Pipe, "pipe: "),
        ("couette.csv", FlowKind::Couette, "coaxial cylinders"),
        ("cone.csv", FlowKind::Cone, "cone and plate"),
        ("plates.csv", FlowKind::Plates, "parallel plates"),
    ] {
        let table = shipped(name, kind)?;
        for noise in [Noise::Estimated, Noise::Relative(0.01)] {
            let mut request = RecoveryRequest::default();
            request.noise = noise;
            let text = recover(&table, &request)?.table(core::slice::from_ref(&table));
            assert!(text.contains(heading) && text.contains("smoothed"), "{text}");
            assert_in_words(&text);
        }
    }
    Ok(())
}

#[test]
fn a_regularisation_alone_is_not_ranked_and_its_criterion_is_not_denied() -> Result<(), MeasuredError> {
    let table = shipped("couette.csv", FlowKind::Couette)?;
    let text = compare(&table, &Request::of(vec![FluidModel::Papanastasiou]))?.table(&table);
    assert!(text.contains("it is not ranked") && !text.contains("No fluid has an AICc"), "{text}");
    assert_in_words(&text);
    // Two rows leave nothing to judge by.
    let few = Measured::parse("few.csv", "shear_rate [1/s],shear_stress [Pa]\n1,1\n2,3\n", FlowKind::Curve, &[])?;
    let found = compare(&few, &Request::of(vec![FluidModel::PowerLaw, FluidModel::HerschelBulkley]))?;
    let text = found.table(&few);
    assert!(text.contains("No fluid has an AICc"), "{text}");
    let refused = ["herschel-bulkley: too few measured points (2) for the number of parameters (3)"];
    assert_eq!(found.refusals_in_words(), refused);
    Ok(())
}

//! Samples are validated when they are read, and results are written.

use nalgebra::{Matrix3, Vector3};
use piola_fields::Interpolation;
use piola_uniformity::{BurgersVector, RoundCircuit, SampledUniformityMap, UniformityMap, UniformityMapSamples};

#[test]
fn samples_are_read_back_and_bad_ones_refused() {
    let samples = UniformityMapSamples {
        nodes: [vec![0.0, 1.0], vec![0.0], vec![0.0]],
        values: vec![Matrix3::identity(), Matrix3::identity() * 2.0],
        interpolation: Interpolation::Cubic,
    };
    let map = SampledUniformityMap::new(samples).expect("samples");
    let text = serde_json::to_string(&map).expect("text");
    let back: SampledUniformityMap = serde_json::from_str(&text).expect("the same");
    let place = Vector3::new(0.3, 0.0, 0.0);
    assert_eq!(back.value(&place), map.value(&place));
    let reversed = text.replace("2.0", "-2.0");
    assert_ne!(reversed, text);
    let error = serde_json::from_str::<SampledUniformityMap>(&reversed).expect_err("det K = −8");
    assert!(error.to_string().contains("reverses the orientation"), "{error}");
}

#[test]
fn results_are_written_with_their_errors() {
    let circle = RoundCircuit::new(Vector3::zeros(), Vector3::z(), 1.0).expect("a circle");
    let burgers = BurgersVector::of(&super::fixtures::Golden::Screws, &circle, 1e-12).expect("b");
    let written = serde_json::to_value(burgers).expect("a value");
    assert!(written["value"].is_array() && written["error"].is_array() && written["scale"].is_array());
}

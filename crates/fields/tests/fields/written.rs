//! What is written is read back, what is impossible is not.

use nalgebra::{Matrix3, Vector3};
use piola_fields::compatibility::GradientResidual;
use piola_fields::{Interpolation, Preimage, Residual, SampledTrajectories, VectorResidual};
use serde::Serialize;
use serde::de::value::{Error, MapDeserializer};
use serde::de::{Deserialize, DeserializeOwned, IntoDeserializer};

/// Reads back what was written, and refuses it when `part` is replaced.
fn read_and_refuse<D: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug>(data: &D, [part, by]: [&str; 2]) {
    let text = serde_json::to_string(data).expect("text");
    assert_eq!(&serde_json::from_str::<D>(&text).expect("as written"), data, "{text}");
    assert!(text.contains(part), "{text}");
    let read = serde_json::from_str::<D>(&text.replacen(part, by, 1));
    assert!(read.is_err(), "{read:?}");
}

#[test]
fn trajectories_are_read_as_written() {
    let places = [[0.0, 0.5, 1.0], [1.0, 0.25, 0.0], [2.0, 0.5, 4.0]];
    let given = SampledTrajectories::new(&[0.0, 0.75, 1.5], &[&places, &places], Interpolation::Cubic);
    let trajectories = given.expect("times increase");
    read_and_refuse(&trajectories, ["0.75", "1.75"]);
    read_and_refuse(&trajectories, ["[0.0,0.75,1.5]", "[0.0,0.75]"]);
    read_and_refuse(&trajectories, ["[2.0,0.5,4.0]", "[2.0,0.5]"]);
    read_and_refuse(&trajectories, ["\"times\"", "\"moments\""]);
}

#[test]
fn results_are_read_as_written() {
    let residual = Residual::zero().plus(3.0_f64).plus(-1.5);
    read_and_refuse(&residual, ["4.5", "null"]);
    read_and_refuse(&VectorResidual::from([residual; 3]), ["4.5", "null"]);
    let matrix = Matrix3::from_element(0.5);
    read_and_refuse(&GradientResidual { value: matrix, scale: matrix }, ["0.5,", ""]);
    let reference = Vector3::new(1.0, 2.0, 3.5);
    read_and_refuse(&Preimage { reference, residual: 0.0, error_bound: 1e-15, iterations: 3 }, ["3.5", "null"]);
}

#[test]
fn results_that_are_not_finite_are_refused() {
    // From a format that knows infinity, which JSON does not.
    let read = |scale: f64| {
        let fields = [("value", 1.0), ("scale", scale)].map(|(name, x)| (name, x.into_deserializer()));
        Residual::<f64>::deserialize(MapDeserializer::<_, Error>::new(fields.into_iter()))
    };
    assert_eq!(read(2.0), Ok(Residual { value: 1.0, scale: 2.0 }));
    assert!(read(f64::INFINITY).is_err());
    assert!(read(f64::NAN).is_err());
}

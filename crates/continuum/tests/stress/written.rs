//! What is written is read back, what is impossible is not.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::stress::DeformedArea;
use piola_continuum::{
    BiotStress, CauchyStress, DeformationGradient, FirstPiola, KirchhoffStress, MandelStress, ReferenceNormal,
    SecondPiola, UnitNormal,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Reads back what was written, and refuses it when `part` is replaced.
fn read_and_refuse<D: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug>(data: &D, [part, by]: [&str; 2]) {
    let text = serde_json::to_string(data).expect("text");
    assert_eq!(&serde_json::from_str::<D>(&text).expect("as written"), data, "{text}");
    assert!(text.contains(part), "{text}");
    let read = serde_json::from_str::<D>(&text.replacen(part, by, 1));
    assert!(read.is_err(), "{read:?}");
}

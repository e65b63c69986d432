//! What is written with serde is read back.

use piola_continuum::stress::tangents::{FirstPiolaTangent, JaumannTangent, MaterialTangent};
use piola_tensor::{FourthOrder, MajorSymmetric};
use serde::Serialize;
use serde::de::DeserializeOwned;

fn returns<V: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug>(value: &V) {
    let text = serde_json::to_string(value).expect("written");
    assert_eq!(&serde_json::from_str::<V>(&text).expect("read"), value, "{text}");
}

#[test]
fn tangents_are_read_as_written() {
    let stiffness = MajorSymmetric::isotropic(1.0, 3.0);
    let material: MaterialTangent = MaterialTangent(stiffness);
    returns(&material);
    let jaumann: JaumannTangent = JaumannTangent(stiffness);
    returns(&jaumann);
    returns(&FirstPiolaTangent(FourthOrder::<f64>::identity()));
}

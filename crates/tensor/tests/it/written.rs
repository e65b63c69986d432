//! What is written with serde is read back, and checked.

use piola_tensor::Symmetric;
use piola_tensor::voigt::{Abaqus, ComplianceMatrix, StrainVector};
use piola_tensor::{MajorSymmetric, MinorSymmetric, PairSymmetric, Skew};
use serde::Serialize;
use serde::de::DeserializeOwned;

fn returns<V: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug>(value: &V) {
    let text = serde_json::to_string(value).expect("written");
    assert_eq!(&serde_json::from_str::<V>(&text).expect("read"), value, "{text}");
}

#[test]
fn what_is_written_is_read() {
    let tensor = Symmetric::new(1.0, 0.1, 3.0, -4.0, 5.0, 6.0);
    returns(&tensor);
    returns(&Skew::new(1.0, 2.0, 0.3));
    let stiffness = MajorSymmetric::isotropic(1.0, 3.0);
    returns(&stiffness);
    returns(&stiffness.minor());
    returns(&stiffness.general());
    returns(&StrainVector::<f64, Abaqus>::of(&tensor));
    returns(&ComplianceMatrix::<f64, Abaqus>::of(&stiffness));
}

#[test]
fn what_is_read_is_checked() {
    // 1e999 reads as infinity or is refused by the format: either way it does not come in.
    assert!(serde_json::from_str::<Symmetric>("[1e999, 0, 0, 0, 0, 0]").is_err());
    let mut slots = MinorSymmetric::<f64>::identity().components;
    slots[0][1] = 1.0;
    let text = serde_json::to_string(&slots).expect("written");
    assert!(serde_json::from_str::<MinorSymmetric>(&text).is_ok());
    let error = serde_json::from_str::<MajorSymmetric>(&text).expect_err("not symmetric").to_string();
    assert!(error.contains("major symmetry"), "{error}");
}

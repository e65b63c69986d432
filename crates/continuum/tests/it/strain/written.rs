//! Strains and gradients written as text and read back, with their checks.

use piola_continuum::strain::{
    AlmansiStrain, BiotStrain, GreenStrain, HenckyStrain, LeftCauchyGreen, LinearStrain, RightCauchyGreen,
    RightStretch, Rotation, SethHill, SethHillStrain, SpatialSethHillStrain,
};
use piola_continuum::{DeformationGradient, DisplacementGradient, HomogeneousDeformation};
use serde::{Serialize, de::DeserializeOwned};

fn returns<V: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug>(value: &V) {
    let text = serde_json::to_string(value).expect("numbers");
    assert_eq!(serde_json::from_str::<V>(&text).expect("its own text"), *value, "{text}");
}

#[test]
fn written_values_equal_read_ones() {
    let f = DeformationGradient::from_rows([[1.25, 0.5, 0.1], [0.125, 1.5, 0.3], [0.0, -0.5, 2.0]]).expect("0 < det F");
    let h = DisplacementGradient::simple_shear(1e-20).expect("finite");
    returns(&f);
    returns(&h);
    returns(&RightCauchyGreen::of(&f));
    returns(&LeftCauchyGreen::of(&f));
    returns(&GreenStrain::of(&h));
    returns(&AlmansiStrain::of(&f));
    returns(&RightStretch::of(&f));
    returns(&BiotStrain::of(&f));
    returns(&HenckyStrain::of(&f));
    returns(&LinearStrain::of(&h));
    returns(&Rotation::of(&f));
    returns(&SethHill::ALMANSI);
    returns(&SethHillStrain::of(&f, SethHill::BIOT));
    returns(&SpatialSethHillStrain::of(&f, SethHill::HENCKY));
    returns(&HomogeneousDeformation::new(h, nalgebra::Vector3::new(1.0, 2.0, 3.0)).expect("finite"));
    assert_eq!(serde_json::to_string(&h).expect("numbers"), "[[0.0,0.0,0.0],[1e-20,0.0,0.0],[0.0,0.0,0.0]]");
}

fn refuses<V: DeserializeOwned>(text: &str, because: &str) {
    let error = serde_json::from_str::<V>(text).err().map(|error| error.to_string()).unwrap_or_default();
    assert!(error.contains(because), "{text}: {error:?} does not say {because:?}");
}

#[test]
fn read_values_are_checked() {
    refuses::<DeformationGradient>("[[-1,0,0],[0,1,0],[0,0,1]]", "det F = -1e0 is not positive");
    refuses::<DisplacementGradient>("[[-2,0,0],[0,0,0],[0,0,0]]", "not positive");
    refuses::<RightCauchyGreen>("[1,-1,1,0,0,0]", "C is not positive definite");
    refuses::<GreenStrain>("[-1,0,0,0,0,0]", "1 + 2E is not positive definite");
    refuses::<AlmansiStrain>("[1,0,0,0,0,0]", "1 - 2e is not positive definite");
    refuses::<BiotStrain>("[0,-2,0,0,0,0]", "U is not positive definite");
    refuses::<Rotation>("[[1,0,0],[0,1,0],[0,0,2]]", "not a rotation");
}

//! What is written is read back, what is impossible is not.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::stress::DeformedArea;
use piola_continuum::{
    BiotStress, CauchyStress, DeformationGradient, KirchhoffStress, MandelStress, ReferenceNormal, SecondPiola,
    UnitNormal,
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

#[test]
fn stresses_are_read_as_written() {
    let stress: CauchyStress = CauchyStress::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.5).expect("finite");
    assert_eq!(serde_json::to_string(&stress).expect("text"), "[1.0,2.0,3.0,4.0,5.0,6.5]");
    read_and_refuse(&stress, ["6.5", "null"]);
    read_and_refuse(&stress, ["6.5", "6.5,7.0"]);
    read_and_refuse(&KirchhoffStress(stress.0), ["6.5", "1e999"]);
    read_and_refuse(&SecondPiola(stress.0), ["6.5", "1e999"]);
    let f = DeformationGradient::new(Matrix3::new(1.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)).expect("0 < det F");
    let first_piola = stress.first_piola(&f);
    assert_eq!(serde_json::to_string(&first_piola).expect("text"), "[[-1.0,4.0,6.5],[3.0,2.0,5.0],[4.0,5.0,3.0]]");
    read_and_refuse(&first_piola, ["-1.0", "null"]);
    read_and_refuse(&BiotStress(first_piola.0), ["[-1.0,4.0,6.5]", "[4.0,6.5]"]);
    read_and_refuse(&MandelStress(first_piola.0), ["-1.0", "1e999"]);
}

#[test]
fn normals_and_areas_are_read_as_written() {
    let normal = UnitNormal::new(Vector3::new(1.0, -2.0, 3.0)).expect("a direction");
    read_and_refuse(&normal, ["[", "[\"x\","]);
    read_and_refuse(&ReferenceNormal::new(Vector3::<f64>::z()).expect("a direction"), ["1.0", "0.0"]);
    let read: UnitNormal = serde_json::from_str("[0.0,3.0,4.0]").expect("any length");
    assert_eq!(Ok(read), UnitNormal::new(Vector3::new(0.0, 3.0, 4.0)));
    let f = DeformationGradient::new(Matrix3::from_diagonal(&Vector3::new(1.0, 3.0, 4.0))).expect("0 < det F");
    let area: DeformedArea = ReferenceNormal::new(Vector3::x()).expect("a direction").deformed(&f);
    assert_eq!(serde_json::to_string(&area).expect("text"), "[12.0,0.0,0.0]");
    read_and_refuse(&area, ["12.0", "0.0"]);
    let point = CauchyStress(piola_continuum::Symmetric::diagonal([3.0, 1.0, 0.5])).haigh_westergaard();
    read_and_refuse(&point, ["[", "[0.0,"]);
    let principal = CauchyStress(piola_continuum::Symmetric::diagonal([3.0, 1.0, 0.5])).principal();
    read_and_refuse(&principal, ["\"deviatoric\":[", "\"deviatoric\":[-9.0,"]);
    read_and_refuse(&principal, ["\"mean\":1.5", "\"mean\":null"]);
    read_and_refuse(&principal, ["[1.0,0.0,0.0]", "[2.0,0.0,0.0]"]);
    read_and_refuse(&principal.mohr_circles()[0], ["\"radius\":", "\"radius\":-"]);
    assert!(serde_json::from_str::<piola_continuum::stress::HaighWestergaard>("[1.0,-1.0,0.5]").is_err());
    assert!(serde_json::from_str::<piola_continuum::stress::HaighWestergaard>("[1.0,1.0,1.5]").is_err());
}

//! What is written is read back, what is impossible is not.

use nalgebra::{DMatrix, Vector3};
use piola_lagrangian::small_motions::{ComplexModes, Equilibrium, Linearisation, NormalModes};
use piola_lagrangian::{ConstraintVerdict, IdealConstraintTest, PartForce, Reaction, SampledMotion};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::systems::driven;

/// Reads back what was written, and refuses it when `part` is replaced.
fn read_and_refuse<D: Serialize + DeserializeOwned + PartialEq + core::fmt::Debug>(data: &D, [part, by]: [&str; 2]) {
    let text = serde_json::to_string(data).unwrap();
    assert_eq!(&serde_json::from_str::<D>(&text).unwrap(), data, "{text}");
    assert!(text.contains(part), "{text}");
    let read = serde_json::from_str::<D>(&text.replacen(part, by, 1));
    assert!(read.is_err(), "{read:?}");
}

#[test]
fn forces_and_tests_of_them_are_read_as_written() {
    let system = driven();
    let state = ([0.25; 3], [0.5; 3]);
    let reactions: Vec<Reaction> = system.reactions(&state.0, &state.1, 0.0).unwrap();
    read_and_refuse(&reactions, ["\"part\":\"body\"", "\"part\":\"particle\""]);
    let text = serde_json::to_string(&reactions[1]).unwrap();
    let attitude = text.split("\"attitude\":").nth(1).and_then(|rest| rest.split(']').next()).unwrap();
    assert!(serde_json::from_str::<Reaction>(&text.replace(attitude, "[2.0,0.0,0.0,0.0")).is_err());
    read_and_refuse(&PartForce::<f64> { force: Vector3::x(), moment: Vector3::z() }, ["1.0", "null"]);
    read_and_refuse(&system.system_momentum(&state.0, &state.1, 0.0, &Vector3::zeros()).unwrap(), ["momentum", "m"]);
    let test: IdealConstraintTest = system.reaction_test(&state.0, &state.1, 0.0).unwrap();
    read_and_refuse(&test, ["\"scales\":[", "\"scales\":[1.0,"]);
    read_and_refuse(&ConstraintVerdict::Working { coordinate: 1, power: 2.0, scale: 4.0 }, ["scale", "size"]);
    let samples = SampledMotion::new(1, vec![0.0, 0.5], vec![1.0, 2.0], vec![2.0; 2]).unwrap();
    read_and_refuse(&samples, ["0.5", "0.0"]);
}

#[test]
fn small_motions_are_read_as_written_by_rows() {
    let matrix = |a: f64, b: f64, c: f64, d: f64| DMatrix::from_row_slice(2, 2, &[a, b, c, d]);
    let zero = matrix(0.0, 0.0, 0.0, 0.0);
    let linearisation = Linearisation {
        acceleration: nalgebra::DVector::from_vec(vec![0.5, 0.25]),
        mass_matrix: matrix(2.0, 0.0, 0.0, 1.0),
        damping: zero.clone(),
        gyroscopic: matrix(0.0, 8.0, -8.0, 0.0),
        stiffness: matrix(4.0, 0.0, 0.0, 16.0),
        circulatory: zero,
    };
    let text = serde_json::to_string(&linearisation).unwrap();
    assert!(text.contains("\"gyroscopic\":[[0.0,8.0],[-8.0,0.0]]"), "{text}");
    read_and_refuse(&linearisation, ["[[0.0,8.0],[-8.0,0.0]]", "[[0.0,8.0],[-8.0]]"]);
    read_and_refuse(&linearisation, ["[[0.0,8.0],[-8.0,0.0]]", "[[0.0]]"]);
    let modes: NormalModes = linearisation.normal_modes().unwrap();
    read_and_refuse(&modes, ["\"shapes\":[[", "\"shapes\":[[1.0,1.0],["]);
    let modes: ComplexModes = linearisation.complex_modes().unwrap();
    read_and_refuse(&modes, ["\"eigenvalue\":[", "\"eigenvalue\":[1.0,"]);
    let found = Equilibrium {
        coordinates: nalgebra::DVector::from_vec(vec![1.0, 2.0]),
        residual: 0.0,
        condition: 4.0,
        iterations: 3,
        stability: linearisation.stability().unwrap(),
        linearisation,
    };
    read_and_refuse(&found, ["\"coordinates\":[1.0,", "\"coordinates\":["]);
}

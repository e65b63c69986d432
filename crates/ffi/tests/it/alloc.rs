//! Evaluations allocate nothing.

use piola_ffi::abaqus::{PointIncrement, Stretching, umat, vumat};
use piola_ffi::materials::material;
use piola_ffi::points::{StressMeasure, TangentMeasure, VoigtNumbering, stress, stress_and_tangent};
use piola_testkit::allocations_in;

#[test]
fn stresses_tangents_and_materials_allocate_nothing() {
    let f = vec![[1.1, 0.1, 0.0, 0.0, 1.0, 0.2, 0.0, 0.0, 1.0]; 300];
    let (mut t, mut c) = (vec![[0.0; 9]; 300], vec![0.0; 300 * 36]);
    for law in crate::points::laws() {
        let (counted, ()) = allocations_in(|| {
            stress(&law, StressMeasure::SecondPiola, &f, &mut t).unwrap();
            let measures = (StressMeasure::Cauchy, TangentMeasure::Jaumann);
            let out = (&mut t[..], &mut c[..]);
            stress_and_tangent(&law, measures, VoigtNumbering::Abaqus, &f, out).unwrap();
        });
        assert_eq!(counted, 0);
    }
    let properties = [0.5, 0.25, 1.0];
    let first = material("MOONEY_RIVLIN", &properties).unwrap();
    let (mut stresses, mut tangent, mut corotated) = ([0.0; 6], [0.0; 36], [0.0; 12]);
    let stretches = [1.0, 1.1, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let (counted, ()) = allocations_in(|| {
        let law = material("MOONEY_RIVLIN", &properties).unwrap();
        let increment = PointIncrement { f: [&f[0], &f[0]], dt: 1.0, temperature: 0.0 };
        umat(&law, [3, 3], increment, &mut [], &mut stresses, &mut tangent).unwrap();
        let stretching = Stretching { before: &[], after: &stretches, added: 0.0, dt: 1.0, temperatures: &[] };
        vumat(&law, [3, 3], stretching, (&[], &mut []), &mut corotated).unwrap();
    });
    assert_eq!(counted, 0);
    assert_eq!(*first, *material("MOONEY_RIVLIN", &properties).unwrap());
}

//! Evaluations allocate nothing.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::stress::{gradients, invariants, oblique_traction};
use piola_continuum::{CauchyStress, DeformationGradient, ReferenceNormal, UnitNormal};
use piola_testkit::allocations_in;

#[test]
fn stresses_are_evaluated_without_allocating() {
    let (allocations, finite) = allocations_in(|| {
        let t: CauchyStress = CauchyStress::new(3.0, -1.0, 2.0, 0.5, 4.0, -2.0).expect("finite");
        let f = DeformationGradient::new(Matrix3::new(1.0, 0.2, 0.0, 0.1, 1.1, 0.0, 0.0, 0.3, 0.9)).expect("0 < det F");
        let n = UnitNormal::new(Vector3::new(1.0, 2.0, 3.0)).expect("a direction");
        let reference = ReferenceNormal::new(Vector3::new(1.0, 2.0, 3.0)).expect("a direction");
        let p = t.first_piola(&f);
        let measures = [
            p.second_piola(&f).mandel(&f).cauchy(&f).0.components[0],
            t.kirchhoff(&f).second_piola(&f).0.components[0],
            p.traction(&reference).x,
            reference.deformed(&f).ratio,
        ];
        let tractions = [t.traction(&n).x, t.normal_traction(&n), t.shear_traction_size(&n)];
        let oblique = oblique_traction(&[t.traction(&n); 3], &n, 0.1, &Vector3::zeros()).x;
        let invariants = [
            t.von_mises(),
            t.tresca(),
            t.lode_angle(),
            t.haigh_westergaard().principal_values()[0],
            invariants::triaxiality(&t.0).expect("a deviator"),
            gradients::tresca(&t.0).trace(),
        ];
        let checked = p.check_moment(&f).is_ok();
        measures.iter().chain(&tractions).chain(&invariants).all(|x| x.is_finite()) && oblique.is_finite() && checked
    });
    assert_eq!((allocations, finite), (0, true));
}

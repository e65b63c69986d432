//! Evaluations allocate nothing.

use nalgebra::Matrix3;
use piola_continuum::stress::tangents::{MaterialTangent, ObjectiveRate};
use piola_continuum::{DeformationGradient, SecondPiola, Symmetric};
use piola_tensor::MajorSymmetric;
use piola_tensor::voigt::{Abaqus, StiffnessMatrix};
use piola_testkit::allocations_in;

#[test]
fn tangents_and_their_conversions_allocate_nothing() {
    let f = Matrix3::new(1.2, 0.3, 0.0, -0.1, 0.9, 0.2, 0.0, 0.1, 1.1);
    let deformation = DeformationGradient::new(f).expect("0 < det F");
    let stress = SecondPiola(Symmetric::new(1.0, 2.0, 3.0, 0.1, 0.2, 0.3));
    let cauchy = stress.cauchy(&deformation);
    let (allocations, ()) = allocations_in(|| {
        let material: MaterialTangent = MaterialTangent(MajorSymmetric::isotropic(1.0, 3.0));
        let first_piola = material.first_piola(&stress, &deformation);
        let back = first_piola.material(&stress, &deformation);
        let truesdell = back.truesdell(&deformation);
        let naghdi = truesdell.of_cauchy_rate(ObjectiveRate::GreenNaghdi, &cauchy, &deformation);
        let logarithmic = truesdell.of_kirchhoff_rate(ObjectiveRate::Logarithmic, &cauchy, &deformation);
        let matrix = StiffnessMatrix::<f64, Abaqus>::of(&(naghdi + logarithmic));
        let compliance = matrix.compliance().expect("regular");
        let singular = MajorSymmetric::<f64>::spherical().inverse();
        core::hint::black_box((compliance, singular.is_err()));
    });
    assert_eq!(allocations, 0);
}

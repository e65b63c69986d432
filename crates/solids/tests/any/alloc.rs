//! No law allocates in an evaluation.

use piola_continuum::DeformationGradient;
use piola_solids::Hyperelastic;
use piola_testkit::allocations_in;

use super::laws::all;

#[test]
fn allocations_in_evaluations_of_every_law_equal_zero() {
    let f = DeformationGradient::from_rows([[1.1, 0.2, 0.0], [-0.1, 0.9, 0.3], [0.05, 0.1, 1.02]]).expect("0 < det F");
    let shear = DeformationGradient::simple_shear(0.3).expect("finite");
    for (law, any_volume) in all() {
        let (count, ()) = allocations_in(|| {
            let f = if any_volume { f } else { shear };
            assert!(law.check(&f).is_ok());
            let stresses =
                (law.energy(&f), law.first_piola(&f), law.second_piola(&f), law.kirchhoff(&f), law.cauchy(&f));
            let tangents = (law.first_piola_tangent(&f), law.material_tangent(&f), law.truesdell_tangent(&f));
            let direction = stresses.1.0;
            let both = (law.first_piola_and_tangent(&f), law.first_piola_derivative(&f, &direction));
            let _ = core::hint::black_box((stresses, tangents, both, law.reference_stress(), law.reference_energy()));
        });
        assert_eq!(count, 0, "{law:?}");
    }
}

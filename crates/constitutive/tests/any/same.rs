//! The one type answers as the law itself, to the last bit.

use piola_constitutive::ConstitutiveError;
use piola_constitutive::solids::isochoric::{Gent, MooneyRivlin};
use piola_constitutive::solids::volumetric::SimoTaylor;
use piola_constitutive::solids::{
    AnySolid, Compressible, Hencky, Hyperelastic, IncompressibleSolid, SaintVenantKirchhoff, SolidVisitor,
};
use piola_continuum::{DeformationGradient, DisplacementGradient};

fn check<L: Hyperelastic + Clone + Into<AnySolid>>(law: &L) {
    let any: AnySolid = law.clone().into();
    for size in [1e-9, 0.3] {
        let h = [[0.3, -0.2, 0.5], [0.4, 0.7, -0.1], [-0.6, 0.2, 0.9]].map(|row| row.map(|x| size * x));
        let u = DisplacementGradient::<f64>::from_rows(h).expect("0 < det F");
        assert_eq!(any.energy(&u).to_bits(), law.energy(&u).to_bits());
        assert_eq!(any.first_piola_and_tangent(&u), law.first_piola_and_tangent(&u));
        assert_eq!(any.cauchy(&u), law.cauchy(&u));
        assert_eq!(any.check(&u), law.check(&u));
    }
    assert_eq!(any.reference_energy().to_bits(), law.reference_energy().to_bits());
    assert_eq!(any.reference_stress(), law.reference_stress());
}

#[test]
fn answers_of_the_one_type_equal_those_of_the_law() -> Result<(), ConstitutiveError> {
    check(&Compressible::new(Gent::new(0.8, 30.0)?, SimoTaylor::new(5.0)?));
    check(&IncompressibleSolid::new(MooneyRivlin::new(0.5, 0.25)?).at_excess_pressure(0.25)?);
    check(&SaintVenantKirchhoff::new(1.5, 0.75)?);
    check(&Hencky::new(2.0, 0.9)?);
    check(&piola_constitutive::solids::MooneyRivlin::new(0.5, 0.25, 1.25, 3.0)?);
    Ok(())
}

#[test]
fn a_visitor_meets_the_law_that_the_one_type_is() {
    struct Energy(DeformationGradient);
    impl SolidVisitor for Energy {
        type Output = f64;
        fn visit<L: Hyperelastic + Sync>(self, law: &L) -> f64 {
            law.energy(&self.0)
        }
    }
    let f = DeformationGradient::from_rows([[1.1, 0.2, 0.0], [-0.1, 0.9, 0.3], [0.05, 0.1, 1.02]]).expect("0 < det F");
    for (law, _) in super::laws::all() {
        assert_eq!(law.visit(Energy(f)).to_bits(), law.energy(&f).to_bits(), "{law:?}");
    }
}

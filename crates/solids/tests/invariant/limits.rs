//! What laws refuse: deformations beyond their limits.

use piola_continuum::DeformationGradient;
use piola_solids::SolidsError;
use piola_solids::isochoric::{ArrudaBoyce, Gent, NeoHookean};
use piola_solids::volumetric::Quadratic;
use piola_solids::{Compressible, Hyperelastic, IncompressibleSolid};

fn shear(k: f64) -> DeformationGradient {
    DeformationGradient::simple_shear(k).expect("finite")
}

#[test]
fn gent_beyond_its_limit_is_refused_and_not_a_number() {
    let law = Compressible::new(Gent::new(2.0, 4.0).expect("bounds"), Quadratic::new(10.0).expect("bounds"));
    assert_eq!(law.check(&shear(1.9)), Ok(()));
    for k in [2.0, 3.0] {
        let refused = law.check(&shear(k));
        assert!(matches!(refused, Err(SolidsError::BeyondLimit { law: "Gent", limit: 4.0, .. })), "{refused:?}");
        assert!(law.energy(&shear(k)).is_nan());
        assert!(law.first_piola(&shear(k)).0[(0, 0)].is_nan());
        assert!(law.first_piola_tangent(&shear(k)).entry(0, 0, 0, 0).is_nan());
    }
}

#[test]
fn arruda_boyce_beyond_its_limit_is_refused_and_not_a_number() {
    let law = IncompressibleSolid::new(ArrudaBoyce::new(2.0, 2.0).expect("bounds"));
    assert_eq!(law.check(&shear(1.7)), Ok(()));
    let refused = law.check(&shear(2.0));
    assert!(matches!(refused, Err(SolidsError::BeyondLimit { law: "Arruda–Boyce", limit: 3.0, .. })), "{refused:?}");
    assert!(law.energy(&shear(2.0)).is_nan());
    assert!(law.first_piola(&shear(2.0)).0[(0, 0)].is_nan());
}

#[test]
fn change_of_volume_of_an_incompressible_solid_is_refused() {
    let law = IncompressibleSolid::new(NeoHookean::new(2.0).expect("bounds"));
    let refused = law.check(&DeformationGradient::dilatation(1.1).expect("positive"));
    assert!(matches!(refused, Err(SolidsError::BeyondLimit { quantity: "|J − 1|", .. })), "{refused:?}");
}

//! The one type answers as the law itself, to the last bit.

use piola_continuum::DeformationGradient;
use piola_solids::SolidsError;
use piola_solids::isochoric::{Gent, MooneyRivlin};
use piola_solids::volumetric::SimoTaylor;
use piola_solids::{
    AnySolid, Compressible, Hencky, Hyperelastic, IncompressibleSolid, SaintVenantKirchhoff, SolidVisitor,
};

use super::once::Once;

fn check<L: Hyperelastic + Clone + Into<AnySolid>>(law: &L) {
    let any: AnySolid = law.clone().into();
    let law = Once(law);
    for size in [1e-9, 0.3] {
        let h = [[0.3, -0.2, 0.5], [0.4, 0.7, -0.1], [-0.6, 0.2, 0.9]].map(|row| row.map(|x| size * x));
        let rows = core::array::from_fn(|i| core::array::from_fn(|j| h[i][j] + if i == j { 1.0 } else { 0.0 }));
        let u = DeformationGradient::<f64>::from_rows(rows).expect("0 < det F");
        assert_eq!(any.energy(&u).to_bits(), law.energy(&u).to_bits());
        assert_eq!(any.first_piola_and_tangent(&u), law.first_piola_and_tangent(&u));
        assert_eq!(any.energy_first_piola_and_tangent(&u), law.energy_first_piola_and_tangent(&u));
        assert_eq!(any.cauchy(&u), law.cauchy(&u));
        assert_eq!(any.check(&u), law.check(&u));
    }
    assert_eq!(any.reference_energy().to_bits(), law.reference_energy().to_bits());
    assert_eq!(any.reference_stress(), law.reference_stress());
}

#[test]
fn answers_of_the_one_type_equal_those_of_the_law() -> Result<(), SolidsError> {
    check(&Compressible::new(Gent::new(0.8, 30.0)?, SimoTaylor::new(5.0)?));
    check(&IncompressibleSolid::new(MooneyRivlin::new(0.5, 0.25)?).at_excess_pressure(0.25)?);
    check(&SaintVenantKirchhoff::new(1.5, 0.75)?);
    check(&Hencky::new(2.0, 0.9)?);
    check(&piola_solids::MooneyRivlin::new(0.5, 0.25, 1.25, 3.0)?);
    Ok(())
}

#[test]
fn a_visitor_meets_the_law_that_the_one_type_is() {
    /// The name of its type, of which no kernel need be compiled.
    struct Name;
    impl SolidVisitor for Name {
        type Output = &'static str;
        fn visit<L: Hyperelastic + Sync>(self, _law: &L) -> &'static str {
            core::any::type_name::<L>()
        }
    }
    for (law, _) in super::laws::all() {
        let variant = format!("{law:?}");
        let (name, _) = variant.split_once('(').expect("a variant");
        let (name, met) = (name.replace("Incompressible", ""), law.visit(Name));
        assert!(met.contains(&name), "{name}: {met}");
    }
}

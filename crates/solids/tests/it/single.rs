//! Every kind of law in single precision against double precision.

use piola_continuum::DisplacementGradient;
use piola_solids::isochoric::{self, ArrudaBoyce, Gent, Yeoh};
use piola_solids::volumetric::Quadratic;
use piola_solids::{
    BlatzKo, Compressible, Fibre, Fung, Hencky, HolzapfelGasserOgden, Hyperelastic, IncompressibleSolid,
    IsochoricOgden, MooneyRivlin, NeoHookeanCiarlet, NeoHookeanLogarithmic, Ogden, OgdenTerm, Pressurised,
    ReinforcedNeoHookean, SaintVenantKirchhoff, Stiffness,
};
use piola_testkit::{Tol, assert_close};

const TERMS: [OgdenTerm; 2] = [OgdenTerm { modulus: 0.6, exponent: 1.3 }, OgdenTerm { modulus: -0.02, exponent: -2.0 }];

/// ∇u of single precision, the same numbers in double.
#[expect(clippy::cast_possible_truncation, reason = "that is what single precision is")]
fn states() -> impl Iterator<Item = (f64, DisplacementGradient<f32>, DisplacementGradient)> {
    let shape = [[0.7, -0.4, 0.2], [0.3, -0.5, 0.6], [-0.1, 0.25, -0.35]];
    [4e-7, 1e-5, 1e-3, 0.02, 0.1, 0.4].into_iter().map(move |size| {
        let single = shape.map(|row| row.map(|x| (x * size) as f32));
        let double = single.map(|row| row.map(f64::from));
        let single = DisplacementGradient::from_rows(single).expect("0 < det F");
        (size, single, DisplacementGradient::from_rows(double).expect("0 < det F"))
    })
}

fn agrees(name: &str, law: &impl Hyperelastic) {
    let rounding = Tol::ulps32(16.0);
    // What is incompressible is compared where the volume changes by rounding alone.
    let largest = if law.is_incompressible() { 1e-5 } else { 1.0 };
    let states: Vec<_> = states().filter(|(size, ..)| *size <= largest).collect();
    assert_eq!(states.len(), if law.is_incompressible() { 2 } else { 6 }, "{name}");
    for (size, single, double) in states {
        let wide = |entries: &[f32]| entries.iter().map(|x| f64::from(*x)).collect::<Vec<_>>();
        let what = |quantity: &str| format!("{name} at {size:e}: {quantity}");
        assert_close(&what("W"), &wide(&[law.energy(&single)]), &[law.energy(&double)], rounding);
        let (stress, tangent) = law.first_piola_and_tangent(&single);
        let (expected, stiffness) = law.first_piola_and_tangent(&double);
        assert_close(&what("P"), &wide(stress.0.as_slice()), expected.0.as_slice(), rounding);
        let (found, stiffness) = (tangent.0.components, stiffness.0.components);
        assert_close(&what("∂P/∂F"), &wide(found.as_flattened()), stiffness.as_flattened(), rounding);
        let (found, expected) = (law.second_piola(&single).0.components, law.second_piola(&double).0.components);
        assert_close(&what("S"), &wide(&found), &expected, rounding);
        let (found, expected) = (law.cauchy(&single).0.components, law.cauchy(&double).0.components);
        assert_close(&what("T"), &wide(&found), &expected, rounding);
    }
}

#[test]
fn laws_in_single_precision_equal_those_in_double_to_rounding() -> Result<(), piola_solids::SolidsError> {
    let bulk = Quadratic::new(5.0)?;
    let mooney = isochoric::MooneyRivlin::new(0.5, 0.25)?;
    agrees("Mooney–Rivlin", &MooneyRivlin::stress_free(0.5, 0.25, 1.25)?);
    agrees("isochoric Mooney–Rivlin", &Compressible::new(mooney, bulk));
    agrees("Yeoh", &Compressible::new(Yeoh::new(0.5, -0.05, 0.01)?, bulk));
    agrees("Gent", &Compressible::new(Gent::new(0.8, 30.0)?, bulk));
    agrees("Arruda–Boyce", &Compressible::new(ArrudaBoyce::new(0.8, 9.0)?, bulk));
    agrees("neo-Hookean of ln J", &NeoHookeanLogarithmic::with_constants(0.8, 3.0)?);
    agrees("neo-Hookean of Ciarlet", &NeoHookeanCiarlet::with_constants(0.8, 3.0)?);
    agrees("Saint-Venant–Kirchhoff", &SaintVenantKirchhoff::new(1.5, 0.75)?);
    agrees("Blatz–Ko", &BlatzKo::new(0.8, 0.4, 0.7)?);
    agrees("Ogden", &Ogden::new(&TERMS, 2.0)?);
    agrees("isochoric Ogden", &IsochoricOgden::new(&TERMS, 5.0)?);
    agrees("Hencky", &Hencky::new(1.5, 0.75)?);
    let axis = Fibre::new([0.6, 0.0, 0.8])?;
    agrees("reinforced", &ReinforcedNeoHookean::new(1.0, 2.0, 3.0, axis)?);
    agrees("Fung", &Fung::new(0.5, Stiffness::isotropic(1.0, 0.5)?)?);
    let fibres = [Fibre::in_plane(0.6)?, Fibre::in_plane(-0.6)?];
    agrees("wall", &HolzapfelGasserOgden::new(1.0, 5.0, 2.0, 1.0, 0.1, fibres)?);
    agrees("incompressible Mooney–Rivlin", &IncompressibleSolid::new(mooney));
    agrees("pressurised Hencky", &Pressurised::new(Hencky::new(1.5, 0.75)?).at_pressure(0.5)?);
    Ok(())
}

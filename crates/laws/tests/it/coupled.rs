//! Coupled forms of the literature: limits that are known in closed form, derivatives, refusals.

use core::error::Error;

use piola_continuum::{DeformationGradient, DisplacementGradient};

use piola_laws::coupled::{GentCoupled, HolzapfelCoupled};
use piola_laws::{OfInvariants, OfVolume, Sum};
use piola_solids::volumetric::QuadraticLogarithmic;
use piola_solids::{Fibre, Fung, Hyperelastic, NeoHookeanLogarithmic, SolidsError, Stiffness, derived};
use piola_testkit::{Tol, assert_close};

fn sample() -> DeformationGradient {
    DeformationGradient::from_rows([[1.1, 0.2, 0.0], [-0.1, 0.9, 0.3], [0.05, 0.1, 1.02]]).expect("0 < det F")
}

/// For m → ∞ Gent's law is the neo-Hookean one; so is Holzapfel's where the fibres are pressed.
#[test]
fn limits_of_coupled_laws_equal_the_neo_hookean_law() -> Result<(), Box<dyn Error>> {
    let plain = NeoHookeanLogarithmic::with_constants(0.8, 3.0)?;
    let gent = OfInvariants(GentCoupled::new(0.8, 1e18, 3.0)?);
    let f = sample();
    let tol = Tol::ulps(64.0);
    assert_close("Gent", gent.first_piola(&f).0.as_slice(), plain.first_piola(&f).0.as_slice(), tol);
    let fibres = OfInvariants(HolzapfelCoupled::new(0.8, 3.0, 5.0, 2.0, Fibre::new([0.0, 1.0, 0.0])?)?);
    let pressed = DeformationGradient::diagonal([1.2, 0.8, 1.1])?;
    let (stress, tangent) = fibres.first_piola_and_tangent(&pressed);
    let (expected, expected_tangent) = plain.first_piola_and_tangent(&pressed);
    assert_close("Holzapfel, P", stress.0.as_slice(), expected.0.as_slice(), tol);
    let (a, b) = (tangent.0.components.concat(), expected_tangent.0.components.concat());
    assert_close("Holzapfel, ∂P/∂F", &a, &b, tol);
    Ok(())
}

#[test]
fn answers_of_coupled_laws_equal_derivatives_of_their_energies() -> Result<(), Box<dyn Error>> {
    fn check(what: &str, law: &impl Hyperelastic) {
        let f = sample();
        let (p, a) = law.first_piola_and_tangent(&f);
        let (q, b) = derived::first_piola_and_tangent(law, &f);
        let tol = Tol::ulps_because(256.0, "two orders of summation of some hundred terms");
        assert_close(what, p.0.as_slice(), q.0.as_slice(), tol);
        assert_close(what, &a.0.components.concat(), &b.0.components.concat(), tol);
    }
    check("Gent", &OfInvariants(GentCoupled::new(0.8, 2.0, 3.0)?));
    check("Holzapfel", &OfInvariants(HolzapfelCoupled::new(0.8, 3.0, 5.0, 2.0, Fibre::new([1.0, 0.5, 0.0])?)?));
    let tissue = Fung::new(1.5, Stiffness::isotropic(1.0, 2.0)?)?;
    check("Fung with a volume term", &Sum(tissue, OfVolume(QuadraticLogarithmic::new(3.0)?)));
    Ok(())
}

/// P = (λ + 2 μ/m) tr ε 1 + 2 μ ε at small strain, to the last digits.
#[test]
fn coupled_gent_stress_at_small_strain_equals_hookes() -> Result<(), Box<dyn Error>> {
    let law = OfInvariants(GentCoupled::new(0.8, 2.0, 3.0)?);
    let f = DisplacementGradient::from_rows([[1e-17, 2e-17, 0.0], [2e-17, -3e-17, 0.0], [0.0, 0.0, 4e-17]])?;
    let stress = law.first_piola(&f).0;
    // λ + 2 μ/m = 3.8, tr ε = 2e-17.
    let expected = [(0, 0, 7.6e-17 + 1.6e-17), (0, 1, 3.2e-17), (1, 1, 7.6e-17 - 4.8e-17), (2, 2, 7.6e-17 + 6.4e-17)];
    for (i, j, value) in expected {
        assert_close("P", &[stress[(i, j)]], &[value], Tol::ulps(64.0));
    }
    Ok(())
}

#[test]
fn coupled_laws_refuse_parameters_and_deformations_by_name() -> Result<(), Box<dyn Error>> {
    assert!(matches!(GentCoupled::new(0.8, 0.0, 3.0), Err(SolidsError::OutOfBounds { parameter: "limit", .. })));
    let error = GentCoupled::new(f64::NAN, 1.0, 3.0);
    assert!(matches!(error, Err(SolidsError::NotFinite { parameter: "shear_modulus", .. })));
    let law = OfInvariants(GentCoupled::new(0.8, 2.0, 3.0)?);
    let error = law.check(&DeformationGradient::simple_shear(1.5)?);
    assert!(matches!(error, Err(SolidsError::BeyondLimit { limit: 2.0, .. })));
    Ok(())
}
